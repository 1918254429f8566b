#include "keyline/fit/curvature_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/curve/chain_deviation.h"
#include "keyline/curve/jet.h"
#include "keyline/curve/monotone.h"
#include "keyline/fit/chain_displacement.h"
#include "keyline/fit/control_edges.h"
#include "keyline/fit/drive_targets.h"
#include "keyline/fit/standard_way.h"
#include "keyline/numeric/halving.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::fit {
namespace {

using core::ErrorCode;
using core::Result;
using curve::Bezier2;
using curve::PiecewiseBezier;
using detail::LocalTarget;

Result<PiecewiseBezier> as_quintics(const PiecewiseBezier& chain) {
  if (chain.pieces.empty())
    return core::fail(ErrorCode::bad_input, "the chain has no piece", "give a quintic path",
                      "curve");
  PiecewiseBezier out;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const Bezier2& piece = chain.pieces[i];
    const std::string where = "curve.curves[" + std::to_string(i) + "]";
    if (auto ok = validate(piece); !ok)
      return core::fail(ErrorCode::bad_input, ok.error().message, {}, where);
    if (is_rational(piece) || curve::degree(piece) > 5)
      return core::fail(ErrorCode::bad_input, "a piece is no polynomial of degree 5 or less",
                        "approximate it by quintics first", where);
    out.pieces.push_back(elevate_degree(piece, 5 - curve::degree(piece)));
    const double size = core::distance(piece.control.front(), piece.control.back());
    if (i > 0 &&
        core::distance(out.pieces[i - 1].control[5], out.pieces[i].control[0]) > 1e-6 * size)
      return core::fail(ErrorCode::bad_input, "a piece does not start where the last one ends",
                        "give a path without gaps", where);
  }
  return out;
}

double rms_error(const PiecewiseBezier& chain, const std::vector<LocalTarget>& targets) {
  double sum = 0;
  for (const LocalTarget& t : targets) {
    const double d = curvature(jet(chain.pieces[t.piece], t.u)) - t.curvature;
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(targets.size()));
}

struct Solution {
  PiecewiseBezier chain;
  numeric::LevenbergMarquardtReport report;
  double moved = 0;    ///< bound of the distance from the start, see moved_bound
  double stretch = 0;  ///< of the length that changed most: |ln| of its factor
  bool held = false;   ///< lengths had to be held near the start for it
};

/// Everything the search for the lengths starts from.
struct Problem {
  const PiecewiseBezier& chain;
  std::vector<Edges> edges;
  FreeLengths lengths;
  ChainDisplacement displacement;
  int iterations = 100;
  double max_deviation = 0;  ///< 0: any
  curve::ChainEnds ends = curve::ChainEnds::matched;
};

/// Bound of the distance between the start and a chain; what a free end has moved along the curve
/// does not count. As sharp as `wanted` asks.
double moved_bound(const Problem& problem, const PiecewiseBezier& chain, double wanted) {
  return curve::deviation_bound(chain, problem.chain, wanted, problem.ends);
}

/// Root of the weight of a length's own change (of its logarithm) to that of distance.
constexpr double kEvenness = 0.1;

/// ln of the factor by which a length may grow or shrink. Where no lengths meet the targets the
/// least squares may be an infimum only, at a length of 0 or none. A first edge of length a gives
/// an end 0.8 h / a^2 of curvature, h the height of the third control point over it: rounding eps
/// of a curve of size L tells there as eps (L / a)^3 / L, 1e-9 of 1 / L for a hundredth.
const double kMostStretch = std::log(100);

/// Residuals of Eq. 14, and with `weight` > 0 of the way every place moved, in largest deviations
/// (where there is one), and of the lengths' own changes.
class Residuals {
 public:
  Residuals(const Problem& problem, const std::vector<LocalTarget>& targets, double weight)
      : problem_(problem), targets_(targets), now_(problem.edges), weight_(weight) {
    for (const LocalTarget& t : targets) scale_ = std::max(scale_, std::abs(t.curvature));
    if (!(scale_ > 0)) scale_ = 1;
  }

