#include "keyline/document/cusped.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::document {
namespace {

constexpr double kInfinity = HUGE_VAL;

TEST(Cusped, JetsTellTheCuspsOfAPath) {
  const lac::Chain to_cusp{{{0, 0}, 0.3}, {{2, 1, 0.5, 2}, {2, 3, 2, kInfinity}}, false};
  const lac::Chain from_cusp{{{0, 0}, 0.3}, {{3, 2, -kInfinity, -1}}, false};
  const document::Path path{{{to_cusp}, {from_cusp}}, false};
  const auto stops = stops_of(path);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].t, 0.5);
  EXPECT_EQ(stops[0].before->curvature, kInfinity);
  EXPECT_EQ(stops[0].after->curvature, -kInfinity);
  const document::Path one{{{from_cusp}}, false};
  const CuspedPath cusped(one);
  EXPECT_EQ(curve::curvature(jet(cusped, 0)), -kInfinity);
  EXPECT_EQ(jet(cusped, 1), jet(one, 1));
}

TEST(Cusped, JetsGoOnWhereABezierStops) {
  const Path path{{{curve::Bezier2{{{0, 0}, {1, 0}, {2, 0}, {3, 2}, {3, 2}}, {}}},
                   {curve::Bezier2{{{3, 2}, {3, 2}, {4, 2}, {5, 2}, {6, 4}}, {}}}},
                  false};
  const CuspedPath cusped(path);
  EXPECT_EQ(curve::curvature(jet(cusped, std::nextafter(0.5, 0.0))), kInfinity);
  EXPECT_NEAR(curve::curvature(jet(cusped, 0.5)), 1.0 / 9, 1e-14);
  EXPECT_EQ(curve::curvature_rate(jet(cusped, 0.5)), kInfinity);
  EXPECT_EQ(jet(cusped, 0.75), jet(path, 0.75));
  EXPECT_EQ(breakpoints(cusped), breakpoints(path));
}

TEST(Cusped, PlacesInsideAreBreakpoints) {
  const Path path{{{curve::Bezier2{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}, {}}}}, false};
  ASSERT_EQ(breakpoints(CuspedPath(path)).size(), 3U);
  EXPECT_TRUE(has_cusp(stops_of(path)));
  EXPECT_TRUE(has_cusp(stops_of(path), 1));
  EXPECT_FALSE(has_cusp(stops_of(path), -1));
}

}  // namespace
}  // namespace keyline::document
