#include "keyline/curve/cubic_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "keyline/core/polygon.h"
#include "keyline/numeric/damped_descent.h"
#include "keyline/numeric/lawson.h"

namespace keyline::curve::detail {

using core::Point2;
using core::Vector2;

Point2 point_on(const Cubic& c, double u) {
  const auto& b = c.control;
  const double v = 1 - u;
  const Vector2 offset =
      3 * u * v * v * (b[1] - b[0]) + 3 * u * u * v * (b[2] - b[0]) + u * u * u * (b[3] - b[0]);
  return b[0] + offset;
}

Vector2 velocity_on(const Cubic& c, double u) {
  const auto& b = c.control;
  const double v = 1 - u;
  return 3 * (v * v * (b[1] - b[0]) + 2 * u * v * (b[2] - b[1]) + u * u * (b[3] - b[2]));
}

std::pair<Cubic, Cubic> split(const Cubic& c, double u) {
  const auto& b = c.control;
  const Point2 a1 = mix(b[0], b[1], u), a2 = mix(b[1], b[2], u), a3 = mix(b[2], b[3], u);
  const Point2 b1 = mix(a1, a2, u), b2 = mix(a2, a3, u);
  const Point2 m = mix(b1, b2, u);
  return {{{b[0], a1, b1, m}}, {{m, b2, a3, b[3]}}};
}

Cubic subcurve(const Cubic& c, double u0, double u1) {
  const Cubic head = u1 < 1 ? split(c, u1).first : c;
  return u0 > 0 ? split(head, u0 / u1).second : head;
}

namespace {

Vector2 first_direction(const std::array<Vector2, 3>& candidates) {
  for (const Vector2& v : candidates) {
    const double size = norm(v);
    if (size > 0) return v / size;
  }
  return {};
}

}  // namespace

Vector2 start_tangent(const Cubic& c) {
  const auto& b = c.control;
  return first_direction({b[1] - b[0], b[2] - b[0], b[3] - b[0]});
}

Vector2 end_tangent(const Cubic& c) {
  const auto& b = c.control;
  return first_direction({b[3] - b[2], b[3] - b[1], b[3] - b[0]});
}

namespace {

/// Foot of p on q near u, by Newton's method kept in [0, 1].
double foot_on(const Cubic& q, Point2 p, double u) {
  for (int step = 0; step < 4; ++step) {
    const Vector2 velocity = velocity_on(q, u);
    const auto& b = q.control;
    const Vector2 bend =
        6 * ((1 - u) * ((b[2] - b[1]) - (b[1] - b[0])) + u * ((b[3] - b[2]) - (b[2] - b[1])));
    const Vector2 offset = point_on(q, u) - p;
    const double square = dot(velocity, velocity);
    const double slope = std::max(square + dot(offset, bend), 0.25 * square);
    if (!(slope > 0)) return u;
    const double next = std::clamp(u - dot(offset, velocity) / slope, 0.0, 1.0);
    if (std::abs(next - u) < 1e-13) return next;
    u = next;
  }
  return u;
}

/// Parameters of a cubic by fractions of its length, roughly: first guesses for feet.
class LengthTable {
 public:
  explicit LengthTable(const Cubic& q) {
    Point2 before = q.control[0];
    for (std::size_t i = 1; i <= kParts; ++i) {
      const Point2 at = point_on(q, static_cast<double>(i) / kParts);
      length_[i] = length_[i - 1] + distance(before, at);
      before = at;
    }
  }

  double parameter(double fraction) const {
    const double wanted = fraction * length_[kParts];
    if (!(length_[kParts] > 0)) return fraction;
    std::size_t i = 1;
    while (i < kParts && length_[i] < wanted) ++i;
    const double part = length_[i] - length_[i - 1];
    const double within = part > 0 ? std::clamp((wanted - length_[i - 1]) / part, 0.0, 1.0) : 0.0;
    return (static_cast<double>(i - 1) + within) / kParts;
  }

