#include "keyline/lac/space/space_steer.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/axis.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::lac::detail::space {

using core::ErrorCode;
using core::Result;
using core::Vector3;

namespace {

Result<void> check(const SpaceHermite& data, double alpha, double beta, double omega) {
  for (const auto& [value, name] : {std::pair{alpha, "alpha"}, {beta, "beta"}, {omega, "omega"}})
    if (!std::isfinite(value))
      return core::fail(ErrorCode::bad_input, std::string(name) + " is not finite", "", name);
  if (!is_finite(data.start) || !is_finite(data.end))
    return core::fail(ErrorCode::bad_input, "an end is not finite");
  constexpr double kFarthest = 1e150;  // squares of it are numbers
  const double chord = norm(data.end - data.start);
  if (!(chord > 0 && chord < kFarthest))
    return core::fail(ErrorCode::bad_input, "start and end coincide or lie too far apart",
                      "move one of them", "end");
  for (const auto& [v, name] :
       {std::pair{data.start_tangent, "tangents[0]"}, {data.end_tangent, "tangents[1]"}})
    if (!is_finite(v) || !(norm(v) > 0))
      return core::fail(ErrorCode::bad_input, "a tangent has no direction",
                        "give a vector that is not zero", name);
  return {};
}

Vector3 end_tangent(const Invariants& i) {
  const double s = std::sin(i.last);
  return {std::cos(i.last), -s * std::cos(i.twist), -s * std::sin(i.twist)};
}

}  // namespace

ChordFrame chord_frame(Vector3 chord, Vector3 side) {
  const Vector3 x = unit(chord);
  Vector3 across = side - dot(side, x) * x;
  if (norm(across) < 1e-14) across = core::any_normal(x);
  const Vector3 nearly = unit(across);  // what is small has kept a share of x
  const Vector3 y = unit(nearly - dot(nearly, x) * x);
  return {x, y, cross(x, y)};
}

Result<Setting> setting_of(const SpaceHermite& given, double alpha, double beta, double omega) {
  if (auto sound = check(given, alpha, beta, omega); !sound) return std::unexpected(sound.error());
  Setting s{given, {}, false, false};
  s.data.start_tangent = unit(given.start_tangent);
  s.data.end_tangent = unit(given.end_tangent);
  const Vector3 chord = unit(given.end - given.start);
  const Vector3 end = into(chord_frame(chord, s.data.start_tangent), s.data.end_tangent);
  s.wanted = {angle_between(chord, s.data.start_tangent), angle_between(chord, s.data.end_tangent),
              std::atan2(-end.z, -end.y)};
  s.planar = std::abs(dot(cross(chord, s.data.start_tangent), s.data.end_tangent)) < 1e-12;
  s.mirrored = !s.planar && s.wanted.twist < 0;
  s.wanted.twist = std::abs(s.wanted.twist);
  return s;
}

SpaceChain placed(const SpaceChain& own_chain, Vector3 own, const SpaceHermite& data,
                  bool mirrored) {
  const Vector3 wanted = data.end - data.start;
  const ChordFrame a = chord_frame(own, {1, 0, 0});
  ChordFrame b = chord_frame(wanted, data.start_tangent);
  if (mirrored) b.z = -b.z;
  const auto turn = [&](Vector3 v) { return from(b, into(a, v)); };
  const double scale = norm(wanted) / norm(own);
  const double twist = mirrored ? -scale : scale;
  SpaceChain chain = own_chain;
  const Vector3 tangent = unit(turn({1, 0, 0}));
  const Vector3 binormal = unit(cross(tangent, turn({0, 1, 0})));
  chain.start = {data.start, tangent, cross(binormal, tangent), binormal};
  for (SpacePiece& p : chain.pieces) {
    p.length *= scale;
    p.curvature_start /= scale;
    p.curvature_end /= scale;
    p.torsion_start /= twist;
    p.torsion_end /= twist;
  }
  return chain;
}

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
  return {core::angle_between({1, 0, 0}, chord) - wanted.first, scale * x, scale * y};
}

