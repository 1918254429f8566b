#include "keyline/sketch/meet_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "keyline/numeric/solve.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {
namespace {

using core::cross;
using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kReach = 2.5;    ///< widths an end is lengthened at most
constexpr double kBack = 1.0;     ///< widths it is shortened at most
constexpr double kTail = 6;       ///< widths that a line may go on beyond the one it meets
constexpr double kBorder = 0.25;  ///< pixels within the ink's border
constexpr double kClear = 0.25;   ///< pixels that ink has to lie off another line's to be a tail
constexpr double kArm = 30;       ///< pixels of a line, or six widths, that tell how it goes on

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

/// How a stroke goes on beyond its end: as the parabola through its last reach of line does, what
/// lies in the junction left out.
class Onward {
 public:
  Onward(const std::vector<Point2>& points, double width) {
    const auto skip = static_cast<std::size_t>(2 * width + 1);
    const auto reach = static_cast<std::size_t>(std::max(kArm, 6 * width));
    if (points.size() < skip + reach / 2) return;
    const std::size_t last = points.size() - 1 - skip;
    const std::size_t first = last > reach ? last - reach : 0;
    from_ = points[last];
    const Vector2 d = from_ - points[first];
    if (!(core::norm(d) > 0)) return;
    along_ = d / core::norm(d);
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(last - first + 1), 3);
    Eigen::VectorXd beside(rows.rows());
    for (std::size_t k = first; k <= last; ++k) {
      const auto row = static_cast<Eigen::Index>(k - first);
      const double x = dot(along_, points[k] - from_);
      rows.row(row) << 1, x, x * x;
      beside[row] = cross(along_, points[k] - from_);
    }
    parabola_ = numeric::least_squares(rows, beside);
  }

  explicit operator bool() const { return parabola_.size() > 0; }
  double ahead(Point2 p) const { return dot(along_, p - from_); }
  Point2 at(double x) const {
    const double y = parabola_[0] + x * (parabola_[1] + x * parabola_[2]);
    return from_ + x * along_ + y * core::perpendicular_left(along_);
  }

 private:
  Point2 from_;
  Vector2 along_;
  Eigen::VectorXd parabola_;
};

class Ends {
 public:
  Ends(std::vector<FineStroke>& strokes, const Refiner& refiner, bool ragged)
      : strokes_(strokes), refiner_(refiner), ragged_(ragged), lines_(strokes.size()) {
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
    if (!go_beyond(grid, i, s.points.back() + way.value_or(0) * *d) && way) stop_at(s, *way, *d);
  }

  void stop_at(FineStroke& s, double way, Vector2 d) {
    const Point2 goal = s.points.back() + way * d;
    while (s.points.size() > 2 && dot(goal - s.points.back(), d) < 0.5) {
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

  /// Distance from the ink of all strokes but the last part of stroke i's own.
  double off_lines(const StrokeGrid& grid, std::size_t i, Point2 p, double most) const {
    double least = most;
    grid.visit_others(p, most, i, [&](std::size_t j, std::size_t k) {
      least = std::min(least, distance(lines_[j].points[k], p) - 0.5 * strokes_[j].width);
    });
    return least;
  }

  /// Where the pen went on beyond the line that the stroke meets, or ends at, at `goal`, and
  /// stopped before the two inks parted, there is ink ahead that no line accounts for: it ends half
  /// a width before that does, clear of the other line's ink.
  bool go_beyond(const StrokeGrid& grid, std::size_t i, Point2 goal) {
    FineStroke& s = strokes_[i];
    const Onward onward(s.points, s.width);
    if (ragged_ || !onward) return false;
    const double start = onward.ahead(goal);
    const double ink = 0.5 * refiner_.darkness(onward.at(start));
    double x = start;
    while (x < start + kTail * s.width && refiner_.darkness(onward.at(x)) > ink) x += 0.25;
    const double end = x - 0.5 * s.width;
    if (x >= start + kTail * s.width || end <= start) return false;
    if (off_lines(grid, i, onward.at(x - kBorder), 0.5 * s.width + 2) < kClear) return false;
    while (s.points.size() > 2 && onward.ahead(s.points.back()) > 0) {
      s.points.pop_back();
      s.widths.pop_back();
    }
    const int steps = std::max(1, static_cast<int>(std::lround(end)));
    for (int k = 1; k <= steps; ++k) {
      s.points.push_back(onward.at(end * k / steps));
      s.widths.push_back(s.widths.back());
    }
    return true;
  }

  std::vector<FineStroke>& strokes_;
  const Refiner& refiner_;
  bool ragged_;
  std::vector<SampledStroke> lines_;
  double cell_ = 1;
};

}  // namespace

void end_on_lines(std::vector<FineStroke>& strokes, const Refiner& refiner, bool ragged) {
  Ends(strokes, refiner, ragged).meet();
}

}  // namespace keyline::sketch
