#include "keyline/operations/subject.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/core/angle.h"
#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using core::Point2;
using nlohmann::json;

/// A quarter of a circle from the direction, as a cubic (its radius off by 2.7e-4), and where it
/// ends.
curve::Bezier2 quarter(Point2 from, double direction, double radius) {
  const double handle = 4.0 / 3 * (std::sqrt(2.0) - 1) * radius;
  const core::Vector2 t{std::cos(direction), std::sin(direction)}, n{-t.y, t.x};
  const Point2 to = from + radius * (t + n);
  return {{from, from + handle * t, to - handle * n, to}, {}};
}

/// Quarters of radius 40 and of `radius` that meet in a kink of so many degrees, and a smooth one
/// of `third` beyond.
std::size_t corners(double radius, double degrees, double tolerance, double third) {
  const double turned = core::kPi / 2 + degrees * core::kPi / 180;
  document::Path path;
  path.curves.push_back({quarter({0, 0}, 0, 40)});
  const curve::Bezier2 next = quarter({40, 40}, turned, radius);
  path.curves.push_back({next});
  path.curves.push_back({quarter(next.control[3], turned + core::kPi / 2, third)});
  const auto line = sampled_line(path, tolerance);
  return line ? line->corners.size() : 99;
}

// A kink of t radians is hidden within d where the step of curvature beside it is t^2 / (2 d): of 5
// degrees and 0.4 0.0095, which is that from a radius of 40 to one of 65.
TEST(SampledLine, HasNoCornerWhereAStepOfCurvatureHidesIt) {
  EXPECT_EQ(corners(80, 5, 0.4, 80), 0U);
  EXPECT_EQ(corners(80, -5, 0.4, 80), 0U);
  EXPECT_EQ(corners(55, 5, 0.4, 55), 1U);
  EXPECT_EQ(corners(80, 5, 0.2, 80), 1U);
  EXPECT_EQ(corners(80, 20, 0.4, 80), 1U);
  EXPECT_EQ(corners(80, 5, 0, 80), 1U);  // by default a ten-thousandth of the length, 0.03
}

// Or by an arc of curvature t^2 / (8 d): of 5 degrees and 0.4 0.0024, of 8 degrees 0.0061. A
// fiftieth of the range from a radius of 40 to one of 4 is 0.0045.
TEST(SampledLine, HasNoCornerWhereABendTooSlightForAWaveHidesIt) {
  EXPECT_EQ(corners(40, 5, 0.4, 4), 0U);
  EXPECT_EQ(corners(40, 8, 0.4, 4), 1U);
  EXPECT_EQ(corners(40, 5, 0.4, 40), 1U);
}

TEST(SampledLine, HasACornerBetweenLines) {
  document::Path path;
  path.curves.push_back({curve::Bezier2{{{0, 0}, {10, 0}}, {}}});
  path.curves.push_back({curve::Bezier2{{{10, 0}, {20, 0.5}}, {}}});
  const auto line = sampled_line(path, 0.4);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->corners.size(), 1U);
}

// Four quarters that close within rounding, and the line from there to the start that some programs
// add: it points anywhere, and was taken for two corners with a run of one point between.
TEST(SampledLine, HasNoCornerWhereACircleClosesWithinRounding) {
  document::Path path;
  core::Point2 at{0, 0};
  for (int i = 0; i < 4; ++i) {
    path.curves.push_back({quarter(at, i * core::kPi / 2, 40)});
    at = std::get<curve::Bezier2>(path.curves.back().value).control[3];
  }
  const core::Point2 beside{at.x - 3e-14, at.y + 2e-14};
  path.curves.push_back({curve::Bezier2{{at, beside}, {}}});
  path.closed = true;
  const auto line = sampled_line(path, 0.01);
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->closed);
  EXPECT_EQ(line->corners.size(), 0U);
}

