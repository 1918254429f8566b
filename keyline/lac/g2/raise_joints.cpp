#include "keyline/lac/g2/raise_joints.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "keyline/lac/chain/departure.h"
#include "keyline/lac/g2/rate_run.h"

namespace keyline::lac {
namespace {

using detail::Parts;

constexpr std::array<detail::Cut, 6> kCuts{
    {{3, 1}, {3, 0.7}, {3, 1.5}, {4, 1}, {4, 0.7}, {4, 1.5}}};
constexpr double kEqual = 1e-9;  ///< relative difference of what counts as equal

bool has_cusp(const Piece& p) {
  return std::isinf(p.curvature_start) || std::isinf(p.curvature_end);
}
bool is_constant(const Piece& p) { return p.curvature_start == p.curvature_end; }
bool rises(const Piece& p) { return p.curvature_end > p.curvature_start; }

/// What a joint is before anything is tried; `raised` where it is to be tried.
JointFate fate_of(const Piece& before, const Piece& after) {
  if (has_cusp(before) || has_cusp(after)) return JointFate::cusp;
  const double k0 = before.curvature_end;
  const double k1 = after.curvature_start;
  const double unit = std::max(1 / before.length, 1 / after.length);
  if (std::abs(k1 - k0) > kEqual * std::max({std::abs(k0), std::abs(k1), unit}))
    return JointFate::jump;
  if (is_constant(before) && is_constant(after)) return JointFate::already;
  if (is_constant(before) || is_constant(after)) return JointFate::constant;
  if (rises(before) != rises(after)) return JointFate::turn;
  const double r0 = std::abs(curvature_rate(before, 1));
  const double r1 = std::abs(curvature_rate(after, 0));
  const bool equal = std::isfinite(r0) && r0 > 0 && std::abs(r1 - r0) <= kEqual * std::max(r0, r1);
  return equal ? JointFate::already : JointFate::raised;
}

/// How far the rates of both sides are apart; infinite where one is 0 or infinite.
double rate_gap(const Piece& before, const Piece& after) {
  const double gap = std::abs(std::log(std::abs(curvature_rate(before, 1))) -
                              std::log(std::abs(curvature_rate(after, 0))));
  return std::isnan(gap) ? HUGE_VAL : gap;
}

Parts backwards(std::span<const Piece> row) {
  return reverse(Chain{{}, {row.begin(), row.end()}, false}).pieces;
}

/// Tried from the end where nothing is found from the start: neither way must find what the other
/// does not.
std::optional<Parts> free_run_either_way(std::span<const Piece> row) {
  if (auto run = detail::solve_free_run(row)) return run;
  const auto run = detail::solve_free_run(backwards(row));
  if (!run) return std::nullopt;
  return backwards(*run);
}
std::optional<std::vector<Parts>> rate_run_either_way(std::span<const Piece> row,
                                                      const detail::Cut& cut) {
  if (auto run = detail::solve_rate_run(row, cut)) return run;
  auto run = detail::solve_rate_run(backwards(row), cut);
  if (!run) return std::nullopt;
  std::ranges::reverse(*run);
  for (Parts& parts : *run) parts = backwards(parts);
  return run;
}

/// The pieces of the chain with what takes their place so far.
class Raising {
 public:
  Raising(const Chain& chain, const RaiseOptions& options)
      : pieces_(chain.pieces),
        count_(chain.pieces.size()),
        hold_(options.hold),
        limit_(options.limit.value_or(HUGE_VAL)),
        fate_(count_, JointFate::jump),
        parts_(count_) {
    for (std::size_t i = 0; i < count_; ++i) {
      parts_[i] = {pieces_[i]};
      if (i > 0 || chain.closed) fate_[i] = fate_of(pieces_[(i + count_ - 1) % count_], pieces_[i]);
    }
    for (std::size_t i = 0; i < count_; ++i) {  // equal to the last bit where they count as equal
      if (!is_joined(i)) continue;
      const double shared = pieces_[(i + count_ - 1) % count_].curvature_end;
      pieces_[i].curvature_start = shared;
    }
  }

  void run() {
    // Around a closed chain curvature cannot rise all the way: somewhere a run begins.
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_joined(i)) continue;
      std::size_t many = 1;
      while (many < count_ && is_joined((i + many) % count_)) ++many;
      raise(i, many);
    }
  }

  JointFate fate(std::size_t joint) const { return fate_[joint]; }
  const Parts& parts(std::size_t piece) const { return parts_[piece]; }
  double departure() const { return departure_; }

