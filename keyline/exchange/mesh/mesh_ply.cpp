#include <algorithm>
#include <cmath>
#include <functional>

#include "keyline/core/text.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/mesh_polygon.h"
#include "keyline/exchange/mesh/ply_header.h"

namespace keyline::exchange {
namespace {

using core::Result;
using detail::PlyElement;
using detail::PlyHeader;
using detail::PlyProperty;
using detail::PlyValues;

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), header_(header), values_(bytes, header) {}

  Result<Mesh> read() {
    for (const PlyElement& element : header_.elements)
      if (auto done = read(element); !done) return std::unexpected(done.error());
    mesh_.skipped = detail::other_elements(header_);
    if (bad_points_ > 0)
      mesh_.skipped.push_back(core::counted(bad_points_, "vertex that is", "vertices that are") +
                              " not finite");
    if (values_.more())
      mesh_.skipped.push_back(
          "what stands behind the last element its header tells of: check that no number is "
          "missing");
    if (bad_faces_ > 0)
      mesh_.skipped.push_back(core::counted(bad_faces_, "face that names", "faces that name") +
                              " no vertices");
    if (large_faces_ > 0)
      mesh_.skipped.push_back(core::counted(large_faces_, "face") +
                              " of too many corners; divide them");
    return std::move(mesh_);
  }

 private:
  Result<void> read(const PlyElement& element) {
    const bool points = element.name == "vertex";
    const bool faces = element.name == "face";
    if (element.properties.empty()) return {};
    // The space is made as the file fills it: a count alone is no reason to allocate.
    const std::size_t most = bytes_.size() - std::min(bytes_.size(), values_.position());
    if (points) mesh_.points.reserve(std::min(element.count, most / 3));
    for (std::size_t i = 0; i < element.count; ++i) {
      core::Point3 p;
      for (const PlyProperty& property : element.properties) {
        if (auto done = read(property, p, faces); !done) return done;
      }
      if (points) add(p);
    }
    return {};
  }

  Result<void> read(const PlyProperty& property, core::Point3& p, bool faces) {
    if (property.count) return read_list(property, faces);
    const auto value = values_.next(property.type);
    if (!value) return std::unexpected(value.error());
    if (property.name == "x") p.x = *value;
    if (property.name == "y") p.y = *value;
    if (property.name == "z") p.z = *value;
    return {};
  }

  Result<void> read_list(const PlyProperty& property, bool faces) {
    const auto count = values_.next_count(*property.count);
    if (!count) return std::unexpected(count.error());
    const bool wanted = faces && detail::is_vertex_list(property);
    corners_.clear();
    bool known = true;
    for (std::size_t i = 0; i < *count; ++i) {
      const auto index = values_.next(property.type);
      if (!index) return std::unexpected(index.error());
      known = known && *index >= 0 && *index < static_cast<double>(mesh_.points.size()) &&
              *index == std::floor(*index);
      if (wanted && known) corners_.push_back(static_cast<std::uint32_t>(*index));
    }
    if (!wanted) return {};
    if (!known || corners_.size() < 3) {
      ++bad_faces_;
      return {};
    }
    large_faces_ += !detail::add_polygon(mesh_, corners_);
    return {};
  }

  /// Points that are not finite keep their number for the faces' sake; faces with them are cut
  /// nowhere, since no comparison with the plane holds.
  void add(core::Point3 p) {
    bad_points_ += !core::is_finite(p);
    mesh_.points.push_back(p);
  }

  std::string_view bytes_;
  const PlyHeader& header_;
  PlyValues values_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::size_t bad_points_ = 0;
  std::size_t bad_faces_ = 0;
  std::size_t large_faces_ = 0;
};

}  // namespace

Result<Mesh> read_ply(std::string_view bytes) {
  const auto header = detail::read_ply_header(bytes);
  if (!header) return std::unexpected(header.error());
  if (auto sound = detail::check_vertices(*header); !sound) return std::unexpected(sound.error());
  return PlyReader(bytes, *header).read();
}

}  // namespace keyline::exchange
