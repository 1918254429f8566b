#include "keyline/acquire/symmetry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Eigenvalues>

#include "keyline/core/extent.h"
#include "keyline/core/text.h"

namespace keyline::acquire {
namespace {

using core::Point3;
using core::Vector3;

constexpr std::size_t kProbes = 4000;      // points that are mirrored: a score is their mean
constexpr std::size_t kTargets = 200'000;  // points that their mirror images are looked for among

std::vector<Point3> thinned(std::span<const Point3> points, std::size_t most) {
  const std::size_t step = (points.size() + most - 1) / most;
  std::vector<Point3> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

/// Points in cubes, for the nearest one within the side of a cube.
class Cubes {
 public:
  Cubes(std::vector<Point3> points, double side) : points_(std::move(points)), side_(side) {
    for (std::size_t i = 0; i < points_.size(); ++i) cubes_[key(cell(points_[i]))].push_back(i);
  }

  std::optional<Point3> nearest(Point3 p) const {
    double best = side_;
    std::optional<Point3> found;
    const auto at = cell(p);
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        for (long dz = -1; dz <= 1; ++dz) {
          const auto cube = cubes_.find(key({at[0] + dx, at[1] + dy, at[2] + dz}));
          if (cube == cubes_.end()) continue;
          for (const std::size_t i : cube->second)
            if (const double d = distance(points_[i], p); d < best) {
              best = d;
              found = points_[i];
            }
        }
    return found;
  }
  double side() const { return side_; }

 private:
  using Cell = std::array<long, 3>;
  Cell cell(Point3 p) const {
    return {std::lround(p.x / side_), std::lround(p.y / side_), std::lround(p.z / side_)};
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t k = 0;
    for (const long v : c) k = k * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(v);
    return k;
  }

  std::vector<Point3> points_;
  double side_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cubes_;
};

struct Mirror {
  Vector3 normal;
  double offset = 0;
};

Point3 mirrored(const Mirror& m, Point3 p) {
  return p - 2 * (dot(p - Point3{}, m.normal) - m.offset) * m.normal;
}

double score(const Mirror& m, const std::vector<Point3>& probes, const Cubes& cubes) {
  double sum = 0;
  for (const Point3 p : probes) {
    const Point3 image = mirrored(m, p);
    const auto q = cubes.nearest(image);
    sum += q ? distance(*q, image) : cubes.side();
  }
  return sum / static_cast<double>(probes.size());
}

Point3 mean_of(std::span<const Point3> points) {
  Vector3 sum{};
  for (const Point3 p : points) sum = sum + (p - Point3{});
  return Point3{} + sum / static_cast<double>(points.size());
}

/// Coordinate planes and those of the principal axes, through the mean and the middle of the box.
std::vector<Mirror> candidates(const std::vector<Point3>& points, const core::Box3& box) {
  const Point3 mean = mean_of(points);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Point3 p : points) {
    const Eigen::Vector3d v(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    spread += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::vector<Mirror> list;
  const Point3 middle = core::mix(box.low, box.high, 0.5);
  for (const Vector3 n : {Vector3{0, 1, 0}, Vector3{1, 0, 0}, Vector3{0, 0, 1}})
    for (const Point3 through : {Point3{}, middle, mean})
      list.push_back({n, dot(through - Point3{}, n)});
  for (int k = 0; k < 3; ++k) {
    const auto v = axes.eigenvectors().col(k);
    const Vector3 n{v[0], v[1], v[2]};
    list.push_back({n, dot(mean - Point3{}, n)});
  }
  return list;
}

/// One round of pairing mirrored points with their neighbours.
Mirror refined(const Mirror& m, const std::vector<Point3>& probes, const Cubes& cubes) {
  double offset = 0;
  double count = 0;
  Vector3 across{};
  for (const Point3 p : probes) {
    const auto q = cubes.nearest(mirrored(m, p));
    if (!q) continue;
    const Vector3 between = p - *q;
    across = across + (dot(between, m.normal) < 0 ? -between : between);
    offset += dot(core::mix(p, *q, 0.5) - Point3{}, m.normal);
    ++count;
  }
  const double length = norm(across);
  if (count < 10 || !(length > 0)) return m;
  return {across / length, offset / count};
}

/// A coordinate direction or position 0 in place of the refined ones where they are as good.
Mirror settled(const Mirror& found, double found_score, const std::vector<Point3>& probes,
               const Cubes& cubes) {
  constexpr double kAsGood = 1.02;  // of the score: what 4,000 probes tell no better
  Mirror best = found;
  for (const Vector3 axis : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
    if (std::abs(dot(axis, found.normal)) < 0.999) continue;
    const double side = dot(axis, found.normal) < 0 ? -1 : 1;
    for (const double offset : {side * found.offset, 0.0}) {
      const Mirror plain{axis, offset};
      if (score(plain, probes, cubes) <= kAsGood * found_score) best = plain;
    }
  }
  return best;
}

}  // namespace

Plane plane_of(Vector3 normal, double offset) {
  const Point3 origin = Point3{} + offset * normal;
  if (normal == Vector3{0, 0, 1}) return {origin, {1, 0, 0}, {0, 1, 0}};
  if (normal == Vector3{0, 1, 0}) return {origin, {1, 0, 0}, {0, 0, 1}};
  if (normal == Vector3{1, 0, 0}) return {origin, {0, 1, 0}, {0, 0, 1}};
  const Vector3 up = std::abs(normal.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{0, 1, 0};
  const Vector3 y = up - dot(up, normal) * normal;
  const Vector3 unit = y / norm(y);
  return {origin, cross(unit, normal), unit};
}

namespace {

/// What there is to cut: the bounding box, and the planes through its middle.
std::string planes_of(const core::Box3& box) {
  constexpr int kDigits = 4;
  const auto side = [](char axis, double low, double high) {
    return std::string(1, axis) + " from " + core::number_text(low, kDigits) + " to " +
           core::number_text(high, kDigits);
  };
  const auto middle = [](char axis, double low, double high) {
    return std::string(1, axis) + "=" + core::number_text(0.5 * low + 0.5 * high, kDigits);
  };
  return "the points lie in " + side('x', box.low.x, box.high.x) + ", " +
         side('y', box.low.y, box.high.y) + ", " + side('z', box.low.z, box.high.z) +
         "; name a plane, as in " + middle('x', box.low.x, box.high.x) + ", " +
         middle('y', box.low.y, box.high.y) + " or " + middle('z', box.low.z, box.high.z);
}

}  // namespace

core::Result<SymmetryPlane> symmetry_plane(std::span<const Point3> points) {
  const bool finite =
      std::all_of(points.begin(), points.end(), [](Point3 p) { return core::is_finite(p); });
  if (points.size() < 20 || !finite)
    return core::fail(core::ErrorCode::bad_input, "a symmetry plane needs 20 points or more",
                      "name the plane, as in y=0");
  const core::Box3 box = core::box_of(points);
  const double size = diagonal(box);
  if (!(size > 0) || !std::isfinite(size))
    return core::fail(core::ErrorCode::bad_input, "the points have no extent", "check the file");
  const std::vector<Point3> probes = thinned(points, kProbes);
  std::vector<Point3> targets = thinned(points, kTargets);
  // Points of a surface stand about size / sqrt(n) apart.
  const double side = 3 * size / std::sqrt(static_cast<double>(targets.size()));
  const std::vector<Mirror> list = candidates(probes, box);
  const Cubes cubes(std::move(targets), side);
  Mirror best;
  double least = HUGE_VAL;
  for (const Mirror& m : list)
    if (const double s = score(m, probes, cubes); s < least) {
      least = s;
      best = m;
    }
  for (int round = 0; round < 10; ++round) {
    const Mirror next = refined(best, probes, cubes);
    const double s = score(next, probes, cubes);
    if (!(s < least)) break;
    least = s;
    best = next;
  }
  if (least > 0.5 * side)
    return core::fail(core::ErrorCode::undrawable, "there is no plane of symmetry", planes_of(box));
  const Mirror plain = settled(best, least, probes, cubes);
  return SymmetryPlane{plane_of(plain.normal, plain.offset), least};
}

}  // namespace keyline::acquire
