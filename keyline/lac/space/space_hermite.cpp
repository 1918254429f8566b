#include "keyline/lac/space/space_hermite.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/space/compound_steer.h"
#include "keyline/lac/space/space_plane.h"
#include "keyline/lac/space/space_steer.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;
using detail::size_of;
using detail::SpaceUnknowns;
using detail::space::ChordFrame;
using detail::space::directions_in;
using detail::space::in_plane;
using detail::space::Invariants;
using detail::space::JointFamily;
using detail::space::Miss;
using detail::space::miss_of;
using detail::space::moved;
using detail::space::newton_step;
using detail::space::plane_of;
using detail::space::reasonable;
using detail::space::Setting;
using detail::space::steer;
using detail::space::turning_of;

/// A curve of the family in the standard frame, integrated exactly.
struct Member {
  SpaceStandardForm form;
  SpaceChain chain;
  SpaceFrame end;
};

std::optional<Member> member(SpaceStandardForm form, const SpaceUnknowns& x) {
  const auto torsion = detail::start_torsion(form.beta, form.omega, x);
  if (!torsion || !reasonable(form.alpha, x)) return std::nullopt;
  form.lambda = x.bend / x.length;
  form.nu = *torsion / x.length;
  const auto piece = standard_piece(form, x.length);
  if (!piece) return std::nullopt;
  Member m{form, {{}, {*piece}}, {}};
  m.end = frame_at(m.chain, 1);
  return m;
}

/// Newton's step with the derivatives of exact misses, by central differences: where the miss
/// hardly depends on one of the unknowns, those of quick shots lead nowhere.
std::optional<Miss> exact_step(const SpaceStandardForm& form, const Invariants& wanted,
                               const SpaceUnknowns& x, const Miss& miss) {
  constexpr double kShare = 1e-4;
  const Miss by{kShare * (1e-3 + std::abs(x.bend)), kShare * (1e-3 + std::abs(x.twist)),
                kShare * x.length};
  std::array<Miss, 3> slope{};
  for (std::size_t i = 0; i < 3; ++i) {
    Miss one{};
    one[i] = by[i];
    const auto up = member(form, moved(x, one, -1)), down = member(form, moved(x, one, 1));
    if (!up || !down) return std::nullopt;
    const Miss above = miss_of(up->end.position - Point3{}, up->end.tangent, wanted);
    const Miss below = miss_of(down->end.position - Point3{}, down->end.tangent, wanted);
    for (std::size_t row = 0; row < 3; ++row)
      slope[row][i] = (above[row] - below[row]) / (2 * by[i]);
  }
  Miss step = miss;
  return detail::solve_small(slope, step) ? std::optional(step) : std::nullopt;
}

/// From six digits to all of them: exact misses, the derivatives of quick shots as long as they
/// halve the miss.
std::optional<Member> polished(const SpaceStandardForm& form, const Invariants& wanted,
                               SpaceUnknowns x, int& iterations) {
  std::optional<Member> best;
  double least = 1e-12;
  double before = 1e300;
  bool quick = true;
  for (int i = 0; i < 30; ++i) {
    auto m = member(form, x);
    if (!m) break;
    const Miss miss = miss_of(m->end.position - Point3{}, m->end.tangent, wanted);
    const double size = size_of(miss);
    if (size <= least) {
      least = size;
      best = std::move(m);
    }
    if (size <= 4e-14 || (best && size > 0.5 * before)) break;
    quick = quick && size < 0.5 * before;
    before = size;
    const auto shot = quick ? detail::shoot_space(form, x) : std::nullopt;
    const auto step = shot ? newton_step(*shot, miss, wanted) : exact_step(form, wanted, x, miss);
    if (!step) break;
    ++iterations;
    x = moved(x, *step, 1);
  }
  return best;
}

/// A way from a curve that is known to the data.
struct Way {
  Invariants from;
  SpaceUnknowns start;
};

struct Reached {
  SpaceUnknowns x;
  double share = 0;  ///< of the way to the data
  int iterations = 0;
};

