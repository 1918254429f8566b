#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/conversion.h"
#include "keyline/curve/length.h"
#include "keyline/curve/monotone.h"

/// Random searches for a curve that breaks a law.
namespace keyline::curve {
namespace {

using core::Point2;

/// In [low, high], often at the ends or next to a round value.
double draw(double low, double high) {
  const int raw = *rc::gen::inRange(0, 1000001);
  const int nudge = *rc::gen::weightedElement<int>({{8, 0}, {1, 1}, {1, -1}});
  const double u = raw / 1e6 + nudge * 1e-15;
  return low + (high - low) * std::clamp(u, 0.0, 1.0);
}

Bezier2 draw_bezier(int max_degree) {
  Bezier2 c;
  const int degree = *rc::gen::inRange(1, max_degree + 1);
  const bool rational = *rc::gen::arbitrary<bool>();
  for (int i = 0; i <= degree; ++i) {
    c.control.push_back({draw(-10, 10), draw(-10, 10)});
    if (rational) c.weights.push_back(draw(0.1, 5));
  }
  return c;
}

/// Clamped spline with knots as close or as multiple as chance wants.
BSpline2 draw_spline() {
  BSpline2 c;
  c.degree = *rc::gen::inRange(1, 6);
  const int inner = *rc::gen::inRange(0, 8);
  std::vector<double> knots;
  for (int i = 0; i < inner; ++i) {
    const double u = draw(0, 1);
    if (u > 1e-3 && u < 1 - 1e-3 && std::count(knots.begin(), knots.end(), u) < c.degree)
      knots.push_back(u);
  }
  std::sort(knots.begin(), knots.end());
  c.knots.assign(c.degree + 1, 0.0);
  c.knots.insert(c.knots.end(), knots.begin(), knots.end());
  c.knots.insert(c.knots.end(), c.degree + 1, 1.0);
  for (std::size_t i = 0; i + c.degree + 1 < c.knots.size(); ++i)
    c.control.push_back({draw(-10, 10), draw(-10, 10)});
  return c;
}

void law(const char* name, const std::function<void()>& body) {
  rc::detail::TestParams params;
  params.seed = 20240229;
  params.maxSuccess = 100;
  const auto result = rc::detail::checkTestable(body, rc::detail::TestMetadata{name, ""}, params);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << name;
}

TEST(Laws, SubdivisionAndElevationKeepBeziers) {
  law("bezier", [] {
    const Bezier2 c = draw_bezier(12);
    const double cut = draw(0, 1);
    const double t = draw(0, 1);
    const auto [a, b] = split(c, cut);
    RC_ASSERT(distance(evaluate(a, t), evaluate(c, cut * t)) < 1e-12);
    RC_ASSERT(distance(evaluate(b, t), evaluate(c, cut + (1 - cut) * t)) < 1e-12);
    RC_ASSERT(distance(evaluate(elevate_degree(c, 2), t), evaluate(c, t)) < 1e-12);
  });
}

TEST(Laws, RefinementKeepsSplines) {
  law("spline", [] {
    const BSpline2 c = draw_spline();
    RC_ASSERT(validate(c).has_value());
    const double t = draw(0, 1);
    const Point2 p = evaluate(c, t);
    const double u = draw(0, 1);
    if (u > 0 && u < 1 && std::count(c.knots.begin(), c.knots.end(), u) <= c.degree)
      RC_ASSERT(distance(evaluate(insert_knot(c, u), t), p) < 1e-10);
    RC_ASSERT(distance(evaluate(elevate_degree(c), t), p) < 1e-9);
    const auto joined = to_bspline(to_beziers(c), 1e-12);
    RC_ASSERT(joined.has_value());
    RC_ASSERT(closest_point(*joined, p).distance < 1e-10);
  });
}

TEST(Laws, LengthIsBetweenChordAndPolygon) {
  law("length", [] {
    const Bezier2 c = draw_bezier(8);
    double polygon = 0;
    for (std::size_t i = 1; i < c.control.size(); ++i)
      polygon += distance(c.control[i - 1], c.control[i]);
    const double length = arc_length(c, 0, 1, 1e-10);
    RC_ASSERT(length <= polygon * (1 + 1e-9));
    RC_ASSERT(length >= distance(c.control.front(), c.control.back()) * (1 - 1e-9));
    const double t = parameter_at_length(c, 0.3 * length, 1e-10);
    RC_ASSERT(std::abs(arc_length(c, 0, t, 1e-10) - 0.3 * length) <= 1e-8 * (length + 1e-300));
  });
}

TEST(Laws, VerdictSurvivesSubdivision) {
  law("monotone", [] {
    const Bezier2 c = draw_bezier(6);
    const auto whole = certify_monotone_curvature(c);
    const auto part = certify_monotone_curvature(subcurve(c, 0.25, 0.5));
    if (whole.answer == MonotoneVerdict::yes) RC_ASSERT(part.answer != MonotoneVerdict::no);
  });
}

}  // namespace
}  // namespace keyline::curve
