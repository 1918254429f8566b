#include "keyline/acquire/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "keyline/acquire/going_on.h"
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
constexpr double kTip = 1.25;      // 5.3 / 4.3, rounded up: how much faster the last step may grow
constexpr double kEdgeTip = 1.45;  // the same at each of two points with the tip half way between
constexpr double kSure = 3;        // standard errors by which what is seen is no noise
constexpr std::ptrdiff_t kApart = 2;  // vertices between corners at least
// A corner in the edge between two points.
constexpr std::size_t kSide = 9;  // points of a side: as many as going_on.h asks for, and the last
constexpr double kHolds = 0.1;    // of its depth behind the edge: how far off its sides may be
constexpr double kUneven = 1.25;  // of the distance of points beside: the way round the corner

/// Polygon read with indices that may run past its ends.
class Ring {
 public:
  Ring(std::span<const core::Point2> points, bool closed) : points_(points), closed_(closed) {}

  bool has(std::ptrdiff_t i) const { return closed_ || (i >= 0 && i < size()); }
  std::size_t index(std::ptrdiff_t i) const {
    const std::ptrdiff_t n = size();
    return static_cast<std::size_t>(((i % n) + n) % n);
  }
  core::Point2 operator[](std::ptrdiff_t i) const { return points_[index(i)]; }
  std::size_t count() const { return points_.size(); }
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

/// Where the direction may jump: at a vertex (first and last are it) or in the edge between two.
struct Place {
  std::ptrdiff_t first;
  std::ptrdiff_t last;

