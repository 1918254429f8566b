#include "keyline/fit/knot_polish.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "keyline/fit/knot_positions.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fit::detail {
namespace {

using Knots = std::vector<double>;

constexpr double kGain = 1e-3;  // an improvement must be worth this much BIC

/// How hard each round tries: large data get by with less, as one fit costs more.
struct Effort {
  std::size_t all_variables;  // up to this many distinct knots are optimised together
  std::size_t neighbours;     // otherwise those this near to the change
  int iterations;             // of the optimiser, for a candidate
  int settling;               // and for the best of a round
  std::size_t merges;
  std::size_t exchanges;
};
constexpr Effort kSmallData{40, 4, 15, 30, 12, 6};
constexpr Effort kLargeData{6, 2, 5, 8, 6, 6};
constexpr std::size_t kSmall = 300;       // data times columns
constexpr std::size_t kPairPlaces = 40;   // 820 pairs: some milliseconds
constexpr std::size_t kMovedPlaces = 20;  // for each two neighbours put elsewhere, and of their
constexpr std::size_t kMovedPairs = 2;    // pairs so many are optimised

/// Places where a knot may be inserted: between data, at most 200.
Knots insertion_sites(const SplineSolver& solver) {
  const auto& x = solver.data().parameters;
  Knots all;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[i - 1]) all.push_back((x[i] + x[i - 1]) / 2);
  }
  const std::size_t most = 200;
  if (all.size() <= most) return all;
  Knots fewer;
  for (std::size_t i = 0; i < most; ++i) fewer.push_back(all[i * all.size() / most]);
  return fewer;
}

/// Groups i - 1 and i as one, at the mean place of their knots.
std::vector<KnotGroup> with_one(std::vector<KnotGroup> groups, std::size_t i) {
  const std::size_t together = groups[i - 1].multiplicity + groups[i].multiplicity;
  const double share = static_cast<double>(groups[i].multiplicity) / static_cast<double>(together);
  groups[i - 1] = {groups[i - 1].at + share * (groups[i].at - groups[i - 1].at), together};
  groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(i));
  return groups;
}

/// Whether no two data lie between groups i - 1 and i, and together they are no more than a kink.
bool hardly_differ(const std::vector<KnotGroup>& groups, std::size_t i,
                   const SplineSolver& solver) {
  const KnotGroup &a = groups[i - 1], &b = groups[i];
  const auto& x = solver.data().parameters;
  const auto between = std::ranges::upper_bound(x, b.at) - std::ranges::lower_bound(x, a.at);
  return between < 2 && a.multiplicity + b.multiplicity < static_cast<std::size_t>(solver.order());
}

class Polisher {
 public:
  Polisher(std::span<SplineSolver> solvers, const BayesCriterion& criterion,
           const core::Progress& progress, bool in_pairs)
      : solvers_(solvers),
        criterion_(criterion),
        progress_(progress),
        in_pairs_(in_pairs),
        effort_(is_small(solvers[0]) ? kSmallData : kLargeData),
        sites_(insertion_sites(solvers[0])) {}

  ScoredKnots run(const Knots& knots, int rounds) {
    ScoredKnots best{knots, score(knots, 0)};
    best = improved(best, settled(best.knots, effort_.settling));
    for (int round = 0; round < rounds && !progress_.stop_requested(); ++round) {
      const double before = best.bic;
      std::vector<Candidate> candidates;
      add_merges_and_splits(best.knots, candidates);
      add_exchanges(best.knots, candidates);
      best = improved(best, best_of(candidates));
      if (in_pairs_ && !(best.bic < before - kGain)) best = improved(best, paired(best.knots));
      if (!(best.bic < before - kGain)) break;
      if (effort_.all_variables > 10) best = improved(best, settled(best.knots, effort_.settling));
    }
    return improved(best, settled(best.knots, 3 * effort_.settling));
  }

  double score(const Knots& knots, int worker) {
    SplineSolver& solver = solvers_[static_cast<std::size_t>(worker)];
    return criterion_(solver.sum_near_data(knots), knots.size());
  }

 private:
  /// Knots to be optimised, about the place where they were changed.
  struct Candidate {
    Knots knots;
    double centre = 0;
  };

  struct Move {
    double bic = 0;
    std::ptrdiff_t removed = -1;  // index, or -1: none
    double inserted = 0;
    bool inserts = false;
  };

