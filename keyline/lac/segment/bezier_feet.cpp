#include "keyline/lac/segment/bezier_feet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/numeric/roots.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

struct At {
  Vector2 point, velocity;
};

/// de Casteljau, also outside [0, 1].
At at(const Homogeneous& h, double t) {
  std::array<Weighted, curve::kMaxBezierDegree + 1> b;
  const int n = h.degree();
  std::copy(h.control.begin(), h.control.end(), b.begin());
  for (int level = n; level > 1; --level)
    for (int i = 0; i < level; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
  const Weighted value = (1 - t) * b[0] + t * b[1];
  const Weighted slope = n * (b[1] - b[0]);
  const Vector2 p = value.point / value.weight;
  return {p, (slope.point - slope.weight * p) / value.weight};
}

struct Frame {
  Vector2 point, tangent;
};
Frame frame_at(const UnitPiece& unit, double v) {
  return {displacement(unit.piece, v), core::unit_vector(turning(unit.piece, v))};
}

/// Parameter where the Bézier crosses the normal of the segment at v, near the guess; NaN if lost.
double foot(const Homogeneous& h, const Frame& f, double guess) {
  double t = guess;
  for (int step = 0; step < 12; ++step) {
    const At b = at(h, t);
    const double pace = dot(b.velocity, f.tangent);
    if (!(pace > 0)) break;
    const double change = std::clamp(dot(b.point - f.point, f.tangent) / pace, -0.25, 0.25);
    t -= change;
    if (!(t > -0.5 && t < 1.5)) break;
    if (std::abs(change) < 1e-14 || std::abs(change) * pace < 1e-15) return t;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The same from no guess: of the places where the Bézier crosses the normal forwards the one
/// nearest to the segment's point; NaN where there is none.
double searched_foot(const Homogeneous& h, const Frame& f) {
  const int places = 12 * h.degree();
  const auto ahead = [&](double t) { return dot(at(h, t).point - f.point, f.tangent); };
  double nearest = std::numeric_limits<double>::infinity();
  double low = -1;
  bool behind = ahead(0) <= 0;
  for (int i = 1; i <= places; ++i) {
    const double t = static_cast<double>(i) / places;
    const bool now_behind = ahead(t) <= 0;
    if (behind && !now_behind) {
      const double off = norm(at(h, t - 0.5 / places).point - f.point);
      if (off < nearest) {
        nearest = off;
        low = t - 1.0 / places;
      }
    }
    behind = now_behind;
  }
  const auto found =
      low < 0 ? std::nullopt : numeric::bracketed_root(ahead, low, low + 1.0 / places, 5e-16);
  return found.value_or(std::numeric_limits<double>::quiet_NaN());
}

constexpr double kNear = 1e-3;  ///< of the length

}  // namespace

Homogeneous reduced(const curve::Bezier2& c, const Segment& s, const UnitPiece& unit) {
  Homogeneous h;
  const double largest =
      c.weights.empty() ? 1 : *std::max_element(c.weights.begin(), c.weights.end());
  for (std::size_t i = 0; i < c.control.size(); ++i) {
    const core::Point2 p = to_local(s.start, c.control[i]);
    const double w = c.weights.empty() ? 1 : c.weights[i] / largest;
    const Vector2 v{p.x / unit.length, unit.mirror * p.y / unit.length};
    h.control.push_back({w * v, w});
    h.least_weight = std::min(h.least_weight, w);
  }
  return h;
}

ParameterMap::ParameterMap(const Homogeneous& h, const UnitPiece& unit) : h_(h), unit_(unit) {
  start_ = foot(h, frame_at(unit, 0), 0);
  end_ = foot(h, frame_at(unit, 1), 1);
  sound_ = std::isfinite(start_) && std::isfinite(end_) && end_ - start_ > 0.1;
}

double ParameterMap::operator()(double v, double guess) const {
  if (v <= 0) return 0;
  if (v >= 1) return 1;
  if (!sound_) return guess;
  const double shift = -(1 - v) * start_ + v * (1 - end_);
  const Frame frame = frame_at(unit_, v);
  double t = foot(h_, frame, guess - shift);
  const auto off = [&](double u) {
    return std::isfinite(u) ? norm(at(h_, u).point - frame.point)
                            : std::numeric_limits<double>::infinity();
  };
  if (const double found = off(t); !(found < kNear)) {  // lost, or the foot of another branch
    const double other = searched_foot(h_, frame);
    if (off(other) < found) t = other;
  }
  return std::isfinite(t) ? std::clamp(t + shift, 0.0, 1.0) : guess;
}

}  // namespace keyline::lac::detail