 private:
  static constexpr std::size_t kParts = 16;
  std::array<double, kParts + 1> length_{};
};

/// Length of a short cubic, to a few per cent.
double rough_length(const Cubic& c) {
  return 0.5 * (core::polygon_length(c.control) + distance(c.control[0], c.control[3]));
}

// ---- Deviation bound ----------------------------------------------------------------------

/// Product of polynomials in scaled Bernstein coefficients (see bernstein.h).
template <class A, std::size_t N, class B, std::size_t M>
auto convolve(const std::array<A, N>& a, const std::array<B, M>& b) {
  std::array<decltype(a[0] * b[0]), N + M - 1> r{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < M; ++j) r[i + j] = r[i + j] + a[i] * b[j];
  return r;
}

/// Scaled coefficients of q(u(s)), u a cubic with plain coefficients; relative to `origin`.
std::array<Vector2, 10> composed(const Cubic& q, const std::array<double, 4>& u, Point2 origin) {
  const std::array<double, 4> a{u[0], 3 * u[1], 3 * u[2], u[3]};
  const std::array<double, 4> b{1 - u[0], 3 * (1 - u[1]), 3 * (1 - u[2]), 1 - u[3]};
  const auto aa = convolve(a, a);
  const auto bb = convolve(b, b);
  const std::array basis{convolve(bb, b), convolve(bb, a), convolve(aa, b), convolve(aa, a)};
  constexpr std::array<double, 4> kBinomials{1, 3, 3, 1};
  std::array<Vector2, 10> r{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 10; ++i)
      r[i] = r[i] + kBinomials[k] * basis[k][i] * (q.control[k] - origin);
  return r;
}

/// Largest Bernstein coefficient of h(s) - q(u(s)).
double difference_bound(const Cubic& h, const Cubic& q, const std::array<double, 4>& u) {
  constexpr std::array<double, 7> kOne{1, 6, 15, 20, 15, 6, 1};
  constexpr std::array<double, 10> kBinomials{1, 9, 36, 84, 126, 126, 84, 36, 9, 1};
  const Point2 origin = h.control[0];
  const std::array<Vector2, 4> scaled{Vector2{}, 3 * (h.control[1] - origin),
                                      3 * (h.control[2] - origin), h.control[3] - origin};
  const auto raised = convolve(scaled, kOne);
  const auto carried = composed(q, u, origin);
  double largest = 0;
  for (std::size_t i = 0; i < 10; ++i)
    largest = std::max(largest, norm(raised[i] - carried[i]) / kBinomials[i]);
  return largest;
}

/// du/ds that carries the velocity of the row onto that of q.
double carried_speed(const Cubic& q, double u, Vector2 velocity) {
  const Vector2 v = velocity_on(q, u);
  const double square = dot(v, v);
  return square > 0 ? std::max(dot(velocity, v) / square, 0.0) : 0.0;
}

/// Bound of the distance between h and q over [u0, u1]; in halves while it is above `wanted`.
double part_bound(const Cubic& h, const Cubic& q, double u0, double u1, double wanted, int depth) {
  const double v0 = carried_speed(q, u0, velocity_on(h, 0));
  const double v1 = carried_speed(q, u1, velocity_on(h, 1));
  const std::array<double, 4> u{u0, std::min(u0 + v0 / 3, 1.0), std::max(u1 - v1 / 3, 0.0), u1};
  const std::array<double, 4> even{u0, (2 * u0 + u1) / 3, (u0 + 2 * u1) / 3, u1};
  const double bound = std::min(difference_bound(h, q, u), difference_bound(h, q, even));
  if (!(bound > wanted) || depth >= 4) return bound;
  const auto [left, right] = split(h, 0.5);
  const double middle = std::clamp(foot_on(q, left.control[3], 0.5 * (u0 + u1)), u0, u1);
  const double first = part_bound(left, q, u0, middle, wanted, depth + 1);
  if (first > wanted) return bound;
  return std::min(bound, std::max(first, part_bound(right, q, middle, u1, wanted, depth + 1)));
}

}  // namespace

double deviation_bound(std::span<const Cubic> row, const Cubic& q, double wanted) {
  double total = 0;
  for (const Cubic& h : row) total += rough_length(h);
  const LengthTable table(q);
  double done = 0;
  double largest = 0;
  double u0 = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    done += rough_length(row[i]);
    const bool last = i + 1 == row.size();
    const double guess = total > 0 ? std::max(table.parameter(done / total), u0) : u0;
    const double u1 = last ? 1.0 : std::max(u0, foot_on(q, row[i].control[3], guess));
    largest = std::max(largest, part_bound(row[i], q, u0, u1, wanted, 0));
    u0 = u1;
  }
  return largest;
}

// ---- Fit ----------------------------------------------------------------------------------

namespace {

class HandleFit {
 public:
  explicit HandleFit(std::span<const Cubic> row) : row_(row) {
    start_ = start_tangent(row.front());
    end_ = end_tangent(row.back());
    for (const Cubic& h : row) length_ += rough_length(h);
    const std::size_t stride = 1 + row.size() / 24;
    double done = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double part = rough_length(row[i]);
      const bool last = i + 1 == row.size();
      if (i % stride == stride / 2) add(row[i], 0.5, done + 0.5 * part);
      if (stride == 1 && !last) add(row[i], 1, done + part);
      done += part;
    }
  }

  double length() const { return length_; }

  /// From the given handle lengths; keeps the best in the sense of the largest distance.
  void run(double a, double b, double wanted) {
    weights_.assign(points_.size(), 1.0);
    Normal at = linearise(a, b);
    numeric::FactorDamping rule{.least = 0, .most = 1e4};
    numeric::damped_descent(rule, 40, [&](double damping) -> numeric::StepOutcome {
      const Normal next = linearise(moved(at, damping));
      if (!(next.cost < at.cost)) return {};
      const bool settled = next.cost > 0.9995 * at.cost || best_ <= 0.7 * wanted;
      at = next;
      return {settled ? numeric::StepEnd::settled : numeric::StepEnd::taken};
    });
    for (int step = 0; step < 12 && best_ > 0.9 * wanted && best_ < 3 * wanted; ++step) {
      numeric::lawson_weights(weights_, residuals_);
      at = linearise(at.a, at.b);
      at = linearise(moved(at, 1e-9));
    }
  }

