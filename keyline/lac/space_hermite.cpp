#include "keyline/lac/space_hermite.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite.h"
#include "keyline/lac/piece_shape.h"
#include "keyline/lac/space_shooting.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;
using detail::SpaceShot;
using detail::SpaceUnknowns;
using Miss = std::array<double, 3>;

/// What does not depend on place: both tangents against the chord, and how far the end tangent is
/// turned about the chord out of the plane of the start tangent (0: the arc of a plane curve).
struct Invariants {
  double first = 0;
  double last = 0;
  double twist = 0;
};

/// Orthonormal, x along the chord.
struct ChordFrame {
  Vector3 x, y, z;
};

Vector3 unit(Vector3 v) { return v / norm(v); }

Vector3 from(const ChordFrame& f, Vector3 v) { return v.x * f.x + v.y * f.y + v.z * f.z; }
Vector3 into(const ChordFrame& f, Vector3 v) { return {dot(v, f.x), dot(v, f.y), dot(v, f.z)}; }

/// y towards `side` (any direction where that lies along the chord).
ChordFrame chord_frame(Vector3 chord, Vector3 side) {
  const Vector3 x = unit(chord);
  Vector3 across = side - dot(side, x) * x;
  if (norm(across) < 1e-14)
    across = cross(x, std::abs(x.x) < 0.6 ? Vector3{1, 0, 0} : Vector3{0, 1, 0});
  const Vector3 y = unit(across);
  return {x, y, cross(x, y)};
}

double angle_between(Vector3 a, Vector3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

Vector3 end_tangent(const Invariants& i) {
  const double s = std::sin(i.last);
  return {std::cos(i.last), -s * std::cos(i.twist), -s * std::sin(i.twist)};
}

/// Angle of the start tangent against the chord, and direction of the end tangent, less the wanted
/// ones, for a curve in its standard frame.
Miss miss_of(Vector3 chord, Vector3 tangent, const Invariants& wanted) {
  const Vector3 there = into(chord_frame(chord, {1, 0, 0}), tangent);
  const double c = std::cos(wanted.last);
  const Vector3 along{-std::sin(wanted.last), -c * std::cos(wanted.twist),
                      -c * std::sin(wanted.twist)};
  const Vector3 around{0, std::sin(wanted.twist), -std::cos(wanted.twist)};
  const double x = dot(there, along);
  const double y = dot(there, around);
  const double sine = std::hypot(x, y);
  // Far off, the angle still tells how far.
  const double angle = std::atan2(sine, dot(there, end_tangent(wanted)));
  const double scale = sine > 1e-8 ? angle / sine : angle > 1 ? HUGE_VAL : 1;
  return {angle_between({1, 0, 0}, chord) - wanted.first, scale * x, scale * y};
}

double size_of(const Miss& miss) {
  double size = 0;
  for (const double m : miss) size = std::isfinite(m) ? std::max(size, std::abs(m)) : 1e300;
  return size;
}

bool reasonable(const SpaceUnknowns& x) {
  return std::isfinite(x.bend) && std::isfinite(x.twist) && x.length > 1e-6 && x.length < 100 &&
         std::abs(x.twist) < 4 * core::kPi;
}

/// Newton's step for a miss, with the derivatives of a shot; empty where the matrix is singular.
std::optional<Miss> newton_step(const SpaceShot& shot, const Miss& at, const Invariants& wanted) {
  constexpr double kSize = 1e-6;
  std::array<std::array<double, 3>, 3> slope{};
  const Miss base = miss_of(shot.chord, shot.tangent, wanted);
  for (int i = 0; i < 3; ++i) {
    const Miss near = miss_of(shot.chord + kSize * shot.chord_by[i],
                              shot.tangent + kSize * shot.tangent_by[i], wanted);
    for (int row = 0; row < 3; ++row) slope[row][i] = (near[row] - base[row]) / kSize;
  }
  Miss step = at;
  if (!detail::solve_small(slope, step)) return std::nullopt;
  return size_of(step) < 1e6 ? std::optional(step) : std::nullopt;
}

SpaceUnknowns moved(const SpaceUnknowns& x, const Miss& step, double share) {
  return {x.bend - share * step[0], x.twist - share * step[1],
          x.length * std::exp(-share * std::clamp(step[2] / x.length, -1.0, 1.0))};
}

/// A shot that starts and ends apart, and its miss.
struct Aimed {
  SpaceShot shot;
  Miss miss{};
};
std::optional<Aimed> aim(const SpaceStandardForm& form, const SpaceUnknowns& x,
                         const Invariants& wanted) {
  if (!reasonable(x)) return std::nullopt;
  const auto shot = detail::shoot_space(form, x);
  if (!shot || !(norm(shot->chord) > 1e-3)) return std::nullopt;
  return Aimed{*shot, miss_of(shot->chord, shot->tangent, wanted)};
}

/// Newton's method on quick shots, with steps shortened until the miss falls.
bool steer(const SpaceStandardForm& form, const Invariants& wanted, double enough, SpaceUnknowns& x,
           int& iterations) {
  auto here = aim(form, x, wanted);
  for (int i = 0; here && i < 12; ++i) {
    const double size = size_of(here->miss);
    if (size <= enough) return true;
    const auto step = newton_step(here->shot, here->miss, wanted);
    if (!step) return false;
    ++iterations;
    double share = 1;
    for (;; share /= 2) {
      if (share < 0.02) return false;
      const SpaceUnknowns next = moved(x, *step, share);
      const auto there = aim(form, next, wanted);
      if (!there || !(size_of(there->miss) < (1 - 0.1 * share) * size)) continue;
      x = next;
      here = there;
      break;
    }
  }
  return here && size_of(here->miss) <= enough;
}

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

/// The member moved so that it starts and ends where it should.
SpaceChain placed(const Member& m, const SpaceHermite& data) {
  const Vector3 own = m.end.position - Point3{};
  const Vector3 wanted = data.end - data.start;
  const ChordFrame a = chord_frame(own, {1, 0, 0});
  const ChordFrame b = chord_frame(wanted, data.start_tangent);
  const auto turn = [&](Vector3 v) { return from(b, into(a, v)); };
  const double scale = norm(wanted) / norm(own);
  SpaceChain chain = m.chain;
  const Vector3 tangent = unit(turn({1, 0, 0}));
  const Vector3 binormal = unit(cross(tangent, turn({0, 1, 0})));
  chain.start = {data.start, tangent, cross(binormal, tangent), binormal};
  for (SpacePiece& p : chain.pieces) {
    p.length *= scale;
    p.curvature_start /= scale;
    p.curvature_end /= scale;
    p.torsion_start /= scale;
    p.torsion_end /= scale;
  }
  return chain;
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
  const Segment& s = solved->segment;
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
  const double bend = sense * s.curvature_start;
  solution.length = bend * s.length;
  if (bend != 0 || s.curvature_end != 0)
    solution.lambda = -sense * curvature_rate(s, 0) / (bend * bend);
  return solution;
}

Result<void> check(const SpaceHermite& data, double alpha, double beta, double omega) {
  for (const auto& [value, name] : {std::pair{alpha, "alpha"}, {beta, "beta"}, {omega, "omega"}})
    if (!std::isfinite(value))
      return core::fail(ErrorCode::bad_input, std::string(name) + " is not finite", "", name);
  if (!is_finite(data.start) || !is_finite(data.end))
    return core::fail(ErrorCode::bad_input, "an end is not finite");
  if (!(norm(data.end - data.start) > 0))
    return core::fail(ErrorCode::bad_input, "start and end coincide", "move one of them", "end");
  for (const Vector3 v : {data.start_tangent, data.end_tangent})
    if (!is_finite(v) || !(norm(v) > 0))
      return core::fail(ErrorCode::bad_input, "a tangent has no direction",
                        "give a vector that is not zero", "tangents");
  return {};
}

}  // namespace