  bool operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
    if (!problem_.lengths.expand(x, a_, jacobian ? &by_x_ : nullptr)) return false;
    for (Eigen::Index k = 0; k < a_.size(); ++k)
      now_[static_cast<std::size_t>(k) / kEdges].length[static_cast<std::size_t>(k) % kEdges] =
          a_[k];
    const auto count = static_cast<Eigen::Index>(targets_.size());
    const bool near = weight_ > 0 && problem_.max_deviation > 0;
    const Eigen::Index places = near ? problem_.displacement.by_length().rows() : 0;
    const Eigen::Index all = count + places + (weight_ > 0 ? a_.size() : 0);
    residuals.resize(all);
    if (jacobian) rows_.setZero(all, problem_.lengths.size());
    add_curvatures(residuals, jacobian != nullptr);
    if (weight_ > 0) add_distances(count, places, residuals, jacobian != nullptr);
    if (jacobian) *jacobian = rows_;
    return residuals.allFinite();
  }

 private:
  void add_curvatures(Eigen::VectorXd& residuals, bool derivatives) {
    std::array<double, kEdges> gradient{};
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const LocalTarget& t = targets_[i];
      const double kappa =
          curvature_with_gradient(now_[t.piece], t.u, derivatives ? &gradient : nullptr);
      const auto row = static_cast<Eigen::Index>(i);
      residuals[row] = (kappa - t.curvature) / scale_;
      for (std::size_t n = 0; derivatives && n < kEdges; ++n)
        rows_.row(row) +=
            (gradient[n] / scale_) * by_x_.row(static_cast<Eigen::Index>(kEdges * t.piece + n));
    }
  }

  void add_distances(Eigen::Index first, Eigen::Index places, Eigen::VectorXd& residuals,
                     bool derivatives) {
    const double evenness = weight_ * kEvenness;
    const ChainDisplacement& moved = problem_.displacement;
    residuals.tail(a_.size()) = evenness * (a_.array() / moved.start().array()).log();
    if (derivatives)
      rows_.bottomRows(a_.size()) = evenness * (a_.cwiseInverse().asDiagonal() * by_x_);
    if (places == 0) return;
    const double nearness = weight_ / problem_.max_deviation;
    residuals.segment(first, places) = nearness * moved(a_);
    if (derivatives)
      rows_.middleRows(first, places).noalias() = nearness * (moved.by_length() * by_x_);
  }

  const Problem& problem_;
  const std::vector<LocalTarget>& targets_;
  std::vector<Edges> now_;
  double weight_ = 0;
  double scale_ = 0;
  Eigen::VectorXd a_;
  RowMatrix by_x_;
  RowMatrix rows_;
};

Solution solve_weighted(const Problem& problem, const std::vector<LocalTarget>& targets,
                        double weight) {
  Eigen::VectorXd x = problem.lengths.unknowns();
  numeric::LevenbergMarquardtOptions options;
  options.max_iterations = problem.iterations;
  Solution solution;
  solution.report =
      numeric::minimize_least_squares(Residuals(problem, targets, weight), x, options);
  Eigen::VectorXd a;
  problem.lengths.expand(x, a, nullptr);
  solution.chain = chain_of(problem.chain.pieces.front().control.front(), problem.edges, a);
  solution.stretch = (a.array() / problem.displacement.start().array()).log().abs().maxCoeff();
  solution.held = weight > 0 && problem.max_deviation <= 0;
  if (!(solution.stretch <= kMostStretch)) return solution;  // no answer: its place is no matter
  const double about = problem.displacement(a).lpNorm<Eigen::Infinity>();
  solution.moved = moved_bound(problem, solution.chain,
                               problem.max_deviation > 0 ? problem.max_deviation : about);
  return solution;
}

/// Largest curvature, ends of pieces included.
double sharpest(const PiecewiseBezier& chain) {
  constexpr int kSteps = 64;
  double most = 0;
  for (const Bezier2& piece : chain.pieces)
    for (int i = 0; i <= kSteps; ++i)
      most = std::max(most, std::abs(curvature(jet(piece, static_cast<double>(i) / kSteps))));
  return most;
}

