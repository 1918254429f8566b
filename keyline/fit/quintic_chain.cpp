#include "keyline/fit/quintic_chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keyline/core/error.h"
#include "keyline/fit/chain_data.h"
#include "keyline/fit/quintic_powers.h"
#include "keyline/fit/quintic_solver.h"

namespace keyline::fit {
namespace {

using core::Point2;

constexpr double kNeedle = 158;          ///< variation of a spiral from straight on, once round
constexpr double kWorthPiece = 0.25;     ///< of it is left, or less, by a piece more
constexpr std::size_t kFewestKept = 24;  ///< points: fewer would hold back the number of pieces
constexpr int kFootRounds = 3;
constexpr int kEvenPieces = 4;  ///< up to here joints are laid evenly, then where they lack

/// A chain and how its curvature varies.
struct Tried {
  QuinticChain chain;
  std::vector<double> deviations;  ///< by piece
  double variation = 0;
};

Tried try_chain(const ChainData& data, bool closed, const std::vector<std::size_t>& at,
                const QuinticChainOptions& options) {
  QuinticSolver fit(data, closed, at, options);
  fit.run();
  Tried tried{fit.result(), fit.deviations(), 0};
  if (options.calm && tried.chain.within_tolerance) {
    fit.calm();
    tried.chain = fit.result();
    tried.variation = fit.variation();
  }
  return tried;
}

/// Pieces more, as long as they take most of the variation away: too few may follow the points by a
/// needle of curvature alone.
QuinticChain with_more_pieces(const ChainData& data, bool closed, Tried best, int most,
                              const QuinticChainOptions& options) {
  int pieces = static_cast<int>(best.chain.pieces.size());
  while (best.variation > kNeedle && pieces < std::min(most, kEvenPieces)) {
    Tried more = try_chain(data, closed, joint_indices(data, ++pieces), options);
    if (!more.chain.within_tolerance || more.variation > kWorthPiece * best.variation) break;
    best = std::move(more);
  }
  return std::move(best.chain);
}

QuinticChain follow_all(const std::vector<Point2>& points, bool closed,
                        const QuinticChainOptions& options) {
  const ChainData data = prepare_chain_data(points, closed);
  const int most =
      std::clamp(static_cast<int>(points.size()) / 3, closed ? 2 : 1, options.max_pieces);
  QuinticChain best;
  std::vector<std::size_t> at = joint_indices(data, closed ? 2 : 1);
  while (true) {
    const int pieces = static_cast<int>(at.size()) - 1;
    Tried tried = try_chain(data, closed, at, options);
    if (tried.chain.within_tolerance)
      return with_more_pieces(data, closed, std::move(tried), most, options);
    if (best.pieces.empty() || tried.chain.max_deviation < best.max_deviation)
      best = std::move(tried.chain);
    if (pieces >= most) return best;
    if (pieces < kEvenPieces) {
      at = joint_indices(data, pieces + 1);
    } else if (!split_worst(data, tried.deviations, options.tolerance, most, at)) {
      return best;
    }
  }
}

/// Distances of points from the chain that follows them, by feet that go on from point to point. A
/// foot that lost the nearest place makes a distance too long: the points are all followed then.
void measure(const std::vector<Point2>& points, bool closed, double tolerance,
             QuinticChain& chain) {
  std::vector<QuinticPowers> pieces;
  for (const curve::Bezier2& piece : chain.pieces) {
    QuinticHandles handles;
    std::ranges::copy(piece.control, handles.begin());
    pieces.emplace_back(handles);
  }
  QuinticFoot foot;
  double most = 0;
  double sum = 0;
  for (const Point2 p : points) {
    const core::Vector2 off = follow(pieces, closed, p, kFootRounds, foot).off;
    most = std::max(most, dot(off, off));
    sum += dot(off, off);
  }
  chain.max_deviation = std::sqrt(most);
  chain.rms_deviation = std::sqrt(sum / static_cast<double>(points.size()));
  chain.within_tolerance = chain.within_tolerance && chain.max_deviation <= tolerance;
}

/// One of so many points, in the mean of those about it: where it lies for itself is chance. Ends
/// of an open line stay.
std::vector<Point2> thinned(const std::vector<Point2>& points, bool closed, std::size_t every) {
  const std::size_t n = points.size();
  const std::size_t half = every / 2;
  std::vector<Point2> kept;
  if (!closed) kept.push_back(points.front());
  for (std::size_t i = closed ? 0 : every; i + (closed ? half : every) < n; i += every) {
    core::Vector2 sum{};
    for (std::size_t k = i + n - half; k <= i + n + half; ++k)
      sum = sum + (points[k % n] - points[i]);
    kept.push_back(points[i] + sum / static_cast<double>(2 * half + 1));
  }
  if (!closed) kept.push_back(points.back());
  return kept;
}

}  // namespace

QuinticChain fit_quintic_chain(const std::vector<Point2>& points, bool closed,
                               const QuinticChainOptions& options) {
  if (points.size() < 2) throw core::InvalidInput("fit_quintic_chain needs at least two points");
  const std::size_t every = std::max<std::size_t>(1, options.every);
  if (every > 1 && points.size() >= every * kFewestKept) {
    QuinticChain chain = follow_all(thinned(points, closed, every), closed, options);
    if (chain.within_tolerance) measure(points, closed, options.tolerance, chain);
    if (chain.within_tolerance) return chain;
  }
  return follow_all(points, closed, options);
}

}  // namespace keyline::fit
