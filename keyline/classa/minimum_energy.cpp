#include "keyline/classa/minimum_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "keyline/classa/energy_refine.h"
#include "keyline/classa/reach.h"
#include "keyline/core/angle.h"
#include "keyline/core/text.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Interval;
using core::kPi;
using detail::Candidate;
using detail::Frame;
using detail::ReachTable;
using detail::Rim;
using detail::Target;

namespace {

constexpr int kAlphaStarts = 9;  // per feasible range
constexpr int kRimStarts = 8;    // points around the allowed end

// ---- Starts -------------------------------------------------------------------------------

/// The least of the samples of one winding on each range of alpha, and its local minima there.
std::vector<Candidate> starts_of(const Frame& f, const ReachTable& table, int winding) {
  std::vector<Candidate> starts;
  const int rims = f.slack > 0 ? kRimStarts : 1;
  for (int r = 0; r < rims; ++r) {
    const Rim rim{2 * kPi * r / rims, winding};
    for (const Interval& range : feasible_alpha(f, table, target_at(f, rim).angle)) {
      std::array<Candidate, kAlphaStarts + 1> line;
      for (int i = 0; i <= kAlphaStarts; ++i) {
        const double u = i / static_cast<double>(kAlphaStarts);
        line[i] = candidate_at(f, rim, at(range, u * u * (3 - 2 * u)));
      }
      for (int i = 0; i <= kAlphaStarts; ++i) {
        const bool below = i == 0 || line[i].energy <= line[i - 1].energy;
        const bool above = i == kAlphaStarts || line[i].energy <= line[i + 1].energy;
        if (below && above && std::isfinite(line[i].energy)) starts.push_back(line[i]);
      }
    }
  }
  return starts;
}

/// Keeps the few best starts that are not neighbours of a better one.
std::vector<Candidate> choose(std::vector<Candidate> starts) {
  constexpr std::size_t kMost = 4;
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
  std::vector<Candidate> chosen;
  for (const Candidate& c : starts) {
    if (chosen.size() == kMost) break;
    const auto near = [&](const Candidate& other) {
      return other.rim.winding == c.rim.winding && std::abs(other.alpha - c.alpha) < 0.15;
    };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(c);
  }
  return chosen;
}
// ---- Conditions in and out ----------------------------------------------------------------

core::Result<void> check(const EnergyConditions& c) {
  const double chord = norm(c.chord);
  if (!is_finite(c.tangent) || !(norm(c.tangent) > 0))
    return fail(ErrorCode::bad_input, "the tangent has no direction",
                "give a finite vector that is not zero", "tangent");
  if (!is_finite(c.chord)) return fail(ErrorCode::bad_input, "the end is not finite", {}, "chord");
  if (!(c.end_tolerance >= 0 && std::isfinite(c.end_tolerance)))
    return fail(ErrorCode::bad_input, "the end tolerance is negative or not finite",
                "give a length of 0 or more", "end_tolerance");
  if (c.degree < 2 || c.degree > curve::kMaxBezierDegree)
    return fail(ErrorCode::bad_input, "the degree has to lie between 2 and 30", {}, "degree");
  if (!(c.alpha.low >= 0 && c.alpha.low <= c.alpha.high && c.alpha.high < kPi / 2))
    return fail(ErrorCode::bad_input, "the range of alpha is empty or leaves [0, pi/2)",
                "give [low, high] below 1.5707", "alpha_range");
  if (!(c.s.low > 0 && c.s.low <= c.s.high && std::isfinite(c.s.high)))
    return fail(ErrorCode::bad_input, "the range of s is empty or not positive", {}, "s_range");
  if (!(chord > 0))
    return fail(ErrorCode::undrawable, "the curve ends where it starts: no Class A curve does",
                "move the end away from the start", "chord");
  if (!(c.end_tolerance < chord))
    return fail(ErrorCode::bad_input, "the end tolerance is not smaller than the chord",
                "give less than " + core::number_text(chord, 6), "end_tolerance");
  return {};
}

/// The range of alpha in which the branch meets the range of s.
bool restrict_alpha(Frame& f) {
  if (f.growing && f.s.high < 1) return false;
  if (!f.growing && f.s.low > 1) return false;
  f.alpha.high = std::min(f.alpha.high, std::acos(f.growing ? 1 / f.s.high : f.s.low));
  return f.alpha.low <= f.alpha.high;
}

core::Failure infeasible(const EnergyConditions& c, const Frame& f) {
  const std::string branch = f.growing ? "s >= 1/cos(alpha)" : "s <= cos(alpha)";
  return {ErrorCode::undrawable,
          "no Class A curve of degree " + std::to_string(c.degree) + " with " + branch +
              ", alpha in [" + core::number_text(c.alpha.low, 6) + ", " +
              core::number_text(c.alpha.high, 6) + "] and s in [" + core::number_text(c.s.low, 6) +
              ", " + core::number_text(c.s.high, 6) +
              "] reaches the end, which lies at an angle of " + core::number_text(f.angle, 6) +
              " to the tangent",
          "widen the ranges, raise the degree, or ask for the other branch", "alpha_range"};
}

EnergyMinimum straight(const EnergyConditions& c, const Frame& f, double offset) {
  EnergyMinimum m;
  m.s = clamp(f.s, c.near_s);
  m.s = f.growing ? std::max(m.s, 1.0) : std::min(m.s, 1.0);
  const double tolerance = c.end_tolerance;
  const double length = norm(c.chord) * std::cos(offset) +
                        std::sqrt(std::max(0.0, tolerance * tolerance -
                                                    std::pow(norm(c.chord) * std::sin(offset), 2)));
  m.beta = length / (norm(c.tangent) * end_in_frame({0, m.s}, c.degree).x);
  m.chord = (length / norm(c.tangent)) * c.tangent;
  m.left = c.left.value_or(true);
  return m;
}

EnergyMinimum finish(const EnergyConditions& c, const Frame& f, const Candidate& best, bool left) {
  const Target target = target_at(f, best.rim);
  const double length = target.length * norm(c.chord);
  EnergyMinimum m{best.alpha, best.s, 1, best.energy / norm(c.chord), {}, left};
  m.beta = length / (norm(c.tangent) * norm(end_in_frame({best.alpha, best.s}, c.degree)));
  m.chord = length * core::unit_vector(core::direction_of(c.tangent) +
                                       (left ? target.angle : -target.angle));
  return m;
}

}  // namespace

