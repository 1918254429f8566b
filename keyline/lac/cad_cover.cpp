#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/curve/monotone.h"
#include "keyline/lac/cad_cubic.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

constexpr std::size_t kMostPieces = 100000;
constexpr double kShortest = 0.01;       ///< of the length: not made shorter for monotone curvature
constexpr double kCoarsestTable = 1e-9;  ///< a short cubic must not follow the table's errors
constexpr int kMostRefused = 8;          ///< cubics whose curvature is not monotone

bool is_monotone(const Cubic& c) {
  curve::Bezier2 b;
  for (const Vector2 v : c.control) b.control.push_back({v.x, v.y});
  return curve::certify_monotone_curvature(b).answer == curve::MonotoneVerdict::yes;
}

/// Lays cubic after cubic along the piece.
class Cover {
 public:
  Cover(const UnitPiece& unit, double tolerance, bool monotone)
      : unit_(unit),
        tolerance_(tolerance),
        monotone_(monotone && unit.piece.curvature_start != unit.piece.curvature_end),
        table_(unit, std::min(2e-3 * tolerance, kCoarsestTable)) {}

  std::vector<CubicPiece> run() {
    std::vector<CubicPiece> pieces;
    double v = 0;
    Frame start = exact_frame(unit_, 0);
    double width = 1;
    while (v < 1) {
      const auto next = longest(v, start, width);
      if (!next || pieces.size() > kMostPieces) return {};
      pieces.push_back(next->piece);
      width = next->piece.v1 - v;
      v = next->piece.v1;
      start = next->end;
    }
    return pieces;
  }

 private:
  struct Laid {
    CubicPiece piece;
    Frame end;
  };

  Frame rough_frame(double v) const {
    const Vector2 d = table_.velocity(v);
    return {table_.point(v), d / norm(d)};
  }

  double log_ratio(double v0, double v1) const {
    const double l = std::log(curvature(unit_.piece, v1) / curvature(unit_.piece, v0));
    return std::isfinite(l) ? l : 0;
  }

  /// Handles differ as the ends do: by some -0.1 times the logarithm of the curvatures' ratio; how
  /// much exactly is learnt from one cubic for the next.
  CubicTry tried(double v0, double v1, const Frame& start, const Frame& end, bool last) {
    const double l = log_ratio(v0, v1);
    const HandleGuess guess{std::clamp(tilt_rate_ * l, -0.25, 0.25), 0.05 * tolerance_,
                            last ? 64 * tolerance_ : 8 * tolerance_};
    const CubicTry c = try_cubic(table_, v0, v1, start, end, guess);
    if (c.sound && std::abs(l) > 1e-6 && c.error < 4 * tolerance_)
      tilt_rate_ = std::clamp(c.tilt / l, -0.3, 0.1);
    return c;
  }

  /// Width whose estimated error is just within the tolerance.
  double fitting_width(double v0, const Frame& start, double width, double rest) {
    double most = rest;
    for (int step = 0; step < 16; ++step) {
      width = std::min(width, most);
      const CubicTry c = tried(v0, v0 + width, start, rough_frame(v0 + width), false);
      if (!c.sound) {
        most = width;
        width *= 0.5;
        continue;
      }
      const double share = c.error / tolerance_;
      if (share <= 1 && (share > 0.9 || width == rest)) return width;
      const double growth = std::pow(0.95 / std::max(share, 1e-12), 1.0 / 6);
      if (share <= 1 && width == most && most < rest) return width;
      width *= std::clamp(growth, 0.3, 4.0);
    }
    return width;
  }

  std::optional<Laid> longest(double v0, const Frame& start, double width) {
    const double rest = 1 - v0;
    width = fitting_width(v0, start, width, rest);
    std::optional<Laid> longest;  // within the tolerance, monotone or not
    int refused = 0;
    for (int step = 0; step < 60; ++step) {
      if (!(width > 1e-9)) break;
      if (width > 0.999 * rest && width < rest) width = rest;
      const double v1 = width == rest ? 1.0 : v0 + width;
      const Frame end = exact_frame(unit_, v1);
      const CubicTry c = tried(v0, v1, start, end, true);
      const double bound =
          c.sound ? cubic_bound(table_, v0, v1, c.cubic, tolerance_) : 64 * tolerance_;
      if (bound <= tolerance_) {
        Laid laid{{c.cubic, v0, v1, bound}, end};
        if (monotone_) laid.piece.monotone = is_monotone(c.cubic);
        if (!monotone_ || laid.piece.monotone || width < kShortest) return laid;
        if (!longest) longest = laid;
        if (++refused > kMostRefused) break;
      }
      width *= bound <= tolerance_ ? 0.9 : std::pow(0.98 * tolerance_ / bound, 1.0 / 6);
    }
    return longest;
  }

  const UnitPiece& unit_;
  double tolerance_;
  bool monotone_;
  SeriesTable table_;
  double tilt_rate_ = -0.12;
};

}  // namespace

std::vector<CubicPiece> cubics_of(const UnitPiece& unit, double tolerance, bool monotone) {
  return Cover(unit, tolerance, monotone).run();
}

}  // namespace keyline::lac::detail
