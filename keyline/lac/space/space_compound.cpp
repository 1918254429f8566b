#include "keyline/lac/space/space_compound.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/chain/extend.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/space/compound_plane.h"
#include "keyline/lac/space/space_plane.h"
#include "keyline/lac/space/space_steer.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Result;
using detail::size_of;
using detail::SpaceUnknowns;
using detail::space::ChordFrame;
using detail::space::directions_in;
using detail::space::in_plane;
using detail::space::Invariants;
using detail::space::Miss;
using detail::space::miss_of;
using detail::space::moved;
using detail::space::plane_of;
using detail::space::PlaneSearch;
using detail::space::Setting;
using detail::space::solve_compound_plane;

/// As the family of one slope is searched: what winds more is no curve to look at, nor quick to
/// follow.
constexpr double kMostTurning = 3 * core::kPi;

/// Of both, to either side: what the tangent turns by, or the frame about it.
double turning_of(const SpaceChain& chain) {
  double bend = 0, twist = 0;
  for (const SpacePiece& p : chain.pieces) {
    bend += detail::absolute_turning(curvature_law(p));
    twist += detail::absolute_turning(torsion_law(p));
  }
  return std::max(bend, twist);
}

/// Both pieces in the standard frame, the radius of curvature at the start being 1; `twist` of the
/// unknowns is here the torsion at the start times the length. Empty where one ends too early.
std::optional<SpaceChain> chain_of(const SpaceRhythm& r, const SpaceUnknowns& x) {
  if (!(x.length > 0) || !std::isfinite(x.bend) || !std::isfinite(x.twist)) return std::nullopt;
  const double lambda = x.bend / x.length;
  const double nu = x.twist / x.length;
  const double first = r.length_share * x.length;
  const double second = x.length - first;
  const double bend = detail::carried(1, r.alpha[0], lambda * first);
  const double twist = detail::carried(nu, r.beta[0], r.omega * first);
  const double bend_rate = -lambda * std::pow(std::abs(bend), r.alpha[0] + 1);
  const double twist_rate =
      nu == 0 && r.omega == 0 ? 0 : -r.omega * std::pow(std::abs(twist), r.beta[0] + 1);
  if (!std::isfinite(bend_rate) || !std::isfinite(twist_rate)) return std::nullopt;
  const auto last_bend = detail::curvature_continued(r.alpha[1], bend, bend_rate, second);
  const auto last_twist = twist == 0 && twist_rate == 0
                              ? std::optional(0.0)
                              : detail::curvature_continued(r.beta[1], twist, twist_rate, second);
  if (!last_bend || !last_twist) return std::nullopt;
  SpaceChain chain{{},
                   {{r.alpha[0], r.beta[0], first, 1, bend, nu, twist},
                    {r.alpha[1], r.beta[1], second, bend, *last_bend, twist, *last_twist}}};
  if (!validate(chain) || !(turning_of(chain) <= kMostTurning)) return std::nullopt;
  return chain;
}

struct Shot {
  SpaceChain chain;
  SpaceFrame end;
  Miss miss{};
};

std::optional<Shot> shot_of(const SpaceRhythm& r, const SpaceUnknowns& x,
                            const Invariants& wanted) {
  auto chain = chain_of(r, x);
  if (!chain) return std::nullopt;
  Shot shot{std::move(*chain), {}, {}};
  shot.end = frame_at(shot.chain, 1);
  const core::Vector3 chord = shot.end.position - core::Point3{};
  if (!(norm(chord) > 1e-6 * x.length)) return std::nullopt;
  shot.miss = miss_of(chord, shot.end.tangent, wanted);
  return shot;
}

/// Newton's step by differences, that of a small torsion small beside it: with slopes above 0 the
/// law of torsion changes with its size.
std::optional<Miss> step_of(const SpaceRhythm& r, const SpaceUnknowns& x, const Shot& at,
                            const Setting& setting) {
  constexpr double kSize = 1e-6;
  std::array<std::array<double, 3>, 3> slope{};
  for (std::size_t i = 0; i < 3; ++i) {
    SpaceUnknowns near = x;
    double& unknown = i == 0 ? near.bend : i == 1 ? near.twist : near.length;
    const double by = i == 1 && x.twist != 0 ? std::min(kSize, 1e-3 * std::abs(x.twist)) : kSize;
    unknown += by;
    const auto shot = shot_of(r, near, setting.wanted);
    if (!shot) return std::nullopt;
    for (std::size_t row = 0; row < 3; ++row) slope[row][i] = (shot->miss[row] - at.miss[row]) / by;
  }
  Miss step = at.miss;
  if (!detail::solve_small(slope, step)) return std::nullopt;
  return size_of(step) < 1e6 ? std::optional(step) : std::nullopt;
}

