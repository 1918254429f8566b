#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/curve/monotone.h"
#include "keyline/lac/cad/cad_cubic.h"
#include "keyline/numeric/binomials.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

constexpr std::size_t kMostPieces = 100000;
constexpr double kShortest = 0.01;       ///< of the length: not made shorter for monotone curvature
constexpr double kCoarsestTable = 1e-7;  ///< a short cubic must not follow the table's errors
/// Share of the tolerance that an estimated error may have, and that is aimed at: the bound is up
/// to 6 % above it.
constexpr double kLeastShare = 0.84, kAimedShare = 0.92, kMostShare = 0.95;
constexpr int kMostRefused = 8;  ///< cubics whose curvature is not monotone

/// a times b in Bernstein's basis.
template <std::size_t A, std::size_t B>
std::array<double, A + B - 1> product(const std::array<double, A>& a,
                                      const std::array<double, B>& b) {
  constexpr const auto& kBinomials = numeric::kBinomials<A + B - 2>;
  std::array<double, A + B - 1> c{};
  for (std::size_t i = 0; i < A; ++i)
    for (std::size_t j = 0; j < B; ++j)
      c[i + j] += a[i] * b[j] * (kBinomials[A - 1][i] * kBinomials[B - 1][j]);
  for (std::size_t k = 0; k < c.size(); ++k) c[k] /= kBinomials[A + B - 2][k];
  return c;
}

}  // namespace

bool plainly_monotone(const Cubic& c) {
  const auto& b = c.control;
  const std::array<Vector2, 3> d{b[1] - b[0], b[2] - b[1], b[3] - b[2]};  // C' / 3
  const std::array<Vector2, 2> e{d[1] - d[0], d[2] - d[1]};               // C'' / 6
  const Vector2 f = e[1] - e[0];                                          // C''' / 6
  const std::array<double, 3> x{d[0].x, d[1].x, d[2].x};
  const std::array<double, 3> y{d[0].y, d[1].y, d[2].y};
  const std::array<double, 2> u{e[0].x, e[1].x};
  const std::array<double, 2> v{e[0].y, e[1].y};
  const auto xu = product(x, u), yv = product(y, v), xv = product(x, v), yu = product(y, u);
  const auto xx = product(x, x), yy = product(y, y);
  std::array<double, 5> speed{};
  std::array<double, 4> along{};
  for (std::size_t i = 0; i < 5; ++i) speed[i] = xx[i] + yy[i];
  for (std::size_t i = 0; i < 4; ++i) along[i] = xu[i] + yv[i];
  // d x e and d x f are of degrees 2 and 1: their leading terms cancel.
  const double first_bend = xv[0] - yu[0];
  const std::array<double, 3> bend{first_bend, (3 * (xv[1] - yu[1]) - first_bend) / 2,
                                   xv[3] - yu[3]};
  const auto first = product(std::array{cross(d[0], f), cross(d[2], f)}, speed);
  const auto second = product(bend, along);
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  double size = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const double n = first[i] - 6 * second[i];
    least = std::min(least, n);
    most = std::max(most, n);
    size = std::max(size, std::abs(first[i]) + 6 * std::abs(second[i]));
  }
  return least > 1e-12 * size || most < -1e-12 * size;
}

