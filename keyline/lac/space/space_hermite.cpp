#include "keyline/lac/space/space_hermite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/space/space_steer.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;
using detail::SpaceUnknowns;
using detail::space::chord_frame;
using detail::space::ChordFrame;
using detail::space::Invariants;
using detail::space::Miss;
using detail::space::miss_of;
using detail::space::moved;
using detail::space::newton_step;
using detail::space::reasonable;
using detail::space::size_of;
using detail::space::steer;
using detail::space::unit;

/// A curve of the family in the standard frame, integrated exactly.
struct Member {
  SpaceStandardForm form;
  SpaceChain chain;
  SpaceFrame end;
};

std::optional<Member> member(SpaceStandardForm form, const SpaceUnknowns& x) {
  const auto torsion = detail::start_torsion(form.beta, form.omega, x);
  if (!torsion || !reasonable(x)) return std::nullopt;
  form.lambda = x.bend / x.length;
  form.nu = *torsion / x.length;
  const auto piece = standard_piece(form, x.length);
  if (!piece) return std::nullopt;
  Member m{form, {{}, {*piece}}, {}};
  m.end = frame_at(m.chain, 1);
  return m;
}

/// From six digits to all of them: exact misses, the derivatives of quick shots.
std::optional<Member> polished(const SpaceStandardForm& form, const Invariants& wanted,
                               SpaceUnknowns x, int& iterations) {
  std::optional<Member> best;
  double least = 1e-12;
  double before = 1e300;
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
    before = size;
    const auto shot = detail::shoot_space(form, x);
    const auto step = shot ? newton_step(*shot, miss, wanted) : std::nullopt;
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

struct Search {
  std::optional<Member> found;
  double furthest = 0;
  int iterations = 0;
};

/// By the ways from known curves; where none leads there, from places all over the family.
Search find_member(const SpaceStandardForm& form, const Invariants& wanted) {
  Search s;
  for (const Way& way : ways(wanted, form.alpha)) {
    const Reached reached = follow(form, wanted, way);
    s.iterations += reached.iterations;
    s.furthest = std::max(s.furthest, reached.share);
    if (reached.share == 1) s.found = polished(form, wanted, reached.x, s.iterations);
    if (s.found) return s;
  }
  for (const SpaceUnknowns& x : detail::space::search_family(form, wanted, s.iterations)) {
    s.found = polished(form, wanted, x, s.iterations);
    if (s.found) return s;
  }
  return s;
}

/// The same with no curvature at an end where the inflection lies within rounding of it: what is
/// left there has a random sign, and the rate of its radius a random size.
Segment bare_ends(Segment s) {
  constexpr double kMet = 1e-12;  // radians, as end tangents are met
  if (!(s.alpha < 0) || s.curvature_start == s.curvature_end) return s;
  const double turning = std::abs(total_turning(s));
  // By so much about the tangents turn where the inflection moves on to the end.
  const auto missed = [&](double k, double other) {
    return std::pow(std::abs(k / other), -s.alpha) * turning;
  };
  if (missed(s.curvature_start, s.curvature_end) < kMet) s.curvature_start = 0;
  if (missed(s.curvature_end, s.curvature_start) < kMet) s.curvature_end = 0;
  return s;
}

/// drho/ds at the start of a plane curve that turns left (sense 1) or right (-1) there.
double start_rate(const Segment& s, double sense) {
  if (s.curvature_start == s.curvature_end) return 0;
  if (s.curvature_start == 0) return -std::numeric_limits<double>::infinity();
  return -sense * curvature_rate(s, 0) / (s.curvature_start * s.curvature_start);
}

/// The plane curve, with positive curvature at its start.
Result<SpaceSolution> solve_in_plane(const SpaceHermite& data, const Invariants& i, double alpha,
                                     double beta) {
  const Vector3 wanted = data.end - data.start;
  const double chord = norm(wanted);
  const Vector3 side = i.first > 1e-14 ? data.start_tangent : data.end_tangent;
  const ChordFrame f = chord_frame(wanted, side);
  const auto angle = [&](Vector3 v) { return std::atan2(dot(v, f.y), dot(v, f.x)); };
  const auto solved = solve_g1_directions({{0, 0}, angle(data.start_tangent)},
                                          {{1, 0}, angle(data.end_tangent)}, alpha);
  if (!solved) return std::unexpected(solved.error());
  const Segment s = bare_ends(solved->segment);
  const double sense =
      s.curvature_start < 0 || (s.curvature_start == 0 && s.curvature_end < 0) ? -1 : 1;
  SpaceSolution solution;
  solution.planar = true;
  const Vector3 tangent =
      unit(from(f, {std::cos(s.start.direction), std::sin(s.start.direction), 0}));
  const Vector3 binormal = sense * f.z;
  solution.chain = {{data.start, tangent, cross(binormal, tangent), binormal},
                    {{alpha, beta, s.length * chord, sense * s.curvature_start / chord,
                      sense * s.curvature_end / chord, 0, 0}}};
  solution.length = sense * s.curvature_start * s.length;
  solution.lambda = start_rate(s, sense);
  return solution;
}

}  // namespace

Result<SpaceSolution> solve_g1_space(const SpaceHermite& given, double alpha, double beta,
                                     double omega) {
  const auto setting = detail::space::setting_of(given, alpha, beta, omega);
  if (!setting) return std::unexpected(setting.error());
  const auto& [data, wanted, planar, mirrored] = *setting;
  if (planar) return solve_in_plane(data, wanted, alpha, beta);
  const Search search = find_member({alpha, beta, 0, omega, 0}, wanted);
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

}  // namespace keyline::lac
