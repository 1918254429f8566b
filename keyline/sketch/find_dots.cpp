#include "keyline/sketch/find_dots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "keyline/core/disjoint_sets.h"
#include "keyline/core/point.h"
#include "keyline/sketch/ink_piece.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kRound = 2;  ///< times as long as broad: no dot is longer

/// A piece of a picture with rows of `width` pixels as a dot, where it is one.
std::optional<GraphDot> dot_of(std::span<const std::size_t> piece, int width) {
  const Dash shape = dash_of(piece, 0, static_cast<std::size_t>(width));
  const auto area = static_cast<double>(piece.size());
  if (shape.length > kRound * area / shape.length + kGrid) return {};
  return GraphDot{shape.middle, std::sqrt(area / std::numbers::pi), {}};
}

/// Edges that hang together.
std::vector<std::vector<int>> pieces_of(const StrokeGraph& graph) {
  core::DisjointSets nodes(graph.nodes.size());
  for (const GraphEdge& e : graph.edges)
    if (e.alive && e.from >= 0)
      nodes.join(static_cast<std::size_t>(e.from), static_cast<std::size_t>(e.to));
  std::vector<std::vector<int>> all(graph.nodes.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& e = graph.edges[i];
    if (!e.alive) continue;
    if (e.from >= 0)
      all[nodes.find(static_cast<std::size_t>(e.from))].push_back(static_cast<int>(i));
    else if (e.points.size() == 1)
      all.push_back({static_cast<int>(i)});
  }
  std::erase_if(all, [](const std::vector<int>& piece) { return piece.empty(); });
  return all;
}

/// The pixels of the ink that a place is on; none where it reaches farther than `most` from there.
std::vector<std::size_t> ink_about(const Binary& ink, Point2 at, int most) {
  const int left = static_cast<int>(std::floor(at.x)) - most;
  const int top = static_cast<int>(std::floor(at.y)) - most;
  Binary seen(2 * most + 1, 2 * most + 1);
  std::vector<std::size_t> piece;
  bool inside = true;
  const auto take = [&](int x, int y) {
    if (!ink.at(x, y)) return false;
    inside = inside && seen.contains(x - left, y - top);
    return inside && std::exchange(seen.at(x - left, y - top), 1) == 0;
  };
  const int x = left + most;
  const int y = top + most;
  if (ink.contains(x, y) && take(x, y)) piece.push_back(ink.index(x, y));
  follow_piece(ink, true, piece, take, [&](int, int) { return inside; });
  if (!inside) piece.clear();
  return piece;
}

}  // namespace

void find_dots(const Binary& ink, const InkPieces& left_out, StrokeGraph& graph) {
  for (std::size_t k = 0; k < left_out.size(); ++k)
    if (const auto dot = dot_of(left_out[k], ink.width)) graph.dots.push_back(*dot);
  for (std::vector<int>& piece : pieces_of(graph)) {
    double length = 0;
    double radius = 0;
    for (const int e : piece) {
      const GraphEdge& edge = graph.edges[static_cast<std::size_t>(e)];
      length += length_of(edge);
      for (const float r : edge.radii) radius = std::max(radius, r + kGrid);
    }
    if (length > 4 * kRound * radius) continue;  // a fork at either end makes it longer
    const Point2 on = graph.edges[static_cast<std::size_t>(piece.front())].points.front();
    const auto pixels = ink_about(ink, on, static_cast<int>(2 * kRound * radius));
    if (pixels.empty()) continue;
    if (auto dot = dot_of(pixels, ink.width)) {
      dot->edges = std::move(piece);
      graph.dots.push_back(std::move(*dot));
    }
  }
}

}  // namespace keyline::sketch
