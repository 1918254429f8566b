#include "keyline/acquire/ends.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"

namespace keyline::acquire {
namespace {

constexpr double kAcross = 0.8;      // radians
constexpr double kOften = 4.6;       // -ln(0.01): one loop in a hundred has a wider gap
constexpr double kSeamCorner = 0.9;  // radians; less is no corner at the seam of an outline
constexpr double kCornerTurns = 3;   // times what the curve beside it does
constexpr double kClearance = 4;     // and less than so many standard errors of the turn there
constexpr double kByChance = 2;      // the same of the turns beside it, which no corner is beside
constexpr double kNoTurn = 1e-9;     // radians
constexpr double kAbout = 0.7;       // of the steps at the ends: about as long as those

/// Largest of the steps near both ends.
double spacing_at_ends(std::span<const core::Point2> points, std::size_t stride) {
  double most = 0;
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < 3 && (k + 1) * stride < n; ++k) {
    most = std::max(most, core::distance(points[k * stride], points[(k + 1) * stride]));
    most = std::max(most,
                    core::distance(points[n - 1 - k * stride], points[n - 1 - (k + 1) * stride]));
  }
  return most;
}

/// The points from one end inwards.
class FromEnd {
 public:
  FromEnd(std::span<const core::Point2> points, bool first) : points_(points), first_(first) {}

  core::Point2 operator[](std::size_t k) const {
    return first_ ? points_[k] : points_[points_.size() - 1 - k];
  }

  /// The first point, from the one with that index on, that is at least so far away.
  std::size_t away(double distance, std::size_t from) const {
    std::size_t k = from;
    while (k + 1 < points_.size() / 4 && core::distance((*this)[0], (*this)[k]) < distance) ++k;
    return k;
  }

 private:
  std::span<const core::Point2> points_;
  bool first_;
};

/// An end of an outline: the direction of the step inwards, how far the next one turns from it, and
/// the one after that from the next.
struct EndStep {
  core::Vector2 inwards;
  double turn = 0;
  double turn_before = 0;

  /// What a curve that bends more and more, as on its way to a round tip, turns at the end, if of
  /// the turn so much is sure and errors make that much.
  double expected(double sure, double error) const {
    const double growth = sure / std::max({turn_before, error, kNoTurn});
    return sure * std::clamp(growth, 1.0, kCornerTurns);
  }
};

/// A step goes to the first point that is so far away: in shorter ones the points' errors may make
/// any direction.
EndStep end_step(const FromEnd& at, double away, std::size_t stride) {
  const std::size_t k = at.away(away, stride);
  const core::Vector2 step = at[k] - at[0];
  const core::Vector2 next = at[2 * k] - at[k];
  return {step, std::abs(core::angle_between(step, next)),
          std::abs(core::angle_between(next, at[3 * k] - at[2 * k]))};
}

/// Whether the turn from the gap into the steps at an end stands out from the curve's own beside
/// it, which is over as much way. Errors add to that one in squares, so that they hide no corner;
/// where it is more than they explain, the curve bends.
bool stands_out(const FromEnd& at, core::Vector2 over_gap, double away, std::size_t stride,
                double noise) {
  const EndStep end = end_step(at, away, stride);
  const double by_chance = kByChance * std::sqrt(1.5) * 2 * noise / core::norm(end.inwards);
  const double sure = std::sqrt(std::max(0.0, end.turn * end.turn - by_chance * by_chance));
  return std::abs(core::angle_between(over_gap, end.inwards)) >=
         kCornerTurns * end.expected(sure, by_chance);
}

/// Whether both ends are corners, each by itself: at a round tip the seam holds the turns of two
/// steps and the gap, and those of steps beside it are on their way there.
bool is_blunt(std::span<const core::Point2> points, double away, std::size_t stride, double noise) {
  const core::Vector2 chord = points.front() - points.back();
  const auto both = [&](double far) {
    return stands_out({points, false}, -chord, far, stride, noise) &&
           stands_out({points, true}, chord, far, stride, noise);
  };
  return both(0) && both(away);
}

/// True where the chord between the ends goes on from the curve before it and into that after it.
bool runs_across(std::span<const core::Point2> points) {
  const core::Vector2 chord = points.front() - points.back();
  const double away = 0.25 * core::norm(chord);
  const EndStep last = end_step({points, false}, away, 1);
  const EndStep first = end_step({points, true}, away, 1);
  return std::abs(core::angle_between(-last.inwards, chord)) < kAcross &&
         std::abs(core::angle_between(chord, first.inwards)) < kAcross;
}

/// The widest gap that points scattered evenly over a loop leave, as a share of its length: of n it
/// passes (ln n + x) / n in a share 1 - exp(-exp(-x)) of all cases (Lévy 1939; Holst 1980).
double widest_gap_by_chance(std::size_t n) {
  const auto count = static_cast<double>(n);
  return std::min((std::log(count) + kOften) / count, 0.2);
}

}  // namespace

Ends recognise_ends(std::span<const core::Point2> points, std::size_t stride, bool scattered,
                    double noise) {
  const std::size_t n = points.size();
  const std::size_t s = std::max<std::size_t>(stride, 1);
  if (n < 4 || n <= 6 * s) return Ends::apart;
  const double length = core::polygon_length(points);
  const double gap = core::distance(points.front(), points.back());
  const bool repeated = gap <= 1e-9 * length;
  const double spacing = spacing_at_ends(points, s);
  const bool near = n >= 8 && gap <= 1.75 * spacing && gap <= 0.2 * length;
  // A wider gap still belongs to an outline if the curve runs straight across it.
  const double widest = scattered ? std::max(0.05, widest_gap_by_chance(n)) * (length + gap)
                                  : std::min(4 * spacing, 0.05 * length);
  const bool facing = n >= 8 && gap <= widest && runs_across(points);
  if (!repeated && !near && !facing) return Ends::apart;

  const double away = std::max({gap, kAbout * spacing, 2 * kClearance / kSeamCorner * noise});
  const EndStep last = end_step({points, false}, away, s);
  const EndStep first = end_step({points, true}, away, s);
  const double seam = core::angle_between(-last.inwards, first.inwards);
  // Of steps without a common end, and of the next ones, which have one that counts twice.
  const double error = 2 * noise / away;
  const double by_chance = kByChance * std::sqrt(1.5) * error;
  const auto expected = [by_chance](const EndStep& end) {
    return end.expected(std::max(0.0, end.turn - by_chance), by_chance);
  };
  const bool corner = std::abs(seam) >= std::max(kSeamCorner, kClearance * error) &&
                      std::abs(seam) >= kCornerTurns * std::max(expected(last), expected(first));
  if (repeated) return corner ? Ends::corner_repeated : Ends::closed_repeated;
  if (!corner) return Ends::closed;
  const core::Vector2 chord = points.front() - points.back();
  const double at_last = std::abs(core::angle_between(-last.inwards, chord));
  const double at_first = std::abs(core::angle_between(chord, first.inwards));
  if (std::min(at_last, at_first) >= 0.3 * std::max(at_last, at_first))
    return is_blunt(points, away, s, noise) ? Ends::blunt : Ends::closed;
  return at_first > at_last ? Ends::corner_at_first : Ends::corner_at_last;
}

}  // namespace keyline::acquire
