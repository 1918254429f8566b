#include "keyline/fairing/structure.h"

#include <cmath>
#include <optional>

#include "keyline/fairing/chain_edit.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kRounds = 6;        // changes of a joint, one after the other, unless none is better
constexpr double kSplitGain = 4;  // beyond the price of a joint: errors are not quite normal

struct Candidate {
  FitChain chain;
  double score = HUGE_VAL;
};

Candidate fitted(FitChain chain, const std::vector<FitPoint>& points,
                 const ChainSearchOptions& options) {
  ChainFitOptions fit;
  fit.iterations = 40;
  fit.scale = options.accept.tolerance;
  fit.hopeless = 6 * options.accept.tolerance;
  const ChainFitReport report = fit_chain(chain, points, fit);
  if (!accepts(options.accept, report, points, offsets(chain, points))) return {};
  const double score = structure_score(chain, points, options.accept.noise);
  return {std::move(chain), score};
}

std::vector<FitChain> changes_of(const FitChain& chain) {
  std::vector<FitChain> changes;
  const int n = static_cast<int>(chain.pieces.size());
  for (int joint = 1; joint < n; ++joint) changes.push_back(without_joint(chain, joint));
  for (int at = 0; at < n; ++at) {
    changes.push_back(with_joint(chain, at, 0.5));
    if (!chain.closed && at == 0) changes.push_back(with_joint(chain, at, 0.15));
    if (!chain.closed && at + 1 == n) changes.push_back(with_joint(chain, at, 0.85));
  }
  return changes;
}

}  // namespace

double structure_score(const FitChain& chain, const std::vector<FitPoint>& points, double noise) {
  const std::vector<double> off = offsets(chain, points);
  double sum = 0;
  double count = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (points[j].count == 0) continue;
    sum += points[j].weight * off[j] * off[j];
    count += points[j].count;
  }
  return sum / (noise * noise) + 3 * std::log(count) * static_cast<double>(chain.pieces.size());
}

bool improve_structure(FitChain& chain, const std::vector<FitPoint>& points,
                       const ChainSearchOptions& options) {
  Candidate best = fitted(chain, points, options);
  if (best.score == HUGE_VAL) return false;
  for (int round = 0; round < kRounds && !options.progress.stop_requested(); ++round) {
    const std::vector<FitChain> changes = changes_of(best.chain);
    std::vector<Candidate> tried(changes.size());
    numeric::parallel_for(changes.size(), options.threads, [&](std::size_t i) {
      if (!options.progress.stop_requested()) tried[i] = fitted(changes[i], points, options);
    });
    std::optional<std::size_t> found;
    double least = best.score;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      const bool more = tried[i].chain.pieces.size() > best.chain.pieces.size();
      const double score = tried[i].score + (more ? kSplitGain : 0);
      if (score >= least) continue;
      least = score;
      found = i;
    }
    if (!found) break;
    best = std::move(tried[*found]);
  }
  chain = std::move(best.chain);
  return true;
}

}  // namespace keyline::fairing::detail
