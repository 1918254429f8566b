#include "keyline/surface/conditions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/axis.h"
#include "keyline/surface/edit.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using core::cross;
using core::Interval;
using core::norm;

const classa::CurveValue& curve_of(const EditResult& r, std::size_t i) {
  return r.after.curves[i].value;
}

TEST(Conditions, OwnOverGeneral) {
  const std::vector<CurveCondition> asked{{.s = Interval{1.1, 1.5}, .end_tolerance = 0.2},
                                          {.curve = "A3", .s = Interval{1.2, 1.3}}};
  const auto all = conditions_by_curve(asked, wavy_net(4, 4));
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all[0].s, (Interval{1.1, 1.5}));
  EXPECT_EQ(all[2].s, (Interval{1.2, 1.3}));
  EXPECT_EQ(all[2].end_tolerance, 0.2);
  EXPECT_EQ(all[7].curve, "A8");
}

TEST(Conditions, ChangeTheAnswerAndAreMet) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  const auto plain = edit(s, options);
  ASSERT_TRUE(plain);
  ASSERT_GT(curve_of(*plain, 0).matrix->s, 1.4);
  options.conditions = {{.curve = "A1", .s = Interval{1.2, 1.3}}};
  const auto r = edit(s, options);
  ASSERT_TRUE(r) << r.error().message;
  ASSERT_TRUE(curve_of(*r, 0).matrix);
  EXPECT_LE(curve_of(*r, 0).matrix->s, 1.3 + 1e-6);
  EXPECT_LT(r->after.sav, 1);
  EXPECT_TRUE(r->unmet.empty());
}

TEST(Conditions, MinimaAreThoseWithinTheRanges) {
  EditOptions options;
  options.conditions = {{.s = Interval{1.2, 1.4}}};  // least energy would be at 1.47
  const auto r = edit(crowned_patch(), options);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_LT(r->after.sav, 1e-4);
  for (const auto& c : r->after.curves) EXPECT_NEAR(c.value.matrix->s, 1.4, 1e-4) << c.name;
}

TEST(Conditions, HoldForNetsWithCornersKept) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  options.keep = Keep::corners;
  options.conditions = {{.curve = "A1", .s = Interval{1.3, 1.35}},
                        {.curve = "A6", .tangent = true}};
  const auto r = edit(s, options);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_LT(r->after.sav, 5);
  EXPECT_GE(curve_of(*r, 0).matrix->s, 1.3 - 1e-6);
  EXPECT_LE(curve_of(*r, 0).matrix->s, 1.35 + 1e-6);
  const auto before = s.net.at(1, 1) - s.net.at(0, 1);
  const auto after = r->surface.net.at(1, 1) - r->surface.net.at(0, 1);
  EXPECT_LT(norm(cross(before, after)), 1e-6 * norm(before) * norm(after));
  EXPECT_EQ(r->surface.net.at(3, 3), s.net.at(3, 3));
}

TEST(Conditions, RangeOfAlphaIsKept) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  options.keep = Keep::corners;
  const auto plain = edit(s, options);
  ASSERT_TRUE(plain);
  const double alpha = curve_of(*plain, 1).matrix->alpha;
  options.conditions = {{.curve = "A2", .alpha = Interval{0, 0.7 * alpha}}};
  const auto r = edit(s, options);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_LE(curve_of(*r, 1).matrix->alpha, 0.7 * alpha + 1e-6);
}

TEST(Conditions, FallingEdges) {
  const BezierSurface s = crowned_patch();
  EditOptions options;
  options.conditions = {{.branch = classa::Branch::falling}};
  const auto r = edit(s, options);
  ASSERT_TRUE(r) << r.error().message;
  for (const auto& c : r->after.curves) EXPECT_LT(c.value.matrix->s, 1) << c.name;
  EXPECT_LT(r->after.sav, 1e-4);
}

