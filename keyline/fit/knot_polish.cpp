#include "keyline/fit/knot_polish.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::fit::detail {
namespace {

using Knots = std::vector<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGain = 1e-7;             // an improvement must be worth this much BIC
constexpr std::size_t kAllVariables = 40;  // up to this many distinct knots are moved together
constexpr std::size_t kNeighbours = 4;     // otherwise those this near to the change

/// A distinct knot and how often it is repeated.
struct Group {
  double at = 0;
  std::size_t multiplicity = 1;
};

std::vector<Group> grouped(const Knots& knots) {
  std::vector<Group> groups;
  for (const double t : knots) {
    if (!groups.empty() && groups.back().at == t) {
      ++groups.back().multiplicity;
    } else {
      groups.push_back({t, 1});
    }
  }
  return groups;
}

Knots flattened(const std::vector<Group>& groups) {
  Knots knots;
  for (const Group& g : groups) knots.insert(knots.end(), g.multiplicity, g.at);
  return knots;
}

class Polisher {
 public:
  Polisher(SplineSolver& solver, const BayesCriterion& criterion, const core::Progress& progress)
      : solver_(solver), criterion_(criterion), progress_(progress) {
    const auto& x = solver.data().parameters;
    sites_.push_back(solver.domain().low);
    for (std::size_t i = 1; i < x.size(); ++i) {
      if (x[i] > x[i - 1]) sites_.push_back((x[i] + x[i - 1]) / 2);
    }
    sites_.erase(sites_.begin());
    const std::size_t most = 200;
    if (sites_.size() > most) {
      Knots fewer;
      for (std::size_t i = 0; i < most; ++i) fewer.push_back(sites_[i * sites_.size() / most]);
      sites_ = fewer;
    }
  }

  ScoredKnots run(Knots knots, int rounds) {
    ScoredKnots best{knots, score(knots)};
    best = improved(best, refine(best.knots, 30, 0.5, true));
    for (int round = 0; round < rounds && !progress_.stop_requested(); ++round) {
      const double before = best.bic;
      best = improved(best, merge_or_split(best));
      best = improved(best, exchange(best));
      if (!(best.bic < before - kGain)) break;
      best = improved(best, refine(best.knots, 30, 0.5, true));
    }
    return improved(best, refine(best.knots, 100, 0.5, true));
  }

  double score(const Knots& knots) {
    return criterion_(solver_.sum_of_squares(knots), knots.size());
  }

 private:
  static ScoredKnots improved(const ScoredKnots& best, const ScoredKnots& candidate) {
    return candidate.bic < best.bic ? candidate : best;
  }

  /// Continuous optimisation of the distinct positions: all of them where there are few or
  /// `everywhere` is set, otherwise those next to `centre`.
  ScoredKnots refine(const Knots& knots, int iterations, double centre, bool everywhere) {
    ScoredKnots result{knots, score(knots)};
    if (knots.empty() || !std::isfinite(result.bic)) return result;
    std::vector<Group> groups = grouped(knots);
    const auto [first, last] = window(groups, centre, everywhere);
    Eigen::VectorXd x(static_cast<Eigen::Index>(last - first));
    for (std::size_t i = first; i < last; ++i) {
      x[static_cast<Eigen::Index>(i - first)] = groups[i].at;
    }
    numeric::LevenbergMarquardtOptions options;
    options.max_iterations = iterations;
    options.step_tolerance = 1e-9;
    options.cost_tolerance = 1e-9;
    const auto function = [&, f = first, l = last](const Eigen::VectorXd& at,
                                                   Eigen::VectorXd& residuals,
                                                   Eigen::MatrixXd* jacobian) {
      return linearise(groups, f, l, at, residuals, jacobian);
    };
    numeric::minimize_least_squares(function, x, options);
    for (std::size_t i = first; i < last; ++i) {
      groups[i].at = x[static_cast<Eigen::Index>(i - first)];
    }
    const Knots moved = flattened(groups);
    return improved(result, {moved, score(moved)});
  }

