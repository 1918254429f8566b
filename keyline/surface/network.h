#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/classa/nearest_space.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/surface/surface.h"

/// Surface aesthetic value of
/// [Oya]. What that key and the others stand for is told in docs/bibliography.md, how open passages
/// are read in docs/readings.md.
namespace keyline::surface {

/// A row or column of a Bézier patch's net, read as the control polygon of a curve. A bicubic patch
/// has A1…A4 (rows, along v) and A5…A8 (columns, along u); other degrees have all rows, then all
/// columns, numbered on.
struct NetworkCurve {
  std::string name;
  bool is_row = true;
  int index = 0;  ///< of the row or column
  std::vector<core::Point3> control;
};
std::vector<NetworkCurve> network_curves(const Net& net);

struct NetworkValue {
  std::string name;
  classa::CurveValue value;
  std::optional<classa::NearestValue> nearest = {};  ///< of types 4 and 5, by add_nearest
};

/// [Oya] Eq. 8.
struct SurfaceValue {
  double sav = 0;  ///< sum of the curves' CAVs
  std::vector<NetworkValue> curves;
  std::size_t worst = 0;  ///< curve of the largest CAV, the first of equals
};

/// Curves without a length and closed ones have no control matrix: type 5.
/// Errors: bad_input for alpha_max outside (0, pi/2) and as classa::cav; unsupported for a rational
/// patch; undrawable as classa::cav. What one curve fails by has its name before the message and
/// the option as path, or "surface".
core::Result<SurfaceValue> sav(const BezierSurface& s, const classa::CavOptions& options = {});

/// The same with options of each curve's own.
using CavOptionsOf = std::function<classa::CavOptions(const NetworkCurve&)>;
core::Result<SurfaceValue> sav(const BezierSurface& s, const CavOptionsOf& options);

/// The same for each Bézier patch of a surface.
struct PatchValue {
  int row = 0;  ///< span in u
  int column = 0;
  SurfaceValue value;
};

/// Patches are shared among threads (<= 0: all of the machine's); the result does not depend on how
/// many. Errors: as sav, with "patch [i][j]: " before the message, and cancelled.
core::Result<std::vector<PatchValue>> sav_by_patch(const Surface& s,
                                                   const classa::CavOptions& options = {},
                                                   int threads = 1,
                                                   const core::Progress& progress = {});

/// Beside the letter of Tab. 2: gives every curve of type 4 and 5 its nearest curve of one matrix,
/// where it has one (a few milliseconds for each curve). `values` as sav_by_patch found them for s,
/// or some of them. Stops early on cancellation, with curves left without.
void add_nearest(const Surface& s, std::vector<PatchValue>& values,
                 const classa::CavOptions& options = {}, int threads = 1,
                 const core::Progress& progress = {});

}  // namespace keyline::surface