  static ScoredKnots improved(const ScoredKnots& best, const ScoredKnots& candidate) {
    return candidate.bic < best.bic ? candidate : best;
  }

  /// All positions optimised together.
  ScoredKnots settled(const Knots& knots, int iterations) {
    ScoredKnots start{knots, score(knots, 0)};
    if (!std::isfinite(start.bic)) return start;
    const auto groups = grouped(knots);
    const Knots moved =
        flattened(optimise_positions(solvers_, groups, 0, groups.size(), iterations));
    return improved(start, {moved, score(moved, 0)});
  }

  /// Positions near the centre optimised, all of them where they are few.
  ScoredKnots optimised(const Candidate& candidate, int worker) {
    ScoredKnots start{candidate.knots, score(candidate.knots, worker)};
    if (!std::isfinite(start.bic)) return start;
    const auto groups = grouped(candidate.knots);
    std::size_t first = 0;
    std::size_t last = groups.size();
    if (groups.size() > effort_.all_variables) {
      const auto near = static_cast<std::size_t>(
          std::lower_bound(groups.begin(), groups.end(), candidate.centre,
                           [](const KnotGroup& g, double t) { return g.at < t; }) -
          groups.begin());
      first = near > effort_.neighbours ? near - effort_.neighbours : 0;
      last = std::min(groups.size(), near + effort_.neighbours + 1);
    }
    const auto solver = solvers_.subspan(static_cast<std::size_t>(worker), 1);
    const Knots moved =
        flattened(optimise_positions(solver, groups, first, last, effort_.iterations));
    return improved(start, {moved, score(moved, worker)});
  }

  /// The best of the candidates after optimisation, the first of equals.
  ScoredKnots best_of(const std::vector<Candidate>& candidates) {
    std::vector<ScoredKnots> ends(candidates.size());
    for_all(candidates.size(), [&](std::size_t i, int worker) {
      ends[i] = {candidates[i].knots, std::numeric_limits<double>::infinity()};
      if (!progress_.stop_requested()) ends[i] = optimised(candidates[i], worker);
    });
    ScoredKnots best{{}, std::numeric_limits<double>::infinity()};
    for (const ScoredKnots& end : ends) best = improved(best, end);
    return best;
  }

  template <class Body>
  void for_all(std::size_t count, Body body) {
    numeric::parallel_for(count, static_cast<int>(solvers_.size()), body);
  }

  /// Near neighbours made one multiple knot, multiple knots made two.
  void add_merges_and_splits(const Knots& knots, std::vector<Candidate>& candidates) const {
    const auto order = static_cast<std::size_t>(solvers_[0].order());
    const auto groups = grouped(knots);
    std::vector<std::pair<double, std::size_t>> gaps;
    for (std::size_t i = 1; i < groups.size(); ++i) {
      if (groups[i - 1].multiplicity + groups[i].multiplicity > order) continue;
      gaps.emplace_back(groups[i].at - groups[i - 1].at, i);
    }
    std::sort(gaps.begin(), gaps.end());
    if (gaps.size() > effort_.merges) gaps.resize(effort_.merges);
    for (const auto& [_, i] : gaps) {
      const auto merged = with_one(groups, i);
      candidates.push_back({flattened(merged), merged[i - 1].at});
    }
    const double spacing =
        core::length(solvers_[0].domain()) / static_cast<double>(solvers_[0].data_count());
    std::size_t splits = 0;
    for (std::size_t i = 0; i < groups.size() && splits < effort_.merges; ++i) {
      if (groups[i].multiplicity < 2) continue;
      ++splits;
      auto split = groups;
      --split[i].multiplicity;
      split[i].at -= spacing / 4;
      split.insert(split.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                   {groups[i].at + spacing / 4, 1});
      candidates.push_back({flattened(split), groups[i].at});
    }
  }

  static Knots apply(const Knots& knots, const Move& move) {
    Knots result = knots;
    if (move.removed >= 0) result.erase(result.begin() + move.removed);
    if (move.inserts) {
      result.insert(std::upper_bound(result.begin(), result.end(), move.inserted), move.inserted);
    }
    return result;
  }

