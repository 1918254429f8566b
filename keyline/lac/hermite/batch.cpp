#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/lanes/batch_lanes.h"

namespace keyline::lac {
namespace {

using core::Vector2;
using detail::ChordBlock;
using detail::kBatchSize;

/// A problem ready for a lane, and what the lane does not need to know.
struct Prepared {
  std::size_t index = 0;
  double theta = 0;
  double excess = 0;
  double chord = 0;
  double direction = 0;
  double sign = 1;
  bool reversed = false;
  int effort = 0;  ///< problems of like effort share their lanes' loops best
};
constexpr int kEfforts = 17;

/// The three angles of the handles of each problem, a column each.
struct AngleBlock {
  struct Column {
    alignas(64) double y[kBatchSize]{};
    alignas(64) double x[kBatchSize]{};
    alignas(64) double angle[kBatchSize]{};
    void set(std::size_t at, double sine, double cosine) {
      y[at] = sine;
      x[at] = cosine;
    }
    void compute(std::size_t count) { detail::angles_of_block(y, x, angle, count); }
  };
  Column turning, chord, direction;
  double square[kBatchSize]{};  ///< of the chord
  bool plain[kBatchSize]{};     ///< distinct points of ordinary size
};

void measure(std::span<const G1Problem> problems, AngleBlock& block) {
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const G1Problem& p = problems[i];
    const Vector2 first = p.p1 - p.p0;
    const Vector2 chord = p.p2 - p.p0;
    const Vector2 second = p.p2 - p.p1;
    const double square = dot(chord, chord);
    const double smallest = std::min({dot(first, first), dot(second, second), square});
    const double largest = std::max({dot(first, first), dot(second, second), square});
    block.plain[i] = smallest > 1e-200 && largest < 1e200 && std::abs(p.alpha) < 1e6;
    block.square[i] = square;
    block.turning.set(i, cross(first, second), dot(first, second));
    block.chord.set(i, cross(first, chord), dot(first, chord));
    block.direction.set(i, first.y, first.x);
  }
  block.turning.compute(problems.size());
  block.chord.compute(problems.size());
  block.direction.compute(problems.size());
}

/// About the range of the integral: the turning and, by the first guess, the decay. Clothoids,
/// which need none, come first.
int effort_of(double theta, double excess, double alpha) {
  if (alpha == -1) return 0;
  const double x = excess * std::max(1.0, std::abs(2 * alpha - 1)) / theta;  // below 1/2
  const double reach = theta + 6 * x / (1.05 - 2 * std::min(x, 0.5));
  return 1 + static_cast<int>(std::min(reach, kEfforts - 2.0));
}

/// False where the problem is one for the single solver.
bool prepare(const AngleBlock& angles, std::size_t i, double alpha, Prepared& p) {
  const double turning = angles.turning.angle[i];
  p.theta = std::abs(turning);
  const double psi = turning < 0 ? -angles.chord.angle[i] : angles.chord.angle[i];
  p.excess = std::abs(psi - p.theta / 2);
  const bool ordinary = p.theta > 1e-12 && p.theta < 3.1 && psi > 0 && psi < p.theta;
  if (!(angles.plain[i] && ordinary && p.excess > 1e-9 * p.theta)) return false;
  p.index = i;
  p.chord = std::sqrt(angles.square[i]);
  p.direction = angles.direction.angle[i];
  p.sign = turning < 0 ? -1 : 1;
  p.reversed = psi < p.theta / 2;
  p.effort = effort_of(p.theta, p.excess, alpha);
  return true;
}

/// Positions in order of effort (counting sort).
void order_by_effort(std::span<const Prepared> prepared, std::span<std::size_t> lane) {
  std::array<std::size_t, kEfforts + 1> start{};
  for (const Prepared& p : prepared) ++start[p.effort + 1];
  for (int e = 0; e < kEfforts; ++e) start[e + 1] += start[e];
  for (std::size_t i = 0; i < prepared.size(); ++i) lane[i] = start[prepared[i].effort]++;
}

void solve_singly(const G1Problem& problem, G1Outcome& outcome) {
  const auto solution = solve_g1(problem.p0, problem.p1, problem.p2, problem.alpha);
  outcome.drawn = solution.has_value();
  if (!solution) return;
  outcome.segment = solution->segment;
  outcome.lambda = solution->lambda;
  outcome.reversed = solution->reversed;
}

void leave(const G1Problem& problem, const ChordBlock& block, std::size_t at,
           const Prepared& placed, G1Outcome& outcome) {
  // Curvatures for unit arc length to curvatures of the arc length chord / chord_length.
  const double unit = placed.sign * block.chord_length[at] / placed.chord;
  const double heavy = unit * block.heavy[at];
  const bool sharp_is_heavy = problem.alpha < 0;
  const double sharp = sharp_is_heavy ? heavy : heavy / block.ratio[at];
  const double flat = sharp_is_heavy ? heavy * block.ratio[at] : heavy;
  outcome.segment = {{problem.p0, placed.direction},
                     problem.alpha,
                     placed.chord / block.chord_length[at],
                     placed.reversed ? flat : sharp,
                     placed.reversed ? sharp : flat};
  outcome.lambda = block.lambda[at];
  outcome.drawn = true;
  outcome.reversed = placed.reversed;
}

/// At most kBatchSize problems.
void solve_some(std::span<const G1Problem> problems, std::span<G1Outcome> outcomes,
                AngleBlock& angles, ChordBlock& block) {
  std::array<Prepared, kBatchSize + 1> prepared;
  std::array<std::size_t, kBatchSize> lane;
  measure(problems, angles);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    outcomes[i] = {};
    if (prepare(angles, i, problems[i].alpha, prepared[filled])) {
      ++filled;
    } else {
      solve_singly(problems[i], outcomes[i]);
    }
  }
  order_by_effort(std::span(prepared).first(filled), lane);
  for (std::size_t i = 0; i < filled; ++i) {
    block.alpha[lane[i]] = problems[prepared[i].index].alpha;
    block.theta[lane[i]] = prepared[i].theta;
    block.excess[lane[i]] = prepared[i].excess;
  }
  for (std::size_t i = filled; i < std::min(filled + 8, kBatchSize); ++i) {
    block.alpha[i] = -1;
    block.theta[i] = 1;
    block.excess[i] = 0.01;
  }
  detail::solve_block(block, filled);
  for (std::size_t i = 0; i < filled; ++i) {
    const std::size_t index = prepared[i].index;
    if (block.solved[lane[i]] != 0) {
      leave(problems[index], block, lane[i], prepared[i], outcomes[index]);
    } else {
      solve_singly(problems[index], outcomes[index]);
    }
  }
}

}  // namespace

void solve_g1(std::span<const G1Problem> problems, std::span<G1Outcome> outcomes) {
  if (problems.size() != outcomes.size()) {
    throw core::InvalidInput("solve_g1: sizes of the spans differ");
  }
  AngleBlock angles;
  ChordBlock block;
  for (std::size_t done = 0; done < problems.size(); done += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, problems.size() - done);
    solve_some(problems.subspan(done, count), outcomes.subspan(done, count), angles, block);
  }
}

}  // namespace keyline::lac