/// The lengths that meet the targets best; where some would run away, the least weight of all
/// lengths' own changes that keeps them, by powers of ten.
Solution solve_freely(const Problem& problem, const std::vector<LocalTarget>& targets) {
  Solution found = solve_weighted(problem, targets, 0);
  for (double weight = 1e-6; !(found.stretch <= kMostStretch) && weight < 1e3; weight *= 10)
    found = solve_weighted(problem, targets, weight);
  return found.stretch <= kMostStretch ? found : Solution{problem.chain, {}, 0, 0, true};
}

/// The lengths that meet the targets best; with a largest deviation, best of those that neither
/// take the curve farther nor leave a spike between targets: the least weight of nearness that
/// does, by halving of its logarithm.
Solution solve(const Problem& problem, const std::vector<LocalTarget>& targets) {
  if (problem.max_deviation <= 0) return solve_freely(problem, targets);
  constexpr double kSpike = 1.2;
  constexpr double kNearest = 2, kFreest = -3;  // logarithms of the weight
  constexpr int kHalvings = 5;
  double bend = sharpest(problem.chain);
  for (const LocalTarget& t : targets) bend = std::max(bend, std::abs(t.curvature));
  Solution best{problem.chain, {}};
  const auto serves = [&](double log_weight) {
    Solution found = solve_weighted(problem, targets, std::pow(10, log_weight));
    const bool good = found.stretch <= kMostStretch && found.moved <= problem.max_deviation &&
                      sharpest(found.chain) <= kSpike * bend;
    if (good) best = std::move(found);
    return good;
  };
  numeric::last_that_holds(serves, kNearest, kFreest, kHalvings);
  return best;
}

bool stays_monotone(const PiecewiseBezier& before, const PiecewiseBezier& after) {
  for (std::size_t i = 0; i < before.pieces.size(); ++i)
    if (certify_monotone_curvature(before.pieces[i]).answer == curve::MonotoneVerdict::yes &&
        certify_monotone_curvature(after.pieces[i]).answer != curve::MonotoneVerdict::yes)
      return false;
  return true;
}

/// The longest part of the way to the target on which monotone pieces stay monotone.
Solution keep_monotone(const Problem& problem, const std::vector<LocalTarget>& targets,
                       double& share) {
  constexpr int kHalvings = 9;
  Solution best{problem.chain, {}};
  const auto stays = [&](double way) {
    std::vector<LocalTarget> part = targets;
    for (LocalTarget& t : part) {
      const double now = curvature(jet(problem.chain.pieces[t.piece], t.u));
      t.curvature = now + way * (t.curvature - now);
    }
    Solution found = solve(problem, part);
    const bool monotone = stays_monotone(problem.chain, found.chain);
    if (monotone) best = std::move(found);
    return monotone;
  };
  share = stays(1) ? 1 : numeric::last_that_holds(stays, 0, 1, kHalvings);
  return best;
}

/// Of the control polygons, from each edge to the next; exactly the opposite in a mirror.
double turning(const PiecewiseBezier& chain) {
  double sum = 0;
  for (const Bezier2& piece : chain.pieces)
    for (std::size_t i = 2; i < piece.control.size(); ++i)
      sum += core::angle_between(piece.control[i - 1] - piece.control[i - 2],
                                 piece.control[i] - piece.control[i - 1]);
  return sum;
}

PiecewiseBezier mirrored(PiecewiseBezier chain) {
  for (Bezier2& piece : chain.pieces)
    for (core::Point2& p : piece.control) p.y = -p.y;
  return chain;
}

std::vector<CurvatureTarget> mirrored(std::vector<CurvatureTarget> targets) {
  for (CurvatureTarget& t : targets) t.curvature = -t.curvature;
  return targets;
}