  Cubic cubic() const { return cubic_of(best_a_, best_b_); }
  double largest() const { return best_; }

 private:
  void add(const Cubic& h, double s, double length_before) {
    points_.push_back(point_on(h, s));
    fractions_.push_back(length_ > 0 ? length_before / length_ : 0);
  }

  Cubic cubic_of(double a, double b) const {
    const Point2 p0 = row_.front().control[0];
    const Point2 p3 = row_.back().control[3];
    return {{p0, p0 + a * start_, p3 - b * end_, p3}};
  }

  /// Normal equations of the weighted squared distances at the handle lengths a, b.
  struct Normal {
    double a = 0, b = 0;
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0, cost = 0;
  };

  Normal linearise(std::pair<double, double> handles) {
    return linearise(handles.first, handles.second);
  }

  Normal linearise(double a, double b) {
    const Cubic q = cubic_of(a, b);
    const LengthTable table(q);
    Normal at{a, b};
    double largest = 0;
    residuals_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const double u = foot_on(q, points_[k], table.parameter(fractions_[k]));
      const Vector2 velocity = velocity_on(q, u);
      const double v = norm(velocity);
      const Vector2 offset = point_on(q, u) - points_[k];
      const Vector2 normal = v > 0 ? perpendicular_left(velocity / v) : Vector2{};
      const double r = dot(offset, normal);
      const double ja = 3 * u * (1 - u) * (1 - u) * dot(start_, normal);
      const double jb = -3 * u * u * (1 - u) * dot(end_, normal);
      const double w = weights_[k];
      at.aa += w * ja * ja;
      at.ab += w * ja * jb;
      at.bb += w * jb * jb;
      at.ra += w * ja * r;
      at.rb += w * jb * r;
      at.cost += w * dot(offset, offset);
      residuals_.push_back(norm(offset));
      largest = std::max(largest, residuals_.back());
    }
    if (largest < best_) {
      best_ = largest;
      best_a_ = a;
      best_b_ = b;
    }
    return at;
  }

  /// Handle lengths after one damped step, kept positive.
  std::pair<double, double> moved(const Normal& at, double damping) const {
    const double aa = at.aa * (1 + damping) + 1e-14 * (at.aa + at.bb);
    const double bb = at.bb * (1 + damping) + 1e-14 * (at.aa + at.bb);
    const double determinant = aa * bb - at.ab * at.ab;
    if (!(determinant > 0)) return {at.a, at.b};
    const auto step = [&](double x, double change) {
      return std::clamp(x - change, std::max(0.3 * x, 1e-4 * length_), 2.0 * x + 1e-3 * length_);
    };
    return {step(at.a, (bb * at.ra - at.ab * at.rb) / determinant),
            step(at.b, (aa * at.rb - at.ab * at.ra) / determinant)};
  }

  std::span<const Cubic> row_;
  Vector2 start_, end_;
  double length_ = 0;
  std::vector<Point2> points_;
  std::vector<double> fractions_, weights_, residuals_;
  double best_ = std::numeric_limits<double>::infinity();
  double best_a_ = 0;
  double best_b_ = 0;
};

/// The cubic with the row's velocities at its ends in the common parameter, and the largest
/// difference at equal parameter.
CubicFit fit_in_parameter(std::span<const Cubic> row, std::span<const double> ends) {
  const Point2 p0 = row.front().control[0];
  const Point2 p3 = row.back().control[3];
  const double last_width = row.size() > 1 ? 1 - ends[row.size() - 2] : 1.0;
  const Vector2 a = velocity_on(row.front(), 0) / (3 * ends[0]);
  const Vector2 b = velocity_on(row.back(), 1) / (3 * last_width);
  CubicFit fit{{{p0, p0 + a, p3 - b, p3}}, 0, 0};
  double u0 = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double u1 = ends[i];
    const double gap =
        difference_bound(row[i], fit.cubic, {u0, (2 * u0 + u1) / 3, (u0 + 2 * u1) / 3, u1});
    fit.bound =
        std::isfinite(gap) ? std::max(fit.bound, gap) : std::numeric_limits<double>::infinity();
    u0 = u1;
  }
  return fit;
}

}  // namespace

CubicFit fit_cubic(std::span<const Cubic> row, std::span<const double> ends, double wanted) {
  const CubicFit plain = fit_in_parameter(row, ends);
  if (plain.bound <= wanted) return plain;
  HandleFit fit(row);
  fit.run(fit.length() / 3, fit.length() / 3, wanted);
  if (fit.largest() > wanted) {
    const auto& q = plain.cubic.control;
    const double a = distance(q[0], q[1]);
    const double b = distance(q[2], q[3]);
    if (std::isfinite(a) && std::isfinite(b)) fit.run(a, b, wanted);
  }
  CubicFit result{fit.cubic(), std::numeric_limits<double>::infinity(), fit.largest()};
  if (fit.largest() <= 1.02 * wanted) result.bound = deviation_bound(row, result.cubic, wanted);
  return result;
}

}  // namespace keyline::curve::detail