bool reasonable(double alpha, const SpaceUnknowns& x) {
  constexpr double kMost = 4 * core::kPi;
  if (!(x.length > 1e-6) || !(std::abs(x.twist) < kMost)) return false;
  const double end = detail::carried(1, alpha, x.bend);
  return std::isfinite(end) && absolute_turning(Piece{alpha, x.length, 1, end}) < kMost;
}

std::optional<Miss> newton_step(const SpaceShot& shot, const Miss& at, const Invariants& wanted) {
  const auto by = slopes_of(shot, wanted);
  std::array<std::array<double, 3>, 3> slope{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t row = 0; row < 3; ++row) slope[row][i] = by[i][row];
  Miss step = at;
  if (!solve_small(slope, step)) return std::nullopt;
  return size_of(step) < 1e6 ? std::optional(step) : std::nullopt;
}

SpaceUnknowns moved(const SpaceUnknowns& x, const Miss& step, double share) {
  return {x.bend - share * step[0], x.twist - share * step[1],
          x.length * std::exp(-share * std::clamp(step[2] / x.length, -1.0, 1.0))};
}

namespace {

/// For a slope above 0: torsion that the rate changes by its own size along the curve.
double felt_torsion(double beta, double rate) { return std::pow(beta * rate, -1 / beta); }

double rate_of(const SpaceStandardForm& form, double length) {
  return std::abs(detail::unit_rate(form.beta, form.omega, length));
}

}  // namespace

double most_twist(const SpaceStandardForm& form, double length) {
  if (!(form.beta > 1) || form.omega == 0) return HUGE_VAL;
  return felt_torsion(form.beta, rate_of(form, length)) * form.beta / (form.beta - 1);
}

namespace {

/// bend after d(bend) = by, linear in the logarithm of the ratio of the curvatures (for a slope
/// below 0, where it may change its sign, as far as it is large or small).
double bend_moved(double alpha, double bend, double by) {
  if (alpha == 0) return bend + by;
  const double at = alpha * bend;
  if (alpha > 0) return bend + (1 + at) * std::expm1(alpha * by / (1 + at)) / alpha;
  return std::sinh(std::asinh(at) + alpha * by / std::hypot(1, at)) / alpha;
}

}  // namespace

SpaceUnknowns moved_within(const SpaceStandardForm& form, const SpaceUnknowns& x, const Miss& step,
                           double share) {
  SpaceUnknowns next = moved(x, step, share);
  next.bend = bend_moved(form.alpha, x.bend, -share * step[0]);
  const double most = most_twist(form, x.length);
  if (std::isinf(most)) return next;
  const double part = x.twist / most;
  const double grown = (1 - 1 / form.beta) * std::log(next.length / x.length);  // of `most`
  const double part_by = -share * step[1] / most - part * grown;
  next.twist =
      most_twist(form, next.length) * std::tanh(std::atanh(part) + part_by / (1 - part * part));
  return next;
}

namespace {

/// A shot that starts and ends apart, and its miss.
struct Aimed {
  SpaceShot shot;
  Miss miss{};
};
std::optional<Aimed> aim(const SpaceStandardForm& form, const SpaceUnknowns& x,
                         const Invariants& wanted) {
  if (!reasonable(form.alpha, x)) return std::nullopt;
  const auto shot = shoot_space(form, x);
  if (!shot || !(norm(shot->chord) > 1e-3)) return std::nullopt;
  return Aimed{*shot, miss_of(shot->chord, shot->tangent, wanted)};
}

/// What quick shots to such data are off by, and more: a miss below it that no step lessens is
/// theirs.
double shot_error(const Invariants& wanted) {
  return std::min(1e-7, 1e-5 * (wanted.first + wanted.last));
}

}  // namespace

