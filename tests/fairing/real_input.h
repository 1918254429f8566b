#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/key_line.h"

/// Key-lines out of the real files beside the project, each named by file and curve.
namespace keyline::fairing::testing {

struct RealLine {
  std::string name;
  acquire::KeyLine line;
};

/// False where the folder of real files is absent: tests skip.
bool real_files_present();

/// Files of points under 1_profiles/`folder`, every curve of them by id; `every` n-th point.
std::vector<RealLine> profiles(const std::string& folder);
/// One curve of one file, first by default.
RealLine profile(const std::string& file, const std::string& id = "", std::size_t every = 1);
/// Car side views made of Bézier curves in any order and direction: strung together.
std::vector<RealLine> bezier_cars();
/// Half-breadths over height, one curve per station of the hull table, in metres.
std::vector<RealLine> hull_stations();
/// Centre-line band of every car cloud.
std::vector<RealLine> car_sections();

}  // namespace keyline::fairing::testing
