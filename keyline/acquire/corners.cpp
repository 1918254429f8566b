#include "keyline/acquire/corners.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::acquire {
namespace {

constexpr std::array<int, 5> kArms{1, 2, 3, 4, 6};
constexpr double kConcentration = 3;  // turn at the corner against the turn beside it
constexpr double kClearance = 5;      // turn at the corner against its standard error

/// Polygon read with indices that may run past its ends.
class Ring {
 public:
  Ring(std::span<const core::Point2> points, bool closed) : points_(points), closed_(closed) {}

  bool has(std::ptrdiff_t i) const { return closed_ || (i >= 0 && i < size()); }
  core::Point2 operator[](std::ptrdiff_t i) const {
    const std::ptrdiff_t n = size();
    return points_[static_cast<std::size_t>(((i % n) + n) % n)];
  }
  std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(points_.size()); }

 private:
  std::span<const core::Point2> points_;
  bool closed_;
};

/// Straight line through points from..from+count: direction and its spread along the line.
struct Arm {
  core::Vector2 direction;
  double spread = 0;  // sum of squared distances from the mean along the line
};

Arm arm_of(const Ring& ring, std::ptrdiff_t from, std::ptrdiff_t to) {
  core::Vector2 sum;
  const double count = static_cast<double>(to - from + 1);
  for (std::ptrdiff_t i = from; i <= to; ++i) sum = sum + (ring[i] - ring[from]);
  const core::Point2 mean = ring[from] + sum / count;
  double xx = 0, xy = 0, yy = 0;
  for (std::ptrdiff_t i = from; i <= to; ++i) {
    const core::Vector2 d = ring[i] - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double half = 0.5 * std::atan2(2 * xy, xx - yy);
  core::Vector2 v = core::unit_vector(half);
  if (core::dot(v, ring[to] - ring[from]) < 0) v = -v;
  const double spread = 0.5 * (xx + yy) + 0.5 * std::hypot(2 * xy, xx - yy);
  return {v, spread};
}

struct Turn {
  double angle = 0;
  double error = 0;  // standard deviation from noise
};

Turn turn_at(const Ring& ring, std::ptrdiff_t i, int arm, double noise) {
  const Arm before = arm_of(ring, i - arm, i);
  const Arm after = arm_of(ring, i, i + arm);
  return {core::angle_between(before.direction, after.direction),
          1.3 * noise * std::sqrt(1 / before.spread + 1 / after.spread)};
}

/// Turn at vertex i if it is a corner, else 0. The arm is the shortest that beats the noise.
double corner_turn(const Ring& ring, std::ptrdiff_t i, double noise, double angle) {
  for (const int arm : kArms) {
    if (!ring.has(i - arm) || !ring.has(i + arm) || 4 * arm >= ring.size()) return 0;
    const Turn turn = turn_at(ring, i, arm, noise);
    if (turn.error * kClearance > std::max(angle, 0.5 * std::abs(turn.angle))) continue;
    if (std::abs(turn.angle) < std::max(angle, kClearance * turn.error)) return 0;
    double beside = 0;
    for (const std::ptrdiff_t k : {i - arm, i + arm}) {
      if (!ring.has(k - arm) || !ring.has(k + arm)) continue;
      const Turn flank = turn_at(ring, k, arm, noise);
      beside = std::max(beside, std::abs(flank.angle) - 2 * flank.error);
    }
    return std::abs(turn.angle) >= kConcentration * beside ? turn.angle : 0;
  }
  return 0;
}

}  // namespace

std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle) {
  const Ring ring(points, closed);
  std::vector<double> turns(points.size(), 0);
  if (points.size() >= 4) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      turns[i] = corner_turn(ring, static_cast<std::ptrdiff_t>(i), noise, angle);
    }
  }
  // Of neighbouring candidates only the sharpest is the corner.
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (turns[i] == 0) continue;
    bool sharpest = true;
    for (std::ptrdiff_t d = -2; d <= 2 && sharpest; ++d) {
      const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + d;
      if (d == 0 || !ring.has(k)) continue;
      const double other =
          std::abs(turns[static_cast<std::size_t>((k + ring.size()) % ring.size())]);
      sharpest = other < std::abs(turns[i]) || (other == std::abs(turns[i]) && d > 0);
    }
    if (sharpest) corners.push_back(i);
  }
  return corners;
}

}  // namespace keyline::acquire
