#include "keyline/lac/cad_cubic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"

namespace keyline::lac::detail {

using core::Vector2;

namespace {

Vector2 value(const Cubic& c, double t) {
  const double s = 1 - t;
  const auto& b = c.control;
  return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}

Vector2 slope(const Cubic& c, double t) {
  const double s = 1 - t;
  const auto& b = c.control;
  return 3 * (s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
}

/// One step of the foot of p on the cubic, against the direction given.
double step_foot(const Cubic& c, Vector2 p, Vector2 direction, double t) {
  const double pace = dot(slope(c, t), direction);
  return pace > 0 ? t - dot(value(c, t) - p, direction) / pace : t;
}

}  // namespace

Frame exact_frame(const UnitPiece& unit, double v) {
  return {displacement(unit.piece, v), core::unit_vector(turning(unit.piece, v))};
}

// ---- Table --------------------------------------------------------------------------------

SeriesTable::SeriesTable(const UnitPiece& unit, double allowed) { cut(unit, 0, 1, allowed, 0); }

void SeriesTable::cut(const UnitPiece& unit, double from, double to, double allowed, int depth) {
  const double middle = 0.5 * (from + to);
  TaylorSeries series = taylor_series(unit, SeriesVariable::arc_length, middle, kDegree);
  double remainder = quick_remainder_bound(series, 0.5 * (to - from));
  if (!(remainder <= allowed)) {
    const double bend = (to - from) * std::abs(turning(unit.piece, to) - turning(unit.piece, from));
    if (!(bend <= allowed) && depth < 60) {
      cut(unit, from, middle, allowed, depth + 1);
      cut(unit, middle, to, allowed, depth + 1);
      return;
    }
    series.coefficient.fill({});
    series.coefficient[1] = {1, 0};
    remainder = bend;
  }
  const Frame frame = exact_frame(unit, middle);
  Stretch s{from, to, middle, remainder, 0, kDegree, {}, {}};
  s.curvature = std::max(curvature(unit.piece, from), curvature(unit.piece, to));
  s.x[0] = frame.point.x;
  s.y[0] = frame.point.y;
  for (int k = 1; k <= kDegree; ++k) {
    const Vector2 c = series.coefficient[k];
    s.x[k] = frame.tangent.x * c.x - frame.tangent.y * c.y;
    s.y[k] = frame.tangent.y * c.x + frame.tangent.x * c.y;
  }
  double power = std::pow(0.5 * (to - from), kDegree);
  while (s.degree > 2) {  // terms too small to matter
    const double term = power * std::hypot(s.x[s.degree], s.y[s.degree]);
    if (s.remainder + term > allowed) break;
    s.remainder += term;
    power /= 0.5 * (to - from);
    --s.degree;
  }
  stretches_.push_back(s);
}

const SeriesTable::Stretch& SeriesTable::at(double v) const {
  std::size_t i = 0;
  while (i + 1 < stretches_.size() && stretches_[i].to < v) ++i;
  return stretches_[i];
}

Vector2 SeriesTable::point(double v) const {
  const Stretch& s = at(v);
  const double u = v - s.middle;
  double x = s.x[s.degree], y = s.y[s.degree];
  for (int k = s.degree - 1; k >= 0; --k) {
    x = s.x[k] + u * x;
    y = s.y[k] + u * y;
  }
  return {x, y};
}

Vector2 SeriesTable::velocity(double v) const {
  const Stretch& s = at(v);
  const double u = v - s.middle;
  double x = s.degree * s.x[s.degree], y = s.degree * s.y[s.degree];
  for (int k = s.degree - 1; k > 0; --k) {
    x = k * s.x[k] + u * x;
    y = k * s.y[k] + u * y;
  }
  return {x, y};
}

// ---- One cubic ----------------------------------------------------------------------------

namespace {

constexpr double kInner = 0.337;  ///< the error is to vanish here and at the complement
constexpr std::array kTops{0.15, 0.24, 0.5, 0.76, 0.85};

/// Handle lengths (p + d) / 2 and (p - d) / 2, in lengths of the stretch.
///
/// The sum of the normal distances at the inner places is nearly linear in p and decides it well;
/// their difference, with p so chosen, is a smooth function of d alone, flat where the turning is
/// small: a root of that is looked for by secants from a guess, and by a scan where these fail.
class HandleSolve {
 public:
  HandleSolve(const SeriesTable& table, double v0, double v1, const Frame& start, const Frame& end)
      : table_(table), v0_(v0), width_(v1 - v0), start_(start), end_(end) {
    for (int i = 0; i < 2; ++i) {
      const double v = v0 + t_[i] * width_;
      const Vector2 d = table.velocity(v);
      inner_[i] = {table.point(v), d / norm(d)};
    }
  }

  CubicTry run(const HandleGuess& guess) {
    const double d = solve(std::clamp(guess.tilt, -kMost, kMost), guess.fine);
    CubicTry c = measured(d);
    if (!met_ && c.error <= guess.hopeful) c = measured(scan(guess.fine));
    return c;
  }

