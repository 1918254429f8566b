#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/lac/space/space.h"
#include "keyline/numeric/binomials.h"

namespace keyline::lac {
namespace {

using core::Point3;

/// Bounds of a quantity and of its derivatives in arc length.
using Bounds = std::array<double, 6>;

/// Of the positions of frames(), by the length.
constexpr double kRounding = 2e-13;
/// Shortest part of a piece one quintic is given to.
constexpr double kShortest = 1e-5;

/// The quintic through both ends with first and second derivatives in arc length; h: the length.
curve::Bezier3 quintic(const SpaceFrame& a, double bend_a, const SpaceFrame& b, double bend_b,
                       double h) {
  const auto handle = [h](const SpaceFrame& f, double bend, double sense, double i) {
    // Points 1 and 2 from either end: i h/5 along the tangent, and h^2/20 kappa n for the second.
    const Point3 p = f.position + sense * i * h / 5 * f.tangent;
    return i < 2 ? p : p + h * h / 20 * bend * f.normal;
  };
  return {{a.position, handle(a, bend_a, 1, 1), handle(a, bend_a, 1, 2), handle(b, bend_b, -1, 2),
           handle(b, bend_b, -1, 1), b.position},
          {}};
}

/// |kappa| and its derivatives at one place. kappa^-alpha is linear, so each derivative is
/// (1 + j alpha) kappa' / kappa times the one before.
Bounds derivatives_at(const Piece& law, double t) {
  Bounds all{};
  all[0] = std::abs(curvature(law, t));
  if (law.curvature_start == law.curvature_end) return all;
  if (all[0] == 0) {  // as distance^order: finite up to it
    const double order = -1 / law.alpha;
    const bool whole = std::abs(order - std::round(order)) < 1e-12;
    for (std::size_t n = 1; n < all.size(); ++n) {
      const bool vanishes = static_cast<double>(n) < order - 0.5 || whole;
      if (!vanishes) all[n] = HUGE_VAL;
    }
    return all;
  }
  all[1] = std::abs(curvature_rate(law, t));
  const double ratio = all[1] / all[0];
  for (std::size_t n = 2; n < all.size(); ++n) {
    const double factor = std::abs(1 + static_cast<double>(n - 1) * law.alpha);
    all[n] = factor < 1e-14 ? 0 : all[n - 1] * factor * ratio;
  }
  return all;
}

/// Over [from, to], free of zeros inside: every derivative is a power of a linear function and so
/// largest at an end.
Bounds derivatives_over(const Piece& law, double from, double to) {
  Bounds most = derivatives_at(law, from);
  const Bounds other = derivatives_at(law, to);
  for (std::size_t n = 0; n < most.size(); ++n) most[n] = std::max(most[n], other[n]);
  return most;
}

/// Bounds of (a b) and of its derivatives added to those of the derivative of c.
Bounds derivative_and_products(const Bounds& c, const Bounds& k, const Bounds& b, const Bounds& t,
                               const Bounds& d) {
  const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; };
  Bounds sum{};
  for (std::size_t n = 0; n < 5; ++n) {
    sum[n] = c[n + 1];
    for (std::size_t j = 0; j <= n; ++j)
      sum[n] += numeric::kBinomials<4>[n][j] * (product(k[j], b[n - j]) + product(t[j], d[n - j]));
  }
  return sum;
}

/// Bound of the distance at equal arc length between the curve over [from, to] of a piece and its
/// quintic. Of several bounds c_k h^k max |C^(k)|, k = 2 ... 6, the least; the constants are those
/// of Peano's kernels of quintic Hermite interpolation, found numerically and rounded up (k = 6:
/// exactly 1/46080). The derivatives follow from Frenet's equations with all signs positive.
double departure(const SpacePiece& piece, double from, double to) {
  constexpr std::array<double, 7> kConstant = {0,          0,           1 / 10.2,   1 / 161.0,
                                               1 / 1475.0, 1 / 10235.0, 1 / 46080.0};
  const Bounds bend = derivatives_over(curvature_law(piece), from, to);
  const Bounds twist = derivatives_over(torsion_law(piece), from, to);
  const double h = (to - from) * piece.length;
  const Bounds none{};
  Bounds tangent{1};
  Bounds normal{};
  Bounds binormal{};
  double least = HUGE_VAL;
  double power = h;
  for (std::size_t k = 2; k <= 6; ++k) {
    const Bounds t = derivative_and_products(tangent, bend, normal, none, none);
    const Bounds n = derivative_and_products(normal, bend, tangent, twist, binormal);
    const Bounds b = derivative_and_products(binormal, twist, normal, none, none);
    tangent = t;
    normal = n;
    binormal = b;
    power *= h;
    const double size = std::hypot(t[0], n[0], b[0]);
    if (std::isfinite(size)) least = std::min(least, kConstant[k] * power * size);
  }
  return least;
}

/// The furthest place a quintic from `from` can reach within the tolerance, at most `to`.
double reach(const SpacePiece& piece, double from, double to, double tolerance) {
  if (departure(piece, from, to) <= tolerance) return to;
  double low = std::min(kShortest, to - from);
  double high = to - from;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (departure(piece, from, from + middle) <= tolerance ? low : high) = middle;
  }
  return from + low;
}

/// 0, zeros of curvature and torsion, 1.
std::vector<double> smooth_parts(const SpacePiece& piece) {
  return breakpoints(SpaceChain{{}, {piece}});
}

/// Ends of the quintics of one piece, its start left out.
std::vector<double> cuts(const SpacePiece& piece, double tolerance) {
  std::vector<double> at;
  const std::vector<double> stops = smooth_parts(piece);
  for (std::size_t i = 1; i < stops.size(); ++i) {
    double from = stops[i - 1];
    while (from < stops[i]) {
      from = reach(piece, from, stops[i], tolerance);
      at.push_back(from);
    }
  }
  return at;
}

}  // namespace

SpaceBeziers approximate_by_quintics(const SpaceChain& chain, double tolerance) {
  if (!(tolerance > 0)) throw core::InvalidInput("approximate_by_quintics: tolerance not > 0");
  const double rounding = kRounding * arc_length(chain);
  const double allowed = std::max(tolerance - rounding, rounding);
  SpaceBeziers made;
  SpaceFrame start = chain.start;
  for (const SpacePiece& piece : chain.pieces) {
    const std::vector<double> at = cuts(piece, allowed);
    const std::vector<SpaceFrame> where = frames({start, {piece}}, at);
    double from = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const SpaceFrame& first = i == 0 ? start : where[i - 1];
      const Piece law = curvature_law(piece);
      made.pieces.push_back(quintic(first, curvature(law, from), where[i], curvature(law, at[i]),
                                    (at[i] - from) * piece.length));
      made.deviation = std::max(made.deviation, departure(piece, from, at[i]) + rounding);
      from = at[i];
    }
    start = where.back();
  }
  return made;
}

}  // namespace keyline::lac