Result<SpaceSolution> solve_g1_space(const SpaceHermite& given, double alpha, double beta,
                                     double omega) {
  if (auto sound = check(given, alpha, beta, omega); !sound) return std::unexpected(sound.error());
  SpaceHermite data = given;
  data.start_tangent = unit(given.start_tangent);
  data.end_tangent = unit(given.end_tangent);
  const Vector3 chord = unit(data.end - data.start);
  const Vector3 end = into(chord_frame(chord, data.start_tangent), data.end_tangent);
  Invariants wanted{angle_between(chord, data.start_tangent),
                    angle_between(chord, data.end_tangent), std::atan2(-end.z, -end.y)};
  if (std::abs(dot(cross(chord, data.start_tangent), data.end_tangent)) < 1e-12)
    return solve_in_plane(data, wanted, alpha, beta);
  const SpaceStandardForm form{alpha, beta, 0, omega, 0};
  double furthest = 0;
  int iterations = 0;
  std::optional<Member> found;
  for (const Way& way : ways(wanted, alpha)) {
    const Reached reached = follow(form, wanted, way);
    iterations += reached.iterations;
    furthest = std::max(furthest, reached.share);
    if (reached.share == 1) found = polished(form, wanted, reached.x, iterations);
    if (found) break;
  }
  if (!found) {
    return core::fail(ErrorCode::undrawable, "no space curve of these slopes meets the tangents",
                      "one was followed " + core::number_text(100 * furthest, 3) +
                          " % of the way from a plane curve: turn the tangents towards the chord, "
                          "or take slopes nearer to 0 and a smaller omega");
  }
  const Member& m = *found;
  SpaceSolution solution;
  solution.chain = placed(m, data);
  solution.lambda = m.form.lambda;
  solution.nu = m.form.nu;
  solution.length = m.chain.pieces[0].length;
  solution.iterations = iterations;
  return solution;
}

}  // namespace keyline::lac
