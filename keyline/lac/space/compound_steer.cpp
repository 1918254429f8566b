#include "keyline/lac/space/compound_steer.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "keyline/core/angle.h"
#include "keyline/lac/segment/piece_shape.h"
#include "keyline/lac/space/space_ride.h"
#include "keyline/lac/space/space_shooting.h"

namespace keyline::lac::detail::space {
namespace {

/// As the family of one slope is searched: what winds more is no curve to look at, nor quick to
/// follow.
constexpr double kMostTurning = 3 * core::kPi;

}  // namespace

double turning_of(const SpaceChain& chain) {
  double bend = 0, twist = 0;
  for (const SpacePiece& p : chain.pieces) {
    bend += absolute_turning(curvature_law(p));
    twist += absolute_turning(torsion_law(p));
  }
  return std::max(bend, twist);
}

/// Along the whole length of 1.
struct JointFamily::Laws {
  TwoSlopes bend, twist;
  double size = 1, torsion_size = 1;
  double bend_rate = 0, twist_rate = 0;
  double bend_drawn = 0, twist_drawn = 0;
  std::array<double, 2> bend_ends{}, twist_ends{};

  double curvature(double t) const { return size * bend.at(bend_rate, t); }
  double torsion(double t) const { return torsion_size * twist.at(twist_rate, t); }

  std::vector<Stretch> stretches() const {
    std::vector<Stretch> all;
    for (const int piece : {0, 1}) {
      const double length = bend.length(piece), from = piece == 0 ? 0 : bend.share;
      for (const Stretch& s :
           graded_stretches(bend.run(bend_rate, piece), twist.run(twist_rate, piece)))
        all.push_back({from + length * s.from, from + length * s.to, s.power, s.zero_at_start});
    }
    return all;
  }
  /// By bend, size, twist and flow.
  std::vector<Change<4>> changes(const std::vector<RideNode>& nodes) const {
    std::vector<Change<4>> all(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!(nodes[i].weight > 0)) continue;
      const double t = nodes[i].place;
      const double k = bend.at(bend_rate, t), w = twist.at(twist_rate, t);
      const double by_bend = bend.rate_by(bend_drawn) * std::hypot(1, bend_drawn);
      const double by_flow = twist.rate_by(twist_drawn) * twist_drawn;
      all[i].curvature = {size * bend.by_rate(k, t) * by_bend, size * k, 0, 0};
      all[i].torsion = {0, 0, torsion_size * w, torsion_size * twist.by_rate(w, t) * by_flow};
    }
    return all;
  }
};

struct JointFamily::Aimed {
  Laws laws;
  Ride ride;
  JointMiss miss{};
};

JointFamily::JointFamily(const SpaceRhythm& r)
    : r_(r), bend_{r.alpha, r.length_share}, twist_{r.beta, r.length_share} {}

std::optional<JointFamily::Laws> JointFamily::laws(const Joint& x) const {
  Laws laws{bend_, twist_};
  laws.size = std::exp(x.size);
  laws.torsion_size = std::copysign(std::exp(x.twist), x.left ? 1 : -1);
  laws.bend_drawn = std::sinh(x.bend);
  const bool falls = (r_.omega > 0) == (x.left || r_.beta[0] >= 0);
  laws.twist_drawn = r_.omega == 0 ? 0 : std::copysign(std::exp(x.flow), falls ? -1 : 1);
  laws.bend_rate = bend_.rate(laws.bend_drawn);
  laws.twist_rate = twist_.rate(laws.twist_drawn);
  const auto bend = bend_.ends(laws.bend_drawn), twist = twist_.ends(laws.twist_drawn);
  if (!bend || !twist) return std::nullopt;
  laws.bend_ends = *bend;
  laws.twist_ends = *twist;
  return laws;
}

std::optional<SpaceChain> JointFamily::chain(const Joint& x) const {
  const auto l = laws(x);
  return l ? chain(*l) : std::nullopt;
}

std::optional<SpaceChain> JointFamily::chain(const Laws& l) const {
  const auto& [k0, k1] = l.bend_ends;
  const auto& [w0, w1] = l.twist_ends;
  const double k = k0 < 0 ? -l.size : l.size, w = l.torsion_size;
  SpaceChain chain{{},
                   {{r_.alpha[0], r_.beta[0], bend_.length(0), k * k0, k, w * w0, w},
                    {r_.alpha[1], r_.beta[1], bend_.length(1), k, k * k1, w, w * w1}}};
  if (!validate(chain) || !(turning_of(chain) <= kMostTurning)) return std::nullopt;
  return chain;
}

