#pragma once

#include <cmath>
#include <vector>

#include "keyline/core/point.h"

/// Least squares over a whole G2 chain of log-aesthetic pieces.
///
/// Unknowns are the joints' poses and curvatures beside the pieces' lengths and slopes; "piece i
/// ends where joint i+1 stands" are equality constraints between neighbours, so the problem is
/// that of optimal control and one Gauss-Newton step costs a Riccati sweep: linear in the number
/// of pieces. See docs/design/chain-fit.md.
namespace keyline::fairing {

/// A measured point, or the mean of a run of them with the run's spread about it along the left
/// normal of the key-line.
struct FitPoint {
  core::Point2 position;
  double weight = 1;
  double low = 0;             ///< <= 0: the run's lowest offset
  double high = 0;            ///< >= 0: the run's highest offset
  double count = 1;           ///< how many points the run holds; 0: a guide, not measured
  bool must_pass = false;     ///< its weight is never changed
  double share = 1;           ///< offsets from this point count this much; below 1 for guides
  double lowest = -HUGE_VAL;  ///< limits of its offset (times its share) beside the tolerance
  double highest = HUGE_VAL;
  double pull = 1;  ///< times as much as others its spring pulls
};

/// Slopes beyond this are not told apart from it by any data.
inline constexpr double kSteepestSlope = 12;

enum class PieceKind { curve, arc, line };

struct FitJoint {
  core::Point2 position;
  double direction = 0;
  double curvature = 0;
};

struct FitPiece {
  double length = 0;
  double alpha = -1;
  PieceKind kind = PieceKind::curve;
  double alpha_low = -kSteepestSlope;  ///< equal to alpha_high: the slope is held
  double alpha_high = kSteepestSlope;
};

inline bool slope_held(const FitPiece& piece) { return piece.alpha_low == piece.alpha_high; }
inline void hold_slope(FitPiece& piece, double alpha) {
  piece.alpha = piece.alpha_low = piece.alpha_high = alpha;
}

/// What is held at an end of an open chain.
enum class Hold { free, position, direction, curvature };

/// Where a point's foot lies: piece and fraction of its length.
struct Foot {
  int piece = 0;
  double fraction = 0;
};

/// A chain under construction: joints[i] stands before pieces[i]; one joint more than pieces.
/// Closed chains repeat the first joint at the end, its direction differing by `turning`.
struct FitChain {
  std::vector<FitJoint> joints;
  std::vector<FitPiece> pieces;
  std::vector<Foot> feet;  ///< one per point
  bool closed = false;
  double turning = 0;  ///< of the whole closed chain, a multiple of 2 pi
  Hold hold_start = Hold::free;
  Hold hold_end = Hold::free;
  bool first_at_start = false;  ///< the first point's foot is the start…
  bool last_at_end = false;     ///< …the last one's the end
};

struct ChainFitOptions {
  int iterations = 30;
  double gradient_tolerance = 1e-4;  ///< stop when an iteration lowers the cost by less (relative)
  double slope_prior = 1e-4;         ///< pull of slopes to -1 where the data say nothing
  double length_prior = 0;           ///< pull of all lengths to usual_length, in the same unit
  double usual_length = 1;
  double scale = 1e-3;      ///< offset that counts as one unit (the tolerance)
  bool fine = false;        ///< evaluate to the last digits
  bool close_gaps = false;  ///< only make ends meet, moving the rest as little as needed
  double hopeless = 0;      ///< give up early while max_offset stays above this; 0: never
};

struct ChainFitReport {
  bool converged = false;
  int iterations = 0;
  double cost = 0;        ///< weighted sum of squared offsets
  double max_offset = 0;  ///< largest distance of a point (its spread included)
  double max_gap = 0;     ///< largest distance between a piece's end and its joint
};

/// Improves the chain in place. All lengths should be of order one (total length 1).
/// Precondition: feet.size() == points.size(), pieces >= 1, joints == pieces + 1.
ChainFitReport fit_chain(FitChain& chain, const std::vector<FitPoint>& points,
                         const ChainFitOptions& options);

/// Signed distances of the points (times their share), positive to the left, feet as they stand;
/// beyond the ends of an open chain the distance from the end.
std::vector<double> offsets(const FitChain& chain, const std::vector<FitPoint>& points);

/// The same with everything to the last digits and the feet first moved home (`rounds` Newton
/// steps each, from where they stand).
std::vector<double> settle_feet(FitChain& chain, const std::vector<FitPoint>& points, int rounds);

}  // namespace keyline::fairing
