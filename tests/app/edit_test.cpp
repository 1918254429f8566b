#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

const std::string kCubic = example("cubic.json");

TEST(Edit, PaperExampleToItsMinimum) {
  const Scratch s;
  const std::string report = s.path("report.html");
  const std::string curve = s.path("curve.json");
  const Outcome o = run_keyline("edit " + kCubic + " --end-tolerance 0.01 --json -o " + report +
                                " -o " + curve + " -o " + s.path("page.png"));
  ASSERT_EQ(o.status, 0) << o.err;
  const json result = json::parse(o.out);
  EXPECT_EQ(result["before"]["type"], 3);
  EXPECT_EQ(result["after"]["type"], 1);
  EXPECT_NEAR(result["target"]["alpha"].get<double>(), 0.6474, 5e-5);
  EXPECT_NEAR(result["target"]["s"].get<double>(), 1.4404, 5e-5);
  const std::string page = slurp(report);
  EXPECT_NE(page.find("Curvature along both curves"), std::string::npos);
  const Outcome again = run_keyline("analyze --json " + curve);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["class_a"]["type"], 2);
}

TEST(Edit, HalfWayAndByHand) {
  const Outcome half = run_keyline("edit " + kCubic + " --amount 0.5 --json");
  ASSERT_EQ(half.status, 0) << half.err;
  const double alpha = json::parse(half.out)["after"]["alpha"].get<double>();
  EXPECT_LT(alpha, 0.785);
  EXPECT_GT(alpha, 0.65);
  const Outcome told = run_keyline("edit " + kCubic + " --amount 0");
  EXPECT_NE(told.out.find("departure 0 at most"), std::string::npos) << told.out;
  EXPECT_EQ(told.out.find("moves by"), std::string::npos) << told.out;
  const Outcome let_go = run_keyline("edit " + kCubic + " --end-tolerance 0.01");
  EXPECT_NE(let_go.out.find("the end that is let go moves by 0.01\n"), std::string::npos)
      << let_go.out;
  const Outcome hand = run_keyline("edit " + kCubic + " --target 0.7,1.5 --hold ends --json");
  ASSERT_EQ(hand.status, 0) << hand.err;
  EXPECT_NEAR(json::parse(hand.out)["after"]["s"].get<double>(), 1.5, 1e-9);
}

TEST(Edit, Failures) {
  expect_failure(run_keyline("edit " + kCubic + " --alpha-max 1.6"), 2, "--alpha-max: 1.6 is");
  expect_failure(run_keyline("edit " + kCubic + " --hold nothing"), 2, "hold");
  expect_failure(run_keyline("edit " + kCubic + " --amount 2"), 2, "amount");
  expect_failure(run_keyline("edit nowhere.json"), 3, "nowhere.json");
  const Scratch s;
  const std::string closed =
      s.write("closed.json", R"({"type":"bezier","points":[[0,0],[1,0],[1,1],[0,0]]})");
  expect_failure(run_keyline("edit " + closed), 1, "ends where it starts");
}

// A drawing: a closed outline, a path with a corner and a circle, of which one Bezier curve is
// none. Every one comes back, on its page, with as many curves; the circle stays.
TEST(Edit, FailuresNameOnlyOptionsThereAre) {
  const Scratch s;
  const std::string rational = s.write("rational.json", R"({"type":"bezier-surface",
      "points":[[[0,0,0],[1,0,1],[2,0,0]],[[0,2,0],[1,2,1],[2,2,0]]],"weights":[[1,2,1],[1,2,1]]})");
  const Outcome weights = run_keyline("edit --quiet " + rational);
  expect_failure(weights, 2, "a rational patch has no control matrices");
  EXPECT_EQ(weights.err.find("--"), std::string::npos) << weights.err;
  expect_failure(run_keyline("edit --quiet --amount 2 " + rational), 2, "--amount");
}

