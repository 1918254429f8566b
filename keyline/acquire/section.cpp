#include "keyline/acquire/section.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "keyline/acquire/places.h"
#include "keyline/acquire/section_slope.h"
#include "keyline/acquire/symmetry.h"
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
      core::counted(found, "point") + " within " + core::number_text(band, 4) + " of the plane",
      hint, "section");
}

constexpr std::size_t kMostSlid = 50000;  // more points are averaged across the band later

/// Takes over place i of each list of a section for its place k.
void move_place(RawCurve& section, std::size_t i, std::size_t k) {
  section.points[k] = section.points[i];
  if (!section.weights.empty()) section.weights[k] = section.weights[i];
  if (!section.source_lines.empty()) section.source_lines[k] = section.source_lines[i];
}

void cut_places(RawCurve& section, std::size_t count) {
  section.points.resize(count);
  if (!section.weights.empty()) section.weights.resize(count);
  if (!section.source_lines.empty()) section.source_lines.resize(count);
}

/// Points near the plane moved into it, along the surface where it slopes across; tells how many,
/// and how many were left out whose surface does not meet the plane near them.
template <class Straight>
void slide(RawCurve& section, const Plane& plane, double band, const Straight& straight) {
  using Way = detail::Foot::Way;
  const std::size_t all = section.points.size();
  std::vector<detail::Foot> feet(all);
  if (all <= kMostSlid) feet = detail::feet_on_plane(section.points, plane, band);
  std::size_t along = 0, kept = 0;
  for (std::size_t i = 0; i < all; ++i) {
    if (feet[i].way == Way::off) continue;
    const bool moved = feet[i].way == Way::along;
    section.points[i] = straight(moved ? feet[i].place : section.points[i]);
    along += moved ? 1 : 0;
    move_place(section, i, kept++);
  }
  cut_places(section, kept);
  if (along > 0)
    section.notes.push_back(std::to_string(along) +
                            " of them along the slope of the surface there");
  if (kept < all)
    section.notes.push_back(std::to_string(all - kept) +
                            " of them left out: their surface does not meet the plane nearby");
}

/// Indices of the cloud's points within the band; `distances` are those of all its points.
std::vector<std::size_t> within_band(const RawCurve& cloud, double band, const Plane& plane,
                                     std::vector<double>& distances) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double d = std::abs(distance_from_plane(plane, cloud.points[i]));
    if (!std::isfinite(d)) continue;
    distances.push_back(d);
    if (d <= band) inside.push_back(i);
  }
  return inside;
}

/// Drops points at the same place as an earlier one and tells how many; weights are added up.
void merge_repeated(RawCurve& section) {
  const std::vector<std::size_t> first = detail::first_at_place(section.points);
  std::vector<std::size_t> at(first.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] != i) {
      if (!section.weights.empty()) section.weights[at[first[i]]] += section.weights[i];
      continue;
    }
    at[i] = kept;
    move_place(section, i, kept++);
  }
  if (kept == first.size()) return;
  cut_places(section, kept);
  section.notes.push_back(std::to_string(first.size() - kept) +
                          " of them at the same place as another merged");
}

template <class Straight>
core::Result<RawCurve> cut(const RawCurve& cloud, double band, const Plane& plane,
                           Straight straight) {
  if (auto good = check(cloud, band); !good) return std::unexpected(good.error());
  RawCurve section;
  section.id = cloud.id;
  section.has_z = true;
  section.scattered = true;
  section.notes = cloud.notes;
  std::vector<double> distances;
  for (const std::size_t i : within_band(cloud, band, plane, distances)) {
    section.points.push_back(cloud.points[i]);
    if (!cloud.weights.empty()) section.weights.push_back(cloud.weights[i]);
    if (!cloud.source_lines.empty()) section.source_lines.push_back(cloud.source_lines[i]);
  }
  if (section.points.size() < 3) return too_few(section.points.size(), std::move(distances), band);
  section.notes.push_back("section: " + std::to_string(section.points.size()) + " of " +
                          std::to_string(cloud.points.size()) + " points lie within " +
                          core::number_text(band, 4) + " of the plane and were moved onto it");
  merge_repeated(section);
  slide(section, plane, band, straight);
  if (section.points.size() < 3)
    return core::fail(core::ErrorCode::bad_input,
                      "the surface of the points within " + core::number_text(band, 4) +
                          " of the plane does not meet it",
                      "move the plane", "section");
  return section;
}

}  // namespace

core::Result<RawCurve> section_plane(const RawCurve& cloud, Axis axis, double position,
                                     double band) {
  double core::Point3::* const member = axis == Axis::x   ? &core::Point3::x
                                        : axis == Axis::y ? &core::Point3::y
                                                          : &core::Point3::z;
  core::Vector3 normal;
  (axis == Axis::x ? normal.x : axis == Axis::y ? normal.y : normal.z) = 1;
  return cut(cloud, band, plane_of(normal, position), [&](core::Point3 p) {
    p.*member = position;
    return p;
  });
}

core::Result<RawCurve> section_plane(const RawCurve& cloud, const Plane& plane, double band) {
  return cut(cloud, band, plane,
             [&](core::Point3 p) { return from_plane(plane, to_plane(plane, p)); });
}

}  // namespace keyline::acquire