std::optional<double> JointFamily::omega_miss(const Joint& x) const {
  const auto l = laws(x);
  return l ? std::optional(omega_miss(*l, x)) : std::nullopt;
}

/// torsion' = -omega torsion^(beta + 1), both in units of the radius of curvature at the start.
double JointFamily::omega_miss(const Laws& l, const Joint& x) const {
  if (r_.omega == 0) return 0;
  const double start = x.size + std::log(std::abs(l.bend_ends[0]));
  return std::log(std::abs(l.twist_rate)) - std::log(std::abs(r_.omega)) -
         (1 - r_.beta[0]) * start - r_.beta[0] * x.twist;
}

std::optional<JointFamily::Aimed> JointFamily::aim(const Invariants& wanted, const Joint& x) const {
  const auto l = laws(x);
  if (!l || !chain(*l)) return std::nullopt;
  const std::vector<Stretch> stretches = l->stretches();
  Aimed aimed{*l, ride_along(*l, std::span<const Stretch>(stretches)), {}};
  const Motion& end = aimed.ride.end();
  if (!(norm(end.at) > 1e-3)) return std::nullopt;
  const Miss miss = miss_of(end.at, end.tangent, wanted);
  aimed.miss = {miss[0], miss[1], miss[2], omega_miss(*l, x)};
  return aimed;
}

std::optional<JointMiss> JointFamily::step(const Aimed& at, const JointMiss& miss,
                                           const Invariants& wanted) const {
  const Laws& l = at.laws;
  const auto changes = l.changes(at.ride.nodes);
  const Shot<4> shot = at.ride.shot<4>(std::span<const Change<4>>(changes));
  std::array<JointMiss, 4> slope{};
  const auto by = slopes_of(shot, wanted);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t row = 0; row < 3; ++row) slope[row][i] = by[i][row];
  if (r_.omega == 0) {
    slope[3] = {0, 0, 0, 1};
  } else {
    const double by_bend = bend_.by_rate(l.bend_ends[0], 0) / l.bend_ends[0] *
                           bend_.rate_by(l.bend_drawn) * std::hypot(1, l.bend_drawn);
    const double by_flow = twist_.rate_by(l.twist_drawn) * l.twist_drawn / l.twist_rate;
    slope[3] = {-(1 - r_.beta[0]) * by_bend, r_.beta[0] - 1, -r_.beta[0], by_flow};
  }
  JointMiss step = miss;
  if (!solve_small(slope, step)) return std::nullopt;
  return size_of(step) < 1e6 ? std::optional(step) : std::nullopt;
}

namespace {

/// No coordinate by more than `most`.
Joint moved(const Joint& x, const JointMiss& step, double share) {
  constexpr double kMost = 1.5;
  const double by = std::min(share, kMost / size_of(step));
  return {x.bend - by * step[0], x.size - by * step[1], x.twist - by * step[2],
          x.flow - by * step[3], x.left};
}

}  // namespace

bool JointFamily::steer(const Invariants& wanted, double enough, Joint& x, int& iterations) const {
  auto here = aim(wanted, x);
  for (int i = 0; here && i < 30; ++i) {
    const double size = size_of(here->miss);
    if (size <= enough) return true;
    const auto by = step(*here, here->miss, wanted);
    if (!by) return false;
    ++iterations;
    for (double share = 1;; share /= 2) {
      if (share < 0.02) return false;
      const Joint next = moved(x, *by, share);
      auto there = aim(wanted, next);
      if (!there || !(size_of(there->miss) < (1 - 0.1 * share) * size)) continue;
      x = next;
      here = std::move(there);
      break;
    }
  }
  return here && size_of(here->miss) <= enough;
}

std::optional<Joint> JointFamily::polished(const Invariants& wanted, Joint x,
                                           int& iterations) const {
  std::optional<Joint> best;
  double least = 1e-12;
  double before = 1e300;
  for (int i = 0; i < 30; ++i) {
    const auto aimed = aim(wanted, x);
    if (!aimed) break;
    const SpaceFrame end = frame_at(*chain(x), 1);
    const Miss exact = miss_of(end.position - core::Point3{}, end.tangent, wanted);
    const JointMiss miss{exact[0], exact[1], exact[2], aimed->miss[3]};
    const double size = size_of(miss);
    if (size <= least) {
      least = size;
      best = x;
    }
    if (size <= 4e-14 || (best && size > 0.5 * before)) break;
    before = size;
    const auto by = step(*aimed, miss, wanted);
    if (!by) break;
    ++iterations;
    x = moved(x, *by, 1);
  }
  return best;
}