TEST(Edit, DrawingsAreEditedPieceByPiece) {
  const Scratch s;
  const std::string drawing = s.write(
      "drawing.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">
<path id="egg" d="M20 50C20 20 80 10 120 20C160 30 180 40 180 50C180 70 120 90 80 85C50 80 20 70 20 50Z"/>
<path id="corner" d="M20 80C40 60 60 60 85 80L100 60C105 50 130 50 150 60"/>
<circle id="wheel" cx="50" cy="50" r="20"/></svg>)");
  const std::string made = s.path("made.svg");
  const Outcome o =
      run_keyline("edit --json " + drawing + " -o " + made + " -o " + s.path("made.html"));
  ASSERT_EQ(o.status, 0) << o.err;
  const json all = json::parse(o.out)["curves"];
  ASSERT_EQ(all.size(), 3U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_GE(all[i]["edited"].get<int>(), 2) << all[i]["name"];
    EXPECT_EQ(all[i]["joints_after"]["g1"], all[i]["joints_before"]["g1"]);
  }
  EXPECT_EQ(all[0]["curve"]["closed"], true);
  EXPECT_EQ(all[2]["edited"], 0);
  const json again = json::parse(run_keyline("convert --json " + made).out);
  EXPECT_EQ(again["curves"].size(), 3U);
  EXPECT_NE(slurp(made).find("viewBox"), std::string::npos);
}

// A curve in space goes to the minimum in the plane of its start tangent and chord, its ends held;
// a spline of two pieces has none and stays, which is told. A planar one beside them is edited too.
TEST(Edit, CurvesInSpaceGoToTheirMinimum) {
  const Scratch s;
  const std::string bent = R"({"type":"bezier","points":[[0,0,0],[10,0,0],[18,6,2],[22,14,9]]})";
  const std::string spline = R"({"type":"bspline","degree":3,"knots":[0,0,0,0,0.5,1,1,1,1],)"
                             R"("points":[[0,0,0],[10,0,0],[18,6,2],[22,14,9],[30,20,14]]})";
  const std::string one_piece = R"({"type":"bspline","degree":3,"knots":[0,0,0,0,1,1,1,1],)"
                                R"("points":[[0,0,0],[10,0,0],[18,6,2],[22,14,9]]})";
  const std::string file =
      s.write("space.json", R"({"curves":[{"name":"bent","curve":)" + bent +
                                R"(},{"name":"spline","curve":)" + spline +
                                R"(},{"name":"one","curve":)" + one_piece + "}]}");
  const std::string made = s.path("made.json");
  const Outcome o =
      run_keyline("edit --json " + file + " -o " + made + " -o " + s.path("made.svg"));
  ASSERT_EQ(o.status, 0) << o.err;
  const json all = json::parse(o.out)["curves"];
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1]["pieces"].size(), 2U);  // of the spline, each by itself
  EXPECT_EQ(all[1]["joints_after"]["g1"], 1);
  for (const json& piece : all[1]["pieces"])
    EXPECT_TRUE(piece["after"]["monotone"] == "yes" || piece.contains("why")) << piece;
  for (const json& one : {all[0], all[2]}) {
    EXPECT_EQ(one["before"]["type"], 5);
    EXPECT_EQ(one["after"]["type"], 1);
    const json& points = one["curve"]["points"];
    EXPECT_EQ(points.front(), json({0.0, 0.0, 0.0}));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(points.back()[k].get<double>(), json({22, 14, 9})[k].get<double>(), 0.3);
    EXPECT_NEAR(points[1][1].get<double>(), 0, 1e-12);  // the start tangent
    EXPECT_NEAR(points[1][2].get<double>(), 0, 1e-12);
    for (const json& p : points)  // in the plane of (1, 0, 0) and (22, 14, 9)
      EXPECT_NEAR(14 * p[2].get<double>() - 9 * p[1].get<double>(), 0, 1e-9);
  }
  EXPECT_EQ(json::parse(run_keyline("convert --json " + made).out)["curves"].size(),
            4U);  // pieces in space one by one
  const std::string rational = spline.substr(0, spline.size() - 1) + R"(,"weights":[1,2,1,1,1]})";
  expect_failure(run_keyline("edit " + s.write("spline.json", rational)), 2, "without weights");
}

}  // namespace
}  // namespace keyline::app_test