// Through every door, not of files alone: 20,000 cubics took more than three minutes in a batch.
TEST(MeasuredLine, RefusesWhatWouldTakeHours) {
  Subject subject;
  subject.curve.emplace();
  document::Path& path = *subject.curve;
  for (int i = 0; i < 10001; ++i)
    path.curves.push_back({curve::Bezier2{{{1.0 * i, 0}, {i + 0.5, 1}, {i + 1.0, 0}}, {}}});
  const auto refused = measured_line(subject, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, core::ErrorCode::unsupported);
  EXPECT_EQ(refused.error().path, "curve");
  EXPECT_EQ(refused.error().message, "a curve of 10001 spans; at most 10000 at a time");
  path.curves.pop_back();
  EXPECT_TRUE(measured_line(subject, {}));
}

TEST(Refusals, ACurveThatIsOnePointIsNamed) {
  const json point = {{"type", "bezier"}, {"points", {{1, 1}, {1, 1}, {1, 1}, {1, 1}}}};
  for (const json& request :
       {json{{"op", "curve.analyze"}}, json{{"op", "curve.cav"}}, json{{"op", "curve.edit"}},
        json{{"op", "curve.plane"}}, json{{"op", "curve.offset"}, {"distance", 1}},
        json{{"op", "fit.curvature"}, {"target", "smooth"}}}) {
    json asked = request;
    asked["curve"] = point;
    const auto r = perform(request["op"], asked, {});
    ASSERT_FALSE(r) << request;
    EXPECT_EQ(r.error().message, "the curve has no length") << request;
    EXPECT_EQ(r.error().path, "curve") << request;
  }
}

// Beside a weight of 1e9 half of the curve, 6.6 of 11, lies in 3e-5 of its parameter; it was left
// out of the length. Beside 1e20 there was no answer for minutes.
TEST(Refusals, WeightsThatHideTheCurveAreNamed) {
  const json points = {{3.08, 0.15}, {-2.14, -4.46}, {-1.17, -0.92}, {-4.55, -4.51}, {4.99, 1.52}};
  const json bezier = {{"type", "bezier"}, {"points", points}};
  const json spline = {{"type", "bspline"},
                       {"degree", 3},
                       {"knots", {0, 0, 0, 0, 1, 2, 2, 2, 2}},
                       {"points", points}};
  const auto path = [](json curve, const json& weights) {
    curve["weights"] = weights;
    const auto r = perform("curve.analyze", {{"curve", curve}}, {});
    return r ? "answered" : r.error().path;
  };
  for (const json& curve : {bezier, spline}) {
    EXPECT_EQ(path(curve, {1, 1, 1e9, 1, 1}), "curve.weights[2]");
    EXPECT_EQ(path(curve, {1e20, 1, 1, 1, 1}), "curve.weights[0]");
    EXPECT_EQ(path(curve, {1e-9, 1, 1, 2, 1}), "curve.weights[3]");
  }
}

// Nearly half a circle as one conic: the weight between its ends is small, and hides nothing.
TEST(Refusals, ASmallWeightBetweenTheEndsIsMeasured) {
  const double weight = 1e-5, along = std::sqrt(1 - weight * weight);
  const json arc = {{"type", "bezier"},
                    {"points", {{along, weight}, {0, 1 / weight}, {-along, weight}}},
                    {"weights", {1, weight, 1}}};
  const auto r = perform("curve.analyze", {{"curve", arc}}, {});
  ASSERT_TRUE(r);
  EXPECT_NEAR((*r)["length"].get<double>(), 2 * std::acos(weight), 1e-9);
}

TEST(Refusals, NameTheFieldAtFault) {
  const auto path = [](const char* op, const json& request) {
    const auto r = perform(op, request, {});
    return r ? "answered" : r.error().path;
  };
  const json zeros = {0, 0};
  EXPECT_EQ(path("lac.hermite",
                 {{"start", zeros}, {"end", zeros}, {"directions", {0, 1}}, {"alpha", -1}}),
            "end");
  EXPECT_EQ(path("fit.spline", {{"x", {0, 1, 2, 3, 4, 5}}, {"y", {0, 1}}}), "y");
  EXPECT_EQ(path("lac.region", {{"theta", 1}, {"alpha", 1e300}}), "alpha");
  // Squares of distances would be no numbers any more.
  const json far{{"type", "bezier"}, {"points", {zeros, {1, 0}, {2, 1e101}}}};
  EXPECT_EQ(path("curve.analyze", {{"curve", far}}), "curve.points[2][1]");
}