std::optional<Joint> JointFamily::joint_of(const SpacePiece& piece) const {
  const Piece bend = curvature_law(piece), twist = torsion_law(piece);
  const double at = r_.length_share, k = curvature(bend, at), w = curvature(twist, at);
  if (!(k != 0 && w != 0)) return std::nullopt;
  const auto bend_drawn = bend_.drawn(curvature_rate(bend, at) / k * piece.length);
  const auto twist_drawn = twist_.drawn(curvature_rate(twist, at) / w * piece.length);
  if (!bend_drawn || !twist_drawn) return std::nullopt;
  const Joint x{std::asinh(*bend_drawn), std::log(std::abs(k) * piece.length),
                std::log(std::abs(w) * piece.length),
                r_.omega == 0 ? 0 : std::log(std::abs(*twist_drawn)), w > 0};
  return std::isfinite(x.flow) ? std::optional(x) : std::nullopt;
}

/// Torsion's rate by its size, or its size by the rate, as omega has it.
std::optional<Joint> JointFamily::with_torsion(Joint x, double growth) const {
  const auto unit = laws(x);
  if (!unit) return std::nullopt;
  if (growth > 0) {
    x.flow = std::log(std::abs(twist_.drawn_to(TwoSlopes::grown(unit->twist_drawn), growth)));
    x.twist = 0;
    x.twist = omega_miss(x).value_or(NAN) / r_.beta[0];
  } else {
    const double start = x.size + std::log(std::abs(unit->bend_ends[0]));
    const double rate =
        std::abs(r_.omega) * std::exp((1 - r_.beta[0]) * start + r_.beta[0] * x.twist);
    const auto drawn = twist_.drawn(std::copysign(rate, unit->twist_drawn));
    x.flow = std::log(std::abs(drawn.value_or(NAN)));
  }
  return std::isfinite(x.flow) && std::isfinite(x.twist) ? std::optional(x) : std::nullopt;
}

/// Ratio of either law's end to the joint, where it grows, up to e^4; turning 0.05 to 9, even in
/// its logarithm. Torsion's growth tells its size by omega, or its size, 1e-5 to 9, the growth.
std::optional<Joint> JointFamily::place(std::mt19937_64& random) const {
  constexpr double kGrowth = 4;
  Joint x;
  const int grows = between(random, 0, 1) < 0.5 ? 0 : 1;
  x.bend = std::asinh(bend_.drawn_to(grows, std::exp(between(random, 0, kGrowth))));
  x.left = between(random, 0, 1) < 0.5;
  x.twist = between(random, std::log(1e-5), std::log(kMostTurning));
  const double turning = std::exp(between(random, std::log(0.05), std::log(9.0)));
  const bool by_growth = between(random, 0, 1) < 0.7 && std::abs(r_.beta[0]) > 0.05;
  const double growth = std::exp(between(random, 0, kGrowth));
  const auto ends = bend_.ends(std::sinh(x.bend));
  if (!ends) return std::nullopt;
  x.size = std::log(turning / (absolute_turning({r_.alpha[0], bend_.length(0), (*ends)[0], 1}) +
                               absolute_turning({r_.alpha[1], bend_.length(1), 1, (*ends)[1]})));
  if (!std::isfinite(x.size)) return std::nullopt;
  return r_.omega == 0 ? x : with_torsion(x, by_growth ? growth : 0);
}

std::optional<Joint> JointFamily::search(const Invariants& wanted, int& iterations) const {
  constexpr int kRounds = 5, kPlaces = 1200;
  constexpr std::size_t kSteered = 60;
  std::mt19937_64 random(20260101);  // one seed: one answer
  const double enough = 1e-8 * std::min(1.0, wanted.first + wanted.last);
  std::optional<Joint> best;
  double least = HUGE_VAL;
  for (int round = 0; round < kRounds && !best; ++round) {
    std::vector<std::pair<double, Joint>> starts;
    for (int i = 0; i < kPlaces; ++i) {
      const auto x = place(random);
      const auto aimed = x ? aim(wanted, *x) : std::nullopt;
      if (aimed && size_of(aimed->miss) < 3) starts.emplace_back(size_of(aimed->miss), *x);
    }
    std::ranges::sort(starts, {}, [](const auto& start) { return start.first; });
    starts.resize(std::min(starts.size(), kSteered));
    for (auto& [miss, x] : starts) {
      if (!steer(wanted, enough, x, iterations)) continue;
      const double turning = turning_of(*chain(x));
      if (!(turning < 0.999 * least)) continue;
      const auto exact = polished(wanted, x, iterations);
      if (!exact) continue;
      least = turning;
      best = exact;
    }
  }
  return best;
}

}  // namespace keyline::lac::detail::space