 private:
  static constexpr double kMost = 0.4;

  Cubic cubic(double d) const {
    const double a = 0.5 * (p_ + d) * width_;
    const double b = 0.5 * (p_ - d) * width_;
    return {{start_.point, start_.point + a * start_.tangent, end_.point - b * end_.tangent,
             end_.point}};
  }

  /// Difference of the normal distances at the inner places where their sum is 0.
  double odd(double d) {
    double difference = 0;
    for (int round = 0; round < 6; ++round) {
      const Cubic c = cubic(d);
      double sum = 0, pace = 0;
      difference = 0;
      for (int i = 0; i < 2; ++i) {
        const Frame& f = inner_[i];
        const double t = t_[i] = std::clamp(step_foot(c, f.point, f.tangent, t_[i]), 0.02, 0.98);
        const Vector2 velocity = slope(c, t);
        const double lean = cross(f.tangent, velocity) / dot(velocity, f.tangent);
        const Vector2 across = core::perpendicular_left(f.tangent) - lean * f.tangent;
        const double r = dot(value(c, t) - f.point, across);
        const double s = 1 - t;
        sum += r;
        difference += i == 0 ? r : -r;
        pace += 1.5 * width_ * s * t *
                (s * dot(start_.tangent, across) - t * dot(end_.tangent, across));
      }
      if (!(std::abs(pace) > 1e-14 * width_)) break;  // straight
      const double change = std::clamp(sum / pace, -0.3, 0.3);
      p_ -= change;
      if (std::abs(change) < 1e-3 && round > 0) break;
    }
    return difference;
  }

  CubicTry measured(double d) {
    odd(d);
    CubicTry c{cubic(d), p_ > 0.3 && p_ < 1.6, d, 0};
    for (const double f : kTops) {
      const Vector2 p = table_.point(v0_ + f * width_);
      const Vector2 tangent = table_.velocity(v0_ + f * width_);
      double t = f + (f < 0.5 ? t_[0] - kInner : t_[1] + kInner - 1);
      t = step_foot(c.cubic, p, tangent, t);
      c.error = std::max(c.error, std::abs(cross(tangent, value(c.cubic, t) - p)));
    }
    if (!std::isfinite(c.error)) c.sound = false;
    return c;
  }

  double solve(double guess, double fine) {
    double d0 = guess, d1 = guess + 0.02;
    double f0 = odd(d0);
    met_ = true;
    if (std::abs(f0) <= fine) return d0;
    double f1 = odd(d1);
    for (int step = 0; step < 5; ++step) {
      if (std::abs(f1) <= fine) return d1;
      const double next = d1 - f1 * (d1 - d0) / (f1 - f0);
      if (!(std::abs(next) < kMost)) break;
      d0 = d1;
      f0 = f1;
      d1 = next;
      f1 = odd(d1);
    }
    met_ = std::abs(f1) <= fine;
    return d1;
  }

  /// The root nearest to 0 among changes of sign, else the least difference.
  double scan(double fine) {
    constexpr int kSteps = 16;
    double best = 0, least = std::numeric_limits<double>::infinity();
    double low = 0, high = 0, nearest = 2 * kMost;
    double before = 0, d_before = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double d = kMost * (2.0 * i / kSteps - 1);
      const double f = odd(d);
      if (std::abs(f) < least) {
        least = std::abs(f);
        best = d;
      }
      const bool change = i > 0 && before * f < 0;
      if (change && std::abs(d + d_before) < nearest) {
        nearest = std::abs(d + d_before);
        low = d_before;
        high = d;
      }
      before = f;
      d_before = d;
    }
    if (!(low < high)) return best;
    const double sign = odd(low) > 0 ? 1 : -1;
    for (int i = 0; i < 30; ++i) {
      best = 0.5 * (low + high);
      const double f = sign * odd(best);
      if (std::abs(f) <= fine) break;
      (f > 0 ? low : high) = best;
    }
    return best;
  }

