#pragma once

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <string>

#include <unistd.h>

#include "keyline/lac/chain/chain.h"
#include "keyline/library/library.h"

namespace keyline::library::testing {

/// A folder of its own for every test, gone with it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "keyline-library-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline document::Document one_curve(document::PlanarCurve curve, const std::string& name) {
  document::Document thing;
  thing.unit = "mm";
  thing.paths.push_back({{name, "", ""}, document::Path{{std::move(curve)}, false}, 0});
  return thing;
}

/// A log-aesthetic curve of one to three pieces, another for every seed.
inline lac::Chain random_chain(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  lac::Chain chain;
  chain.start = {{between(-5, 5), between(-5, 5)}, between(-3, 3)};
  double curvature = between(0.05, 2);
  const int pieces = std::uniform_int_distribution<int>(1, 3)(random);
  for (int i = 0; i < pieces; ++i) {
    const double next = between(0.05, 2);
    chain.pieces.push_back({between(-2, 2), between(0.5, 2), curvature, next});
    curvature = next;
  }
  return chain;
}

/// An entry as describe() would make it, without the analysis: what storing needs.
inline Entry quick_entry(unsigned seed) {
  const lac::Chain chain = random_chain(seed);
  Entry entry;
  entry.thing = one_curve({chain}, "curve-" + std::to_string(seed));
  entry.source = "seed";
  entry.size = 1;
  entry.length = lac::arc_length(chain);
  entry.thumbnail = "<svg/>";
  entry.pieces.push_back({1, analysis::Rhythm::minus, {-1.0}, -1.0, 0.0, 0.1, 0.0});
  entry.turning = turning_profile(curve::PlanarView(chain));
  return entry;
}

/// Runs `work` in a process of its own, which may be killed or change its user; what it returns is
/// what went wrong, empty for nothing.
std::string in_child(const std::function<std::string()>& work);

}  // namespace keyline::library::testing