/// What came of it: errors before and after, how far the end went, and notes.
void tell(const Problem& problem, const std::vector<LocalTarget>& targets, Solution solution,
          CurvatureDrive& result) {
  const PiecewiseBezier& chain = problem.chain;
  result.before = rms_error(chain, targets);
  result.after = rms_error(solution.chain, targets);
  result.end_moved = core::distance(solution.chain.pieces.back().control.back(),
                                    chain.pieces.back().control.back());
  result.iterations = solution.report.iterations;
  result.converged = solution.report.status == numeric::LevenbergMarquardtStatus::converged;
  result.moved = solution.moved;
  result.target = detail::over_all(targets, chain.pieces.size());
  result.chain = std::move(solution.chain);
  if (solution.held)
    result.notes.push_back(
        "control edges were held between a hundredth and a hundredfold of their lengths: the "
        "target is met best by none that are");
  if (result.share < 1)
    result.notes.push_back("stopped before the target: monotone pieces would not stay monotone");
}

Result<CurvatureDrive> drive(const PiecewiseBezier& given, std::vector<CurvatureTarget> wanted,
                             const CurvatureDriveOptions& options) {
  const auto quintics = as_quintics(given);
  if (!quintics) return std::unexpected(quintics.error());
  auto targets = detail::local_targets(std::move(wanted), quintics->pieces.size());
  if (!targets) return std::unexpected(targets.error());
  CurvatureDrive result;
  int splits = 0;
  const PiecewiseBezier chain = detail::split_pieces(*quintics, *targets, splits);
  if (splits > 0)
    result.notes.push_back("split at " +
                           core::counted(static_cast<std::size_t>(splits), "inflection") +
                           " inside pieces");
  const auto edges = edges_of(chain);
  if (!edges) return std::unexpected(edges.error());
  const Problem problem{
      chain,
      *edges,
      FreeLengths(*edges, {.closed = options.closed,
                           .end = options.hold_end,
                           .outermost = options.hold_curvature && !options.closed}),
      ChainDisplacement(chain, *edges),
      options.max_iterations,
      options.max_deviation,
      options.closed || options.hold_end ? curve::ChainEnds::matched : curve::ChainEnds::trimmed};
  if (!problem.lengths.can_hold())
    return core::fail(ErrorCode::undrawable, "the end cannot be held: all free edges are parallel",
                      "let the end move", "hold_end");
  Solution solution = options.keep_monotone ? keep_monotone(problem, *targets, result.share)
                                            : solve(problem, *targets);
  tell(problem, *targets, std::move(solution), result);
  return result;
}

Result<CurvatureDrive> drive_to_the_left(const PiecewiseBezier& given,
                                         std::vector<CurvatureTarget> wanted,
                                         const CurvatureDriveOptions& options) {
  if (!(turning(given) < 0)) return drive(given, std::move(wanted), options);
  auto result = drive(mirrored(given), mirrored(std::move(wanted)), options);
  if (!result) return result;
  result->chain = mirrored(std::move(result->chain));
  result->target = mirrored(std::move(result->target));
  return result;
}

}  // namespace

Result<CurvatureDrive> drive_curvature(const PiecewiseBezier& given,
                                       std::vector<CurvatureTarget> wanted,
                                       const CurvatureDriveOptions& options) {
  // Which steps are taken can hang on rounding, as where a certificate stands on its edge, and on
  // which lengths a joint gives up: so that a mirror's and the way back's are the same, chains that
  // turn right on the whole are driven in the mirror, those whose ends stay in the standard way.
  const bool ends_stay = options.closed || options.hold_end;
  if (ends_stay && detail::goes_back(given)) {
    using detail::on_the_way_back;
    auto result = drive_to_the_left(on_the_way_back(given), on_the_way_back(wanted), options);
    if (result) {  // else the places its reason names are to be those given
      result->chain = on_the_way_back(std::move(result->chain));
      result->target = on_the_way_back(std::move(result->target));
      return result;
    }
  }
  return drive_to_the_left(given, std::move(wanted), options);
}

}  // namespace keyline::fit
