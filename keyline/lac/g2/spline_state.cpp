#include <algorithm>
#include <cmath>

#include "keyline/lac/g2/spline_newton.h"

namespace keyline::lac::detail {

SplineState straight_state(const SplineProblem& problem) {
  return {std::vector<double>(problem.slots(), 0.0), problem.chord};
}

SplineState guessed_state(const SplineProblem& problem) {
  SplineState state = straight_state(problem);
  const std::size_t n = problem.spans();
  for (std::size_t i = 0; i < problem.slots(); ++i) {
    if (!problem.closed && (i == 0 || i == n)) continue;
    const double chords = problem.chord[(i + n - 1) % n] + problem.chord[i];
    state.curvature[i] = 2 * problem.fold * problem.turn[i] / chords;
  }
  if (!problem.closed && n > 1) {
    state.curvature[0] = state.curvature[1];
    state.curvature[n] = state.curvature[n - 1];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double mean = 0.5 * (state.curvature[i] + state.curvature[(i + 1) % problem.slots()]);
    const double h = std::min(1.5, 0.5 * std::abs(mean) * problem.chord[i]);
    state.length[i] *= 1 + h * h / 6;
  }
  return state;
}

std::vector<Piece> pieces_of_span(const SplineProblem& problem, const SplineState& state,
                                  std::size_t i) {
  const std::size_t n = problem.spans();
  const double alpha = problem.alpha[i];
  const double length = state.length[i];
  const double k0 = state.curvature[i];
  const double k1 = state.curvature[problem.closed && i + 1 == n ? 0 : i + 1];
  if (!problem.closed && i == 0 && problem.start.both()) {
    const double given = problem.fold * *problem.start.curvature;
    return {{alpha, length / 2, given, k0}, {alpha, length / 2, k0, k1}};
  }
  if (!problem.closed && i + 1 == n && problem.end.both()) {
    const double given = problem.fold * *problem.end.curvature;
    return {{alpha, length / 2, k0, k1}, {alpha, length / 2, k1, given}};
  }
  return {{alpha, length, k0, k1}};
}

}  // namespace keyline::lac::detail
