#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "keyline/fit/knot_polish.h"

namespace keyline::fit::detail {
namespace {

using Knots = std::vector<double>;

double score(SplineSolver& solver, const BayesCriterion& criterion, const Knots& knots) {
  return criterion(solver.sum_near_data(knots), knots.size());
}

/// Spans of largest squared residual get a knot at the middle of their data.
Knots with_more_knots(SplineSolver& solver, const Knots& knots, std::size_t more) {
  const auto& x = solver.data().parameters;
  const std::size_t n = x.size();
  std::vector<double> residuals(n * solver.column_count());
  solver.residuals(residuals);
  struct Span {
    double squares;
    double middle;
  };
  std::vector<Span> spans;
  std::size_t first = 0;
  for (std::size_t k = 0; k <= knots.size(); ++k) {
    const double end = k < knots.size() ? knots[k] : solver.domain().high;
    std::size_t last = first;
    double squares = 0;
    while (last < n && (x[last] < end || k == knots.size())) {
      for (std::size_t c = 0; c < solver.column_count(); ++c) {
        squares += residuals[c * n + last] * residuals[c * n + last];
      }
      ++last;
    }
    if (last > first + 2) {
      const std::size_t mid = first + (last - first) / 2;
      spans.push_back({squares, (x[mid - 1] + x[mid]) / 2});
    }
    first = last;
  }
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& a, const Span& b) { return a.squares > b.squares; });
  Knots result = knots;
  for (std::size_t i = 0; i < std::min(more, spans.size()); ++i) {
    if (spans[i].middle > solver.domain().low) result.push_back(spans[i].middle);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Drops knots whose absence lowers the criterion, the least useful first.
ScoredKnots without_idle_knots(SplineSolver& solver, const BayesCriterion& criterion,
                               ScoredKnots best) {
  for (bool again = true; again;) {
    again = false;
    std::vector<std::pair<double, double>> costs;  // criterion without it, knot
    for (std::size_t i = 0; i < best.knots.size(); ++i) {
      Knots fewer = best.knots;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      costs.emplace_back(score(solver, criterion, fewer), best.knots[i]);
    }
    std::stable_sort(costs.begin(), costs.end());
    for (const auto& [cost, knot] : costs) {
      if (!(cost < best.bic)) break;
      Knots fewer = best.knots;
      fewer.erase(std::find(fewer.begin(), fewer.end(), knot));
      const double bic = score(solver, criterion, fewer);
      if (!(bic < best.bic)) continue;
      best = {fewer, bic};
      again = true;
    }
  }
  return best;
}

}  // namespace

ScoredKnots refined_knots(SplineSolver& solver, const BayesCriterion& criterion, bool thorough) {
  Knots knots;
  ScoredKnots best{knots, score(solver, criterion, knots)};
  ScoredKnots lean = best;
  std::size_t thinned_at = 16;
  const std::size_t most = solver.data_count() / (thorough ? 2 : 3);
  while (knots.size() < most && (thorough || knots.size() < 2 * best.knots.size() + 16)) {
    if (!solver.solve(knots)) break;
    Knots more = with_more_knots(solver, knots, 1 + knots.size() / 8);
    if (more.size() == knots.size()) break;
    knots = std::move(more);
    const double bic = score(solver, criterion, knots);
    if (bic < best.bic) best = {knots, bic};
    // Too many knots may pay once the idle ones are gone, though none of the few did.
    if (!thorough || knots.size() < thinned_at || knots.size() > 150 || !std::isfinite(bic))
      continue;
    thinned_at *= 2;
    const ScoredKnots thinned = without_idle_knots(solver, criterion, {knots, bic});
    if (thinned.bic < lean.bic) lean = thinned;
  }
  const ScoredKnots end = without_idle_knots(solver, criterion, best);
  return lean.bic < end.bic ? lean : end;
}

}  // namespace keyline::fit::detail