  const SeriesTable& table_;
  double v0_, width_;
  Frame start_, end_;
  std::array<double, 2> t_{kInner, 1 - kInner};
  std::array<Frame, 2> inner_;
  double p_ = 2.0 / 3;
  bool met_ = false;
};

}  // namespace

CubicTry try_cubic(const SeriesTable& table, double v0, double v1, const Frame& start,
                   const Frame& end, const HandleGuess& guess) {
  return HandleSolve(table, v0, v1, start, end).run(guess);
}

// ---- Bound --------------------------------------------------------------------------------

namespace {

constexpr int kMapDegree = 3;
constexpr int kCarried = 3 * kMapDegree;

template <int N>
const std::array<double, N>& chebyshev_nodes() {
  static const std::array<double, N> nodes = [] {
    std::array<double, N> x;
    for (int j = 0; j < N; ++j) x[j] = std::cos(core::kPi * (j + 0.5) / N);
    return x;
  }();
  return nodes;
}

/// t as polynomial of x in [-1, 1]: (1 + x) / 2 + (1 - x^2) (k0 + k1 x), through two feet.
/// Within [0, 1] because |k0 + k1 x| <= 1/4 (else both 0).
struct ParameterMap {
  double k0 = 0, k1 = 0;
};

ParameterMap parameter_map(const SeriesTable& table, double v0, double v1, const Cubic& c) {
  constexpr double p = 0.5;
  const auto off = [&](double x) {
    const double v = v0 + (v1 - v0) * 0.5 * (1 + x);
    const Vector2 at = table.point(v);
    const Vector2 d = table.velocity(v);
    double t = 0.5 * (1 + x);
    for (int i = 0; i < 2; ++i) t = step_foot(c, at, d, t);
    return (t - 0.5 * (1 + x)) / ((1 - x) * (1 + x));
  };
  const double low = off(-p);
  const double high = off(p);
  const ParameterMap map{0.5 * (low + high), 0.5 * (high - low) / p};
  return std::abs(map.k0) + std::abs(map.k1) <= 0.25 ? map : ParameterMap{};
}

/// What N Chebyshev nodes of [w0, w1] say about difference D = cubic - curve and velocity C'.
struct NodeValues {
  double across = 0;  ///< largest |D x C'|
  double square = 0;  ///< largest |D|^2
  double pace = 0;    ///< largest ||C'|^2 - 1|
};

template <int N>
NodeValues node_values(const SeriesTable::Stretch& s, double w0, double w1, double v0, double v1,
                       const Cubic& c, const ParameterMap& map) {
  const auto& nodes = chebyshev_nodes<N>();
  const Vector2 origin = c.control[0];
  const Vector2 c1 = 3 * (c.control[1] - origin);
  const Vector2 c2 = 3 * (c.control[2] - origin) - 2 * c1;
  const Vector2 c3 = c.control[3] - origin - c1 - c2;
  const Vector2 shift{s.x[0] - origin.x, s.y[0] - origin.y};
  const double scale = 2 / (v1 - v0);
  const int n = s.degree;
  NodeValues largest;
  for (int j = 0; j < N; ++j) {
    const double v = 0.5 * (w0 + w1 + (w1 - w0) * nodes[j]);
    const double x = (v - v0) * scale - 1;
    const double t = (1 + x) * (0.5 + (1 - x) * (map.k0 + map.k1 * x));
    const double u = v - s.middle;
    double px = s.x[n], py = s.y[n];
    double qx = px, qy = py;  // by Horner's rule with its derivative
    for (int i = n - 1; i > 0; --i) {
      px = s.x[i] + u * px;
      py = s.y[i] + u * py;
      qx = px + u * qx;
      qy = py + u * qy;
    }
    const double dx = t * (c1.x + t * (c2.x + t * c3.x)) - u * px - shift.x;
    const double dy = t * (c1.y + t * (c2.y + t * c3.y)) - u * py - shift.y;
    largest.across = std::max(largest.across, std::abs(dx * qy - dy * qx));
    largest.square = std::max(largest.square, dx * dx + dy * dy);
    largest.pace = std::max(largest.pace, std::abs(qx * qx + qy * qy - 1));
  }
  return largest;
}

/// Bound for all of [w0, w1]. A point at D = a along + b across the curve is within |b| of it, up
/// to what the curve bends over the length a: a^2 / 2 times curvature.
template <int N>
double stretch_bound(const SeriesTable::Stretch& s, double w0, double w1, double v0, double v1,
                     const Cubic& c, const ParameterMap& map) {
  const NodeValues at = node_values<N>(s, w0, w1, v0, v1, c, map);
  const auto whole = [](double value, int degree) {
    return value / std::cos(std::min(degree, N - 1) * core::kPi / (2 * N));
  };
  const int degree = std::max(kCarried, s.degree);
  const double pace = 1 - whole(at.pace, 2 * s.degree - 2);
  const double any = whole(std::sqrt(at.square), degree);
  if (!(pace > 0.5) || !(any < 0.1) || std::isinf(s.curvature)) return any + s.remainder;
  const double across = whole(at.across, degree + s.degree - 1) / std::sqrt(pace);
  return std::min(any, across + any * any * s.curvature) + s.remainder;
}

}  // namespace

double cubic_bound(const SeriesTable& table, double v0, double v1, const Cubic& c, double wanted) {
  const ParameterMap map = parameter_map(table, v0, v1, c);
  double largest = 0;
  for (const auto& s : table.stretches()) {
    const double w0 = std::max(v0, s.from);
    const double w1 = std::min(v1, s.to);
    if (!(w0 < w1)) continue;
    double bound = stretch_bound<48>(s, w0, w1, v0, v1, c, map);
    if (bound > wanted && bound < 1.4 * wanted)
      bound = std::min(bound, stretch_bound<192>(s, w0, w1, v0, v1, c, map));
    if (!std::isfinite(bound)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, bound);
  }
  return largest + 2e-15;
}

}  // namespace keyline::lac::detail
