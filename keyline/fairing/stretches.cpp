#include "keyline/fairing/stretches.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/exact_chain.h"
#include "keyline/fairing/one_piece.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::fairing::detail {
namespace {

// Tried: three for each piece of the longest chain that is drawn exactly.
constexpr std::size_t kStretches = 3 * kMostExactPieces;
// Stretches this long in the whole: of places on a chain of the most pieces, a third begins one
// that holds no joint.
constexpr double kStretchShare = 2.0 / (3 * kMostExactPieces);
constexpr double kWhole = 0.25;   // of the stretches: what is left of that third by the grid
constexpr double kStep = 0.05;    // of the larger curvature: less may be the fit's error…
constexpr double kFitError = 64;  // …which is so many times what bends a stretch by rounding
constexpr double kRateShare = 4;  // of what curvature changes by on the way between two stretches

/// Curvature and its rate at an end of a stretch.
struct End {
  std::size_t point = 0;
  double curvature = 0;
  double rate = 0;
};

class Stretches {
 public:
  Stretches(const std::vector<FitPoint>& points, bool closed, double exact)
      : points_(points), closed_(closed), exact_(exact) {
    const auto n = static_cast<double>(points.size());
    step_ = static_cast<std::size_t>(std::max(1.0, kStretchShare * n / (kStretchPoints - 1)));
    span_ = step_ * (kStretchPoints - 1);
    const std::size_t places = closed ? points.size() : points.size() - span_;
    const std::size_t tried = std::min(kStretches, places);
    for (std::size_t i = 0; i < tried; ++i)
      if (followed(i * places / tried)) whole_.push_back(i * places / tried);
    enough_ = static_cast<double>(whole_.size()) >= kWhole * static_cast<double>(tried);
  }

  bool enough() const { return enough_; }

  /// Whether curvature steps between two neighbouring stretches of one piece each.
  bool any_step() const {
    for (std::size_t i = 1; i < whole_.size(); ++i)
      if (whole_[i] - whole_[i - 1] > span_ / 2 && steps_between(whole_[i - 1], whole_[i]))
        return true;
    return closed_ && whole_.size() > 1 &&
           steps_between(whole_.back(), whole_.front() + points_.size());
  }

 private:
  OnePiece piece_from(std::size_t first) const {
    std::vector<FitPoint> stretch;
    for (std::size_t i = 0; i < kStretchPoints; ++i)
      stretch.push_back(points_[(first + i * step_) % points_.size()]);
    return fit_one_piece(stretch);
  }
  bool followed(std::size_t first) const { return piece_from(first).off <= exact_; }

  /// The last place between two, the first of which begins a stretch of one piece, that still does,
  /// or going back from the second the first that does.
  std::size_t moved(std::size_t from, std::size_t to) const {
    while (from + 1 < to || to + 1 < from) {
      const std::size_t middle = (from + to) / 2;
      (followed(middle) ? from : to) = middle;
    }
    return from;
  }

  End end_of(std::size_t first, bool start) const {
    const lac::Piece piece = lac::piece_of(piece_from(first).segment());
    const double curvature = start ? piece.curvature_start : piece.curvature_end;
    const bool arc = piece.curvature_start == piece.curvature_end;
    const double rate = arc ? 0 : std::abs(lac::curvature_rate(piece, start ? 0 : 1));
    return {start ? first : first + span_, curvature, rate};
  }

  bool steps_between(std::size_t first, std::size_t second) const {
    const End before = end_of(moved(first, second), false);
    const End after = end_of(moved(second, first), true);
    if (after.point > before.point + 1) return false;  // another piece is between them
    const std::size_t n = points_.size();
    const double gap =
        core::distance(points_[before.point % n].position, points_[after.point % n].position) +
        core::distance(points_[before.point % n].position,
                       points_[(before.point + 1) % n].position);
    const double length = kStretchShare;
    const double let =
        std::max(kStep * std::max(std::abs(before.curvature), std::abs(after.curvature)),
                 kFitError * exact_ / (length * length)) +
        kRateShare * gap * (before.rate + after.rate);
    return std::abs(after.curvature - before.curvature) > let;
  }

  const std::vector<FitPoint>& points_;
  bool closed_;
  double exact_;
  std::size_t step_ = 1;
  std::size_t span_ = 0;
  std::vector<std::size_t> whole_;  ///< where stretches of one piece begin
  bool enough_ = false;
};

}  // namespace

bool may_be_exact(const std::vector<FitPoint>& points, bool closed, double exact) {
  if (points.size() < 2 * kStretchPoints) return true;
  const Stretches stretches(points, closed, exact);
  return stretches.enough() && !stretches.any_step();
}

namespace {

/// A piece that came back to where it set out from, as a closed chain: a circle, if anything.
void close(FitChain& chain) {
  const double turn = chain.joints[1].direction - chain.joints[0].direction;
  chain.closed = true;
  chain.first_at_start = chain.last_at_end = false;
  chain.turning = 2 * core::kPi * std::round(turn / (2 * core::kPi));
  chain.joints[1] = chain.joints[0];
  chain.joints[1].direction += chain.turning;
  chain.feet.pop_back();
}

}  // namespace

std::optional<FitChain> one_exact_piece(std::vector<FitPoint> points, bool closed, double exact) {
  if (closed) points.push_back(points.front());
  OnePiece found = fit_one_piece(points);
  if (!(found.off <= exact)) return std::nullopt;
  if (closed) close(found.chain);
  return std::move(found.chain);
}

}  // namespace keyline::fairing::detail