  static std::pair<std::size_t, std::size_t> window(const std::vector<Group>& groups, double centre,
                                                    bool everywhere) {
    if (everywhere || groups.size() <= kAllVariables) return {0, groups.size()};
    const auto near = static_cast<std::size_t>(
        std::lower_bound(groups.begin(), groups.end(), centre,
                         [](const Group& g, double t) { return g.at < t; }) -
        groups.begin());
    return {near > kNeighbours ? near - kNeighbours : 0,
            std::min(groups.size(), near + kNeighbours + 1)};
  }

  /// Residuals at the positions, and their forward differences by each position.
  bool linearise(const std::vector<Group>& groups, std::size_t first, std::size_t last,
                 const Eigen::VectorXd& at, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
    std::vector<Group> moved = groups;
    for (std::size_t i = first; i < last; ++i) {
      moved[i].at = at[static_cast<Eigen::Index>(i - first)];
    }
    for (std::size_t i = 1; i < moved.size(); ++i) {
      if (!(moved[i].at > moved[i - 1].at)) return false;
    }
    const auto size = static_cast<Eigen::Index>(solver_.data_count() * solver_.column_count());
    residuals.resize(size);
    if (!solver_.solve(flattened(moved))) return false;
    solver_.residuals({residuals.data(), static_cast<std::size_t>(size)});
    if (jacobian == nullptr) return true;
    jacobian->setZero(size, at.size());
    Eigen::VectorXd shifted(size);
    for (std::size_t i = first; i < last; ++i) {
      const double t = moved[i].at;
      const double next = i + 1 < moved.size() ? moved[i + 1].at : solver_.domain().high;
      const double step = std::min(1e-6, 0.25 * (next - t));
      moved[i].at = t + step;
      if (solver_.solve(flattened(moved))) {
        solver_.residuals({shifted.data(), static_cast<std::size_t>(size)});
        jacobian->col(static_cast<Eigen::Index>(i - first)) =
            (shifted - residuals) / (moved[i].at - t);
      }
      moved[i].at = t;
    }
    return true;
  }

  /// The best of: two neighbouring knots made one multiple knot, one multiple knot made two.
  ScoredKnots merge_or_split(const ScoredKnots& start) {
    ScoredKnots best = start;
    const std::vector<Group> groups = grouped(start.knots);
    std::vector<std::pair<double, std::size_t>> gaps;
    for (std::size_t i = 1; i < groups.size(); ++i) {
      gaps.emplace_back(groups[i].at - groups[i - 1].at, i);
    }
    std::sort(gaps.begin(), gaps.end());
    if (gaps.size() > 12) gaps.resize(12);
    for (const auto& [gap, i] : gaps) {
      std::vector<Group> merged = groups;
      const Group& a = groups[i - 1];
      const Group& b = groups[i];
      const std::size_t together = a.multiplicity + b.multiplicity;
      if (together > static_cast<std::size_t>(solver_.order())) continue;
      const double share = static_cast<double>(b.multiplicity) / static_cast<double>(together);
      merged[i - 1] = {a.at + share * (b.at - a.at), together};
      merged.erase(merged.begin() + static_cast<std::ptrdiff_t>(i));
      best = improved(best, refine(flattened(merged), 15, merged[i - 1].at, false));
      if (progress_.stop_requested()) return best;
    }
    const double spacing =
        core::length(solver_.domain()) / static_cast<double>(solver_.data_count());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i].multiplicity < 2) continue;
      std::vector<Group> split = groups;
      --split[i].multiplicity;
      split[i].at -= spacing / 4;
      split.insert(split.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                   {groups[i].at + spacing / 4, 1});
      best = improved(best, refine(flattened(split), 15, groups[i].at, false));
    }
    return best;
  }

  struct Move {
    double bic = kInfinity;
    std::ptrdiff_t removed = -1;  // index or -1
    double inserted = 0;
    bool inserts = false;
  };

  static Knots apply(const Knots& knots, const Move& move) {
    Knots result = knots;
    if (move.removed >= 0) result.erase(result.begin() + move.removed);
    if (move.inserts) {
      result.insert(std::upper_bound(result.begin(), result.end(), move.inserted), move.inserted);
    }
    return result;
  }

  /// Removals, insertions and both at once; the most promising are optimised.
  ScoredKnots exchange(const ScoredKnots& start) {
    const Knots& knots = start.knots;
    std::vector<Move> removals;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      if (i > 0 && knots[i] == knots[i - 1]) continue;
      removals.push_back({0, static_cast<std::ptrdiff_t>(i), 0, false});
    }
    Knots sites = sites_;
    for (const Group& g : grouped(knots)) sites.push_back(g.at);
    std::vector<Move> insertions;
    for (const double t : sites) insertions.push_back({0, -1, t, true});
    rank(knots, removals, 8);
    rank(knots, insertions, knots.size() <= 12 ? sites.size() : 16);
    std::vector<Move> both;
    for (const Move& r : removals) {
      for (const Move& i : insertions) both.push_back({0, r.removed, i.inserted, true});
    }
    rank(knots, both, 6);
    if (removals.size() > 3) removals.resize(3);
    if (insertions.size() > 4) insertions.resize(4);
    ScoredKnots best = start;
    for (const std::vector<Move>* moves : {&removals, &insertions, &both}) {
      for (const Move& move : *moves) {
        if (progress_.stop_requested()) return best;
        const double centre =
            move.inserts ? move.inserted : knots[static_cast<std::size_t>(move.removed)];
        best = improved(best, refine(apply(knots, move), 15, centre, false));
      }
    }
    return best;
  }

  /// Scores the moves and keeps the best `keep`, best first.
  void rank(const Knots& knots, std::vector<Move>& moves, std::size_t keep) {
    for (Move& move : moves) move.bic = score(apply(knots, move));
    std::stable_sort(moves.begin(), moves.end(),
                     [](const Move& a, const Move& b) { return a.bic < b.bic; });
    if (moves.size() > keep) moves.resize(keep);
  }

  SplineSolver& solver_;
  const BayesCriterion& criterion_;
  const core::Progress& progress_;
  Knots sites_;  // where a knot may be inserted
};

