#include "keyline/figure/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "keyline/core/error.h"

namespace keyline::figure {

using core::Point2;

namespace {

/// Segments between edges of the grid; every edge has at most one neighbour in each of its two
/// cells. Edge 2k leads from node k to the right, edge 2k + 1 upwards.
class Tracer {
 public:
  Tracer(const Grid& grid, double level) : grid_(grid), level_(level) {
    for (int row = 0; row + 1 < grid.rows; ++row)
      for (int column = 0; column + 1 < grid.columns; ++column) add_cell(column, row);
  }

  std::vector<std::vector<Point2>> lines() {
    std::vector<std::vector<Point2>> all;
    for (const bool open_ends : {true, false})
      for (auto& [edge, ends] : links_)
        if (ends[0] >= 0 && (!open_ends || ends[1] < 0)) all.push_back(walk(edge));
    return all;
  }

 private:
  using Edge = long long;

  Edge node(int column, int row) const { return Edge{row} * grid_.columns + column; }
  double value(Edge at) const { return grid_.values[static_cast<std::size_t>(at)]; }

  void add_cell(int column, int row) {
    const std::array<Edge, 4> corner = {node(column, row), node(column + 1, row),
                                        node(column + 1, row + 1), node(column, row + 1)};
    std::array<bool, 4> above{};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!std::isfinite(value(corner[i]))) return;
      above[i] = value(corner[i]) >= level_;
      sum += value(corner[i]) / 4;
    }
    // Edges of the cell: bottom, right, top, left; edge i joins corners i and i + 1.
    const std::array<Edge, 4> edge = {2 * corner[0], 2 * corner[1] + 1, 2 * corner[3],
                                      2 * corner[0] + 1};
    std::array<std::size_t, 4> crossed{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (above[i] != above[(i + 1) % 4]) crossed[count++] = i;
    if (count == 2) link(edge[crossed[0]], edge[crossed[1]]);
    if (count != 4) return;
    // At a saddle the corners that agree with the middle are joined.
    const bool joins_first = (sum >= level_) == above[0];
    link(edge[0], edge[joins_first ? 1 : 3]);
    link(edge[2], edge[joins_first ? 3 : 1]);
  }

  void link(Edge a, Edge b) {
    const auto add = [this](Edge from, Edge to) {
      auto& ends = links_.try_emplace(from, std::array<Edge, 2>{-1, -1}).first->second;
      ends[ends[0] < 0 ? 0 : 1] = to;
    };
    add(a, b);
    add(b, a);
  }

  /// Takes a link away and returns the edge it led to, -1 where there is none.
  Edge take(Edge from) {
    auto& ends = links_.at(from);
    const Edge to = ends[0];
    if (to < 0) return -1;
    ends = {ends[1], -1};
    auto& back = links_.at(to);
    if (back[0] == from) back[0] = back[1];
    back[1] = -1;
    return to;
  }

  std::vector<Point2> walk(Edge start) {
    std::vector<Point2> line{point_on(start)};
    for (Edge edge = take(start); edge >= 0; edge = take(edge)) line.push_back(point_on(edge));
    return line;
  }

  Point2 place(Edge at) const {
    const Edge column = at % grid_.columns;
    const Edge row = at / grid_.columns;
    const double u = static_cast<double>(column) / (grid_.columns - 1);
    const double v = static_cast<double>(row) / (grid_.rows - 1);
    return {(1 - u) * grid_.low.x + u * grid_.high.x, (1 - v) * grid_.low.y + v * grid_.high.y};
  }

  Point2 point_on(Edge edge) const {
    const Edge a = edge / 2;
    const Edge b = edge % 2 == 0 ? a + 1 : a + grid_.columns;
    const double u = (level_ - value(a)) / (value(b) - value(a));
    return core::mix(place(a), place(b), std::isfinite(u) ? std::clamp(u, 0.0, 1.0) : 0.5);
  }

  const Grid& grid_;
  double level_;
  std::map<Edge, std::array<Edge, 2>> links_;
};

}  // namespace

std::vector<std::vector<Point2>> contour_lines(const Grid& grid, double level) {
  if (grid.columns < 2 || grid.rows < 2 ||
      grid.values.size() !=
          static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows))
    throw core::InvalidInput("contour_lines: the grid's counts do not agree");
  return Tracer(grid, level).lines();
}

std::vector<double> even_levels(const Grid& grid, int count) {
  std::vector<double> values = grid.values;
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  std::vector<double> levels;
  for (int i = 1; i <= count && !values.empty(); ++i) {
    const double place = static_cast<double>(values.size() - 1) * i / (count + 1);
    levels.push_back(values[static_cast<std::size_t>(place)]);
  }
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

}  // namespace keyline::figure