core::Result<EnergyMinimum> minimum_energy(const EnergyConditions& conditions) {
  if (auto checked = check(conditions); !checked) return std::unexpected(checked.error());
  const double offset = core::angle_between(conditions.tangent, conditions.chord);
  const bool left = conditions.left.value_or(offset >= 0);
  Frame f{conditions.degree,
          left ? offset : -offset,
          conditions.end_tolerance,
          conditions.alpha,
          conditions.s,
          conditions.branch == Branch::growing};
  f.slack /= norm(conditions.chord);
  const bool possible = restrict_alpha(f);
  if (possible && f.alpha.low == 0 && std::cos(offset) > 0 &&
      std::abs(std::sin(offset)) <= std::max(f.slack, 1e-15))
    return straight(conditions, f, offset);
  if (f.angle < 0) f.angle += 2 * kPi;
  if (!possible) return std::unexpected(infeasible(conditions, f));
  const ReachTable table = tabulate(f);
  const int windings = static_cast<int>((f.degree - 1) * f.alpha.high / (2 * kPi));
  std::vector<Candidate> starts;
  for (int winding = -1; winding <= windings; ++winding) {
    const std::vector<Candidate> more = starts_of(f, table, winding);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  Candidate best;
  for (const Candidate& start : choose(std::move(starts))) {
    const Candidate c = refine(f, table, start);
    if (c.energy < best.energy) best = c;
  }
  if (!std::isfinite(best.energy)) return std::unexpected(infeasible(conditions, f));
  return finish(conditions, f, best, left);
}

}  // namespace keyline::classa
