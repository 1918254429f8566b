#include "keyline/acquire/section.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "keyline/core/text.h"

namespace keyline::acquire {
namespace {

core::Result<void> check(const RawCurve& cloud, double band) {
  if (!cloud.has_z) {
    return core::fail(core::ErrorCode::bad_input, "a section needs points with x, y and z",
                      "give three columns, or leave the section out");
  }
  if (!(band > 0) || !std::isfinite(band)) {
    return core::fail(core::ErrorCode::bad_input, "the band of a section must be positive",
                      "give the largest distance from the plane, in the unit of the points",
                      "band");
  }
  return {};
}

core::Result<RawCurve> too_few(std::size_t found, std::vector<double> distances, double band) {
  std::string hint = "move the plane";
  if (distances.size() >= 3) {
    std::nth_element(distances.begin(), distances.begin() + 2, distances.end());
    hint = "the third nearest point is " + core::number_text(distances[2], 4) +
           " away: widen the band, or move the plane";
  }
  return core::fail(
      core::ErrorCode::bad_input,
      std::to_string(found) + " points within " + core::number_text(band, 4) + " of the plane",
      hint, "section");
}

template <class Distance, class Foot>
core::Result<RawCurve> cut(const RawCurve& cloud, double band, Distance distance, Foot foot) {
  if (auto good = check(cloud, band); !good) return std::unexpected(good.error());
  RawCurve section;
  section.id = cloud.id;
  section.has_z = true;
  section.notes = cloud.notes;
  std::vector<double> distances;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double d = distance(cloud.points[i]);
    if (!std::isfinite(d)) continue;
    distances.push_back(d);
    if (d > band) continue;
    section.points.push_back(foot(cloud.points[i]));
    if (!cloud.weights.empty()) section.weights.push_back(cloud.weights[i]);
    if (!cloud.source_lines.empty()) section.source_lines.push_back(cloud.source_lines[i]);
  }
  if (section.points.size() < 3) return too_few(section.points.size(), std::move(distances), band);
  section.notes.push_back("section: " + std::to_string(section.points.size()) + " of " +
                          std::to_string(cloud.points.size()) + " points lie within " +
                          core::number_text(band, 4) + " of the plane and were moved onto it");
  return section;
}

}  // namespace

core::Result<RawCurve> section_plane(const RawCurve& cloud, Axis axis, double position,
                                     double band) {
  double core::Point3::* const member = axis == Axis::x   ? &core::Point3::x
                                        : axis == Axis::y ? &core::Point3::y
                                                          : &core::Point3::z;
  return cut(
      cloud, band, [&](core::Point3 p) { return std::abs(p.*member - position); },
      [&](core::Point3 p) {
        p.*member = position;
        return p;
      });
}

core::Result<RawCurve> section_plane(const RawCurve& cloud, const Plane& plane, double band) {
  return cut(
      cloud, band, [&](core::Point3 p) { return std::abs(distance_from_plane(plane, p)); },
      [&](core::Point3 p) { return from_plane(plane, to_plane(plane, p)); });
}

}  // namespace keyline::acquire
