#include "keyline/fairing/exact_chain.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/condense.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kExactness = 2e-7;  // of the length
constexpr double kRate = 5;     // power of the pieces' length with which approximation gets near
constexpr double kBetter = 10;  // times nearer than that is no approximation

/// A chain for free: one that follows any smooth curve of so few bends comes this near with
/// `pieces` pieces, where `coarse` tells how near a few came. One that was made of pieces beats it
/// by far.
double by_approximation(double coarse, std::size_t few, std::size_t pieces) {
  return coarse * std::pow(static_cast<double>(few) / static_cast<double>(pieces), kRate);
}

/// Full least squares without any pull; true where the chain then reproduces the points. `reached`
/// tells the largest distance, either way.
bool converges(ChainSearchResult& found, const std::vector<FitPoint>& points, double exact,
               double& reached) {
  ChainFitOptions fit;
  fit.fine = true;
  fit.iterations = 400;  // one ill placed joint takes 300
  fit.gradient_tolerance = 1e-6;
  fit.slope_prior = 0;
  fit.scale = std::max(exact, 1e-2 * found.fit.max_offset);
  fit.hopeless = 0;
  FitChain chain = found.chain;
  const ChainFitReport report = fit_chain(chain, points, fit);
  reached = report.max_offset;
  if (!(report.max_offset <= exact && report.max_gap <= 0.05 * exact)) return false;
  found.chain = std::move(chain);
  found.fit = report;
  found.weights.clear();
  for (const FitPoint& p : points) found.weights.push_back(p.weight);
  return true;
}

/// The chain's feet of points `taken` of n, those of the points between in even steps between.
std::vector<Foot> feet_of_all(const FitChain& chain, const std::vector<std::size_t>& taken,
                              std::size_t n) {
  std::vector<double> starts{0};
  for (const FitPiece& piece : chain.pieces) starts.push_back(starts.back() + piece.length);
  const double whole = starts.back();
  const auto along = [&](const Foot& f) {
    return starts[f.piece] + f.fraction * chain.pieces[f.piece].length;
  };
  std::vector<Foot> feet;
  for (std::size_t k = 0; k < taken.size(); ++k) {
    feet.push_back(chain.feet[k]);
    if (k + 1 == taken.size()) break;
    const double from = along(chain.feet[k]);
    double step = along(chain.feet[k + 1]) - from;
    if (chain.closed && step < 0) step += whole;
    for (std::size_t i = taken[k] + 1; i < taken[k + 1]; ++i) {
      const double share = double(i - taken[k]) / double(taken[k + 1] - taken[k]);
      const double s = std::fmod(from + share * step, whole);
      const auto piece = std::ranges::upper_bound(starts, s) - starts.begin() - 1;
      feet.push_back({int(piece), (s - starts[piece]) / chain.pieces[piece].length});
    }
  }
  feet.resize(n, chain.feet.back());
  return feet;
}

}  // namespace

std::vector<std::size_t> telling_points(const std::vector<FitPoint>& points) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / kTellingPoints);
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i % step == 0 || i + 1 == points.size() || points[i].must_pass) taken.push_back(i);
  return taken;
}

bool follows_all(ChainSearchResult& found, const std::vector<std::size_t>& taken,
                 const std::vector<FitPoint>& points, double exact) {
  if (taken.size() == points.size()) return true;
  found.chain.feet = feet_of_all(found.chain, taken, points.size());
  double reached = 0;
  return converges(found, points, exact, reached);
}

double exactness(const Acceptance& accept) { return std::max(kExactness, 6 * accept.noise); }

bool find_exact(ChainSearchResult& best, const std::vector<FitPoint>& points, bool closed,
                ChainSearchOptions search) {
  const double exact = exactness(search.accept);
  if (search.wanted_pieces > 0 || exact * 20 > search.accept.tolerance) return false;
  if (!best.within_tolerance || points.size() < 30) return false;
  if (best.chain.pieces.size() > kMostExactPieces) return false;
  const std::size_t most = 2 * best.chain.pieces.size() + 3;
  search.most_pieces = std::min<int>(96, static_cast<int>(points.size() / 4));
  search.start_pieces = std::min(48, search.most_pieces);
  search.spline_start = false;  // any points have one
  const double loose = search.accept.tolerance;
  const std::size_t few = best.chain.pieces.size();
  double coarse = 0;
  for (const double share : {1.0, 0.1, 0.01, 0.0}) {
    search.accept = {std::max(exact, share * loose), 0};
    const bool known = share == 1 && best.chain.feet.size() == points.size();
    ChainSearchResult found = known ? best : search_chain(cut_digits(points), closed, search);
    if (!found.within_tolerance || found.chain.pieces.size() > most) return false;
    double off = found.fit.max_offset;
    const bool reached = converges(found, points, exact, off) || share == 0;
    if (share == 1) coarse = off;
    if (!reached) continue;
    const std::size_t pieces = found.chain.pieces.size();
    if (pieces > few && !(kBetter * off <= by_approximation(coarse, few, pieces))) return false;
    best = std::move(found);
    return true;
  }
  return false;
}

}  // namespace keyline::fairing::detail
