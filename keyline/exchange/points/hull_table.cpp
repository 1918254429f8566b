#include "keyline/exchange/points/hull_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/text.h"

namespace keyline::exchange {
namespace {

using core::Point3;

/// Puts points that follow each other on the hull into curves.
class Lines {
 public:
  explicit Lines(document::Document& document) : document_(document) {}

  void add(const std::string& name, const std::string& layer, std::vector<Point3> points) {
    trim(points);
    std::reverse(points.begin(), points.end());
    trim(points);
    std::reverse(points.begin(), points.end());
    if (points.size() < 2) {
      ++short_;
      return;
    }
    document_.space_curves.push_back(
        {{name, layer, {}}, {curve::Polyline3{std::move(points)}}, true});
  }

  void finish() {
    if (short_ > 0)
      document_.skipped.push_back(core::counted(static_cast<std::size_t>(short_), "line") +
                                  " of fewer than two points");
  }

 private:
  /// Of points with no breadth at the end all but the innermost go.
  static void trim(std::vector<Point3>& points) {
    while (points.size() > 1 && points.back().y == 0 && points[points.size() - 2].y == 0)
      points.pop_back();
  }

  document::Document& document_;
  int short_ = 0;
};

/// Height at which a station first reaches a half-breadth from below.
std::optional<double> height_at(const HullTable& hull, std::size_t station, double breadth) {
  const std::size_t n = hull.stations.size();
  for (std::size_t i = 1; i < hull.waterlines.size(); ++i) {
    const double a = hull.half_breadth[(i - 1) * n + station];
    const double b = hull.half_breadth[i * n + station];
    if (!(a < breadth && b >= breadth)) continue;
    const double u = (breadth - a) / (b - a);
    return hull.waterlines[i - 1] + u * (hull.waterlines[i] - hull.waterlines[i - 1]);
  }
  return std::nullopt;
}

}  // namespace

document::Document hull_document(const HullTable& hull) {
  document::Document document;
  document.unit = hull.unit;
  document.skipped = hull.left_out;
  Lines lines(document);
  const std::size_t n = hull.stations.size();
  double widest = 0;
  const auto take = [&](std::vector<Point3>& points, std::size_t i, std::size_t k) {
    const double y = hull.half_breadth[i * n + k];
    if (!std::isfinite(y)) return;
    widest = std::max(widest, y);
    points.push_back({hull.stations[k], y, hull.waterlines[i]});
  };
  for (std::size_t i = 0; i < hull.waterlines.size(); ++i) {
    std::vector<Point3> points;
    for (std::size_t k = 0; k < n; ++k) take(points, i, k);
    lines.add("waterline-" + std::to_string(i + 1), "waterlines", std::move(points));
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < hull.waterlines.size(); ++i) take(points, i, k);
    lines.add("station-" + std::to_string(k + 1), "stations", std::move(points));
  }
  for (int quarter = 1; quarter <= 3; ++quarter) {
    const double y = widest * quarter / 4;
    std::vector<Point3> points;
    for (std::size_t k = 0; k < n; ++k)
      if (const auto z = height_at(hull, k, y)) points.push_back({hull.stations[k], y, *z});
    lines.add("buttock-" + std::to_string(quarter), "buttocks", std::move(points));
  }
  lines.finish();
  return document;
}

}  // namespace keyline::exchange
