#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

json drawn(const std::string& arguments) {
  const Outcome o = run_keyline("draw --json " + arguments);
  EXPECT_EQ(o.status, 0) << o.err;
  return o.status == 0 ? json::parse(o.out) : json::object();
}

TEST(Draw, EveryKindOfCurve) {
  const std::string handles = "--points 0,0 2,0 3,1.5 ";
  EXPECT_EQ(drawn(handles)["curve"]["pieces"].size(), 1U);
  EXPECT_EQ(drawn(handles + "--alpha -1,1.5 --ratio 0.4")["curve"]["pieces"].size(), 2U);
  EXPECT_EQ(drawn(handles + "--form taylor-arc --degree 9 --about auto")["curve"]["type"],
            "bezier");
  EXPECT_EQ(drawn(handles + "--form rational-cubic --alpha 0")["curve"]["points"].size(), 4U);
  EXPECT_EQ(drawn("--points 0,0 3,1 --directions 0.9,0.8")["shape"], "S");
  EXPECT_TRUE(
      drawn("--points 0,0 3,1 --directions 0.9,-0.2 --curvatures=-0.2,-0.5")["curve"].contains(
          "pieces"));
  EXPECT_NEAR(drawn("--points 0,0 2,0 --direction 0.6 --volume 0.4")["volume"].get<double>(), 0.4,
              1e-9);
  EXPECT_EQ(drawn("--spline --closed --points 1,0 0,1 -1,0 0,-1")["curve"]["closed"], true);
  EXPECT_EQ(drawn("--space --points 0,0,0 1,0,0 2,0.4,0.2 3,1,0.5")["curve"]["type"],
            "log-aesthetic-space");
}

TEST(Draw, WritesEveryFormatWithFigures) {
  const Scratch s;
  std::string command =
      "draw --points 0,0 2,0 3,1.5 --alpha -1,1.5 --ratio 0.4 --show comb,evolute,lcg,region";
  for (const char* file : {"a.svg", "a.pdf", "a.png", "a.html", "a.json", "a.csv"})
    command += " -o " + s.path(file);
  const Outcome o = run_keyline(command);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(slurp(s.path("a.svg")).find("Drawable region"), std::string::npos);
  EXPECT_TRUE(slurp(s.path("a.pdf")).starts_with("%PDF"));
  EXPECT_TRUE(slurp(s.path("a.png")).starts_with("\x89PNG"));
  EXPECT_NE(slurp(s.path("a.html")).find("Drawable region"), std::string::npos);
  EXPECT_EQ(json::parse(slurp(s.path("a.json")))["pieces"].size(), 2U);
}

TEST(Draw, WritesSpaceCurves) {
  const Scratch s;
  const std::string curve = "draw --space --points 0,0,0 1,1.2,0.6 2,0.1,0.6 3,0,0 ";
  std::string command = curve + "--omega 0.2";
  for (const char* file : {"a.svg", "a.pdf", "a.png", "a.html", "a.json", "a.csv", "a.dxf"})
    command += " -o " + s.path(file);
  const Outcome o = run_keyline(command);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(slurp(s.path("a.svg")).find("From above"), std::string::npos);
  EXPECT_TRUE(slurp(s.path("a.png")).starts_with("\x89PNG"));
  EXPECT_NE(slurp(s.path("a.html")).find("slope of curvature"), std::string::npos);
  EXPECT_GT(slurp(s.path("a.csv")).size(), 100U);
  EXPECT_NE(slurp(s.path("a.dxf")).find("SPLINE"), std::string::npos);
  EXPECT_EQ(json::parse(slurp(s.path("a.json")))["type"], "log-aesthetic-space");
  expect_failure(run_keyline(curve + "--show comb -o " + s.path("b.svg")), 2, "--show");
  expect_failure(run_keyline(curve + "-o " + s.path("b.bmp")), 2, ".bmp");
}

TEST(Draw, SaysWhatDoesNotGoTogether) {
  expect_failure(run_keyline("draw --points 0,0 1,0"), 2, "--points");
  expect_failure(run_keyline("draw --points 0,0 1,x 2,0"), 2, "1,x");
  expect_failure(run_keyline("draw --points 0,0,0 1,0 2,0"), 2, "coordinates");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --alpha 1,2"), 2, "--ratio");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --ratio 0.5"), 2, "--alpha");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --alpha 1,2 --ratio 1"), 2, "ratio");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --closed"), 2, "--spline");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --form spiral"), 2, "spiral");
  expect_failure(run_keyline("draw --points 0,0 1,0 --directions 1,2 --show region -o x.svg"), 2,
                 "region");
  expect_failure(run_keyline("draw --points 0,0 1,0 2,1 --show combs -o x.svg"), 2, "combs");
}

}  // namespace
}  // namespace keyline::app_test
