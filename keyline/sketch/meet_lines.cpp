#include "keyline/sketch/meet_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {
namespace {

using core::cross;
using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kReach = 2.5;  ///< widths an end is lengthened at most
constexpr double kBack = 1.0;   ///< widths it is shortened at most

/// Where the end of a stroke points: from some two widths before it.
std::optional<Vector2> end_direction(const std::vector<Point2>& points, double width) {
  const auto back = static_cast<std::size_t>(std::clamp(2 * width, 4.0, 24.0));
  if (points.size() < back + 2) return std::nullopt;
  const Vector2 d = points.back() - points[points.size() - 1 - back];
  const double length = core::norm(d);
  if (!(length > 0)) return std::nullopt;
  return d / length;
}

/// Way along d from p to the line from q to r; empty where it passes beside.
std::optional<double> way_to(Point2 p, Vector2 d, Point2 q, Point2 r) {
  const Vector2 edge = r - q;
  const double turn = cross(d, edge);
  if (std::abs(turn) < 1e-9) return std::nullopt;
  const double along = cross(q - p, d) / turn;
  if (along < 0 || along > 1) return std::nullopt;
  return cross(q - p, edge) / turn;
}

class Ends {
 public:
  explicit Ends(std::vector<FineStroke>& strokes) : strokes_(strokes), lines_(strokes.size()) {
    double widest = 1;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      lines_[i].points = strokes[i].points;
      widest = std::max(widest, strokes[i].width);
    }
    cell_ = kReach * widest + 2;
  }

  void meet() {
    const StrokeGrid grid(lines_, cell_);
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      FineStroke& s = strokes_[i];
      if (s.closed) continue;
      if (!s.free_end) move_end(grid, i, false);
      if (s.free_start) continue;
      std::reverse(s.points.begin(), s.points.end());
      std::reverse(s.widths.begin(), s.widths.end());
      move_end(grid, i, true);
      std::reverse(s.points.begin(), s.points.end());
      std::reverse(s.widths.begin(), s.widths.end());
    }
  }

 private:
  /// The nearest meeting with a stroke on the way of the end of stroke i; a stroke meets itself
  /// only away from that end.
  std::optional<double> nearest(const StrokeGrid& grid, std::size_t i, bool reversed,
                                Vector2 d) const {
    const FineStroke& s = strokes_[i];
    const Point2 p = s.points.back();
    const double reach = std::min(kReach * s.width + 2, cell_);
    const auto own = static_cast<std::size_t>(4 * s.width + 8);
    std::optional<double> best;
    grid.visit(p, reach, [&](std::size_t j, std::size_t k) {
      const std::vector<Point2>& line = lines_[j].points;
      if (k + 1 >= line.size()) return;
      if (j == i && (reversed ? k : line.size() - 1 - k) < own) return;
      const auto way = way_to(p, d, line[k], line[k + 1]);
      if (!way || *way > kReach * s.width || *way < -kBack * s.width) return;
      if (!best || std::abs(*way) < std::abs(*best)) best = way;
    });
    return best;
  }

  void move_end(const StrokeGrid& grid, std::size_t i, bool reversed) {
    FineStroke& s = strokes_[i];
    const auto d = end_direction(s.points, s.width);
    if (!d) return;
    const auto way = nearest(grid, i, reversed, *d);
    if (!way) return;
    const Point2 goal = s.points.back() + *way * *d;
    while (s.points.size() > 2 && dot(goal - s.points.back(), *d) < 0.5) {
      s.points.pop_back();
      s.widths.pop_back();
    }
    const Point2 from = s.points.back();
    const int steps = std::max(1, static_cast<int>(distance(from, goal)));
    for (int k = 1; k <= steps; ++k) {
      s.points.push_back(core::mix(from, goal, static_cast<double>(k) / steps));
      s.widths.push_back(s.widths.back());
    }
  }

  std::vector<FineStroke>& strokes_;
  std::vector<SampledStroke> lines_;
  double cell_ = 1;
};

}  // namespace

void end_on_lines(std::vector<FineStroke>& strokes) { Ends(strokes).meet(); }

}  // namespace keyline::sketch
