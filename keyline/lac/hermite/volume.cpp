#include "keyline/lac/hermite/volume.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/halving.h"
#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

constexpr double kStraightBack = 1e-6;  // radians from it: a curve there is as long as a million

using core::ErrorCode;
using core::Pose2;
using core::Vector2;

/// Fractions that cut a piece so that its panels shrink towards both ends, where curvature may
/// vanish or grow without bound.
std::vector<double> graded_cuts(double low, double high) {
  std::vector<double> cuts;
  for (const double f : {0.0, 1e-6, 1e-4, 2e-3, 0.02, 0.1, 0.3}) cuts.push_back(f);
  for (const double f : {0.5, 0.7, 0.9, 0.98, 0.998, 1 - 1e-4, 1 - 1e-6, 1.0}) cuts.push_back(f);
  for (double& f : cuts) f = low + f * (high - low);
  return cuts;
}

double area_of(const G1Chain& s) { return std::abs(chord_area(s.chain)); }
double area_of(const CompoundSolution& s) { return std::abs(chord_area(s.chain)); }

/// Curves from one end to the other, for a chord of length 1 along x, leaving at an angle to one
/// side and arriving at an angle to the other: `solve` makes the curve of an arrival angle.
template <class Solve>
class Family {
 public:
  /// inside: an arrival angle that there is a curve of, if there is one.
  Family(double inside, const Solve& solve) : inside_(inside), solve_(solve) {}

  auto at(double arrival) const { return solve_(arrival); }
  /// NaN where there is no curve.
  double area(double arrival) const {
    const auto s = at(arrival);
    return s ? area_of(*s) : std::nan("");
  }
  /// The last arrival angle with a curve on the way from the one inside to `limit`.
  double last_towards(double limit) const {
    if (at(limit)) return limit;
    constexpr int kHalvings = 60;  // to rounding
    return numeric::last_that_holds([this](double b) { return at(b).has_value(); }, inside_, limit,
                                    kHalvings);
  }

 private:
  double inside_;
  const Solve& solve_;
};

/// One of those curves, and what areas they have.
template <class Solution>
struct Found {
  Solution solution;
  VolumeRange range;
};

std::unexpected<core::Failure> unreachable(const VolumeRange& range, double volume) {
  const std::string smallest = core::number_text(range.smallest, 9);
  const std::string largest = core::number_text(range.largest, 9);
  return core::fail(ErrorCode::undrawable,
                    "with these ends, direction and slope the volume lies between " + smallest +
                        " and " + largest,
                    "nearest volume " + (volume < range.smallest ? smallest : largest), "volume");
}

core::Result<void> checked(const Pose2& start, core::Point2 end, double volume) {
  if (!is_finite(start.position) || !std::isfinite(start.direction) || !is_finite(end)) {
    return core::fail(ErrorCode::bad_input, "a position or direction is not finite");
  }
  if (!(volume >= 0) || std::isinf(volume)) {
    return core::fail(ErrorCode::bad_input, "the volume must be a number from 0 on", {}, "volume");
  }
  const double chord = norm(end - start.position);
  if (!(chord > 0) || std::isinf(chord)) {
    return core::fail(ErrorCode::bad_input, "start and end point coincide", "move one of them");
  }
  return {};
}

/// The curve of a chord of length 1 in its place.
void place_at(Chain& chain, const Pose2& start, double chord) {
  chain.start = start;
  for (Piece& p : chain.pieces)
    p = {p.alpha, p.length * chord, p.curvature_start / chord, p.curvature_end / chord};
}

/// How a request stands to its chord.
struct Across {
  double chord = 1;
  double from = 0;  ///< of the start direction, from the chord
};
Across across_of(const Pose2& start, core::Point2 end) {
  const Vector2 way = end - start.position;
  return {norm(way), core::wrap_angle(start.direction - core::direction_of(way))};
}

/// The curve of the family with this volume, over a chord of length 1.
template <class Solve>
auto with_volume(const Across& across, double widest, double volume, const Solve& solve)
    -> core::Result<Found<typename decltype(solve(1.0))::value_type>> {
  const double from = std::abs(across.from);
  if (core::kPi - from < kStraightBack)
    return core::fail(ErrorCode::undrawable, "the direction points straight back along the chord",
                      "turn it to one side");
  // The symmetric one; where that turns too far, the one nearest to it: the farther a curve turns
  // the steeper it may leave.
  const double inside = std::min(from, widest);
  const Family<Solve> family(inside, solve);
  if (!family.at(inside))
    return core::fail(
        ErrorCode::undrawable,
        "no curve of this rhythm leaves in this direction and turns by less than half "
        "a circle",
        "turn the direction towards the chord", "direction");
  const double square = across.chord * across.chord;
  const double unit_volume = volume / square;
  const double low = family.last_towards(1e-9 * from);
  const double high = family.last_towards(widest);
  const VolumeRange range{family.area(low), family.area(high)};
  const VolumeRange reachable{range.smallest * square, range.largest * square};
  if (!(unit_volume >= range.smallest) || !(unit_volume <= range.largest)) {
    return unreachable(reachable, volume);
  }
  const auto arrival = numeric::bracketed_root(
      [&](double b) { return family.area(b) - unit_volume; }, low, high, 1e-15);
  auto found = arrival ? family.at(*arrival) : std::nullopt;
  if (!found || !(std::abs(area_of(*found) - unit_volume) <= 1e-9 * unit_volume + 1e-13)) {
    return core::fail(ErrorCode::not_converged, "the search for the end direction broke down");
  }
  return Found<typename decltype(solve(1.0))::value_type>{std::move(*found), reachable};
}

