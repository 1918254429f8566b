#include "keyline/fairing/fairness.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/fair.h"

namespace keyline::fairing {
namespace {

/// The loop of Descartes' folium, by the angle from 0 to a right one; both ends are its node, where
/// they meet at a right angle.
core::Point2 on_folium(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double radius = 3 * s * c / (s * s * s + c * c * c);
  return {radius * c, radius * s};
}

constexpr double kRight = std::numbers::pi / 2;

acquire::KeyLine folium(int count, int corner) {
  acquire::KeyLine line;
  line.closed = true;
  line.corners = {static_cast<std::size_t>(corner)};
  for (int i = 0; i < count; ++i)
    line.points.push_back(on_folium(kRight * ((i - corner + count) % count) / count));
  for (int i = 0; i < count; ++i)
    line.length += core::distance(line.points[i], line.points[(i + 1) % count]);
  return line;
}

/// L^3 times the integral of (d curvature / ds)^2 of the loop, by differences of its closed form.
double variation_of_folium() {
  constexpr int n = 4000;
  const double h = kRight / n;
  std::vector<double> curvature;
  std::vector<double> at{0};
  for (int i = 1; i < n; ++i) {
    const core::Point2 a = on_folium(h * (i - 1));
    const core::Point2 b = on_folium(h * i);
    const core::Point2 c = on_folium(h * (i + 1));
    const double sides = core::distance(a, b) * core::distance(b, c) * core::distance(a, c);
    curvature.push_back(2 * core::cross(b - a, c - a) / sides);  // of the circle through three
    at.push_back(at.back() + core::distance(b, c));
  }
  double sum = 0;
  for (int i = 1; i + 1 < n; ++i)
    sum += std::pow(curvature[i] - curvature[i - 1], 2) / (at[i + 1] - at[i]);
  return sum * std::pow(at.back(), 3);
}

// A spline that is closed through the corner has to round it within the tolerance, with a spike of
// curvature that no answer with a corner would be worse than.
TEST(FairFigures, TheSplineToCompareWithStaysOpenAtACorner) {
  for (const int corner : {0, 37}) {
    SCOPED_TRACE(corner);
    const acquire::KeyLine line = folium(120, corner);
    FairResult answer;  // any open chain: only that it is open counts
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, line.length, 0.1, 0.2}}});
    answer.closed = true;
    answer.tolerance = 1e-4 * line.length;
    const FairFigures figures = fair_figures(line, answer);
    ASSERT_TRUE(figures.smoothing_spline);
    EXPECT_LE(figures.smoothing_spline->energy, 1.2 * variation_of_folium());
    EXPECT_GE(figures.smoothing_spline->energy, 0.5 * variation_of_folium());
  }
}

}  // namespace
}  // namespace keyline::fairing