bool steer(const SpaceStandardForm& form, const Invariants& wanted, double enough, SpaceUnknowns& x,
           int& iterations) {
  auto here = aim(form, x, wanted);
  for (int i = 0; here && i < 25; ++i) {
    const double size = size_of(here->miss);
    if (size <= enough) return true;
    const auto step = newton_step(here->shot, here->miss, wanted);
    if (!step) return false;
    ++iterations;
    double share = 1;
    for (;; share /= 2) {
      if (share < 0.02) return size <= shot_error(wanted);
      const SpaceUnknowns next = moved_within(form, x, *step, share);
      const auto there = aim(form, next, wanted);
      if (!there || !(size_of(there->miss) < (1 - 0.1 * share) * size)) continue;
      x = next;
      here = there;
      break;
    }
  }
  return here && size_of(here->miss) <= enough;
}

// ---- The whole family --------------------------------------------------------------------------

double bend_for(double alpha, double ratio) {
  const double l = std::log(std::abs(ratio));
  if (ratio > 0) return -l * numeric::expm1_over(-alpha * l);
  return (-std::exp(-alpha * l) - 1) / alpha;
}

double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

namespace {

struct Start {
  SpaceUnknowns x;
  double miss = 0;
};

/// Torsion up to a full turn and a half either way. Where torsion that feels the rate is small it
/// is drawn from far below that to far above.
double random_twist(const SpaceStandardForm& form, double length, std::mt19937_64& random) {
  constexpr double kMost = 3 * core::kPi, kFarAbove = 5;
  const double twist = between(random, -kMost, kMost);
  const double rate = rate_of(form, length);
  if (!(form.beta > 0) || rate == 0) return twist;
  const double scale = felt_torsion(form.beta, rate);
  if (!(scale > 0 && scale < 1e100)) return twist;
  const double size = std::min(kFarAbove, std::asinh(kMost / scale)) * std::abs(twist) / kMost;
  const double largest = scale * std::sinh(size);
  const double least = detail::carried(largest, form.beta, rate);
  return std::copysign(numeric::power_mean_integral(largest, least, -form.beta, 1), twist);
}

/// A place anywhere in the family: ratio of the curvatures e^-5 … e^5, curvature times length at
/// the start from 0.02 to 30.
SpaceUnknowns random_place(const SpaceStandardForm& form, std::mt19937_64& random) {
  const double size = std::exp(between(random, -5, 5));
  const double ratio = form.alpha < 0 && between(random, 0, 1) < 0.4 ? -size : size;
  // What counts is how much the curve turns, about the mean of both ends' curvatures.
  const double turning = std::exp(between(random, std::log(0.05), std::log(9.0)));
  const double length = turning / std::sqrt(size);
  return {bend_for(form.alpha, ratio), random_twist(form, length, random), length};
}

constexpr int kRounds = 5;
constexpr int kPlaces = 1200;
constexpr std::size_t kSteered = 60;

}  // namespace

std::vector<SpaceUnknowns> search_family(const SpaceStandardForm& form, const Invariants& wanted,
                                         int& iterations) {
  std::mt19937_64 random(20260101);  // one seed: one answer
  std::vector<Start> found;
  const double enough = 1e-8 * std::min(1.0, wanted.first + wanted.last);
  for (int round = 0; round < kRounds && found.empty(); ++round) {
    std::vector<Start> starts;
    for (int i = 0; i < kPlaces; ++i) {
      const SpaceUnknowns x = random_place(form, random);
      const auto aimed = aim(form, x, wanted);
      if (aimed && size_of(aimed->miss) < 3) starts.push_back({x, size_of(aimed->miss)});
    }
    const auto by_miss = [](const Start& a, const Start& b) { return a.miss < b.miss; };
    std::sort(starts.begin(), starts.end(), by_miss);
    starts.resize(std::min(starts.size(), kSteered));
    for (Start& start : starts)
      if (steer(form, wanted, enough, start.x, iterations))
        found.push_back({start.x, std::abs(start.x.twist) + start.x.length});
  }
  std::sort(found.begin(), found.end(),
            [](const Start& a, const Start& b) { return a.miss < b.miss; });
  std::vector<SpaceUnknowns> answers;
  for (const Start& start : found) answers.push_back(start.x);
  return answers;
}

}  // namespace keyline::lac::detail::space