  double vertices() const { return static_cast<double>(last - first + 1); }
  /// That many vertices before it, or after it where count is positive.
  std::ptrdiff_t beside(std::ptrdiff_t count) const { return (count < 0 ? first : last) + count; }
  bool has_arms(const Ring& ring, std::ptrdiff_t arm) const {
    return ring.has(first - arm) && ring.has(last + arm);
  }
};

Place vertex(std::ptrdiff_t i) { return {i, i}; }

Turn turn_at(const Ring& ring, Place at, int arm, double noise) {
  const Arm before = arm_of(ring, at.first - arm, at.first);
  const Arm after = arm_of(ring, at.last, at.last + arm);
  return {core::angle_between(before.direction, after.direction),
          1.3 * noise * std::sqrt(1 / before.spread + 1 / after.spread)};
}

double arms_length(const Ring& ring, Place at, int arm) {
  return core::distance(ring[at.first - arm], ring[at.first]) +
         core::distance(ring[at.last], ring[at.last + arm]);
}

/// Largest turn at the four vertices nearest the arms of a place; of a farther one no more than
/// the nearer one's may be by chance, for a bend about the place fades with the distance: what
/// turns more there is another. What noise adds stays in: of a turn that is told by five standard
/// errors (kClearance) it is no share that counts, and taken off it made corners of tips that are
/// bends. Where points stand closer there than at the place, which turns by `angle`, it is what a
/// curve as bent as there turns along the arms of the place: bends are sampled as it comes. Not
/// where a vertex turns by a right angle or more: a bend of which one point tells so much is not
/// known to be one, and what turns the other way beside it is none of it.
double turn_beside(const Ring& ring, Place at, int arm, double noise, double angle) {
  double beside = 0;
  const bool bent = std::abs(angle) < at.vertices() * kUnsampled;
  const double length = bent ? arms_length(ring, at, arm) : 0;
  for (const std::ptrdiff_t way : {-arm, arm}) {
    double most = HUGE_VAL;
    for (const std::ptrdiff_t k : {at.beside(way), at.beside(2 * way)}) {
      if (!vertex(k).has_arms(ring, arm)) continue;
      const Turn flank = turn_at(ring, vertex(k), arm, noise);
      const double closer = std::max(1.0, length / arms_length(ring, vertex(k), arm));
      const bool other_way = std::signbit(flank.angle) != std::signbit(angle);
      const double turn = bent || !other_way ? std::abs(flank.angle) * closer : 0;
      beside = std::max(beside, std::min(turn, most));
      most = turn + kByChance * flank.error * closer;
    }
  }
  return beside;
}

/// True where a place is the tip of a bend: at the vertices an arm away the curve turns the same
/// way and at least kGrowth times as much as two arms away, and at each vertex of the place by no
/// more than that growth, gone on, leads to.
bool is_tip(const Ring& ring, Place at, int arm, double noise, double angle) {
  double expected = 1;  // product of both sides
  for (const std::ptrdiff_t way : {-arm, arm}) {
    if (!vertex(at.beside(2 * way)).has_arms(ring, arm)) return false;
    const Turn near = turn_at(ring, vertex(at.beside(way)), arm, noise);
    const double size = std::copysign(1.0, angle) * near.angle;
    const double next = std::abs(turn_at(ring, vertex(at.beside(2 * way)), arm, noise).angle);
    if (size < kSure * near.error || size < kGrowth * next) return false;
    expected *= size * std::min(size / std::max(next, 1e-300), kMostGrowth);
  }
  return std::abs(angle) <=
         at.vertices() * (at.first == at.last ? kTip : kEdgeTip) * std::sqrt(expected);
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

/// True where the turn between longer arms happens at the place itself, to a standard error: noise
/// as large as the single turns of a bend singles one of them out.
bool is_own_turn(const Ring& ring, Place at, double size, double noise) {
  const auto own = [&](Place k) {
    return k.has_arms(ring, 1) ? std::abs(turn_at(ring, k, 1, 0).angle) : 0.0;
  };
  const double sure = own(at) - turn_at(ring, at, 1, noise).error;
  return sure >= kOwnShare * size &&
         own(at) >=
             1.5 * at.vertices() * std::max(own(vertex(at.beside(-1))), own(vertex(at.beside(1))));
}

/// Turn at a place if it is a corner, else 0. The arm is the shortest that beats the noise.
double corner_turn(const Ring& ring, Place at, const Thresholds& t) {
  for (const int arm : kArms) {
    if (!at.has_arms(ring, arm) || 4 * arm >= ring.size()) return 0;
    const Turn turn = turn_at(ring, at, arm, t.noise);
    const double size = std::abs(turn.angle);
    if (turn.error * kClearance > std::max(t.angle, 0.5 * size)) continue;
    if (size < std::max(kKink * t.angle, 2 * kClearance * turn.error)) return 0;
    const double beside = turn_beside(ring, at, arm, t.noise, turn.angle);
    const double rest = std::max(beside, t.usual);
    if (arm == 1 && size >= at.vertices() * kKinkConcentration * rest) return turn.angle;
    if (size < t.angle || size < at.vertices() * kContrast * t.usual) return 0;
    if (arm > 1 && !is_own_turn(ring, at, size, t.noise)) return 0;
    if (size < at.vertices() * kConcentration * beside) return 0;
    return is_tip(ring, at, arm, t.noise, turn.angle) ? 0 : turn.angle;
  }
  return 0;
}

/// Points of one side of an edge in order towards it, up to the next corner but no more than tell
/// where it goes on to.
std::vector<core::Point2> side_of(const Ring& ring, const std::vector<bool>& cornered,
                                  std::ptrdiff_t from, std::ptrdiff_t step) {
  const std::size_t most = std::min(kSide, ring.count() / 2);
  std::vector<core::Point2> side;
  for (std::ptrdiff_t k = from; ring.has(k) && side.size() < most; k += step) {
    side.push_back(ring[k]);
    if (cornered[ring.index(k)]) break;
  }
  std::ranges::reverse(side);
  return side;
}

/// True where both sides of an edge go on to a corner in it, round which it is no farther than from
/// point to point beside. A bend would leave the last points beside where those before go on to.
bool meet_in(const Ring& ring, const std::vector<bool>& cornered, Place edge, double noise) {
  const auto one = side_of(ring, cornered, edge.first, -1);
  const auto other = side_of(ring, cornered, edge.last, 1);
  const auto place = corner_beyond(one, other);
  if (!place) return false;
  const double round = core::distance(one.back(), *place) + core::distance(*place, other.back());
  const double gap = std::max(core::distance(ring[edge.first - 1], ring[edge.first]),
                              core::distance(ring[edge.last], ring[edge.last + 1]));
  if (round > kUneven * gap) return false;
  const core::Vector2 chord = other.back() - one.back();
  const double depth = std::abs(core::cross(chord, *place - one.back())) / core::norm(chord);
  const auto holds = [&](std::span<const core::Point2> side) {
    const auto off = distance_of_last(side);
    return off && *off <= std::max(kSure * noise, kHolds * depth);
  };
  return holds(one) && holds(other);
}

/// Turns at vertices that are corners, or in the edges after them; of neighbouring ones only the
/// sharpest.
std::vector<std::size_t> sharpest(const Ring& ring, const std::vector<double>& turns) {
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (turns[i] == 0) continue;
    bool is_sharpest = true;
    for (std::ptrdiff_t d = -kApart; d <= kApart && is_sharpest; ++d) {
      const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + d;
      if (d == 0 || !ring.has(k)) continue;
      const double other = std::abs(turns[ring.index(k)]);
      is_sharpest = other < std::abs(turns[i]) || (other == std::abs(turns[i]) && d > 0);
    }
    if (is_sharpest) corners.push_back(i);
  }
  return corners;
}

/// Turns at the vertices that are corners, 0 at all others.
std::vector<double> vertex_turns(const Ring& ring, const Thresholds& t) {
  std::vector<double> turns;
  for (std::ptrdiff_t i = 0; i < ring.size(); ++i) turns.push_back(corner_turn(ring, vertex(i), t));
  return turns;
}

/// The same of the edges after them, but where a corner is within two vertices.
std::vector<double> edge_turns(const Ring& ring, const std::vector<std::size_t>& corners,
                               const Thresholds& t) {
  std::vector<double> turns(ring.count(), 0);
  std::vector<bool> cornered(ring.count(), false);
  for (const std::size_t i : corners) cornered[i] = true;
  const auto near_corner = [&](Place at) {
    for (std::ptrdiff_t k = at.first - kApart; k <= at.last + kApart; ++k)
      if (ring.has(k) && cornered[ring.index(k)]) return true;
    return false;
  };
  for (std::ptrdiff_t i = 0; i < ring.size(); ++i) {
    const Place edge{i, i + 1};
    if (!ring.has(i + 1) || near_corner(edge)) continue;
    const double turn = corner_turn(ring, edge, t);
    if (turn != 0 && meet_in(ring, cornered, edge, t.noise)) turns[ring.index(i)] = turn;
  }
  return turns;
}

}  // namespace

std::vector<std::size_t> find_corners(std::span<const core::Point2> points, bool closed,
                                      double noise, double angle) {
  if (points.size() < 4) return {};
  const Ring ring(points, closed);
  const Thresholds thresholds{noise, angle, usual_turn(ring)};
  std::vector<std::size_t> corners = sharpest(ring, vertex_turns(ring, thresholds));
  const auto between = sharpest(ring, edge_turns(ring, corners, thresholds));
  corners.insert(corners.end(), between.begin(), between.end());
  std::ranges::sort(corners);
  return corners;
}

}  // namespace keyline::acquire
