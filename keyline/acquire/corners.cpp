#include "keyline/acquire/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/acquire/local_fit.h"
#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"
#include "keyline/core/second_moments.h"

namespace keyline::acquire {
namespace {

constexpr std::array<int, 4> kArms{1, 2, 3, 4};
constexpr double kConcentration = 2.5;     // turn at the corner against the turn beside it
constexpr double kContrast = 3;            // and against the usual turn of the whole polygon
constexpr double kClearance = 5;           // turn at the corner against its standard error
constexpr double kByChance = 2;            // standard errors that a turn may be off by chance
constexpr double kOwnShare = 0.5;          // of the turn between the arms, at the vertex itself
constexpr double kKink = 0.17;             // of the corner angle: a kink between very smooth runs
constexpr double kKinkConcentration = 12;  // its turn against the turn beside it
constexpr double kUnsampled = 0.5 * std::numbers::pi;  // a bend turns by less at each of its points
// The tip of a bend that shows at one point only: turns grow towards it on both sides, and it turns
// by no more than that growth goes on to. At the tip of a parabola, sampled evenly in its
// parameter, a point that turns by 113 degrees turns 5.3 times as much as the points beside it, and
// these 4.3 times as much as the next.
constexpr double kGrowth = 2;        // least growth from one turn to the next
constexpr double kMostGrowth = 4.3;  // growth beyond this says nothing about the tip
constexpr double kTip = 1.25;  // 5.3 / 4.3, rounded up: how much faster the last step may grow
constexpr double kSure = 3;    // standard errors by which the turns beside it are no noise

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
  core::SecondMoments moments;
  for (std::ptrdiff_t i = from; i <= to; ++i) moments.add(ring[i] - mean);
  core::Vector2 v = moments.direction();
  if (core::dot(v, ring[to] - ring[from]) < 0) v = -v;
  return {v, moments.along()};
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

double arms_length(const Ring& ring, std::ptrdiff_t i, int arm) {
  return core::distance(ring[i - arm], ring[i]) + core::distance(ring[i], ring[i + arm]);
}

/// Largest turn at the four vertices nearest the arms of vertex i; of a farther one no more than
/// the nearer one's may be by chance, for a bend about i fades with the distance: what turns more
/// there is another. What noise adds stays in: of a turn that is told by five standard errors
/// (kClearance) it is no share that counts, and taken off it made corners of tips that are bends.
/// Where points stand closer there than at i, which turns by `angle`, it is what a curve as bent as
/// there turns along the arms of i: bends are sampled as it comes. Not where i turns by a right
/// angle or more: a bend of which one point tells so much is not known to be one, and what turns
/// the other way beside it is none of it.
double turn_beside(const Ring& ring, std::ptrdiff_t i, int arm, double noise, double angle) {
  double beside = 0;
  const bool bent = std::abs(angle) < kUnsampled;
  const double length = bent ? arms_length(ring, i, arm) : 0;
  for (const std::ptrdiff_t way : {-arm, arm}) {
    double most = HUGE_VAL;
    for (const std::ptrdiff_t k : {i + way, i + 2 * way}) {
      if (!ring.has(k - arm) || !ring.has(k + arm)) continue;
      const Turn flank = turn_at(ring, k, arm, noise);
      const double closer = std::max(1.0, length / arms_length(ring, k, arm));
      const bool other_way = std::signbit(flank.angle) != std::signbit(angle);
      const double turn = bent || !other_way ? std::abs(flank.angle) * closer : 0;
      beside = std::max(beside, std::min(turn, most));
      most = turn + kByChance * flank.error * closer;
    }
  }
  return beside;
}

/// True where vertex i is the tip of a bend: at the vertices an arm away the curve turns the same
/// way and at least kGrowth times as much as two arms away, and at i by no more than that growth,
/// gone on, leads to.
bool is_tip(const Ring& ring, std::ptrdiff_t i, int arm, double noise, double angle) {
  double expected = 1;  // product of both sides
  for (const std::ptrdiff_t way : {-arm, arm}) {
    if (!ring.has(i + 2 * way - arm) || !ring.has(i + 2 * way + arm)) return false;
    const Turn near = turn_at(ring, i + way, arm, noise);
    const double size = std::copysign(1.0, angle) * near.angle;
    const double next = std::abs(turn_at(ring, i + 2 * way, arm, noise).angle);
    if (size < kSure * near.error || size < kGrowth * next) return false;
    expected *= size * std::min(size / std::max(next, 1e-300), kMostGrowth);
  }
  return std::abs(angle) <= kTip * std::sqrt(expected);
}

/// Turn that four fifths of the vertices stay below.
double usual_turn(const Ring& ring) {
  std::vector<double> turns;
  for (std::ptrdiff_t i = 0; i < ring.size(); ++i) {
    if (!ring.has(i - 1) || !ring.has(i + 1)) continue;
    turns.push_back(std::abs(core::angle_between(ring[i] - ring[i - 1], ring[i + 1] - ring[i])));
  }
  return core::quantile(std::move(turns), 4, 5);
}

struct Thresholds {
  double noise;
  double angle;
  double usual;
};

/// True where the turn between longer arms happens at the vertex itself, to a standard error: noise
/// as large as the single turns of a bend singles one of them out.
bool is_own_turn(const Ring& ring, std::ptrdiff_t i, double size, double noise) {
  const auto own = [&](std::ptrdiff_t k) {
    if (!ring.has(k - 1) || !ring.has(k + 1)) return 0.0;
    return std::abs(core::angle_between(ring[k] - ring[k - 1], ring[k + 1] - ring[k]));
  };
  const double sure = own(i) - turn_at(ring, i, 1, noise).error;
  return sure >= kOwnShare * size && own(i) >= 1.5 * std::max(own(i - 1), own(i + 1));
}

/// Turn at vertex i if it is a corner, else 0. The arm is the shortest that beats the noise.
double corner_turn(const Ring& ring, std::ptrdiff_t i, const Thresholds& t) {
  for (const int arm : kArms) {
    if (!ring.has(i - arm) || !ring.has(i + arm) || 4 * arm >= ring.size()) return 0;
    const Turn turn = turn_at(ring, i, arm, t.noise);
    const double size = std::abs(turn.angle);
    if (turn.error * kClearance > std::max(t.angle, 0.5 * size)) continue;
    if (size < std::max(kKink * t.angle, 2 * kClearance * turn.error)) return 0;
    const double beside = turn_beside(ring, i, arm, t.noise, turn.angle);
    const double rest = std::max(beside, t.usual);
    if (arm == 1 && size >= kKinkConcentration * rest) return turn.angle;
    if (size < t.angle || size < kContrast * t.usual) return 0;
    if (arm > 1 && !is_own_turn(ring, i, size, t.noise)) return 0;
    if (size < kConcentration * beside) return 0;
    return is_tip(ring, i, arm, t.noise, turn.angle) ? 0 : turn.angle;
  }
  return 0;
}

}  // namespace

std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle) {
  const Ring ring(points, closed);
  std::vector<double> turns(points.size(), 0);
  if (points.size() >= 4) {
    const Thresholds thresholds{noise, angle, usual_turn(ring)};
    for (std::size_t i = 0; i < points.size(); ++i) {
      turns[i] = corner_turn(ring, static_cast<std::ptrdiff_t>(i), thresholds);
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

namespace {

constexpr std::size_t kFewest = 6;  // points: of fewer a line alone tells, which bends leave
constexpr int kMostDegree = 3;
constexpr double kTells = 10.13;  // F of 1 and 3 degrees of freedom that chance passes in one of 20
constexpr double kReach = 2;      // of the gap between two sides: how far a corner in it may be
constexpr int kSteps = 20;        // of Newton
constexpr double kMet = 1e-12;    // of the gap
constexpr double kLeastSine = 0.1;    // of the angle at which sides meet: others touch anywhere
constexpr double kDifference = 1e-4;  // of the gap: for slopes

/// A polynomial through twice as many of the last points as it has terms.
std::optional<detail::LocalFit> fit_last(std::span<const core::Point2> points, int degree) {
  const auto count = static_cast<std::size_t>(2 * (degree + 1));
  if (points.size() < std::max(count, kFewest)) return std::nullopt;
  return detail::LocalFit::make(points.last(count), degree);
}

/// A line through the last six points, or a parabola where these tell its bend.
std::optional<detail::LocalFit> going_on(std::span<const core::Point2> points) {
  if (points.size() < kFewest) return std::nullopt;
  const auto line = detail::LocalFit::make(points.last(kFewest), 1);
  const auto parabola = detail::LocalFit::make(points.last(kFewest), 2);
  if (!line || !parabola) return line;
  const double left = parabola->squared_residuals() / (kFewest - 3);
  return line->squared_residuals() - parabola->squared_residuals() > kTells * left ? parabola
                                                                                   : line;
}

/// Where both are 0, from a place on.
std::optional<core::Point2> crossing(const detail::LocalFit& one, const detail::LocalFit& other,
                                     core::Point2 from, double gap) {
  const double h = kDifference * gap;
  const auto slope = [h](const detail::LocalFit& fit, core::Point2 p) {
    return core::Vector2{
               fit.residual(p + core::Vector2{h, 0}) - fit.residual(p - core::Vector2{h, 0}),
               fit.residual(p + core::Vector2{0, h}) - fit.residual(p - core::Vector2{0, h})} /
           (2 * h);
  };
  for (int step = 0; step < kSteps; ++step) {
    const double f = one.residual(from);
    const double g = other.residual(from);
    if (std::max(std::abs(f), std::abs(g)) <= kMet * gap) return from;
    const core::Vector2 u = slope(one, from);
    const core::Vector2 v = slope(other, from);
    const double det = core::cross(u, v);
    if (!(std::abs(det) >= kLeastSine * core::norm(u) * core::norm(v))) return std::nullopt;
    from = from + core::Vector2{g * u.y - f * v.y, f * v.x - g * u.x} / det;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> distance_beyond(std::span<const core::Point2> points, core::Point2 p) {
  std::optional<double> least;
  for (int degree = 1; degree <= kMostDegree; ++degree) {
    const auto fit = fit_last(points, degree);
    if (!fit) continue;
    const double off = std::abs(fit->residual(p));
    least = std::min(least.value_or(off), off);
  }
  return least;
}

std::optional<core::Point2> corner_beyond(std::span<const core::Point2> one,
                                          std::span<const core::Point2> other) {
  const auto before = going_on(one);
  const auto after = going_on(other);
  if (!before || !after) return std::nullopt;
  const double gap = core::distance(one.back(), other.back());
  const auto met = crossing(*before, *after, one.back() + (other.back() - one.back()) / 2, gap);
  if (!met) return std::nullopt;
  for (const auto& side : {one, other}) {
    const core::Vector2 on = *met - side.back();
    const core::Vector2 way = side.back() - side[side.size() - 2];
    if (core::dot(on, way) < 0 || core::norm(on) > kReach * gap) return std::nullopt;
  }
  return met;
}

}  // namespace keyline::acquire