/// Along the way in steps as long as Newton's method follows; omega grows from 0 on it.
Reached follow(const SpaceStandardForm& form, const Invariants& wanted, const Way& way) {
  Reached reached{way.start, 0, 0};
  SpaceUnknowns before = reached.x;
  double at_before = 0;
  double step = 0.25;
  while (reached.share < 1 && step > 0.003) {
    const double to = std::min(1.0, reached.share + step);
    const Invariants there{std::lerp(way.from.first, wanted.first, to),
                           std::lerp(way.from.last, wanted.last, to),
                           std::lerp(way.from.twist, wanted.twist, to)};
    SpaceStandardForm part = form;
    part.omega = to * form.omega;
    SpaceUnknowns x = reached.x;
    if (reached.share > at_before) {
      const double on = (to - reached.share) / (reached.share - at_before);
      x.bend += on * (reached.x.bend - before.bend);
      x.twist += on * (reached.x.twist - before.twist);
      x.length += on * (reached.x.length - before.length);
    }
    // On the way the curve need not be exact.
    const double enough = (to < 1 ? 1e-3 : 1e-8) * std::min(1.0, wanted.first + wanted.last);
    if (steer(part, there, enough, x, reached.iterations)) {
      before = reached.x;
      at_before = reached.share;
      reached.x = x;
      reached.share = to;
      step *= 2;
    } else {
      step /= 2.5;
    }
  }
  return reached;
}

/// From the plane curve with both angles kept, C-shaped (twist 0) or S-shaped (twist +-pi).
std::optional<Way> from_plane(const Invariants& wanted, double alpha, double twist) {
  const double to = twist == 0 ? -wanted.last : wanted.last;
  const auto solved = solve_g1_directions({{0, 0}, wanted.first}, {{1, 0}, to}, alpha);
  if (!solved) return std::nullopt;
  const Segment& s = solved->segment;
  const double bend = std::abs(s.curvature_start);
  const double length = bend * s.length;
  if (!(length > 1e-5)) return std::nullopt;
  const double sense = s.curvature_start < 0 ? -1 : 1;
  const double rate = -sense * curvature_rate(s, 0) / (bend * bend);
  if (!std::isfinite(rate)) return std::nullopt;
  return Way{{wanted.first, wanted.last, twist}, {rate * length, 0, length}};
}

/// Likely ways first: from the nearer plane curve, from the circular arc that turns as much, from
/// the other plane curve.
std::vector<Way> ways(const Invariants& wanted, double alpha) {
  const double mean = (wanted.first + wanted.last) / 2;
  const Way arc{{mean, mean, 0}, {0, 0, 2 * mean}};
  const auto c_shaped = from_plane(wanted, alpha, 0);
  const auto s_shaped =
      alpha < 0 ? from_plane(wanted, alpha, std::copysign(core::kPi, wanted.twist)) : std::nullopt;
  const bool folded = std::abs(wanted.twist) > core::kPi / 2;
  std::vector<Way> all;
  if (const auto& near = folded ? s_shaped : c_shaped) all.push_back(*near);
  all.push_back(arc);
  if (const auto& far = folded ? c_shaped : s_shaped) all.push_back(*far);
  return all;
}

/// From places all over the family, told by their start.
std::optional<Member> from_start(const SpaceStandardForm& form, const Invariants& wanted,
                                 int& iterations) {
  for (const SpaceUnknowns& x : detail::space::search_family(form, wanted, iterations))
    if (auto m = polished(form, wanted, x, iterations)) return m;
  return std::nullopt;
}

