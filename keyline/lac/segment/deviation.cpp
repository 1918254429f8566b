#include "keyline/lac/segment/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/taylor.h"

namespace keyline::lac {
namespace {

using core::Vector2;
using detail::TaylorSeries;
using detail::UnitPiece;

constexpr double kAllowed = 1e-14;  ///< of the length, per step of the argument
constexpr int kSeriesDegree = 20;
constexpr int kMapDegree = 12;  ///< of the parameter's polynomial on a stretch
constexpr int kMaxDepth = 60;

/// Point and weight: a rational Bézier in homogeneous form.
struct Weighted {
  Vector2 point;
  double weight = 0;
};
Weighted operator+(Weighted a, Weighted b) { return {a.point + b.point, a.weight + b.weight}; }
Weighted operator-(Weighted a, Weighted b) { return {a.point - b.point, a.weight - b.weight}; }
Weighted operator*(double k, Weighted a) { return {k * a.point, k * a.weight}; }

/// The Bézier in the frame of the unit piece.
struct Homogeneous {
  std::vector<Weighted> control;
  double least_weight = 1;
  int degree() const { return static_cast<int>(control.size()) - 1; }
};

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

// ---- Change of parameter ------------------------------------------------------------------

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
  if (low < 0) return std::numeric_limits<double>::quiet_NaN();
  double high = low + 1.0 / places;
  for (int i = 0; i < 60 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high);
    (ahead(middle) <= 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// v -> t: feet, moved linearly so that ends meet ends; simply v where a foot is lost.
class ParameterMap {
 public:
  ParameterMap(const Homogeneous& h, const UnitPiece& unit) : h_(h), unit_(unit) {
    start_ = foot(h, frame_at(unit, 0), 0);
    end_ = foot(h, frame_at(unit, 1), 1);
    sound_ = std::isfinite(start_) && std::isfinite(end_) && end_ - start_ > 0.1;
  }
  double operator()(double v, double guess) const {
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

 private:
  static constexpr double kNear = 1e-3;  ///< of the length
  const Homogeneous& h_;
  const UnitPiece& unit_;
  double start_ = 0;
  double end_ = 1;
  bool sound_ = false;
};

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

/// Bound over a stretch; loose where the points compared are not the nearest to each other, so that
/// shorter stretches would give a smaller one.
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
  double largest = 0;
  double across = 0;
  for (int j = 0; j < nodes; ++j) {
    const double x = std::cos(core::kPi * (j + 0.5) / nodes);
    const double u = (chebyshev_sum(t, x) - 0.5 * (t0 + t1)) / (0.5 * (t1 - t0));
    const Weighted q = chebyshev_sum(b.series, u);
    const double along = 0.5 * (s.v1 - s.v0) * x;
    const Vector2 p = core::rotate_ccw(sum(s.series, along), direction);
    const Vector2 tangent = core::rotate_ccw(slope_of(s.series, along), direction);
    const Vector2 off = q.point - q.weight * p;
    largest = std::max(largest, norm(off));
    across = std::max(across, std::abs(cross(tangent, off)));
  }
  const double left_out = b.cut + (b.cut_weight + 1) * s.remainder + b.cut_weight * (s.v1 - s.v0);
  return {(largest / std::cos(core::kPi / 12) + left_out) / b.least_weight,
          largest > 1.2 * across + 2 * kAllowed};
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

/// Bound over stretches from t0 on; t0 becomes the parameter at their end. Loose ones are halved.
class Walk {
 public:
  Walk(const UnitPiece& unit, const Homogeneous& h) : unit_(unit), h_(h), map_(h, unit) {}

  void run(const Stretch& s) {
    const double guess = t0_ + (1 - t0_) * (s.v1 - s.v0) / (1 - s.v0);
    const double t1 = std::max(map_(s.v1, guess), std::nextafter(t0_, 2.0));
    const StretchBound b = stretch_bound(h_, unit_, map_, s, t0_, std::min(t1, 1.0));
    if (b.loose && b.bound > largest_ && halvings_ > 0) {
      --halvings_;
      const double middle = 0.5 * (s.v0 + s.v1);
      run(stretch(s.v0, middle));
      run(stretch(middle, s.v1));
      return;
    }
    largest_ = std::max(largest_, b.bound);
    t0_ = std::min(t1, std::nextafter(1.0, 0.0));
  }
  double largest() const { return largest_; }

 private:
  /// Within a stretch that was cut before: by its series, or straight.
  Stretch stretch(double v0, double v1) const {
    const double middle = 0.5 * (v0 + v1);
    Stretch p{v0, v1,
              taylor_series(unit_, detail::SeriesVariable::arc_length, middle, kSeriesDegree), 0};
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
  int halvings_ = 24;  ///< left
  double t0_ = 0;
  double largest_ = 0;
};

}  // namespace

double deviation_bound(const Segment& segment, const curve::Bezier2& bezier) {
  const UnitPiece unit = detail::unit_piece(piece_of(segment));
  const Homogeneous h = reduced(bezier, segment, unit);
  std::vector<Stretch> stretches;
  const double bend = inflection(unit.piece);
  if (bend > 0) cut(unit, 0, bend, 0, stretches);
  cut(unit, std::max(bend, 0.0), 1, 0, stretches);
  Walk walk(unit, h);
  for (const Stretch& s : stretches) walk.run(s);
  const double largest = walk.largest();
  if (!std::isfinite(largest)) return std::numeric_limits<double>::infinity();
  return unit.length * (largest + kAllowed);
}

}  // namespace keyline::lac
