#include "keyline/classa/deviation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "keyline/core/polygon.h"

namespace keyline::classa {

using core::Point2;
using core::Vector2;
using curve::Bezier2;

namespace {

constexpr int kMostHalvings = 11;

/// Largest distance of two curves at equal parameter, bounded by their control points.
double difference(Bezier2 a, Bezier2 b) {
  const int degree = std::max(curve::degree(a), curve::degree(b));
  a = elevate_degree(a, degree - curve::degree(a));
  b = elevate_degree(b, degree - curve::degree(b));
  double most = 0;
  for (std::size_t i = 0; i < a.control.size(); ++i)
    most = std::max(most, distance(a.control[i], b.control[i]));
  return most;
}

/// Foot of p on q near u, kept within [low, high].
double foot(const Bezier2& q, Point2 p, double u, double low, double high) {
  for (int i = 0; i < 6; ++i) {
    const auto j = jet(q, u);
    const Vector2 off = j.point - p;
    const double square = dot(j.first, j.first);
    const double slope = std::max(square + dot(off, j.second), 0.25 * square);
    if (!(slope > 0)) break;
    u = std::clamp(u - dot(off, j.first) / slope, low, high);
  }
  return u;
}

double part_bound(const Bezier2& h, const Bezier2& q, double u0, double u1, double wanted,
                  int halvings) {
  const double bound = difference(h, subcurve(q, u0, u1));
  if (bound <= wanted || halvings == kMostHalvings) return bound;
  const auto [left, right] = split(h, 0.5);
  const double u = foot(q, left.control.back(), 0.5 * (u0 + u1), u0, u1);
  const double halves = std::max(part_bound(left, q, u0, u, wanted, halvings + 1),
                                 part_bound(right, q, u, u1, wanted, halvings + 1));
  return std::min(bound, halves);
}

/// Parameters of q by fractions of its length, roughly: first guesses for feet.
class LengthTable {
 public:
  explicit LengthTable(const Bezier2& q) {
    for (int i = 0; i <= kParts; ++i) points_.push_back(evaluate(q, i / double{kParts}));
    for (int i = 1; i <= kParts; ++i)
      length_.push_back(length_.back() + distance(points_[i - 1], points_[i]));
  }

  double parameter(double fraction) const {
    const double wanted = fraction * length_.back();
    const auto above = std::lower_bound(length_.begin(), length_.end(), wanted);
    return std::min(static_cast<double>(above - length_.begin()) / kParts, 1.0);
  }

 private:
  static constexpr int kParts = 64;
  std::vector<Point2> points_;
  std::vector<double> length_{0.0};
};

double rough_length(const Bezier2& c) {
  return 0.5 * (core::polygon_length(c.control) + distance(c.control.front(), c.control.back()));
}

}  // namespace

double deviation_bound(std::span<const Bezier2> row, const Bezier2& q, double wanted) {
  double total = 0;
  for (const Bezier2& h : row) total += rough_length(h);
  const LengthTable table(q);
  double done = 0;
  double most = 0;
  double u0 = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    done += rough_length(row[i]);
    double u1 = 1;
    if (i + 1 < row.size()) {
      const double guess = total > 0 ? table.parameter(done / total) : u0;
      u1 = foot(q, row[i].control.back(), std::max(guess, u0), u0, 1);
    }
    most = std::max(most, part_bound(row[i], q, u0, u1, wanted, 0));
    u0 = u1;
  }
  return most;
}

}  // namespace keyline::classa
