#include "keyline/document/path_gap.h"

#include <gtest/gtest.h>

#include "keyline/document/join.h"

namespace keyline::document {
namespace {

PlanarCurve line(core::Point2 from, core::Point2 to) { return {curve::Bezier2{{from, to}, {}}}; }

TEST(PathGap, IsFoundWhereACurveDoesNotBeginWhereTheOneBeforeEnds) {
  const Path whole{{line({0, 0}, {100, 0}), line({100, 1e-4}, {100, 50})}, false};
  EXPECT_FALSE(first_gap(whole));  // a millionth of its size
  // 1e-5 of how far it reaches, the diagonal of 125
  const auto torn = [](double gap) {
    return first_gap(Path{{line({0, 0}, {100, 0}), line({100 + gap, 0}, {100, 75})}, false});
  };
  EXPECT_FALSE(torn(1.2e-3));
  EXPECT_TRUE(torn(1.3e-3));
  const Path parted{{line({0, 0}, {100, 0}), line({100, 0}, {100, 50}), line({100, 53}, {0, 0})},
                    false};
  ASSERT_TRUE(first_gap(parted));
  EXPECT_EQ(first_gap(parted)->member, 2U);
  EXPECT_EQ(in_words(*first_gap(parted)), "begins 3 away from where the one before it ends");
  const std::vector<SpaceCurve> space{{curve::Polyline3{{{0, 0, 0}, {1, 0, 0}}}},
                                      {curve::Polyline3{{{1, 0, 0.5}, {2, 0, 0}}}}};
  EXPECT_DOUBLE_EQ(first_gap(space).value().width, 0.5);
}

TEST(PathGap, JoiningWithinATolerancePutsALineThere) {
  const auto made =
      joined({Path{{line({0, 0}, {100, 0})}, false}, Path{{line({100, 3}, {50, 80})}, false},
              Path{{line({48, 80}, {0, 1})}, false}},
             5);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->gap, 3);
  EXPECT_TRUE(made->path.closed);
  ASSERT_EQ(made->path.curves.size(), 6U);
  EXPECT_FALSE(first_gap(made->path));
  EXPECT_EQ(evaluate(made->path.curves.back(), 0), (core::Point2{0, 1}));
  EXPECT_EQ(evaluate(made->path.curves.back(), 1), (core::Point2{0, 0}));
}

TEST(PathGap, AClosedPolylineEndsWhereItBegins) {
  Path corner{{{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}}}}}, true};
  close_gaps(corner);
  close_gaps(corner);
  EXPECT_EQ(std::get<curve::Polyline2>(corner.curves[0].value).points,
            (std::vector<core::Point2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}}));
}

}  // namespace
}  // namespace keyline::document
