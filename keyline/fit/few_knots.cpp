#include "keyline/fit/few_knots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "keyline/curve/spline_graph.h"
#include "keyline/fit/jump_spline.h"
#include "keyline/fit/spline_band.h"
#include "keyline/numeric/halving.h"

namespace keyline::fit {
namespace {

using detail::JumpSpline;
using detail::PlacedPoints;
using Knots = std::vector<std::size_t>;  // as JumpSpline has them

constexpr std::size_t kFewest = 8;  // points
constexpr std::size_t kMostKnots = 1000;
constexpr std::size_t kAtOnce = 20;  // so many knots allow for one more before the next solve
constexpr int kHalvings = 24;
constexpr double kStiffest = 12;  // decimal logarithms of the penalty that are searched; jumps grow
constexpr double kSoftest = -36;  // with the fifth power of how near knots are

/// By chord lengths; points that repeat the one before are left out.
PlacedPoints placed(std::span<const core::Point2> points, bool closed) {
  PlacedPoints data{.points = {}, .at = {}, .closed = closed};
  double length = 0;
  for (const core::Point2 p : points) {
    const double step = data.points.empty() ? 0 : core::distance(data.points.back(), p);
    if (!data.points.empty() && !(step > 0)) continue;
    length += step;
    data.points.push_back(p);
    data.at.push_back(length);
  }
  const double last = closed ? core::distance(data.points.back(), data.points.front()) : 0;
  if (closed && !(last > 0)) {
    data.points.pop_back();
    data.at.pop_back();
  }
  for (double& at : data.at) at /= length + last;
  return data;
}

/// The points between two knots.
struct Gap {
  std::size_t from, to;
  double squares;  ///< of their offsets

  bool has_room() const { return to - from > 1; }
  /// Leaves the first half and returns the other.
  Gap split() {
    const std::size_t middle = (from + to) / 2;
    const double share = static_cast<double>(middle - from) / static_cast<double>(to - from);
    const Gap rest{middle, to, (1 - share) * squares};
    *this = {from, middle, share * squares};
    return rest;
  }
};

/// An offset at a knot counts half on either side.
std::vector<Gap> gaps_between(const Knots& knots, const JumpSpline& spline,
                              const PlacedPoints& data) {
  std::vector<Gap> gaps;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    Gap& gap = gaps.emplace_back(Gap{knots[k], knots[k + 1], 0});
    for (std::size_t i = gap.from; i <= gap.to && i < data.points.size(); ++i) {
      const core::Vector2 offset = spline.offset(i);
      gap.squares += (i == gap.from || i == gap.to ? 0.5 : 1) * dot(offset, offset);
    }
  }
  return gaps;
}

/// More knots where offsets are largest; the same where there is no room for any.
Knots with_more(const Knots& knots, const JumpSpline& spline, const PlacedPoints& data) {
  // As many unknowns as points.
  const std::size_t room = data.closed ? data.points.size() + 1 : data.points.size() - 4;
  const std::size_t more = std::max<std::size_t>(1, knots.size() / kAtOnce);
  const std::size_t wanted = std::min({knots.size() + more, room, kMostKnots});
  std::vector<Gap> gaps = gaps_between(knots, spline, data);
  const auto worse = [](const Gap& a, const Gap& b) {
    return a.has_room() != b.has_room() ? b.has_room() : a.squares < b.squares;
  };
  while (gaps.size() + 1 < wanted) {
    const auto worst = std::max_element(gaps.begin(), gaps.end(), worse);
    if (!worst->has_room()) break;
    const Gap rest = worst->split();
    gaps.insert(worst + 1, rest);
  }
  Knots found{0};
  for (const Gap& gap : gaps) found.push_back(gap.to);
  return found;
}

/// Asks whether a spline keeps the tolerance.
class BandOfPoints {
 public:
  BandOfPoints(const PlacedPoints& data, double tolerance) : data_(data), tolerance_(tolerance) {}

  bool holds(const JumpSpline& spline) {
    return band_.holds(data_.points.size(), [&](std::size_t i) { return farther(spline, i); });
  }

 private:
  bool farther(const JumpSpline& spline, std::size_t i) const {
    const core::Point2 p = data_.points[i];
    return detail::farther_than(
        tolerance_, p, data_.at[i], p + spline.offset(i), {.end = 1, .closed = data_.closed},
        [&](double t) { return evaluate(spline.spline(), t); },
        [&](double t) { return jet(spline.spline(), t).first; });
  }

  const PlacedPoints& data_;
  double tolerance_;
  detail::Band band_;
};

/// The spline of the largest penalty that keeps the tolerance, as that of none does.
curve::BSpline2 most_penalised(JumpSpline& spline, BandOfPoints& band) {
  curve::BSpline2 smoothest = spline.spline();
  const auto is_kept = [&](double logarithm) {
    const bool kept = spline.solve(std::pow(10, logarithm)) && band.holds(spline);
    if (kept) smoothest = spline.spline();
    return kept;
  };
  numeric::last_that_holds(is_kept, kSoftest, kStiffest, kHalvings);
  return smoothest;
}

}  // namespace

std::optional<curve::CurvatureGraph> few_knots_curvature(std::span<const core::Point2> points,
                                                         bool closed, double tolerance) {
  if (points.size() < kFewest) return std::nullopt;
  const PlacedPoints data = placed(points, closed);
  const std::size_t count = data.points.size();
  if (count < kFewest) return std::nullopt;
  Knots knots{0, closed ? count : count - 1};
  if (closed) knots.insert(knots.begin() + 1, count / 2);
  BandOfPoints band(data, tolerance);
  for (;;) {
    JumpSpline spline(data, knots);
    if (!spline.solve(0)) return std::nullopt;
    if (band.holds(spline)) return curve::curvature_graph(most_penalised(spline, band));
    Knots more = with_more(knots, spline, data);
    if (more.size() == knots.size()) return std::nullopt;
    knots = std::move(more);
  }
}

}  // namespace keyline::fit
