#include "keyline/acquire/section_slope.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

#include "keyline/acquire/kd_tree.h"

namespace keyline::acquire::detail {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbours = 12;       // twice the terms of a quadratic, and twice as many…
constexpr std::size_t kMostNeighbours = 384;  // …while that tells more
constexpr double kThin = 0.4;  // thickness over width of points that lie on a surface…
constexpr double kLine = 0.4;  // …and width over length of those that more do not widen
constexpr double kTold = 3;    // a value is told that is so many times its standard error

Vector3d vector_of(core::Vector3 v) { return {v.x, v.y, v.z}; }

/// Points near one of them: a frame of their own, its third axis across the surface.
struct Nearby {
  Eigen::Matrix3Xd places;  // in the frame, the point itself at the origin
  Eigen::Matrix3d axes;     // columns: along, aside, across
  Vector3d spread;          // standard deviations along them
  double reach = 0;         // the farthest one's distance
};

Nearby nearby(std::span<const core::Point3> cloud, const std::vector<std::size_t>& near,
              core::Point3 at) {
  Nearby n;
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(near.size()));
  for (std::size_t k = 0; k < near.size(); ++k)
    places.col(static_cast<Eigen::Index>(k)) = vector_of(cloud[near[k]] - at);
  const Eigen::Matrix3Xd off = places.colwise() - places.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(off * off.transpose());
  n.axes = principal.eigenvectors().rowwise().reverse();
  n.spread = (principal.eigenvalues().reverse() / static_cast<double>(near.size()))
                 .cwiseMax(0)
                 .cwiseSqrt();
  n.places = n.axes.transpose() * places;
  n.reach = places.colwise().norm().maxCoeff();
  return n;
}

bool is_surface(const Nearby& n) { return n.spread(1) > 0 && n.spread(2) <= kThin * n.spread(1); }

/// Distance from the plane along the surface through a point, straight up its slope: to second
/// order in the way gone over the surface's own plane.
struct Climb {
  Vector3d up;         // in space, of unit length, along the surface's own plane
  double rate = 0;     // change of the distance with the way, at the point…
  double bend = 0;     // …and half its second derivative
  double across = 0;   // height over the surface's own plane: its change with the way…
  double arch = 0;     // …and half its second derivative
  double error = 0;    // standard error of the surface's slope, and so of the rate where it is flat
  double scatter = 0;  // what the points stray from the surface
  double flat = 0;     // cosine between the surface's own plane and the section's
  Vector3d beside;     // in the section's plane, across the section
};

Climb climb_of(const Nearby& n, const Vector3d& normal) {
  const auto count = n.places.cols();
  const double unit = n.reach;
  Eigen::Matrix<double, Eigen::Dynamic, 6> rows(count, 6);
  const Eigen::ArrayXd u = n.places.row(0).transpose().array() / unit;
  const Eigen::ArrayXd v = n.places.row(1).transpose().array() / unit;
  rows.col(0).setOnes();
  rows.col(1) = u;
  rows.col(2) = v;
  rows.col(3) = u.square();
  rows.col(4) = u * v;
  rows.col(5) = v.square();
  const Eigen::VectorXd height = n.places.row(2).transpose();
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 6>> solver(rows);
  const Eigen::Matrix<double, 6, 1> w = solver.solve(height);
  const Eigen::Matrix<double, 6, 6> inverse =
      (rows.transpose() * rows).completeOrthogonalDecomposition().pseudoInverse();
  Climb climb;
  climb.scatter = std::sqrt((rows * w - height).squaredNorm() / static_cast<double>(count - 6));
  const Vector3d n_local = n.axes.transpose() * normal;
  const Eigen::Vector2d slope = w.segment<2>(1) / unit;
  const Eigen::Vector2d gradient = n_local.head<2>() + n_local(2) * slope;
  climb.rate = gradient.norm();
  const Eigen::Vector2d way =
      climb.rate > 0 ? Eigen::Vector2d(gradient / climb.rate) : Eigen::Vector2d(1, 0);
  climb.up = n.axes.leftCols<2>() * way;
  climb.across = slope.dot(way);
  climb.arch =
      (w(3) * way(0) * way(0) + w(4) * way(0) * way(1) + w(5) * way(1) * way(1)) / (unit * unit);
  climb.bend = n_local(2) * climb.arch;
  climb.error = climb.scatter * std::sqrt(inverse(1, 1) + inverse(2, 2)) / unit;
  climb.flat = std::abs(n_local(2));
  climb.beside = n.axes * Vector3d(-slope(0), -slope(1), 1);
  climb.beside -= climb.beside.dot(normal) * normal;
  climb.beside.normalize();
  return climb;
}

