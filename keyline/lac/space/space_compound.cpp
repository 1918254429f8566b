#include "keyline/lac/space/space_compound.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/text.h"
#include "keyline/lac/space/compound_plane.h"
#include "keyline/lac/space/compound_steer.h"
#include "keyline/lac/space/space_plane.h"
#include "keyline/lac/space/space_steer.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Result;
using detail::space::ChordFrame;
using detail::space::directions_in;
using detail::space::in_plane;
using detail::space::Invariants;
using detail::space::Joint;
using detail::space::JointFamily;
using detail::space::plane_of;
using detail::space::PlaneSearch;
using detail::space::Setting;
using detail::space::solve_compound_plane;
using detail::space::turning_of;

/// Slopes between those of a curve of one slope and those wanted.
SpaceRhythm part_way(const SpaceRhythm& r, double alpha, double beta, double share) {
  SpaceRhythm part = r;
  for (std::size_t i = 0; i < 2; ++i) {
    part.alpha[i] = std::lerp(alpha, r.alpha[i], share);
    part.beta[i] = std::lerp(beta, r.beta[i], share);
  }
  return part;
}

struct Reached {
  std::optional<Joint> found;
  double share = 0;
  int iterations = 0;
};

/// From the curve of one slope to that of both.
Reached follow(const Setting& setting, const SpaceRhythm& r, double alpha, double beta) {
  Reached reached;
  const auto single = detail::solve_g1_space_by_ways(setting.data, alpha, beta, r.omega);
  if (!single) return reached;
  SpacePiece piece = single->chain.pieces[0];
  if (setting.mirrored) {
    piece.torsion_start = -piece.torsion_start;
    piece.torsion_end = -piece.torsion_end;
  }
  auto x = JointFamily(part_way(r, alpha, beta, 0)).joint_of(piece);
  reached.iterations = single->iterations;
  const Invariants& wanted = setting.wanted;
  const double size = std::min(1.0, wanted.first + wanted.last);
  double step = 0.25;
  while (x && reached.share < 1 && step > 0.004) {
    const double to = std::min(1.0, reached.share + step);
    Joint next = *x;
    const double enough = (to < 1 ? 1e-3 : 1e-8) * size;
    const JointFamily family(part_way(r, alpha, beta, to));
    if (family.steer(wanted, enough, next, reached.iterations)) {
      x = next;
      reached.share = to;
      step *= 2;
    } else {
      step /= 2.5;
    }
  }
  if (reached.share == 1) reached.found = JointFamily(r).polished(wanted, *x, reached.iterations);
  return reached;
}

SpaceSolution solution_of(const SpaceChain& chain, const Setting& setting, int iterations) {
  SpaceSolution solution;
  const SpacePiece& first = chain.pieces[0];
  const double unit = first.curvature_start;
  solution.chain = detail::space::placed(chain, frame_at(chain, 1).position - core::Point3{},
                                         setting.data, setting.mirrored);
  solution.lambda = -curvature_rate(curvature_law(first), 0) / (unit * unit);
  solution.nu = (setting.mirrored ? -1 : 1) * first.torsion_start / unit;
  solution.length = arc_length(chain) * unit;
  solution.iterations = iterations;
  return solution;
}

Result<void> check(const SpaceRhythm& r) {
  if (!(r.length_share > 0 && r.length_share < 1))
    return core::fail(ErrorCode::bad_input, "the share of the length must lie between 0 and 1",
                      "give more than 0 and less than 1", "ratio");
  for (const auto& [slopes, name] : {std::pair{r.alpha, std::string("alpha")}, {r.beta, "beta"}})
    for (const std::size_t i : {0, 1})
      if (!(std::abs(slopes[i]) <= 100))
        return core::fail(ErrorCode::bad_input,
                          "a slope of a compound rhythm in space lies outside -100 to 100",
                          "give slopes nearer to 0",
                          slopes[0] == slopes[1] ? name : name + "[" + std::to_string(i) + "]");
  return {};
}

struct Answer {
  std::optional<SpaceChain> chain;
  double furthest = 0;  ///< of the ways from a curve of one slope
  int iterations = 0;
};

/// By the ways the curve that turns least; where none leads there, from all over the family.
Answer solve_in_space(const Setting& setting, const SpaceRhythm& r) {
  const auto& [a0, a1] = r.alpha;
  const auto& [b0, b1] = r.beta;
  const JointFamily family(r);
  Answer answer;
  std::optional<Joint> best;
  double least = HUGE_VAL;
  for (const auto& [alpha, beta] : {std::pair{a0, b0}, {a1, b1}, {(a0 + a1) / 2, (b0 + b1) / 2}}) {
    const Reached reached = follow(setting, r, alpha, beta);
    answer.furthest = std::max(answer.furthest, reached.share);
    answer.iterations += reached.iterations;
    const double turning = reached.found ? turning_of(*family.chain(*reached.found)) : HUGE_VAL;
    if (!(turning < 0.999 * least)) continue;
    least = turning;
    best = reached.found;
  }
  if (!best) best = family.search(setting.wanted, answer.iterations);
  if (best) answer.chain = family.chain(*best);
  return answer;
}

std::unexpected<core::Failure> none_in_plane(const PlaneSearch& search) {
  const core::Interval& starts = search.without_inflection;
  const bool one_signed = starts.low <= starts.high;
  if (search.may_inflect)
    return core::fail(ErrorCode::not_converged,
                      "no compound curve of these slopes without loops was found in the plane",
                      "bring the slopes together, or turn the tangents towards the chord");
  if (!one_signed)
    return core::fail(ErrorCode::undrawable,
                      "these directions need an inflection, which no curve of these slopes and "
                      "this share of the length has",
                      "give one piece a slope below 0 and more of the length");
  const auto text = [](double x) { return core::number_text(x, 6); };
  return core::fail(ErrorCode::undrawable,
                    "no compound curve of these slopes and this turning leaves its chord as the "
                    "start tangent does",
                    "they leave it at " + text(starts.low) + " to " + text(starts.high) + " rad");
}

/// Whatever beta and omega: a plane curve has no torsion.
Result<SpaceSolution> solve_in_plane(const Setting& setting, const SpaceRhythm& r) {
  const ChordFrame plane = plane_of(setting);
  const auto [first, last] = directions_in(plane, setting.data);
  PlaneSearch search = solve_compound_plane(first, last, {r.alpha[0], r.alpha[1], r.length_share});
  if (!search.found) return none_in_plane(search);
  SpaceSolution solution = in_plane(plane, setting.data, std::move(*search.found), r.beta);
  solution.iterations = search.iterations;
  return solution;
}

}  // namespace

Result<SpaceSolution> solve_compound_space(const SpaceHermite& data, const SpaceRhythm& rhythm) {
  if (auto sound = check(rhythm); !sound) return std::unexpected(sound.error());
  const auto setting =
      detail::space::setting_of(data, rhythm.alpha[0], rhythm.beta[0], rhythm.omega);
  if (!setting) return std::unexpected(setting.error());
  if (setting->planar) return solve_in_plane(*setting, rhythm);
  const Answer answer = solve_in_space(*setting, rhythm);
  if (answer.chain) return solution_of(*answer.chain, *setting, answer.iterations);
  return core::fail(ErrorCode::not_converged,
                    "no compound space curve of these slopes was found for the tangents",
                    "one was followed " + core::number_text(100 * answer.furthest, 3) +
                        " % of the way from a curve of one slope: bring the slopes together, or "
                        "turn the tangents towards the chord");
}

}  // namespace keyline::lac
