#include "keyline/acquire/section_slope.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

#include "keyline/acquire/kd_tree.h"
#include "keyline/core/second_moments.h"

namespace keyline::acquire::detail {
namespace {

constexpr std::size_t kNeighbours = 12;       // enough for a parabola and a slope…
constexpr std::size_t kMostNeighbours = 384;  // …unless the band is wider than these lie apart
constexpr double kGain = 6;        // what the slope must divide the sum of squared residuals by
constexpr double kSteepest = 1.5;  // a surface nearly along the plane has no section to move to
constexpr double kThick = 0.02;    // scatter about the parabola over length: less needs no slope
constexpr double kThin = 0.4;      // width over length of neighbourhoods that are a line at all

/// Feet near a point in their own frame: u along their scatter, v across.
struct Nearby {
  core::Vector2 along;
  Eigen::VectorXd u, v, away;
  double width = 0;   // standard deviations of v…
  double length = 0;  // …and of u
};

Nearby nearby(std::span<const core::Point2> feet, std::span<const double> away,
              const std::vector<std::size_t>& near, core::Point2 at) {
  core::Vector2 mean;
  for (const std::size_t i : near) mean = mean + (feet[i] - at) / static_cast<double>(near.size());
  core::SecondMoments moments;
  for (const std::size_t i : near) moments.add(feet[i] - at - mean);
  Nearby n;
  n.along = moments.direction();
  const auto count = static_cast<Eigen::Index>(near.size());
  n.u.resize(count);
  n.v.resize(count);
  n.away.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t i = near[static_cast<std::size_t>(k)];
    const core::Vector2 d = feet[i] - at - mean;
    n.u(k) = core::dot(d, n.along);
    n.v(k) = core::cross(n.along, d);
    n.away(k) = away[i];
  }
  n.length = std::sqrt(n.u.squaredNorm() / static_cast<double>(count));
  n.width = std::sqrt(n.v.squaredNorm() / static_cast<double>(count));
  return n;
}

bool is_line(const Nearby& n) { return n.length > 0 && n.width <= kThin * n.length; }

/// The fewest of the nearest that lie along a line: where a dense cloud slopes across the plane,
/// its band is wider than a few neighbours reach. All that are looked at where they fill an area.
Nearby nearby_line(std::span<const core::Point2> feet, std::span<const double> away,
                   const KdTree& tree, core::Point2 at) {
  std::size_t count = kNeighbours;
  Nearby n = nearby(feet, away, tree.nearest(at, count, feet.size()), at);
  while (!is_line(n) && 2 * count <= std::min(kMostNeighbours, feet.size())) {
    count *= 2;
    n = nearby(feet, away, tree.nearest(at, count, feet.size()), at);
  }
  return n;
}

/// Change of v with the distance from the plane, where it explains the neighbours.
std::optional<double> slope_of(const Nearby& n) {
  if (!is_line(n)) return std::nullopt;
  const double reach = n.away.cwiseAbs().maxCoeff();
  if (!(reach > 0)) return std::nullopt;
  Eigen::MatrixXd rows(n.u.size(), 4);
  rows.col(0).setOnes();
  rows.col(1) = n.u / n.length;
  rows.col(2) = rows.col(1).cwiseAbs2();
  rows.col(3) = n.away / reach;
  const auto without = rows.leftCols(3);
  const Eigen::VectorXd plain = without.colPivHouseholderQr().solve(n.v);
  const Eigen::VectorXd sloped = rows.colPivHouseholderQr().solve(n.v);
  const double before = (without * plain - n.v).squaredNorm();
  const double after = (rows * sloped - n.v).squaredNorm();
  const double slope = sloped(3) / reach;
  const double scatter = std::sqrt(before / static_cast<double>(n.u.size()));
  if (scatter < kThick * n.length) return std::nullopt;
  if (!(after * kGain < before) || !(std::abs(slope) < kSteepest)) return std::nullopt;
  return slope;
}

}  // namespace

std::vector<core::Point2> slide_to_section(std::span<const core::Point2> feet,
                                           std::span<const double> away) {
  std::vector<core::Point2> moved(feet.begin(), feet.end());
  if (feet.size() < 2 * kNeighbours) return moved;
  const KdTree tree(feet);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Nearby n = nearby_line(feet, away, tree, feet[i]);
    if (const auto slope = slope_of(n))
      moved[i] = feet[i] - *slope * away[i] * core::Vector2{-n.along.y, n.along.x};
  }
  return moved;
}

}  // namespace keyline::acquire::detail
