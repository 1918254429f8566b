#include "keyline/figure/label_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline::figure {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kCell = 3;  ///< of the page: what is smaller is not seen
constexpr std::uint8_t kLine = 1;
constexpr std::uint8_t kLabel = 2;

constexpr double kGap = 2;  ///< between a label and what it names
/// Steps away, in heights of the label, that are tried one after the other.
constexpr std::array kSteps = {0.0, 1.0, 2.0, 3.5, 5.0, 8.0, 12.0, 18.0};
constexpr double kNear = 1;  ///< of them: no leader is needed

// what is worse: a box full of lines is worth so many steps, and so many points farther on
constexpr double kLinesWeigh = 3;
constexpr double kLaterWeighs = 0.15;

/// Ways out, the ones that read best first; along one axis each clears what is named.
constexpr std::array<Vector2, 16> kSides = {
    Vector2{1, -1}, {-1, -1},   {1, 1},   {-1, 1},   {1, 0},    {-1, 0},    {0, -1},  {0, 1},
    {1, -0.4},      {-1, -0.4}, {1, 0.4}, {-1, 0.4}, {0.4, -1}, {-0.4, -1}, {0.4, 1}, {-0.4, 1}};

}  // namespace

LabelPlaces::LabelPlaces(double width, double height)
    : columns_(static_cast<int>(std::ceil(width / kCell))),
      rows_(static_cast<int>(std::ceil(height / kCell))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void LabelPlaces::avoid(const std::vector<Point2>& line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int steps = 1 + static_cast<int>(core::distance(line[i], line[i + 1]) / kCell);
    for (int k = 0; k <= steps; ++k) {
      const Point2 p = core::mix(line[i], line[i + 1], static_cast<double>(k) / steps);
      const double x = std::floor(p.x / kCell);
      const double y = std::floor(p.y / kCell);
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(x)] |= kLine;
    }
  }
}

/// Calls see(cell) for the cells of a box, see(nullopt) for those beyond the page.
template <class See>
void LabelPlaces::visit(Point2 middle, double width, double height, const See& see) const {
  const auto cell = [](double v) { return static_cast<int>(std::floor(v / kCell)); };
  for (int y = cell(middle.y - 0.5 * height); y <= cell(middle.y + 0.5 * height); ++y)
    for (int x = cell(middle.x - 0.5 * width); x <= cell(middle.x + 0.5 * width); ++x) {
      const bool inside = x >= 0 && y >= 0 && x < columns_ && y < rows_;
      see(inside ? std::optional(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(x))
                 : std::nullopt);
    }
}

LabelPlaces::Cover LabelPlaces::cover(Point2 middle, double width, double height) const {
  Cover sum;
  double count = 0;
  visit(middle, width, height, [&](std::optional<std::size_t> cell) {
    ++count;
    if (!cell || cells_[*cell] & kLabel) ++sum.labels;
    if (cell && cells_[*cell] & kLine) ++sum.lines;
  });
  return {sum.lines / count, sum.labels / count};
}

LabelPlaces::Place LabelPlaces::take(const std::vector<Point2>& beside, double width,
                                     double height) {
  Place best{beside.front(), beside.front()};
  double least = HUGE_VAL;
  const double full = 1000;  // any cover of labels is worse than none
  for (std::size_t i = 0; i < beside.size(); ++i)
    for (const double step : kSteps) {
      const double so_far = step + kLaterWeighs * static_cast<double>(i);
      if (so_far >= least) break;
      for (const Vector2 side : kSides) {
        const Vector2 way{side.x * (0.5 * width + kGap + step * height),
                          side.y * (0.5 * height + kGap + step * height)};
        const Cover covered = cover(beside[i] + way, width, height);
        const double cost = so_far + kLinesWeigh * covered.lines +
                            (covered.labels > 0 ? full * (1 + covered.labels) : 0);
        if (cost >= least) continue;
        least = cost;
        best = {beside[i] + way, beside[i], step > kNear, covered.labels > 0};
      }
    }
  visit(best.middle, width, height, [&](std::optional<std::size_t> cell) {
    if (cell) cells_[*cell] |= kLabel;
  });
  return best;
}

}  // namespace keyline::figure