/// Newton's method with steps shortened until the miss falls; false where it does not settle.
bool settle(const SpaceRhythm& r, const Setting& setting, double enough, SpaceUnknowns& x,
            int& iterations) {
  auto at = shot_of(r, x, setting.wanted);
  for (int i = 0; at && i < 25; ++i) {
    if (size_of(at->miss) <= enough) return true;
    const auto step = step_of(r, x, *at, setting);
    if (!step) return false;
    ++iterations;
    std::optional<Shot> next;
    SpaceUnknowns to = x;
    for (double share = 1; share > 1e-3; share /= 2) {
      to = moved(x, *step, share);
      next = shot_of(r, to, setting.wanted);
      if (next && size_of(next->miss) < size_of(at->miss)) break;
      next.reset();
    }
    if (!next) return false;
    at = std::move(next);
    x = to;
  }
  return at && size_of(at->miss) <= enough;
}

using Solver = Result<SpaceSolution> (*)(const SpaceHermite&, double, double, double);

/// A curve of one slope, and how it is sought.
struct Single {
  double alpha = -1, beta = -1, omega = 0;
  Solver solve = solve_g1_space;
};

/// Slopes and omega between those of a curve of one slope and those wanted.
SpaceRhythm part_way(const SpaceRhythm& r, const Single& from, double share) {
  SpaceRhythm part = r;
  for (std::size_t i = 0; i < 2; ++i) {
    part.alpha[i] = std::lerp(from.alpha, r.alpha[i], share);
    part.beta[i] = std::lerp(from.beta, r.beta[i], share);
  }
  part.omega = std::lerp(from.omega, r.omega, share);
  return part;
}

constexpr double kExact = 1e-12;

struct Reached {
  SpaceUnknowns x;
  double share = 0;
  int iterations = 0;
};

/// From the curve of one slope to that of both.
Reached follow(const Setting& setting, const SpaceRhythm& r, const Single& from) {
  Reached reached;
  const auto single = from.solve(setting.data, from.alpha, from.beta, from.omega);
  if (!single || !std::isfinite(single->lambda) || !(single->length > 0)) return reached;
  const double nu = setting.mirrored ? -single->nu : single->nu;
  reached.x = {single->lambda * single->length, nu * single->length, single->length};
  reached.iterations = single->iterations;
  double step = 0.25;
  while (reached.share < 1 && step > 0.004) {
    const double to = std::min(1.0, reached.share + step);
    SpaceUnknowns x = reached.x;
    if (settle(part_way(r, from, to), setting, to < 1 ? 1e-6 : kExact, x, reached.iterations)) {
      reached.x = x;
      reached.share = to;
      step *= 2;
    } else {
      step /= 2.5;
    }
  }
  return reached;
}

