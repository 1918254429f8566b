#include "keyline/fairing/free_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/lac/chain/extend.h"
#include "keyline/numeric/solve.h"

namespace keyline::fairing::detail {
namespace {

// That tell an end: two to three times better than its last point alone. At most an eighth of the
// points: runs of fewer than 96 keep their ends.
constexpr std::size_t kMostPoints = 24;
constexpr std::size_t kLeastPoints = 12;
constexpr double kEven = 1.4;    // residual of evenly spaced points, in noise
constexpr double kBend = 2.5;    // a parabola only where it is this many of its errors from a line
constexpr double kFarthest = 2;  // an end is moved by no more than this, in noise

/// Polynomial through equidistant values: value at the first, and how far the values are off it.
struct Progress {
  double first = 0;
  double spread = 0;
  double bend = 0;  // last coefficient over its standard error
};

Progress fit_progress(const Eigen::VectorXd& values, int degree) {
  const Eigen::Index n = values.size();
  Eigen::MatrixXd rows(n, degree + 1);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k <= degree; ++k) rows(i, k) = std::pow(double(i) / double(n), k);
  const Eigen::VectorXd c = numeric::least_squares(rows, values);
  const double square = (rows * c - values).squaredNorm();
  const double spread = std::sqrt(square / static_cast<double>(n - degree - 1));
  const Eigen::VectorXd last = Eigen::VectorXd::Unit(degree + 1, degree);
  const double error =
      spread * std::sqrt(numeric::solve_symmetric(rows.transpose() * rows, last)(degree));
  return {c(0), spread, error > 0 ? std::abs(c(degree)) / error : 0};
}

/// Distance along the chain from its end to where the points' progress says it is; positive
/// inwards.
std::optional<double> progress_at_end(const Eigen::VectorXd& places, double noise) {
  Progress found = fit_progress(places, 1);
  const Progress bent = fit_progress(places, 2);
  if (bent.bend > kBend) found = bent;
  if (found.spread > kEven * noise) return std::nullopt;
  return found.first;
}

/// Places of the first points along the chain from its start.
Eigen::VectorXd places_along(const lac::Chain& chain, const std::vector<PointPlace>& places,
                             const Run& run, bool from_end, std::size_t count) {
  Eigen::VectorXd along(static_cast<Eigen::Index>(count));
  const core::Pose2 end = from_end ? lac::end_pose(chain) : chain.start;
  const core::Vector2 inwards =
      (from_end ? -1.0 : 1.0) * core::Vector2{std::cos(end.direction), std::sin(end.direction)};
  const int n = static_cast<int>(chain.pieces.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t j = from_end ? places.size() - 1 - k : k;
    const int number = from_end ? n - 1 - places[j].piece : places[j].piece;
    double sum = 0;
    for (int i = 0; i < number; ++i) sum += chain.pieces[from_end ? n - 1 - i : i].length;
    const double share = from_end ? 1 - places[j].fraction : places[j].fraction;
    sum += share * chain.pieces[places[j].piece].length;
    if (sum == 0) sum = std::min(0.0, core::dot(run.points[j] - end.position, inwards));
    along(static_cast<Eigen::Index>(k)) = sum;
  }
  return along;
}

/// The chain with its last piece longer by `more` (shorter where negative) on the same curve.
std::optional<lac::Chain> lengthened(const lac::Chain& chain, double more) {
  const lac::Piece& last = chain.pieces.back();
  const double share = 1 + more / last.length;
  if (share < 0.5 || share > 1.5) return std::nullopt;
  lac::Chain next = chain;
  if (more > 0) {
    auto longer = lac::extend(chain, 0, more);
    if (!longer) return std::nullopt;
    next = std::move(*longer);
  } else {
    next.pieces.back().curvature_end = lac::curvature(last, share);
    next.pieces.back().length *= share;
  }
  if (next.pieces.back().curvature_end * last.curvature_end < 0) return std::nullopt;
  return lac::validate(next) ? std::optional(next) : std::nullopt;
}

void place_end(RunResult& result, const Run& run, const RunOptions& options, bool from_end,
               const std::vector<PointPlace>& places) {
  const std::size_t count = std::min(kMostPoints, places.size() / 8);
  if (count < kLeastPoints) return;
  const auto along = places_along(result.chain, places, run, from_end, count);
  const auto inwards = progress_at_end(along, options.noise);
  if (!inwards) return;
  const double most = kFarthest * options.noise;
  const double move = std::clamp(*inwards, -most, most);
  // The last point itself must stay within the tolerance, now perhaps beyond the end.
  const PointPlace& last = from_end ? places.back() : places.front();
  const double beyond = std::max(0.0, move - along(0));
  const double past = std::min(0.0, along(0));  // of which a point beyond the end has it now
  const double aside = std::sqrt(std::max(0.0, last.offset * last.offset - past * past));
  if (std::hypot(aside, beyond) > options.tolerance) return;
  const lac::Chain chain = from_end ? result.chain : lac::reverse(result.chain);
  const auto moved = lengthened(chain, -move);
  if (!moved) return;
  if (from_end) {
    result.chain = *moved;
    return;
  }
  result.chain = lac::reverse(*moved);
}

/// Whether an end is held nowhere: neither by a clamp, a corner or an axis nor by its own point.
bool is_free(const Run& run, bool end) {
  const std::size_t point = end ? run.points.size() - 1 : 0;
  return (end ? run.clamp_end : run.clamp_start) == Clamp::none &&
         !(end ? run.tie_end : run.tie_start) &&
         (end ? run.end_on_axis : run.start_on_axis) == HalfEnd::free &&
         std::ranges::find(run.must_pass, point) == run.must_pass.end();
}

}  // namespace

void place_free_ends(RunResult& result, const Run& run, const RunOptions& options) {
  // A longer end might leave what the run stays inside.
  if (run.closed || !run.inside.empty() || result.exact || !noisy(result.accept)) return;
  const std::vector<PointPlace> places = place_points(result, run);
  for (const bool end : {false, true})
    if (is_free(run, end)) place_end(result, run, options, end, places);
}

}  // namespace keyline::fairing::detail