  /// The most promising removals, insertions and both at once.
  void add_exchanges(const Knots& knots, std::vector<Candidate>& candidates) {
    std::vector<Move> removals;
    Knots sites = sites_;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      if (i > 0 && knots[i] == knots[i - 1]) continue;
      removals.push_back({0, static_cast<std::ptrdiff_t>(i), 0, false});
      sites.push_back(knots[i]);
    }
    std::vector<Move> insertions;
    for (const double t : sites) insertions.push_back({0, -1, t, true});
    rank(knots, removals, 8);
    rank(knots, insertions, effort_.all_variables > 10 && knots.size() <= 12 ? sites.size() : 12);
    std::vector<Move> both;
    for (const Move& r : removals) {
      for (const Move& i : insertions) both.push_back({0, r.removed, i.inserted, true});
    }
    rank(knots, both, effort_.exchanges);
    if (removals.size() > 3) removals.resize(3);
    if (insertions.size() > 4) insertions.resize(4);
    for (const std::vector<Move>* moves : {&removals, &insertions, &both}) {
      for (const Move& m : *moves) {
        const double centre = m.inserts ? m.inserted : knots[static_cast<std::size_t>(m.removed)];
        candidates.push_back({apply(knots, m), centre});
      }
    }
  }

  /// Two knots inserted at once where one alone does not pay, or two neighbours put elsewhere: at
  /// any two of the better places, the most promising pairs of either kind optimised.
  ScoredKnots paired(const Knots& knots) {
    std::vector<Candidate> candidates;
    add_pairs(knots, kPairPlaces, 2 * effort_.merges, candidates);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      Knots others = knots;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i),
                   others.begin() + static_cast<std::ptrdiff_t>(i) + 2);
      add_pairs(others, kMovedPlaces, kMovedPairs, candidates);
    }
    return best_of(candidates);
  }

  /// The knots with two more, as the best `keep` of all pairs of the best places.
  void add_pairs(const Knots& knots, std::size_t best_places, std::size_t keep,
                 std::vector<Candidate>& candidates) {
    std::vector<Move> places;
    for (const double t : sites_) places.push_back({0, -1, t, true});
    for (const double t : knots) places.push_back({0, -1, t, true});
    rank(knots, places, best_places);
    std::vector<std::pair<double, Knots>> pairs;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = i; j < places.size(); ++j)
        pairs.emplace_back(0, apply(apply(knots, places[i]), places[j]));
    for_all(pairs.size(),
            [&](std::size_t i, int worker) { pairs[i].first = score(pairs[i].second, worker); });
    const std::size_t kept = std::min(pairs.size(), keep);
    std::partial_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept),
                      pairs.end());
    for (std::size_t i = 0; i < kept; ++i) candidates.push_back({pairs[i].second, 0});
  }

  /// Scores the moves and keeps the best `keep`, best first.
  void rank(const Knots& knots, std::vector<Move>& moves, std::size_t keep) {
    for_all(moves.size(), [&](std::size_t i, int worker) {
      moves[i].bic = score(apply(knots, moves[i]), worker);
    });
    std::stable_sort(moves.begin(), moves.end(),
                     [](const Move& a, const Move& b) { return a.bic < b.bic; });
    if (moves.size() > keep) moves.resize(keep);
  }

  std::span<SplineSolver> solvers_;
  const BayesCriterion& criterion_;
  const core::Progress& progress_;
  bool in_pairs_;
  Effort effort_;
  Knots sites_;  // where a knot may be inserted
};

}  // namespace

bool is_small(const SplineSolver& solver) {
  return solver.data_count() * solver.column_count() <= kSmall;
}

ScoredKnots polish_knots(std::span<SplineSolver> solvers, const BayesCriterion& criterion,
                         const std::vector<double>& knots, int rounds,
                         const core::Progress& progress, bool in_pairs) {
  return Polisher(solvers, criterion, progress, in_pairs).run(knots, rounds);
}

ScoredKnots united_knots(SplineSolver& solver, const BayesCriterion& criterion,
                         const ScoredKnots& found, double loss) {
  const auto score = [&](const Knots& knots) {
    return criterion(solver.sum_near_data(knots), knots.size());
  };
  auto groups = grouped(found.knots);
  for (std::size_t i = 1; i < groups.size();) {
    const bool near = hardly_differ(groups, i, solver);
    if (auto one = with_one(groups, i); near && score(flattened(one)) <= found.bic + loss)
      groups = std::move(one);
    else
      ++i;
  }
  const Knots knots = flattened(groups);
  return {knots, score(knots)};
}

}  // namespace keyline::fit::detail