/// Spans of largest squared residual get a knot at the middle of their data.
Knots with_more_knots(const SplineSolver& solver, const Knots& knots, std::size_t more) {
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
ScoredKnots without_idle_knots(Polisher& polisher, ScoredKnots best) {
  for (bool again = true; again;) {
    again = false;
    std::vector<std::pair<double, double>> costs;  // criterion without it, knot
    for (std::size_t i = 0; i < best.knots.size(); ++i) {
      Knots fewer = best.knots;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      costs.emplace_back(polisher.score(fewer), best.knots[i]);
    }
    std::stable_sort(costs.begin(), costs.end());
    for (const auto& [cost, knot] : costs) {
      if (!(cost < best.bic)) break;
      Knots fewer = best.knots;
      fewer.erase(std::find(fewer.begin(), fewer.end(), knot));
      const double bic = polisher.score(fewer);
      if (!(bic < best.bic)) continue;
      best = {fewer, bic};
      again = true;
    }
  }
  return best;
}

}  // namespace

ScoredKnots polish_knots(SplineSolver& solver, const BayesCriterion& criterion,
                         std::vector<double> knots, int rounds, const core::Progress& progress) {
  return Polisher(solver, criterion, progress).run(std::move(knots), rounds);
}

ScoredKnots refined_knots(SplineSolver& solver, const BayesCriterion& criterion) {
  const core::Progress silent;
  Polisher polisher(solver, criterion, silent);
  Knots knots;
  ScoredKnots best{knots, polisher.score(knots)};
  const std::size_t most = solver.data_count() / 3;
  while (knots.size() < most && knots.size() < 2 * best.knots.size() + 16) {
    if (!solver.solve(knots)) break;
    Knots more = with_more_knots(solver, knots, 1 + knots.size() / 8);
    if (more.size() == knots.size()) break;
    knots = std::move(more);
    const double bic = polisher.score(knots);
    if (bic < best.bic) best = {knots, bic};
  }
  return without_idle_knots(polisher, best);
}

}  // namespace keyline::fit::detail
