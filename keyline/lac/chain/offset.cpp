#include "keyline/lac/chain/offset.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::Pose2;
using core::Vector2;

double finite_or_zero(double x) { return std::isfinite(x) ? x : 0.0; }

/// Length of the chain before each piece, and the whole.
std::vector<double> lengths_before(const Chain& chain) {
  std::vector<double> sum{0};
  for (const Piece& p : chain.pieces) sum.push_back(sum.back() + p.length);
  return sum;
}

/// Fraction of the piece's length at which its curvature is k; -1 where it is not strictly inside.
double fraction_at_curvature(const Piece& p, double k) {
  const double low = std::min(p.curvature_start, p.curvature_end);
  const double high = std::max(p.curvature_start, p.curvature_end);
  if (!(k > low && k < high)) return -1;
  const auto t = numeric::bracketed_root([&](double v) { return curvature(p, v) - k; }, 0, 1, 0);
  return t && *t > 0 && *t < 1 ? *t : -1;
}

/// Fractions at which the tangent is parallel to the line, with 0, 1 and the inflection.
std::vector<double> turning_points(const Segment& s, double line_direction) {
  std::vector<double> at = breakpoints(s);
  const Piece whole = piece_of(s);
  const std::vector<double> arms = at;
  for (std::size_t i = 0; i + 1 < arms.size(); ++i) {
    const double from = tangent_angle(s, arms[i]) - line_direction;
    const double to = tangent_angle(s, arms[i + 1]) - line_direction;
    const Piece arm = part(whole, arms[i], arms[i + 1]);
    const double first = std::ceil(std::min(from, to) / core::kPi);
    const double last = std::floor(std::max(from, to) / core::kPi);
    for (double k = first; k <= last && from != to; ++k) {
      const double u = std::clamp((k * core::kPi - from) / (to - from), 0.0, 1.0);
      at.push_back(arms[i] + fraction_at_turning(arm, u) * (arms[i + 1] - arms[i]));
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

core::Point2 evaluate(const OffsetCurve& c, double t) {
  return evaluate(c.base, t) +
         c.distance * core::perpendicular_left(core::unit_vector(tangent_angle(c.base, t)));
}

curve::Jet2 jet(const OffsetCurve& c, double t) {
  const ChainLocation at = locate(c.base, t);
  const Piece& piece = c.base.pieces[at.piece];
  const double length = arc_length(c.base);
  const double d = c.distance;
  const double k = finite_or_zero(curvature(piece, at.t));
  const double k1 = finite_or_zero(curvature_rate(piece, at.t));
  // kappa' goes as kappa^(1 + alpha).
  const double k2 = k == 0 ? 0 : finite_or_zero((1 + piece.alpha) * k1 * k1 / k);
  const Vector2 tangent = core::unit_vector(tangent_angle(c.base, t));
  const Vector2 normal = core::perpendicular_left(tangent);
  const double g = 1 - d * k;
  return {evaluate(c, t), (length * g) * tangent,
          length * length * (g * k * normal - d * k1 * tangent),
          length * length * length *
              ((g * k1 - 2 * d * k * k1) * normal - (g * k * k + d * k2) * tangent)};
}

std::vector<double> offset_cusps(const OffsetCurve& c) {
  std::vector<double> cusps;
  if (c.distance == 0) return cusps;
  const auto before = lengths_before(c.base);
  for (std::size_t i = 0; i < c.base.pieces.size(); ++i) {
    const double t = fraction_at_curvature(c.base.pieces[i], 1 / c.distance);
    if (t > 0) cusps.push_back((before[i] + t * c.base.pieces[i].length) / before.back());
  }
  return cusps;
}

std::vector<double> breakpoints(const OffsetCurve& c) {
  std::vector<double> all = breakpoints(c.base);
  const auto cusps = offset_cusps(c);
  all.insert(all.end(), cusps.begin(), cusps.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<double> intersections(const Segment& segment, const Pose2& line) {
  const auto height = [&](double t) { return to_local(line, evaluate(segment, t)).y; };
  const double touch = 1e-13 * segment.length;
  const auto at = turning_points(segment, line.direction);
  std::vector<double> found;
  const auto add = [&](double t) {
    if (found.empty() || t > found.back() + 1e-12) found.push_back(t);
  };
  double before = height(at[0]);
  if (std::abs(before) <= touch) add(at[0]);
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double here = height(at[i]);
    const bool crosses = std::abs(before) > touch && std::abs(here) > touch && before * here < 0;
    if (crosses) {
      if (const auto t = numeric::bracketed_root(height, at[i - 1], at[i], 1e-16)) add(*t);
    }
    if (std::abs(here) <= touch) add(at[i]);
    before = here;
  }
  return found;
}

std::vector<double> intersections(const Chain& chain, const Pose2& line) {
  const auto before = lengths_before(chain);
  const auto placed = segments(chain);
  std::vector<double> found;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (const double t : intersections(placed[i], line)) {
      const double whole = (before[i] + t * placed[i].length) / before.back();
      if (found.empty() || whole > found.back() + 1e-12) found.push_back(whole);
    }
  }
  return found;
}

}  // namespace keyline::lac
