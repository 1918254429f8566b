#include "keyline/lac/segment/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/bezier_feet.h"
#include "keyline/lac/segment/taylor.h"

namespace keyline::lac {
namespace {

using core::Vector2;
using detail::Homogeneous;
using detail::ParameterMap;
using detail::TaylorSeries;
using detail::UnitPiece;
using detail::Weighted;

constexpr double kAllowed = 1e-14;  ///< of the length, per step of the argument
constexpr int kSeriesDegree = 20;
constexpr int kMapDegree = 12;  ///< of the parameter's polynomial on a stretch
constexpr int kMaxDepth = 60;

// ---- Chebyshev series ---------------------------------------------------------------------

/// sum of c_k T_k(x), Clenshaw's rule.
template <class T>
T chebyshev_sum(const std::vector<T>& c, double x) {
  T b1{}, b2{};
  for (std::size_t k = c.size() - 1; k > 0; --k) {
    const T b = c[k] + (2 * x) * b1 - b2;
    b2 = b1;
    b1 = b;
  }
  return c[0] + x * b1 - b2;
}

/// Interpolates values at x_j = cos(pi (j + 1/2) / count): exact for polynomials below `count`.
template <class T>
std::vector<T> chebyshev_series(const std::vector<T>& values) {
  const std::size_t count = values.size();
  std::vector<T> c(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double x = std::cos(core::kPi * (j + 0.5) / count);
    double before = 1, now = x;
    c[0] = c[0] + (1.0 / count) * values[j];
    for (std::size_t k = 1; k < count; ++k) {
      c[k] = c[k] + (2.0 / count * now) * values[j];
      const double next = 2 * x * now - before;
      before = now;
      now = next;
    }
  }
  return c;
}

/// The Bézier over [t0, t1] as a Chebyshev series, the tail cut that does not matter.
struct LocalBezier {
  std::vector<Weighted> series;
  double cut = 0;  ///< bound of |tail|, points
  double cut_weight = 0;
  double least_weight = 1;
};

LocalBezier local_bezier(const Homogeneous& h, double t0, double t1, Vector2 origin) {
  std::vector<Weighted> values;
  const int count = h.degree() + 1;
  for (int j = 0; j < count; ++j) {
    const double t = 0.5 * (t0 + t1 + (t1 - t0) * std::cos(core::kPi * (j + 0.5) / count));
    std::array<Weighted, curve::kMaxBezierDegree + 1> b;
    for (int i = 0; i < count; ++i)
      b[i] = {h.control[i].point - h.control[i].weight * origin, h.control[i].weight};
    for (int level = count - 1; level > 0; --level)
      for (int i = 0; i < level; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
    values.push_back(b[0]);
  }
  LocalBezier local{chebyshev_series(values), 0, 0, 1};
  auto& c = local.series;
  while (c.size() > 2) {
    const double p = norm(c.back().point);
    const double w = std::abs(c.back().weight);
    if (local.cut + p > kAllowed || local.cut_weight + w > kAllowed) break;
    local.cut += p;
    local.cut_weight += w;
    c.pop_back();
  }
  double swing = local.cut_weight;
  for (std::size_t k = 1; k < c.size(); ++k) swing += std::abs(c[k].weight);
  local.least_weight = std::max(c[0].weight - swing, h.least_weight);
  return local;
}

// ---- One stretch --------------------------------------------------------------------------

struct Stretch {
  double v0 = 0, v1 = 1;
  TaylorSeries series;
  double remainder = 0;
};

/// The parameter's polynomial over a stretch in x in [-1, 1].
std::vector<double> map_series(const ParameterMap& map, const Stretch& s, double t0, double t1) {
  std::vector<double> values;
  const int count = kMapDegree - 1;  // the ends are met by a correction of two degrees more
  for (int j = 0; j < count; ++j) {
    const double x = std::cos(core::kPi * (j + 0.5) / count);
    const double line = 0.5 * (t0 + t1 + (t1 - t0) * x);
    const double v = 0.5 * (s.v0 + s.v1 + (s.v1 - s.v0) * x);
    values.push_back((map(v, line) - line) / ((1 - x) * (1 + x)));
  }
  // (1 - x^2) q(x) + line: T_k (1 - x^2) = T_k / 2 - (T_{k+2} + T_{|k-2|}) / 4.
  const std::vector<double> q = chebyshev_series(values);
  std::vector<double> c(kMapDegree + 1, 0.0);
  for (int k = 0; k < count; ++k) {
    c[k] += q[k] / 2;
    c[k + 2] -= q[k] / 4;
    c[std::abs(k - 2)] -= q[k] / 4;
  }
  c[0] += 0.5 * (t0 + t1);
  c[1] += 0.5 * (t1 - t0);
  // Growing if the derivative's first coefficient outweighs what the others can do (|T_k'| <= k^2).
  double others = 0;
  for (int k = 2; k <= kMapDegree; ++k) others += k * k * std::abs(c[k]);
  if (c[1] > others) return c;
  return {0.5 * (t0 + t1), 0.5 * (t1 - t0)};
}

/// Derivative of the series' sum, not normalised.
Vector2 slope_of(const TaylorSeries& s, double x) {
  Vector2 v = double(s.degree) * s.coefficient[s.degree];
  for (int k = s.degree - 1; k > 0; --k) v = double(k) * s.coefficient[k] + x * v;
  return v;
}

/// Bound over a stretch; loose where shorter stretches would give a smaller one: the points
/// compared are not the nearest to each other, or weights run through so much that their least says
/// little.
struct StretchBound {
  double bound = 0;
  bool loose = false;
};

StretchBound stretch_bound(const Homogeneous& h, const UnitPiece& unit, const ParameterMap& map,
                           const Stretch& s, double t0, double t1) {
  const std::vector<double> t = map_series(map, s, t0, t1);
  const double middle = s.series.arc;
  const Vector2 origin = displacement(unit.piece, middle);
  const double direction = turning(unit.piece, middle);
  const LocalBezier b = local_bezier(h, t0, t1, origin);
  const bool rational = h.least_weight < 1;
  const int carried = static_cast<int>((b.series.size() - 1) * (t.size() - 1));
  const int degree = rational ? carried + s.series.degree : std::max(carried, s.series.degree);
  const int nodes = 6 * degree;
  double largest = 0;  // times the weight
  double reached = 0;
  double across = 0;
  for (int j = 0; j < nodes; ++j) {
    const double x = std::cos(core::kPi * (j + 0.5) / nodes);
    const double u = (chebyshev_sum(t, x) - 0.5 * (t0 + t1)) / (0.5 * (t1 - t0));
    const Weighted q = chebyshev_sum(b.series, u);
    const double along = 0.5 * (s.v1 - s.v0) * x;
    const Vector2 p = core::rotate_ccw(sum(s.series, along), direction);
    const Vector2 tangent = core::rotate_ccw(slope_of(s.series, along), direction);
    const Vector2 off = q.point - q.weight * p;
    const double weight = std::max(q.weight, b.least_weight);
    largest = std::max(largest, norm(off));
    reached = std::max(reached, norm(off) / weight);
    across = std::max(across, std::abs(cross(tangent, off)) / weight);
  }
  const double left_out = b.cut + (b.cut_weight + 1) * s.remainder + b.cut_weight * (s.v1 - s.v0);
  const double bound = (largest / std::cos(core::kPi / 12) + left_out) / b.least_weight;
  const double sharp = 1.2 * across + 2 * kAllowed / b.least_weight;
  if (std::isnan(bound)) return {std::numeric_limits<double>::infinity(), true};
  return {bound, reached > sharp || bound > 1.2 * reached + 2 * kAllowed / b.least_weight};
}

/// Stretches of [v0, v1], in order.
void cut(const UnitPiece& unit, double v0, double v1, int depth, std::vector<Stretch>& out) {
  const double middle = 0.5 * (v0 + v1);
  Stretch s{v0, v1, taylor_series(unit, detail::SeriesVariable::arc_length, middle, kSeriesDegree),
            0};
  s.remainder = remainder_bound(s.series, 0.5 * (v1 - v0));
  const double turn = std::abs(turning(unit.piece, v1) - turning(unit.piece, v0));
  const bool hard = s.remainder > kAllowed;
  if (hard && (v1 - v0) * turn <= kAllowed) {
    s.series.degree = 1;
    s.series.coefficient[1] = {1, 0};
    s.remainder = (v1 - v0) * turn;
  } else if (depth < 2 || (hard && depth < kMaxDepth)) {
    cut(unit, v0, middle, depth + 1, out);
    cut(unit, middle, v1, depth + 1, out);
    return;
  }
  out.push_back(s);
}

/// A stretch beside the part of the Bezier that belongs to it.
struct Part {
  Stretch stretch;
  double t0 = 0, t1 = 1;
  StretchBound bound = {};
  friend bool operator<(const Part& a, const Part& b) { return a.bound.bound < b.bound.bound; }
};

/// Bound over all stretches: the worst is halved as long as that may help.
class Cover {
 public:
  Cover(const UnitPiece& unit, const Homogeneous& h) : unit_(unit), h_(h), map_(h, unit) {}

  double bound(const std::vector<Stretch>& stretches) {
    double t0 = 0;
    for (const Stretch& s : stretches) {
      const double t1 = end_of(s, t0);
      add({s, t0, std::min(t1, 1.0)});
      t0 = std::min(t1, std::nextafter(1.0, 0.0));
    }
    for (int i = 0; i < kMostHalvings && parts_.front().bound.loose; ++i) halve_worst();
    return parts_.front().bound.bound;
  }

 private:
  static constexpr int kMostHalvings = 64;

  /// Where a stretch that begins at t0 ends on the Bezier.
  double end_of(const Stretch& s, double t0) const {
    const double guess = t0 + (1 - t0) * (s.v1 - s.v0) / (1 - s.v0);
    return std::max(map_(s.v1, guess), std::nextafter(t0, 2.0));
  }

  void add(Part part) {
    part.bound = stretch_bound(h_, unit_, map_, part.stretch, part.t0, part.t1);
    parts_.push_back(std::move(part));
    std::push_heap(parts_.begin(), parts_.end());
  }

  void halve_worst() {
    std::pop_heap(parts_.begin(), parts_.end());
    Part worst = std::move(parts_.back());
    parts_.pop_back();
    const Stretch& s = worst.stretch;
    const double v = 0.5 * (s.v0 + s.v1);
    const double t =
        std::min(std::max(map_(v, 0.5 * (worst.t0 + worst.t1)), std::nextafter(worst.t0, 2.0)),
                 std::nextafter(worst.t1, 0.0));
    if (!(worst.t0 < t && t < worst.t1)) {
      worst.bound.loose = false;
      parts_.push_back(std::move(worst));
      std::push_heap(parts_.begin(), parts_.end());
      return;
    }
    add({stretch(s.v0, v), worst.t0, t});
    add({stretch(v, s.v1), t, worst.t1});
  }

  /// Within a stretch that was cut before: by its series, or straight.
  Stretch stretch(double v0, double v1) const {
    Stretch p{
        v0, v1,
        taylor_series(unit_, detail::SeriesVariable::arc_length, 0.5 * (v0 + v1), kSeriesDegree),
        0};
    p.remainder = remainder_bound(p.series, 0.5 * (v1 - v0));
    if (!(p.remainder <= kAllowed)) {
      p.series.degree = 1;
      p.series.coefficient[1] = {1, 0};
      p.remainder = (v1 - v0) * std::abs(turning(unit_.piece, v1) - turning(unit_.piece, v0));
    }
    return p;
  }

  const UnitPiece& unit_;
  const Homogeneous& h_;
  ParameterMap map_;
  std::vector<Part> parts_;  ///< a heap, the worst first
};

}  // namespace

double deviation_bound(const Segment& segment, const curve::Bezier2& bezier) {
  const UnitPiece unit = detail::unit_piece(piece_of(segment));
  const Homogeneous h = reduced(bezier, segment, unit);
  std::vector<Stretch> stretches;
  const double bend = inflection(unit.piece);
  if (bend > 0) cut(unit, 0, bend, 0, stretches);
  cut(unit, std::max(bend, 0.0), 1, 0, stretches);
  const double largest = Cover(unit, h).bound(stretches);
  if (!std::isfinite(largest)) return std::numeric_limits<double>::infinity();
  return unit.length * (largest + kAllowed);
}

}  // namespace keyline::lac