// What would end as numbers that are none (each did, as an internal error, or ran without end).
TEST(Refusals, NameNumbersBeyondWhatTheirProductsAllow) {
  const auto path = [](const char* op, const json& request) {
    const auto r = perform(op, request, {});
    return r ? "answered" : r.error().code == core::ErrorCode::bad_input ? r.error().path : "?";
  };
  const json tiny{{"type", "bezier"}, {"points", {{0, 0}, {1e-160, 0}, {2e-160, 1e-160}}}};
  EXPECT_EQ(path("curve.analyze", {{"curve", tiny}}), "curve.points");
  const json net{{{0, 0, 0}, {0, 1e-160, 0}}, {{1e-160, 0, 0}, {1e-160, 1e-160, 1e-161}}};
  EXPECT_EQ(path("surface.sav", {{"surface", {{"type", "bezier-surface"}, {"points", net}}}}),
            "surface.points");
  const auto chain = [](double direction, double length) {
    const json piece{{"alpha", -1}, {"length", length}, {"curvature", {1, 1.5}}};
    return json{{"type", "log-aesthetic"},
                {"start", {0, 0}},
                {"direction", direction},
                {"pieces", {piece}}};
  };
  EXPECT_EQ(path("curve.offset", {{"curve", chain(1e150, 1)}, {"distance", 0.1}}),
            "curve.direction");
  EXPECT_EQ(path("curve.offset", {{"curve", chain(0, 5e-324)}, {"distance", 0.1}}),
            "curve.pieces[0]");
  EXPECT_EQ(path("curve.cav", {{"alpha", 0.2}, {"s", 1e100}, {"degree", 4}, {"tangent", {1, 0}}}),
            "s");
  const json points{{0, 0}, {1, 0}, {2, 0.2}, {3, 0.7}, {3.8, 1.5}};
  json edge{{"type", "bezier"}, {"points", points}};
  edge["points"][1] = {1e-200, 0};
  EXPECT_EQ(path("fit.curvature", {{"curve", edge}, {"target", "smooth"}}), "curve.curves[0]");
}

// What leaves the range of doubles in the result only is laid to the number that takes it there;
// all were `internal`.
TEST(Requests, ResultsBeyondDoublesAreRefusedByTheirNumber) {
  const auto refused = [](const char* op, const json& request) {
    const auto r = perform(op, request, {});
    return r ? "answered" : r.error().code == core::ErrorCode::bad_input ? r.error().path : "?";
  };
  json bent{{"type", "bezier"}, {"points", {{0, 0}, {1, 0}, {2, 0.6}, {2.5, 1.6}}}};
  bent["weights"] = {1, 2, 1e300, 1};
  EXPECT_EQ(refused("curve.offset", {{"curve", bent}, {"distance", 0.1}}), "curve.weights[2]");
  bent["weights"] = {1e160, 2, 0.5, 1};
  EXPECT_EQ(refused("curve.analyze", {{"curve", bent}}), "curve.weights[0]");
  const json chain{{"type", "log-aesthetic"},
                   {"start", {0, 0}},
                   {"direction", 0},
                   {"pieces", {{{"alpha", 1}, {"length", 2}, {"curvature", {0.2, 1e308}}}}}};
  EXPECT_EQ(refused("curve.show", {{"curve", chain}, {"bezier", {{"tolerance", 1e-3}}}}),
            "curve.pieces[0].curvature[1]");
  EXPECT_EQ(refused("lac.hermite", {{"id", 1e300},
                                    {"start", {0, 0}},
                                    {"end", {3e-300, 1e-300}},
                                    {"directions", {-2e-301, 9e-301}},
                                    {"curvatures", {1e-301, 5e-301}},
                                    {"alpha", -1}}),
            "curvatures[0]");
}

// Below 2.2e-308 a double has no 16 digits, and its ratios none: a slope of 5e-324 is one of 0.
TEST(Requests, NumbersWithoutDigitsAreZero) {
  const auto curve = [](double alpha) {
    return perform("lac.segment", {{"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", alpha}}, {});
  };
  ASSERT_TRUE(curve(0) && curve(5e-324));
  EXPECT_EQ(*curve(5e-324), *curve(0));
}

}  // namespace
}  // namespace keyline::operations
