#include "keyline/lac/space_hermite.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <Eigen/LU>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;
using Unknowns = Eigen::Vector3d;  ///< lambda times length, total torsion, length

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

/// nu for which the torsion over the length comes to `total`; empty where there is none.
std::optional<double> nu_of(const SpaceStandardForm& form, double length, double total) {
  if (form.omega == 0) return total / length;
  if (total == 0 && form.beta >= 0) return 0.0;
  const auto excess = [&](double nu) {
    SpaceStandardForm with = form;
    with.nu = nu;
    const auto piece = standard_piece(with, length);
    return piece ? total_turning(torsion_law(*piece)) - total : std::copysign(HUGE_VAL, nu);
  };
  const double mean = total / length;
  const double least = form.beta >= 0 ? 0.0 : -HUGE_VAL;
  double step = std::abs(mean) + std::abs(form.omega * length) + 1e-9;
  double low = mean;
  double high = mean;
  if (form.beta >= 0) {  // one sign: between no torsion at all and more than enough
    for (int i = 0; i < 60 && excess(high) * mean < 0; ++i) high *= 2;
    low = form.omega > 0 ? mean : least;
  } else {
    for (int i = 0; i < 60 && excess(high) < 0; ++i, step *= 2) high += step;
    for (int i = 0; i < 60 && excess(low) > 0; ++i, step *= 2) low -= step;
  }
  if (low > high) std::swap(low, high);
  if (low == high) return low;
  return numeric::bracketed_root(excess, low, high, 0);
}

/// A curve of the family in the standard frame.
struct Member {
  SpaceStandardForm form;
  SpaceChain chain;
  SpaceFrame end;
};

std::optional<Member> member(SpaceStandardForm form, const Unknowns& x) {
  const double length = x[2];
  if (!(length > 0) || !x.allFinite() || length > 100) return std::nullopt;
  form.lambda = x[0] / length;
  const auto nu = nu_of(form, length, x[1]);
  if (!nu) return std::nullopt;
  form.nu = *nu;
  const auto piece = standard_piece(form, length);
  if (!piece) return std::nullopt;
  Member m{form, {{}, {*piece}}, {}};
  m.end = frame_at(m.chain, 1);
  if (!(norm(m.end.position - Point3{}) > 1e-3 * length)) return std::nullopt;
  return m;
}

/// Angle of the start tangent and direction of the end tangent against the wanted ones.
std::optional<Unknowns> miss(const SpaceStandardForm& form, const Unknowns& x,
                             const Invariants& wanted) {
  const auto m = member(form, x);
  if (!m) return std::nullopt;
  const Vector3 chord = m->end.position - Point3{};
  const Vector3 tangent = into(chord_frame(chord, {1, 0, 0}), m->end.tangent);
  const Vector3 off = tangent - end_tangent(wanted);
  const double c = std::cos(wanted.last);
  const Vector3 along{-std::sin(wanted.last), -c * std::cos(wanted.twist),
                      -c * std::sin(wanted.twist)};
  const Vector3 around{0, std::sin(wanted.twist), -std::cos(wanted.twist)};
  return Unknowns{angle_between({1, 0, 0}, chord) - wanted.first, dot(off, along),
                  dot(off, around)};
}

std::optional<Unknowns> newton_step(const SpaceStandardForm& form, const Unknowns& x,
                                    const Unknowns& at, const Invariants& wanted) {
  Eigen::Matrix3d slope;
  const double sizes[3] = {1e-6, 1e-6, 1e-6 * x[2]};
  for (int i = 0; i < 3; ++i) {
    Unknowns near = x;
    near[i] += sizes[i];
    auto there = miss(form, near, wanted);
    double size = sizes[i];
    if (!there) {
      near[i] = x[i] - size;
      size = -size;
      there = miss(form, near, wanted);
    }
    if (!there) return std::nullopt;
    slope.col(i) = (*there - at) / size;
  }
  const Unknowns step = slope.partialPivLu().solve(at);
  return step.allFinite() ? std::optional(step) : std::nullopt;
}

/// Newton's method with steps shortened until the miss falls.
bool solve(const SpaceStandardForm& form, const Invariants& wanted, double enough, Unknowns& x,
           int& iterations) {
  auto at = miss(form, x, wanted);
  for (int i = 0; at && i < 25; ++i) {
    if (at->lpNorm<Eigen::Infinity>() <= enough) return true;
    const auto step = newton_step(form, x, *at, wanted);
    if (!step) return false;
    ++iterations;
    double share = 1;
    auto there = miss(form, x - *step, wanted);
    while ((!there || there->norm() > at->norm()) && share > 1e-3) {
      share /= 2;
      there = miss(form, x - share * *step, wanted);
    }
    if (!there || !(there->norm() < at->norm()))  // rounding, or stuck
      return at->lpNorm<Eigen::Infinity>() <= std::max(enough, 1e-12);
    x -= share * *step;
    at = there;
  }
  return at && at->lpNorm<Eigen::Infinity>() <= std::max(enough, 1e-12);
}

struct Reached {
  Unknowns x;
  double share = 0;  ///< of the way from the circular arc to the data
  int iterations = 0;
};

/// From the arc that turns as much to the data, in steps as long as Newton's method follows.
Reached follow(const SpaceStandardForm& form, const Invariants& wanted) {
  const double mean = (wanted.first + wanted.last) / 2;
  Reached reached{{0, 0, 2 * mean}, 0, 0};
  Unknowns before = reached.x;
  double at_before = 0;
  double step = 0.25;
  while (reached.share < 1 && step > 0.01) {
    const double to = std::min(1.0, reached.share + step);
    const Invariants there{mean + to * (wanted.first - mean), mean + to * (wanted.last - mean),
                           to * wanted.twist};
    Unknowns x = reached.x;
    if (reached.share > at_before)
      x += (to - reached.share) / (reached.share - at_before) * (reached.x - before);
    // On the way the curve need not be exact.
    const double enough = to < 1 ? 1e-4 * mean : 4e-14;
    if (solve(form, there, enough, x, reached.iterations)) {
      before = reached.x;
      at_before = reached.share;
      reached.x = x;
      reached.share = to;
      step *= 1.5;
    } else {
      step /= 2;
    }
  }
  return reached;
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
  const Reached reached = follow(form, wanted);
  if (reached.share < 1) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * reached.share);
    return core::fail(ErrorCode::undrawable, "no space curve of these slopes meets the tangents",
                      std::string("one was followed ") + text +
                          " of the way from an arc: turn the tangents towards the chord, or take "
                          "slopes nearer to 0 and a smaller omega");
  }
  const Member m = *member(form, reached.x);
  SpaceSolution solution;
  solution.chain = placed(m, data);
  solution.lambda = m.form.lambda;
  solution.nu = m.form.nu;
  solution.length = m.chain.pieces[0].length;
  solution.iterations = reached.iterations;
  return solution;
}

}  // namespace keyline::lac