TEST(Conditions, EmptySetsAreTold) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  options.keep = Keep::boundary;
  options.conditions = {{.curve = "A1", .s = Interval{1.2, 1.3}}};  // A1 stays as it is
  const auto none = edit(s, options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, core::ErrorCode::undrawable);
  EXPECT_EQ(none.error().path, "conditions");
  EXPECT_NE(none.error().message.find("A1"), std::string::npos) << none.error().message;
  // Translates cannot, other nets can: the target is missed with the nearest place that exists.
  options.keep = Keep::start;
  options.conditions = {{.curve = "A1", .alpha = Interval{0.5, 0.6}, .s = Interval{1.2, 1.3}}};
  const auto r = edit(s, options);
  if (!r) {
    EXPECT_NE(r.error().message.find("the nearest has alpha"), std::string::npos);
    return;
  }
  ASSERT_FALSE(r->missed.empty());
  EXPECT_EQ(r->missed.front().curve, "A1");
  EXPECT_NE(r->missed.front().why.find("the nearest has alpha"), std::string::npos);
}

/// Turns and ratios of the edges of a curve.
std::array<double, 4> turns_and_ratios(const std::array<core::Point3, 4>& p) {
  const auto e0 = p[1] - p[0], e1 = p[2] - p[1], e2 = p[3] - p[2];
  return {core::angle_between(e0, e1), core::angle_between(e1, e2), norm(e1) / norm(e0),
          norm(e2) / norm(e1)};
}

// Rows and columns have conditions, and the boundary stays: "rows" leaves columns without a matrix.
TEST(Conditions, OfRowsAndColumnsHoldInsideAKeptBoundary) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  options.keep = Keep::boundary;
  options.conditions = {{.curve = "A3", .alpha = Interval{0.3, 0.4}},
                        {.curve = "A6", .alpha = Interval{0.1, 0.2}, .s = Interval{1.1, 1.3}}};
  const auto r = edit(s, options);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->target, "conditions");
  const Net& net = r->surface.net;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i % 3 == 0 || j % 3 == 0) {
        EXPECT_EQ(net.at(i, j), s.net.at(i, j));
      }
  const auto row = turns_and_ratios({net.at(2, 0), net.at(2, 1), net.at(2, 2), net.at(2, 3)});
  EXPECT_NEAR(row[0], row[1], 1e-7);
  EXPECT_NEAR(row[2], row[3], 1e-7);
  EXPECT_TRUE(row[0] > 0.3 - 1e-6 && row[0] < 0.4 + 1e-6) << row[0];
  const auto column = turns_and_ratios({net.at(0, 1), net.at(1, 1), net.at(2, 1), net.at(3, 1)});
  EXPECT_NEAR(column[0], column[1], 1e-7);
  EXPECT_NEAR(column[2], column[3], 1e-7);
  EXPECT_TRUE(column[0] > 0.1 - 1e-6 && column[0] < 0.2 + 1e-6) << column[0];
  const double ratio = std::max(column[2], 1 / column[2]);
  EXPECT_TRUE(ratio > 1.1 - 1e-6 && ratio < 1.3 + 1e-6) << ratio;
}

TEST(Conditions, PartOfTheWayTellsWhatIsUnmet) {
  EditOptions options;
  options.amount = 0.5;
  options.conditions = {{.curve = "A5", .s = Interval{1.2, 1.3}}};
  const auto r = edit(distorted_patch(), options);
  ASSERT_TRUE(r) << r.error().message;
  ASSERT_EQ(r->unmet.size(), 1U);
  EXPECT_EQ(r->unmet[0].curve, "A5");
}

TEST(Conditions, MistakesAreNamed) {
  const auto path = [](CurveCondition c) {
    EditOptions options;
    options.conditions = {std::move(c)};
    return edit(crowned_patch(), options).error().path;
  };
  EXPECT_EQ(path({.curve = "A9"}), "conditions[0].curve");
  EXPECT_EQ(path({.alpha = Interval{0.3, 0.2}}), "conditions[0].alpha");
  EXPECT_EQ(path({.alpha = Interval{0, 1.5}}), "conditions[0].alpha");
  EXPECT_EQ(path({.s = Interval{0, 1}}), "conditions[0].s");
  EXPECT_EQ(path({.end_tolerance = -1}), "conditions[0].end_tolerance");
  EXPECT_EQ(path({.curve = "A2", .end_tolerance = 1e6}), "conditions[0].end_tolerance");
  EditOptions twice;
  twice.conditions = {{.curve = "A1"}, {.curve = "A1"}};
  EXPECT_EQ(edit(crowned_patch(), twice).error().path, "conditions[1].curve");
}

}  // namespace
}  // namespace keyline::surface
