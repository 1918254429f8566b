#pragma once

#include <optional>
#include <vector>

#include "keyline/core/half_plane.h"
#include "keyline/core/interval.h"
#include "keyline/core/similarity.h"
#include "keyline/fairing/calm.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/fairing/dense_curve.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/half_line.h"
#include "keyline/fairing/members.h"
#include "keyline/lac/chain/chain.h"

/// One smooth stretch of a key-line between corners.
namespace keyline::fairing::detail {

struct Run {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);  ///< no point of the key-line

  std::vector<core::Point2> points;
  std::vector<double> weights;         ///< empty or one per point
  std::vector<std::size_t> index;      ///< of each point in the key-line, or none
  std::vector<std::size_t> must_pass;  ///< into points
  bool closed = false;
  Clamp clamp_start = Clamp::none;
  Clamp clamp_end = Clamp::none;
  std::optional<core::Point2> tie_start;  ///< where the chain must start: a corner shared
  std::optional<core::Point2> tie_end;
  double length = 0;
  std::optional<core::Pose2> axis;  ///< of a half (see half_line.h), and how its ends stand to it
  HalfEnd start_on_axis = HalfEnd::free;
  HalfEnd end_on_axis = HalfEnd::free;
  Members members;  ///< measured points that the run's are means of; empty: its own
  std::vector<core::HalfPlane> inside;  ///< that the chain stays in…
  std::vector<double> margin = {};      ///< …and how much farther; empty: none
};

class FoundBefore;

struct RunOptions {
  double tolerance = 0;  ///< in the points' unit
  double noise = 0;
  int pieces = 0;
  Criterion criterion = Criterion::least_variation;
  double smoothness = 0.5;             ///< see FairOptions
  std::optional<int> waves;            ///< at most, see FairOptions
  std::optional<double> max_rate;      ///< of curvature along the chain, in the points' unit
  core::Interval slopes{-3, 3};        ///< of the calmest chain's pieces
  JointOrder joints = JointOrder::g2;  ///< see FairOptions
  FoundBefore* before = nullptr;       ///< with other smoothnesses, see shortest_run.h
  int threads = 0;
  core::Progress progress;
};

/// What a piece is asked to be.
struct PieceWish {
  int piece = 0;
  std::optional<PieceKind> kind;
  double alpha_low = -kSteepestSlope;
  double alpha_high = kSteepestSlope;
  bool compound = false;    ///< two slopes of opposite sign…
  bool plus_first = false;  ///< …plus first along growing radius
};

/// The solved run: the chain in the points' frame, and the same under construction.
struct RunResult {
  lac::Chain chain;
  FitChain fit;
  std::vector<FitPoint> points;  ///< canonical, condensed, weighted as last fitted
  core::Similarity2 to_canonical;
  bool reversed = false;              ///< the canonical frame runs the other way
  std::size_t most_points = 0;        ///< that were fitted at most: more are taken as means
  std::vector<std::size_t> point_of;  ///< of each point of the run: which of `points` holds it
  Acceptance accept;
  bool within_tolerance = false;
  bool exact = false;        ///< reproduces the points to rounding
  bool calm_missed = false;  ///< no calmest chain was found within the tolerance: the shortest one
  bool missed = false;       ///< neither that nor the shortest one was found within it
  bool joined = false;       ///< solved again for joints of one rate, in the tolerance alone
  int start_pieces = 0;
  int straightened = 0;  ///< pieces that became lines or arcs
  WavesLeft waves;       ///< in the calmest curve
  double spring = 0;  ///< of the calmest curve, see BandOptions; 0: smoothness counts for nothing
  DenseCurve dense;   ///< the same as it was solved for; empty where another way was taken
};

/// Whether the chain turns more than the run's points can tell, half a circle from one to the next:
/// what came of a solution that ran away, and no answer.
bool winds(const RunResult& result, const Run& run);

/// The shortest chain within the tolerance, solved in a frame of the run's own (size 1, direction
/// of travel by the shape), polished and laid out as one exact forward chain.
RunResult fair_run(const Run& run, const curve::BSpline2& spline, const RunOptions& options);

/// The run once more with its ends tied (tie_start, tie_end of the run): the chain found before is
/// moved there where the points still pass; else the search starts anew. `moved`: the calmest chain
/// there already (see solve_again), where that is what was found.
void tie_ends(RunResult& result, const RunResult* moved, const Run& run,
              const curve::BSpline2& spline, const RunOptions& options);

/// Solves again with some pieces told what to be; indices count along the result's chain.
/// Wishes that an inflection or a straight neighbour forbids are not followed; `notes` says so.
/// Returns the pieces that are as asked, counted in the new chain: a compound rhythm is two.
std::vector<int> apply_wishes(RunResult& result, const Run& run, std::vector<PieceWish> wishes,
                              const RunOptions& options, std::vector<std::string>& notes);

/// Where every point of the run stands beside the chain.
struct PointPlace {
  double offset = 0;    ///< signed distance, positive left of the chain
  int piece = 0;        ///< of the chain as laid out…
  double fraction = 0;  ///< …and of its length
};
std::vector<PointPlace> place_points(const RunResult& result, const Run& run);

}  // namespace keyline::fairing::detail
