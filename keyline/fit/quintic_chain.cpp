#include "keyline/fit/quintic_chain.h"

#include <algorithm>
#include <cstddef>

#include "keyline/core/error.h"
#include "keyline/fit/chain_data.h"
#include "keyline/fit/quintic_solver.h"

namespace keyline::fit {
namespace {

using core::Point2;

constexpr int kEvenPieces = 4;  ///< up to here joints are laid evenly, then where they lack

}  // namespace

QuinticChain fit_quintic_chain(const std::vector<Point2>& points, bool closed,
                               const QuinticChainOptions& options) {
  if (points.size() < 2) throw core::InvalidInput("fit_quintic_chain needs at least two points");
  const ChainData data = prepare_chain_data(points, closed);
  const int most =
      std::clamp(static_cast<int>(points.size()) / 3, closed ? 2 : 1, options.max_pieces);
  QuinticChain best;
  std::vector<std::size_t> at = joint_indices(data, closed ? 2 : 1);
  while (true) {
    const int pieces = static_cast<int>(at.size()) - 1;
    QuinticSolver fit(data, closed, at, options);
    fit.run();
    QuinticChain found = fit.result();
    if (options.calm && found.within_tolerance) {
      fit.calm();
      found = fit.result();
    }
    if (best.pieces.empty() || found.within_tolerance || found.max_deviation < best.max_deviation)
      best = std::move(found);
    if (best.within_tolerance || pieces >= most) return best;
    if (pieces < kEvenPieces) {
      at = joint_indices(data, pieces + 1);
    } else if (!split_worst(data, fit.deviations(), options.tolerance, most, at)) {
      return best;
    }
  }
}

}  // namespace keyline::fit
