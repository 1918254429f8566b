#include "keyline/exchange/mesh/section_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keyline/acquire/section.h"
#include "keyline/acquire/section_curves.h"
#include "keyline/acquire/symmetry.h"
#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/mesh_notes.h"

namespace keyline::exchange {
namespace {

using acquire::Plane;
using core::ErrorCode;
using core::Point3;
using core::Result;
using core::Vector3;

/// An even sample of a stream of unknown length, of 200,000 to 400,000 points.
class Sample {
 public:
  void take(Point3 p) {
    if (count_++ % stride_ != 0) return;
    kept_.push_back(p);
    if (kept_.size() < 400'000) return;
    for (std::size_t i = 0; i < kept_.size() / 2; ++i) kept_[i] = kept_[2 * i];
    kept_.resize(kept_.size() / 2);
    stride_ *= 2;
  }
  const std::vector<Point3>& points() const { return kept_; }
  std::size_t count() const { return count_; }

 private:
  std::vector<Point3> kept_;
  std::size_t stride_ = 1;
  std::size_t count_ = 0;
};

std::string described(const Plane& plane, bool found) {
  const Vector3 n = cross(plane.axis_x, plane.axis_y);
  const double offset = dot(plane.origin - Point3{}, n);
  std::string text;
  for (const auto& [axis, name] :
       {std::pair{Vector3{1, 0, 0}, "x"}, std::pair{Vector3{0, 1, 0}, "y"},
        std::pair{Vector3{0, 0, 1}, "z"}})
    if (std::abs(dot(n, axis)) == 1)
      text = std::string(name) + " = " + core::number_text(dot(n, axis) * offset + 0.0, 6);
  if (text.empty())
    text = core::number_text(n.x, 5) + " x + " + core::number_text(n.y, 5) + " y + " +
           core::number_text(n.z, 5) + " z = " + core::number_text(offset, 6);
  return text + (found ? " (symmetry plane, found)" : "");
}

Result<Plane> plane_for(const SectionRequest& request, const std::vector<Point3>& points) {
  if (request.plane) return *request.plane;
  const auto found = acquire::symmetry_plane(points);
  if (!found) return std::unexpected(found.error());
  return found->plane;
}

std::unexpected<core::Failure> too_large() {
  return core::fail(ErrorCode::bad_input, "a coordinate is larger than 1e100",
                    "check that the file is whole, or divide all coordinates by a common factor");
}

Result<FileSection> mesh_section(const Mesh& mesh, const SectionRequest& request) {
  if (std::ranges::any_of(mesh.points, [](Point3 p) { return core::is_too_large(p); }))
    return too_large();
  const auto plane = plane_for(request, mesh.points);
  if (!plane) return std::unexpected(plane.error());
  FileSection result;
  result.ordered = true;
  result.plane = *plane;
  result.description = described(*plane, !request.plane);
  for (const SectionLine& line : section(mesh, *plane)) {
    acquire::RawCurve curve;
    curve.id = "section-" + std::to_string(result.curves.size() + 1);
    for (const core::Point2 p : line.points) curve.points.push_back({p.x, p.y, 0});
    curve.notes.push_back("section of a mesh at " + result.description);
    curve.left_out = core::told_in_part(detail::left_out_of(mesh), "further part of the mesh",
                                        "further parts of the mesh");
    result.curves.push_back(std::move(curve));
    result.closed.push_back(line.closed);
  }
  if (result.curves.empty()) {
    const bool touched = std::ranges::any_of(
        mesh.points, [&](Point3 p) { return acquire::distance_from_plane(*plane, p) == 0; });
    std::string what = touched ? "the plane touches the mesh and cuts nothing of it"
                               : "the plane does not meet the mesh";
    if (!mesh.skipped.empty()) what += "; skipped: " + mesh.skipped.front();
    if (mesh.skipped.size() > 1) what += " and others";
    return core::fail(ErrorCode::bad_input, what, "move it", "--section");
  }
  return result;
}

/// Points within the band and, for the sake of a helpful failure, the three nearest.
struct Gathered {
  acquire::RawCurve cloud;
  std::array<std::pair<double, Point3>, 3> nearest{};
  std::size_t near = 0;

  void take(Point3 p, double away, double band) {
    if (away <= band) {
      cloud.points.push_back(p);
      return;
    }
    std::pair<double, Point3> candidate{away, p};
    for (std::size_t i = 0; i < nearest.size(); ++i)
      if (i >= near || candidate.first < nearest[i].first) std::swap(candidate, nearest[i]);
    near = std::min(near + 1, nearest.size());
  }
};

Result<FileSection> cloud_section(const std::filesystem::path& file, const SectionRequest& request,
                                  std::optional<double> band) {
  Sample sample;
  std::optional<Point3> first;
  double size = 0;
  bool large = false;
  const auto measured = stream_points(file, [&](Point3 p) {
    if (!first) first = p;
    large = large || core::is_too_large(p);
    size = std::max(size, distance(p, *first));
    sample.take(p);
  });
  if (!measured) return std::unexpected(measured.error());
  if (large) return too_large();
  const auto plane = plane_for(request, sample.points());
  if (!plane) return std::unexpected(plane.error());
  const double reach = band ? *band : size > 0 && std::isfinite(size) ? size / 150 : 1;
  Gathered gathered;
  gathered.cloud.has_z = true;
  const auto read = stream_points(file, [&](Point3 p) {
    gathered.take(p, std::abs(acquire::distance_from_plane(*plane, p)), reach);
  });
  if (!read) return std::unexpected(read.error());
  if (gathered.cloud.points.size() < 3)
    for (std::size_t i = 0; i < gathered.near; ++i)
      gathered.cloud.points.push_back(gathered.nearest[i].second);
  auto curve = acquire::section_plane(gathered.cloud, *plane, reach);
  if (!curve) return std::unexpected(curve.error());
  FileSection result;
  result.plane = *plane;
  result.description = described(*plane, !request.plane);
  curve->notes.front() = "section at " + result.description + ": " +
                         std::to_string(curve->points.size()) + " of " +
                         std::to_string(sample.count()) + " points lie within " +
                         core::number_text(reach, 4) + " of the plane and were moved onto it";
  result.curves = acquire::section_curves(*curve, *plane);
  for (acquire::RawCurve& found : result.curves) found.left_out = read->left_out;
  result.unit = read->unit;
  result.closed.assign(result.curves.size(), false);
  return result;
}

}  // namespace

Result<SectionRequest> parse_section(const std::string& text) {
  if (text == "auto") return SectionRequest{};
  static constexpr std::array<Vector3, 3> kAxes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const bool named = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  if (named) {
    if (const auto position = core::parse_number(std::string_view(text).substr(2)))
      return SectionRequest{
          acquire::plane_of(kAxes[static_cast<std::size_t>(text[0] - 'x')], *position)};
  }
  return core::fail(ErrorCode::bad_input, "\"" + text + "\" is no section",
                    "give x=, y= or z= and a number, as in y=0, or auto", "--section");
}

Result<FileSection> section_of_file(const std::filesystem::path& file,
                                    const SectionRequest& request, std::optional<double> band) {
  const auto cut = [&]() -> Result<FileSection> {
    if (!is_mesh_file(file)) return cloud_section(file, request, band);
    const auto mesh = read_mesh(file);
    if (!mesh) return std::unexpected(mesh.error());
    if (mesh->triangles.empty()) return cloud_section(file, request, band);
    return mesh_section(*mesh, request);
  }();
  if (!cut) return std::unexpected(in_file(cut.error(), file.string()));
  return cut;
}

}  // namespace keyline::exchange