SpaceSolution solution_of(const Shot& shot, const Reached& reached, const Setting& setting) {
  SpaceSolution solution;
  solution.chain = detail::space::placed(shot.chain, shot.end.position - core::Point3{},
                                         setting.data, setting.mirrored);
  solution.lambda = reached.x.bend / reached.x.length;
  solution.nu = (setting.mirrored ? -1 : 1) * reached.x.twist / reached.x.length;
  solution.length = reached.x.length;
  solution.iterations = reached.iterations;
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

/// Torsion at the start whose first piece ends with it times e^-3 … e^3, as the law with this rate
/// has it; where the rate tells nothing of its size, 1e-5 to a turn and a half over the length.
double random_torsion(const SpaceRhythm& r, double length, std::mt19937_64& random) {
  using detail::space::between;
  const double by_ratio = between(random, 0, 1);
  const double grows = between(random, -3, 3);  // logarithm of the ratio
  const double size = std::exp(between(random, std::log(1e-5), std::log(kMostTurning))) / length;
  const double share = std::abs(numeric::expm1_over(-r.beta[0] * grows) * grows);
  const double rate = std::abs(r.omega) * r.length_share * length;
  const double felt = std::pow(rate / share, -1 / r.beta[0]);
  if (by_ratio > 0.3 && std::isfinite(felt) && felt > 0) return grows * r.omega < 0 ? felt : -felt;
  return std::copysign(size, grows);
}

/// A place anywhere in the family of both slopes: ratio of the curvatures of the first piece
/// e^-3 … e^3, turning about its start's curvature 0.05 to 9, even in their logarithms.
SpaceUnknowns random_place(const SpaceRhythm& r, std::mt19937_64& random) {
  using detail::space::between;
  const double size = std::exp(between(random, -3, 3));
  const double ratio = r.alpha[0] < 0 && between(random, 0, 1) < 0.3 ? -size : size;
  const double turning = std::exp(between(random, std::log(0.05), std::log(9.0)));
  const double length = turning / std::sqrt(size);
  return {detail::space::bend_for(r.alpha[0], ratio) / r.length_share,
          random_torsion(r, length, random) * length, length};
}

/// Newton's method from the best of many places; of the curves found the one that turns least.
std::optional<Reached> search_both(const Setting& setting, const SpaceRhythm& r) {
  constexpr int kRounds = 2, kPlaces = 1000;
  constexpr std::size_t kSettled = 30;
  std::mt19937_64 random(20260101);  // one seed: one answer
  std::optional<Reached> best;
  double least = HUGE_VAL;
  int iterations = 0;
  for (int round = 0; round < kRounds && !best; ++round) {
    std::vector<std::pair<double, SpaceUnknowns>> starts;
    for (int i = 0; i < kPlaces; ++i) {
      const SpaceUnknowns x = random_place(r, random);
      const auto shot = shot_of(r, x, setting.wanted);
      if (shot && size_of(shot->miss) < 3) starts.emplace_back(size_of(shot->miss), x);
    }
    std::ranges::sort(starts, {}, [](const auto& start) { return start.first; });
    starts.resize(std::min(starts.size(), kSettled));
    for (auto& [miss, x] : starts) {
      if (!settle(r, setting, kExact, x, iterations)) continue;
      const double turning = turning_of(*chain_of(r, x));
      if (!(turning < least)) continue;
      least = turning;
      best = Reached{x, 1, 0};
    }
  }
  if (best) best->iterations = iterations;
  return best;
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
  const SpaceRhythm& r = rhythm;
  const auto& [a0, a1] = r.alpha;
  const auto& [b0, b1] = r.beta;
  using Pair = std::pair<double, double>;
  const std::array slopes{Pair{a0, b0}, Pair{a1, b1}, Pair{(a0 + a1) / 2, (b0 + b1) / 2}};
  double furthest = 0, least = HUGE_VAL;
  std::optional<SpaceSolution> best;
  // One slope has less room for omega than two where torsion grows without bound.
  const std::array starts{std::pair{r.omega, Solver{detail::solve_g1_space_by_ways}},
                          std::pair{0.0, Solver{detail::solve_g1_space_by_ways}},
                          std::pair{r.omega, Solver{solve_g1_space}}};
  for (const auto& [omega, solver] : starts) {
    for (const auto& [alpha, beta] : slopes) {
      const Reached reached = follow(*setting, r, {alpha, beta, omega, solver});
      furthest = std::max(furthest, reached.share);
      if (reached.share < 1) continue;
      const auto shot = shot_of(r, reached.x, setting->wanted);
      if (!shot || !(turning_of(shot->chain) < 0.999 * least)) continue;
      least = turning_of(shot->chain);
      best = solution_of(*shot, reached, *setting);
    }
    if (best) break;
  }
  if (best) return *std::move(best);
  if (const auto reached = search_both(*setting, r))
    return solution_of(*shot_of(r, reached->x, setting->wanted), *reached, *setting);
  return core::fail(ErrorCode::not_converged,
                    "no compound space curve of these slopes was found for the tangents",
                    "one was followed " + core::number_text(100 * furthest, 3) +
                        " % of the way from a curve of one slope: bring the slopes together, or "
                        "turn the tangents towards the chord");
}

}  // namespace keyline::lac
