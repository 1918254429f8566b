#include "keyline/classa/deviation.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/classa/free_form.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/polyline.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

using core::Point2;
using curve::Bezier2;

TEST(Deviation, ClosedForms) {
  const Bezier2 bow{{{0, 0}, {1, 0.6}, {2, 0}}, {}};  // highest at 0.3
  const std::vector<Bezier2> chord{{{{0, 0}, {2, 0}}, {}}};
  const double bound = deviation_bound(chord, bow, 0.301);
  EXPECT_GE(bound, 0.3);
  EXPECT_LE(bound, 0.301);
  // Itself, cut in pieces and raised in degree.
  const auto [head, tail] = split(bow, 0.3);
  EXPECT_LT(deviation_bound(std::vector{head, elevate_degree(tail, 3)}, bow, 1e-12), 1e-9);
}

TEST(Deviation, HoldsBetweenAnySamples) {
  numeric::Random random(7);
  for (int k = 0; k < 30; ++k) {
    Bezier2 q;
    for (int i = 0; i < 6; ++i)
      q.control.push_back({1.0 * i + random.uniform(-0.3, 0.3), random.uniform(-1, 1)});
    Bezier2 near = elevate_degree(q, 2);
    for (std::size_t i = 1; i + 1 < near.control.size(); ++i)
      near.control[i] = near.control[i] + core::Vector2{0, random.uniform(-0.02, 0.02)};
    const auto [head, tail] = split(near, random.uniform(0.2, 0.8));
    double sampled = 0;
    for (int i = 0; i <= 500; ++i)
      sampled = std::max(sampled, closest_point(q, evaluate(near, i / 500.0)).distance);
    const double bound = deviation_bound(std::vector{head, tail}, q, 1.02 * sampled);
    EXPECT_GE(bound, sampled * (1 - 1e-12)) << k;
    EXPECT_LE(bound, 1.1 * sampled) << k;
  }
}

/// Twelve times as many samples as the fit has find nothing beyond it.
TEST(FreeForm, DeviationIsABoundNotASample) {
  curve::BSpline2 arch{3, {0, 0, 0, 0, 0.35, 0.7, 1, 1, 1, 1}, {}, {}};
  for (const Point2 p : {Point2{0, 0}, {1, 0.9}, {2.2, 1.3}, {3.1, 1.2}, {4, 0.8}, {4.5, 0}})
    arch.control.push_back(p);
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const auto a = approximate(curve::PlanarView(arch), tolerance);
    ASSERT_TRUE(a) << a.error().message;
    double sampled = 0;
    for (int i = 0; i <= 5000; ++i)
      sampled = std::max(sampled, closest_point(a->curve, evaluate(arch, i / 5000.0)).distance);
    EXPECT_LE(sampled, a->deviation);
    EXPECT_LE(a->deviation, tolerance);
    EXPECT_LE(a->deviation, 1.05 * sampled + 0.04 * tolerance);
  }
}

TEST(FreeForm, PiecesCarryTheirOwnShare) {
  const curve::Polyline2 line{{{0, 0}, {1, 0.05}, {2, 0.2}, {3, 0.45}}};
  const PiecesWithin pieces = [&](double) -> core::Result<curve::PiecewiseBezier> {
    curve::PiecewiseBezier row{{}, 0.001};
    for (std::size_t i = 1; i < line.points.size(); ++i)
      row.pieces.push_back({{line.points[i - 1], line.points[i]}, {}});
    return row;
  };
  const auto without = approximate(curve::PlanarView(line), 0.1);
  const auto with = approximate(curve::PlanarView(line), 0.1, pieces);
  ASSERT_TRUE(without && with);
  EXPECT_NEAR(with->deviation, without->deviation + 0.001, 0.002);
}

}  // namespace
}  // namespace keyline::classa