/// The way over the surface at which a distance from the plane is made up for: the nearest root.
std::optional<double> way_to_plane(const Climb& climb, double away) {
  const double root = climb.rate * climb.rate - 4 * climb.bend * away;
  if (root < 0 || !(climb.rate > kTold * climb.flat * climb.error)) return std::nullopt;
  return -2 * away / (climb.rate + std::sqrt(root));
}

/// The surface at a point of a cloud, and the way over it to the plane; none where it does not meet
/// the plane as near as the neighbours reach.
struct Surface {
  Nearby near;
  Climb climb;
  std::optional<double> way;

  /// Standard error of where the way ends, across the surface.
  double error() const { return climb.error * std::abs(*way); }
};

/// Of the nearest that lie on a surface as many as tell best where the way ends; where it does not
/// meet the plane the fewest that reach as far as the band. Empty where no neighbours lie on a
/// surface: what is long and as thick as wide is a line, or a strip as narrow as its points stray.
std::optional<Surface> surface_at(std::span<const core::Point3> cloud, const KdTree3& tree,
                                  core::Point3 at, const Vector3d& normal, double away,
                                  double band) {
  std::optional<Surface> best;
  for (std::size_t count = kNeighbours; count <= std::min(kMostNeighbours, cloud.size());
       count *= 2) {
    Surface found{nearby(cloud, tree.nearest(at, count, cloud.size()), at), {}, {}};
    const Nearby& n = found.near;
    if (!is_surface(n) && (best || n.spread(1) < kLine * n.spread(0))) break;
    if (!is_surface(n)) continue;
    found.climb = climb_of(n, normal);
    found.way = way_to_plane(found.climb, away);
    if (found.way && std::abs(*found.way) > n.reach) found.way.reset();
    if (best && best->way && !(found.way && found.error() < best->error())) break;
    best = std::move(found);
    if (!best->way && best->near.reach >= band) break;
  }
  return best;
}

/// Where the way over a surface leads from its point.
core::Point3 led(core::Point3 p, const Surface& surface) {
  const double way = *surface.way;
  const double height = way * (surface.climb.across + way * surface.climb.arch);
  const Vector3d by = way * surface.climb.up + height * surface.near.axes.col(2);
  return {p.x + by(0), p.y + by(1), p.z + by(2)};
}

}  // namespace

std::vector<Foot> feet_on_plane(std::span<const core::Point3> cloud, const Plane& plane,
                                double band) {
  std::vector<Foot> feet(cloud.size());
  const KdTree3 tree(cloud);
  const Vector3d normal = vector_of(core::cross(plane.axis_x, plane.axis_y));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double away = distance_from_plane(plane, cloud[i]);
    const auto surface = surface_at(cloud, tree, cloud[i], normal, away, band);
    if (!surface) continue;
    const Climb& climb = surface->climb;
    if (surface->way) {
      const core::Point3 foot = from_plane(plane, to_plane(plane, led(cloud[i], *surface)));
      const double beside = climb.beside.dot(vector_of(foot - cloud[i]));
      if (std::abs(beside) > climb.scatter + kTold * climb.error * std::abs(away))
        feet[i] = {Foot::Way::along, foot};
    } else if (std::abs(away) > kTold * climb.scatter) {
      feet[i].way = Foot::Way::off;
    }
  }
  return feet;
}

}  // namespace keyline::acquire::detail
