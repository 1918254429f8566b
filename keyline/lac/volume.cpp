#include "keyline/lac/volume.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/lac/slope.h"
#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

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

/// Segments from one end to the other, for a chord of length 1 along x: leaving at `from`, arriving
/// at an angle to the other side.
class Family {
 public:
  Family(double from, double alpha) : from_(from), alpha_(alpha) {}

  std::optional<SegmentSolution> at(double arrival) const {
    const double to = from_ > 0 ? -arrival : arrival;
    auto s = solve_g1_directions({{0, 0}, from_}, {{1, 0}, to}, alpha_);
    if (!s) return std::nullopt;
    return *s;
  }
  /// NaN where there is no curve.
  double area(double arrival) const {
    const auto s = at(arrival);
    return s ? std::abs(chord_area(s->segment)) : std::nan("");
  }
  /// The last arrival angle with a curve on the way from the symmetric one to `limit`.
  double last_towards(double limit) const {
    double good = std::abs(from_);
    if (at(limit)) return limit;
    double bad = limit;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (good + bad);
      (at(middle) ? good : bad) = middle;
    }
    return good;
  }

 private:
  double from_;
  double alpha_;
};

std::unexpected<core::Failure> unreachable(const VolumeRange& range, double volume) {
  char text[160];
  std::snprintf(text, sizeof text,
                "with these ends, direction and slope the volume lies between %.9g and %.9g",
                range.smallest, range.largest);
  char hint[64];
  const double nearest = volume < range.smallest ? range.smallest : range.largest;
  std::snprintf(hint, sizeof hint, "nearest volume %.9g", nearest);
  return core::fail(ErrorCode::undrawable, text, hint, "volume");
}

core::Result<void> checked(const Pose2& start, core::Point2 end, double alpha, double volume) {
  if (!is_finite(start.position) || !std::isfinite(start.direction) || !is_finite(end)) {
    return core::fail(ErrorCode::bad_input, "a position or direction is not finite");
  }
  if (!is_slope(alpha)) {
    return core::fail(ErrorCode::bad_input, kSlopeRule, {}, "alpha");
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

void place_at(SegmentSolution& solution, const Pose2& start, double chord) {
  Segment& s = solution.segment;
  s.start = start;
  s.length *= chord;
  s.curvature_start /= chord;
  s.curvature_end /= chord;
}

core::Result<VolumeSolution> straight(const Pose2& start, double chord, double alpha,
                                      double volume) {
  if (volume > 0) return unreachable({0, 0}, volume);
  VolumeSolution line;
  line.solution.segment = {start, alpha, chord, 0, 0};
  return line;
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

core::Result<VolumeSolution> solve_volume(const Pose2& start, core::Point2 end, double alpha,
                                          double volume) {
  if (const auto ok = checked(start, end, alpha, volume); !ok) return std::unexpected(ok.error());
  const Vector2 across = end - start.position;
  const double chord = norm(across);
  const double from = core::wrap_angle(start.direction - core::direction_of(across));
  if (from == 0) return straight(start, chord, alpha, volume);
  const Family family(from, alpha);
  if (!family.at(std::abs(from))) {
    return core::fail(ErrorCode::undrawable, "the direction points straight back along the chord",
                      "turn it to one side");
  }
  const double unit_volume = volume / chord / chord;
  const double low = family.last_towards(1e-9 * std::abs(from));
  const double high = family.last_towards(core::kPi - 1e-6);
  const VolumeRange range{family.area(low), family.area(high)};
  const VolumeRange reachable{range.smallest * chord * chord, range.largest * chord * chord};
  if (!(unit_volume >= range.smallest) || !(unit_volume <= range.largest)) {
    return unreachable(reachable, volume);
  }
  const auto arrival = numeric::bracketed_root(
      [&](double b) { return family.area(b) - unit_volume; }, low, high, 1e-15);
  const auto found = arrival ? family.at(*arrival) : std::nullopt;
  if (!found) {
    return core::fail(ErrorCode::not_converged, "the search for the end direction broke down");
  }
  VolumeSolution solution{*found, 0, reachable};
  solution.volume = std::abs(chord_area(found->segment)) * chord * chord;
  place_at(solution.solution, start, chord);
  return solution;
}

}  // namespace keyline::lac
