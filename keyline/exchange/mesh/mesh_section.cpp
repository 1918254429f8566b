#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>

#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/format/format.h"
#include "keyline/exchange/mesh/mesh.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;

/// An edge of the mesh, named by its vertices.
using Edge = std::uint64_t;

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return static_cast<Edge>(std::min(a, b)) << 32 | std::max(a, b);
}

/// The segment a plane leaves of a triangle: from one of its edges to another.
struct Segment {
  Edge from = 0;
  Edge to = 0;
  bool used = false;
};

/// The segments that end on an edge, in the order of the triangles.
struct Ends {
  std::vector<std::size_t> segments;
  std::size_t first = 0;  ///< all before are used
};

struct HashPoint {
  std::size_t operator()(Point3 p) const {
    std::size_t hash = 0;
    for (const double v : {p.x, p.y, p.z})
      hash = hash * 1000003 + std::hash<double>()(v);  // 0 and -0 alike
    return hash;
  }
};

class Section {
 public:
  Section(const Mesh& mesh, const acquire::Plane& plane, bool on_plane_is_above)
      : mesh_(mesh), plane_(plane), on_plane_is_above_(on_plane_is_above) {
    height_.reserve(mesh.points.size());
    for (const Point3 p : mesh.points) height_.push_back(acquire::distance_from_plane(plane, p));
    for (const auto& triangle : mesh.triangles) cut(triangle);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      at_[segments_[i].from].segments.push_back(i);
      at_[segments_[i].to].segments.push_back(i);
    }
  }

  std::vector<SectionLine> lines() {
    // Open lines first, from their ends: the rest are loops.
    for (const bool ends : {true, false})
      for (Segment& segment : segments_)
        for (const Edge start : {segment.from, segment.to}) {
          if (segment.used || (ends && at_[start].segments.size() == 2)) continue;
          add_line(start);
        }
    std::vector<double> length;
    std::vector<std::size_t> order;
    for (const SectionLine& line : found_) {
      order.push_back(order.size());
      double sum = 0;
      for (std::size_t i = 1; i < line.points.size(); ++i)
        sum += distance(line.points[i - 1], line.points[i]);
      length.push_back(sum);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    std::vector<SectionLine> sorted;
    for (const std::size_t i : order) sorted.push_back(std::move(found_[i]));
    return sorted;
  }

 private:
  bool is_above(std::uint32_t vertex) const {
    return height_[vertex] > 0 || (on_plane_is_above_ && height_[vertex] == 0);
  }

  void cut(const std::array<std::uint32_t, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    std::array<Edge, 2> crossed{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (!std::isfinite(height_[a])) return;
      if (is_above(a) != is_above(b) && count < 2)
        crossed[count++] = edge_of(first_at(a), first_at(b));
    }
    if (count == 2) segments_.push_back({crossed[0], crossed[1]});
  }

  /// The first vertex met at the place of this one: many files repeat vertices face by face.
  std::uint32_t first_at(std::uint32_t vertex) {
    return first_.try_emplace(mesh_.points[vertex], vertex).first->second;
  }

  Point2 point_on(Edge edge) const {
    const auto a = static_cast<std::uint32_t>(edge >> 32);
    const auto b = static_cast<std::uint32_t>(edge);
    const double u = height_[a] / (height_[a] - height_[b]);
    return acquire::to_plane(plane_, core::mix(mesh_.points[a], mesh_.points[b], u));
  }

  void add_line(Edge start) {
    SectionLine line;
    line.points.push_back(point_on(start));
    Edge edge = start;
    while (true) {
      auto& [here, first] = at_[edge];
      // Where more than two triangles meet, lines end.
      if (edge != start && here.size() != 2) break;
      while (first < here.size() && segments_[here[first]].used) ++first;
      if (first == here.size()) break;
      Segment& segment = segments_[here[first]];
      segment.used = true;
      edge = segment.from == edge ? segment.to : segment.from;
      const Point2 p = point_on(edge);
      if (p != line.points.back()) line.points.push_back(p);
    }
    line.closed = edge == start && line.points.size() > 2;
    if (line.closed && line.points.back() == line.points.front()) line.points.pop_back();
    if (line.points.size() > 1) found_.push_back(std::move(line));
  }

  const Mesh& mesh_;
  acquire::Plane plane_;
  bool on_plane_is_above_;
  std::vector<double> height_;
  std::vector<Segment> segments_;
  std::unordered_map<Point3, std::uint32_t, HashPoint> first_;
  std::unordered_map<Edge, Ends> at_;
  std::vector<SectionLine> found_;
};

}  // namespace

std::vector<SectionLine> section(const Mesh& mesh, const acquire::Plane& plane) {
  for (const bool on_plane_is_above : {true, false})
    if (auto lines = Section(mesh, plane, on_plane_is_above).lines(); !lines.empty()) return lines;
  return {};
}

bool is_mesh_file(const std::filesystem::path& file) {
  return format_of(file, head_of(file).value_or("")) == Format::mesh;
}

core::Result<Mesh> read_mesh(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargest = std::uintmax_t{4} << 30;
  const auto content = read_file(file, kLargest);
  if (!content) return std::unexpected(content.error());
  const std::string extension = telling_extension(file, std::string_view(*content).substr(0, 1024));
  auto mesh = extension == ".obj"   ? read_obj(*content)
              : extension == ".stl" ? read_stl(*content)
                                    : read_ply(*content);
  if (!mesh) return std::unexpected(in_file(mesh.error(), file.string()));
  if (mesh->points.empty())
    return core::fail(core::ErrorCode::bad_input, "the file holds no points",
                      "give a mesh or cloud", file.string());
  return mesh;
}

}  // namespace keyline::exchange