 private:
  struct Found {
    std::vector<Parts> parts;
    std::vector<double> departure;
    double largest = HUGE_VAL;
  };

  bool is_joined(std::size_t i) const {
    return fate_[i] == JointFate::raised || fate_[i] == JointFate::already;
  }

  /// Without new pieces; the departure is that of the whole run.
  Found free_run(std::span<const Piece> row) const {
    auto run = free_run_either_way(row);
    if (!run) return {};
    Found found{{}, {}, departure_bound({{}, {row.begin(), row.end()}, false}, {{}, *run, false})};
    for (const Piece& piece : *run) {
      found.parts.push_back({piece});
      found.departure.push_back(found.largest);
    }
    return found;
  }

  Found best(std::span<const Piece> row) const {
    if (hold_ == HeldJoints::ends) return free_run(row);
    Found best;
    for (const detail::Cut cut : kCuts) {
      if (cut.parts > 3 && std::isfinite(best.largest) && best.largest <= limit_) break;
      auto parts = rate_run_either_way(row, cut);
      if (!parts) continue;
      Found found{std::move(*parts), {}, 0};
      for (std::size_t i = 0; i < row.size(); ++i) {
        found.departure.push_back(
            departure_bound({{}, {row[i]}, false}, {{}, found.parts[i], false}));
        found.largest = std::max(found.largest, found.departure.back());
      }
      if (found.largest < best.largest) best = std::move(found);
    }
    return best;
  }

  /// Pieces first … first + many - 1. Where they cannot all be had, the joint whose rates are the
  /// farthest apart (of those at the piece that departs most) is given up, and both sides tried.
  void raise(std::size_t first, std::size_t many) {
    const auto at = [&](std::size_t i) { return (first + i) % count_; };
    bool needed = false;
    for (std::size_t i = 1; i < many; ++i) needed |= fate_[at(i)] == JointFate::raised;
    if (!needed) return;
    std::vector<Piece> row;
    for (std::size_t i = 0; i < many; ++i) row.push_back(pieces_[at(i)]);
    Found found = best(row);
    if (found.largest <= limit_ && std::isfinite(found.largest)) {
      for (std::size_t i = 0; i < many; ++i) parts_[at(i)] = std::move(found.parts[i]);
      departure_ = std::max(departure_, found.largest);
      return;
    }
    const bool beyond = std::isfinite(found.largest);
    std::size_t worst = 0;
    double gap = -1;
    for (std::size_t i = 1; i < many; ++i) {
      if (fate_[at(i)] != JointFate::raised) continue;
      const bool near = !beyond || std::max(found.departure[i - 1], found.departure[i]) > limit_;
      const double apart = near ? rate_gap(row[i - 1], row[i]) : -0.5;
      if (apart > gap) worst = i;
      gap = std::max(gap, apart);
    }
    fate_[at(worst)] = beyond ? JointFate::beyond_limit : JointFate::not_found;
    raise(first, worst);
    raise(at(worst), many - worst);
  }

  std::vector<Piece> pieces_;
  std::size_t count_;
  HeldJoints hold_;
  double limit_;
  std::vector<JointFate> fate_;  ///< of the joint at which a piece starts
  std::vector<Parts> parts_;
  double departure_ = 0;
};

}  // namespace

core::Result<RaiseSolution> raise_joints(const Chain& chain, const RaiseOptions& options) {
  if (auto valid = validate(chain); !valid) return std::unexpected(valid.error());
  Raising raising(chain, options);
  raising.run();
  RaiseSolution solution{{chain.start, {}, chain.closed}, {}, raising.departure()};
  const std::size_t count = chain.pieces.size();
  std::vector<std::size_t> first;  // new piece that each given one begins with
  for (std::size_t i = 0; i < count; ++i) {
    const Parts& parts = raising.parts(i);
    first.push_back(solution.chain.pieces.size());
    solution.chain.pieces.insert(solution.chain.pieces.end(), parts.begin(), parts.end());
  }
  first.push_back(solution.chain.pieces.size());
  const auto places = joints(solution.chain);
  for (std::size_t k = 1; k < count + (chain.closed ? 1 : 0); ++k) {
    const std::size_t before = k - 1;
    const std::size_t after = k % count;
    solution.joints.push_back(
        {after,
         places[first[k]].position,
         raising.fate(after),
         {curvature_rate(chain.pieces[before], 1), curvature_rate(chain.pieces[after], 0)},
         {curvature_rate(raising.parts(before).back(), 1),
          curvature_rate(raising.parts(after).front(), 0)}});
  }
  return solution;
}

}  // namespace keyline::lac