namespace {

bool is_monotone(const Cubic& c) {
  if (plainly_monotone(c)) return true;
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
        table_(unit, std::min(3e-3 * tolerance, kCoarsestTable)),
        end_(exact_frame(unit, 1)) {}

  std::vector<CubicPiece> run() {
    std::vector<CubicPiece> pieces;
    double v = 0;
    Frame start = exact_frame(unit_, 0);
    double width = 1;
    while (v < 1) {
      const auto next = longest(v, start, width);
      if (!(next.piece.v1 > v) || pieces.size() > kMostPieces) return {};
      pieces.push_back(next.piece);
      width = next.piece.v1 - v;
      v = next.piece.v1;
      start = next.end;
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

  /// Handles differ as the ends do: by some 0.17 times the logarithm of the curvatures' ratio; how
  /// much exactly is learnt from one cubic for the next.
  CubicTry tried(double v0, double v1, const Frame& start, const Frame& end, bool last) {
    const double l = log_ratio(v0, v1);
    const HandleGuess guess{std::clamp(tilt_rate_ * l, -0.25, 0.25),
                            (last ? 0.1 : 0.2) * tolerance_,
                            last ? 64 * tolerance_ : 8 * tolerance_};
    const CubicTry c = try_cubic(table_, v0, v1, start, end, guess);
    if (c.sound && std::abs(l) > 1e-6 && c.error < 4 * tolerance_)
      tilt_rate_ = std::clamp(c.tilt / l, -0.1, 0.3);
    return c;
  }

  struct Width {
    double width = 1;
    std::optional<CubicTry> whole;  ///< the cubic over all the rest, where that is the width
  };

  /// Width whose estimated error is just within the tolerance. The error grows about with its sixth
  /// power; with which exactly the last two tries tell.
  Width fitting_width(double v0, const Frame& start, double width, double rest) {
    double most = rest;
    double power = 6;
    double before = 0, share_before = 0;
    if (1.25 * width > rest) width = rest;
    for (int step = 0; step < 16; ++step) {
      width = std::min(width, most);
      const bool whole = width == rest;
      const CubicTry c =
          tried(v0, v0 + width, start, whole ? end_ : rough_frame(v0 + width), false);
      if (!c.sound) {
        most = width;
        width *= 0.5;
        continue;
      }
      const double share = std::max(c.error / tolerance_, 1e-12);
      if (whole && share <= 1) return {width, c};
      if (share <= kMostShare && share > kLeastShare) return {width, {}};
      if (share <= 1 && width == most) return {width, {}};
      if (before > 0 && std::abs(before - width) > 1e-3 * width)
        power = std::clamp(std::log(share / share_before) / std::log(width / before), 4.0, 8.0);
      before = width;
      share_before = share;
      width *= std::clamp(std::pow(kAimedShare / share, 1 / power), 0.3, 4.0);
    }
    return {width, {}};
  }

  Laid longest(double v0, const Frame& start, double width) {
    const double rest = 1 - v0;
    const Width fitting = fitting_width(v0, start, width, rest);
    width = fitting.width;
    std::optional<Laid> longest;  // within the tolerance, monotone or not
    int refused = 0;
    for (int step = 0; step < 60; ++step) {
      if (!(width > 1e-9)) break;
      if (width > 0.999 * rest && width < rest) width = rest;
      const double v1 = width == rest ? 1.0 : v0 + width;
      const bool whole = fitting.whole && width == rest;
      const Frame end = v1 == 1 ? end_ : exact_frame(unit_, v1);
      const CubicTry c = whole ? *fitting.whole : tried(v0, v1, start, end, true);
      const double bound =
          c.sound ? cubic_bound(table_, v0, v1, c.cubic, tolerance_) : 64 * tolerance_;
      if (bound <= tolerance_) {
        Laid laid{{c.cubic, v0, v1, bound}, end};
        laid.piece.monotone = monotone_ ? is_monotone(c.cubic) : plainly_monotone(c.cubic);
        if (!monotone_ || laid.piece.monotone || width < kShortest) return laid;
        if (!longest) longest = laid;
        if (++refused > kMostRefused) break;
      }
      width *= bound <= tolerance_ ? 0.9 : std::pow(0.98 * tolerance_ / bound, 1.0 / 6);
    }
    return longest ? *longest : within_a_disc(v0, start);
  }

  /// Where the curve turns within less than the tolerance, as close to a cusp: a stretch so short
  /// that whatever joins its ends stays within its length of it.
  Laid within_a_disc(double v0, const Frame& start) const {
    const double width = std::min(1 - v0, 0.9 * tolerance_);
    const double v1 = width < 1 - v0 ? v0 + width : 1.0;
    const Frame end = exact_frame(unit_, v1);
    const double handle = width / 3;
    const Cubic cubic{{start.point, start.point + handle * start.tangent,
                       end.point - handle * end.tangent, end.point}};
    return {{cubic, v0, v1, width, plainly_monotone(cubic)}, end};
  }

  const UnitPiece& unit_;
  double tolerance_;
  bool monotone_;
  SeriesTable table_;
  Frame end_;
  double tilt_rate_ = 0.17;
};

}  // namespace

std::vector<CubicPiece> cubics_of(const UnitPiece& unit, double tolerance, bool monotone) {
  return Cover(unit, tolerance, monotone).run();
}

}  // namespace keyline::lac::detail