/// The line, where the direction is that of the chord.
core::Result<void> only_straight(double volume) {
  if (volume > 0) return unreachable({0, 0}, volume);
  return {};
}

}  // namespace

double chord_area(const Segment& segment) {
  constexpr const auto& rule = numeric::gauss_legendre<14>;
  Segment local = segment;
  local.start = {};
  const auto breaks = breakpoints(local);
  std::vector<double> at;
  std::vector<double> weight;
  for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
    const auto cuts = graded_cuts(breaks[b], breaks[b + 1]);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        at.push_back(cuts[c] + rule.nodes[i] * (cuts[c + 1] - cuts[c]));
        weight.push_back(rule.weights[i] * (cuts[c + 1] - cuts[c]));
      }
    }
  }
  std::vector<core::Point2> points(at.size());
  sample(local, at, points);
  double sum = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vector2 tangent = core::unit_vector(tangent_angle(local, at[i]));
    sum += weight[i] * cross(points[i] - core::Point2{}, tangent);
  }
  return 0.5 * segment.length * sum;
}

double chord_area(const Chain& chain) {
  double twice = 0;
  double own = 0;
  const auto at = joints(chain);
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    own += chord_area(place(chain.pieces[i], at[i]));
    twice += cross(at[i].position - at[0].position, at[i + 1].position - at[0].position);
  }
  return own + 0.5 * twice;
}

core::Result<VolumeSolution> solve_volume(const Pose2& start, core::Point2 end, double alpha,
                                          double volume) {
  if (const auto ok = checked(start, end, volume); !ok) return std::unexpected(ok.error());
  if (!is_slope(alpha)) return core::fail(ErrorCode::bad_input, kSlopeRule, {}, "alpha");
  const Across across = across_of(start, end);
  VolumeSolution answer;
  if (across.from == 0) {
    if (auto line = only_straight(volume); !line) return std::unexpected(line.error());
    answer.solution.chain = lac::chain_of(Segment{start, alpha, across.chord, 0, 0});
    return answer;
  }
  const auto solve = [&](double arrival) -> std::optional<G1Chain> {
    const double to = across.from > 0 ? -arrival : arrival;
    auto s = solve_g1_directions_chain({{0, 0}, across.from}, {{1, 0}, to}, alpha);
    return s ? std::optional(std::move(*s)) : std::nullopt;
  };
  auto found = with_volume(across, core::kPi - kStraightBack, volume, solve);
  if (!found) return std::unexpected(found.error());
  answer.solution = std::move(found->solution);
  answer.volume = area_of(answer.solution) * across.chord * across.chord;
  answer.reachable = found->range;
  place_at(answer.solution.chain, start, across.chord);
  return answer;
}

core::Result<CompoundVolumeSolution> solve_volume(const Pose2& start, core::Point2 end,
                                                  const CompoundRhythm& rhythm, double volume) {
  if (const auto ok = checked(start, end, volume); !ok) return std::unexpected(ok.error());
  const Across across = across_of(start, end);
  CompoundVolumeSolution answer;
  // The rhythm is checked by the solver itself, with a triangle that every rhythm meets.
  if (auto sound = solve_compound({1, 0.5, 1, 0}, rhythm); !sound)
    return std::unexpected(sound.error());
  if (across.from == 0) {
    if (auto line = only_straight(volume); !line) return std::unexpected(line.error());
    const auto& [a0, a1, share] = rhythm;
    answer.solution.chain = {
        start, {{a0, across.chord * share, 0, 0}, {a1, across.chord * (1 - share), 0, 0}}, false};
    answer.solution.joint = segment_at(answer.solution.chain, 1).start.position;
    return answer;
  }
  const double from = std::abs(across.from);
  const auto solve = [&](double arrival) -> std::optional<CompoundSolution> {
    const double sign = across.from > 0 ? -1 : 1;
    auto s = solve_compound({sign * (from + arrival), sign * from, 1, across.from}, rhythm);
    return s ? std::optional(std::move(*s)) : std::nullopt;
  };
  auto found = with_volume(across, core::kPi - from - kStraightBack, volume, solve);
  if (!found) return std::unexpected(found.error());
  answer.solution = std::move(found->solution);
  answer.volume = area_of(answer.solution) * across.chord * across.chord;
  answer.reachable = found->range;
  Chain& chain = answer.solution.chain;
  place_at(chain, start, across.chord);
  answer.solution.joint = segment_at(chain, answer.solution.joint_piece).start.position;
  return answer;
}

}  // namespace keyline::lac