/// The same told by their middle, as curves of two slopes that are one.
std::optional<Member> from_middle(const SpaceStandardForm& form, const Invariants& wanted,
                                  int& iterations) {
  const JointFamily family({{form.alpha, form.alpha}, {form.beta, form.beta}, form.omega, 0.5});
  const auto x = family.search(wanted, iterations);
  if (!x) return std::nullopt;
  const SpaceChain halves = *family.chain(*x);
  const SpacePiece &first = halves.pieces[0], &last = halves.pieces[1];
  const double unit = first.curvature_start;
  const SpacePiece whole{form.alpha,
                         form.beta,
                         arc_length(halves) * unit,
                         1,
                         last.curvature_end / unit,
                         first.torsion_start / unit,
                         last.torsion_end / unit};
  Member m{form, {{}, {whole}}, {}};
  m.form.lambda = -curvature_rate(curvature_law(whole), 0);
  m.form.nu = whole.torsion_start;
  if (!validate(m.chain)) return std::nullopt;
  m.end = frame_at(m.chain, 1);
  const Miss miss = miss_of(m.end.position - Point3{}, m.end.tangent, wanted);
  return size_of(miss) <= 1e-12 ? std::optional(std::move(m)) : std::nullopt;
}

struct Search {
  std::optional<Member> found;
  double furthest = 0;
  int iterations = 0;
};

enum class Reach { ways, family };

/// By the ways from known curves; where none leads there, from places all over the family: either
/// search finds curves that the other does not, and of both the one that turns less is taken.
Search find_member(const SpaceStandardForm& form, const Invariants& wanted, Reach reach) {
  Search s;
  for (const Way& way : ways(wanted, form.alpha)) {
    const Reached reached = follow(form, wanted, way);
    s.iterations += reached.iterations;
    s.furthest = std::max(s.furthest, reached.share);
    if (reached.share == 1) s.found = polished(form, wanted, reached.x, s.iterations);
    if (s.found) return s;
  }
  if (reach == Reach::ways) return s;
  s.found = from_start(form, wanted, s.iterations);
  auto other = from_middle(form, wanted, s.iterations);
  if (other && !(s.found && turning_of(s.found->chain) < 1.001 * turning_of(other->chain)))
    s.found = std::move(other);
  return s;
}

/// The plane curve, with positive curvature at its start.
Result<SpaceSolution> solve_in_plane(const Setting& setting, double alpha, double beta) {
  const ChordFrame plane = plane_of(setting);
  const auto [first, last] = directions_in(plane, setting.data);
  const auto solved = solve_g1_directions({{0, 0}, first}, {{1, 0}, last}, alpha);
  if (!solved) return std::unexpected(solved.error());
  return in_plane(plane, setting.data, chain_of(solved->segment), {beta, beta});
}

Result<SpaceSolution> solve(const SpaceHermite& given, double alpha, double beta, double omega,
                            Reach reach) {
  const auto setting = detail::space::setting_of(given, alpha, beta, omega);
  if (!setting) return std::unexpected(setting.error());
  const auto& [data, wanted, planar, mirrored] = *setting;
  if (planar) return solve_in_plane(*setting, alpha, beta);
  const Search search = find_member({alpha, beta, 0, omega, 0}, wanted, reach);
  if (!search.found) {
    return core::fail(ErrorCode::not_converged,
                      "no space curve of these slopes was found for the tangents",
                      "one was followed " + core::number_text(100 * search.furthest, 3) +
                          " % of the way from a plane curve: turn the tangents towards the chord, "
                          "or take slopes nearer to 0 and a smaller omega");
  }
  const Member& m = *search.found;
  SpaceSolution solution;
  solution.chain = detail::space::placed(m.chain, m.end.position - Point3{}, data, mirrored);
  solution.lambda = m.form.lambda;
  solution.nu = mirrored ? -m.form.nu : m.form.nu;
  solution.length = m.chain.pieces[0].length;
  solution.iterations = search.iterations;
  return solution;
}

}  // namespace

Result<SpaceSolution> solve_g1_space(const SpaceHermite& data, double alpha, double beta,
                                     double omega) {
  return solve(data, alpha, beta, omega, Reach::family);
}

Result<SpaceSolution> detail::solve_g1_space_by_ways(const SpaceHermite& data, double alpha,
                                                     double beta, double omega) {
  return solve(data, alpha, beta, omega, Reach::ways);
}

}  // namespace keyline::lac
