#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string drawing(const std::string& paths) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" )"
         R"(viewBox="0 0 40 40"><g fill="none" stroke="black">)" +
         paths + "</g></svg>";
}
const std::string kLong = R"(<path id="long" d="M0 0 L30 40"/>)";    // 50
const std::string kShort = R"(<path id="short" d="M0 0 L6 8"/>)";    // 10
const std::string kNext = R"(<path id="next" d="M30 40 L36 40"/>)";  // 6, where the long one ends

TEST(OptionFiles, TellWhichOfSeveralCurvesIsTaken) {
  const Scratch s;
  const std::string two = s.write("two.svg", drawing(kLong + kShort));
  const Outcome first = run_keyline("curve.show --curve " + two);
  EXPECT_EQ(first.status, 0);
  EXPECT_THAT(first.err, HasSubstr(two + ": --curve takes the first of 2 curves; " + two +
                                   "#NAME takes another"));
  const Outcome named = run_keyline("curve.analyze --json --curve " + two + "#short");
  EXPECT_EQ(named.status, 0);
  EXPECT_THAT(named.err, Not(HasSubstr("takes the first")));
  EXPECT_NEAR(json::parse(named.out)["length"].get<double>(), 10, 1e-9);
  EXPECT_THAT(run_keyline("curve.show --quiet --curve " + two).err, "");
  const json told = json::parse(run_keyline("curve.analyze --quiet --json --curve " + two).out);
  ASSERT_EQ(told.value("notes", json::array()).size(), 1) << told;
  EXPECT_THAT(told["notes"][0].get<std::string>(), HasSubstr("--curve takes the first of 2"));
  EXPECT_FALSE(json::parse(named.out).contains("notes"));
}

TEST(OptionFiles, InListsStandForAllOfTheirCurves) {
  const Scratch s;
  const std::string two = s.write("two.svg", drawing(kLong + kNext));
  const std::string joined = s.path("joined.json");
  EXPECT_EQ(run_keyline("curve.join --curves " + two + " -o " + joined).status, 0);
  const Outcome path = run_keyline("analyze --json " + joined);
  EXPECT_NEAR(json::parse(path.out)["length"].get<double>(), 56, 1e-9);
  EXPECT_THAT(json::parse(run_keyline("list --json " + joined).out)["unit"], "mm");
}

TEST(OptionFiles, WhatTheFileHoldsBesideIsTold) {
  const Scratch s;
  const std::string text = s.write("text.svg", drawing("<text>hi</text>" + kLong));
  EXPECT_THAT(run_keyline("curve.show --curve " + text).err, HasSubstr("skipped: line 1: text"));
  for (const std::string command : {"curve.analyze --curve ", "analyze ", "curve.trim --curve "}) {
    SCOPED_TRACE(command);
    const json told = json::parse(run_keyline(command + text + " --json --quiet").out);
    ASSERT_EQ(told.value("notes", json::array()).size(), 1) << told;
    EXPECT_THAT(told["notes"][0].get<std::string>(), HasSubstr("skipped: line 1: text"));
  }
}

TEST(OptionFiles, AreReadFromStandardInputToo) {
  EXPECT_EQ(run_keyline("curve.show --curve -", "cat " + example("cubic.json") + " |").status, 0);
}

TEST(OptionFiles, OfTwoUnitsAreRefused) {
  const Scratch s;
  const std::string curve =
      R"(","curves":[{"curve":{"type":"bezier","points":[[0,0],[1,1],[2,0]]}}]})";
  const std::string in_mm = s.write("mm.json", R"({"unit":"mm)" + curve);
  const std::string in_inches = s.write("in.json", R"({"unit":"in)" + curve);
  expect_failure(run_keyline("curve.compare --curves " + in_mm + " " + in_inches), 2,
                 in_inches + ": is in in, " + in_mm + " in mm; bring it to mm first");
}

// A polygon of 60 corners whose first one is not repeated.
TEST(OptionFiles, MeasuredLinesStayClosed) {
  const Scratch s;
  const int corners = 60;
  std::string points = "x,y\n";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points += std::to_string(std::cos(angle)) + "," + std::to_string(std::sin(angle)) + "\n";
  }
  const Outcome read = run_keyline("curve.trim --json --curve " + s.write("ring.csv", points));
  const json curve = json::parse(read.out)["curve"];
  ASSERT_EQ(curve["points"].size(), corners + 1) << read.out;
  EXPECT_EQ(curve["points"].back(), curve["points"].front());
}

TEST(OptionFiles, MayBeCalledByANameWithANumberSign) {
  const Scratch s;
  const std::string odd = s.write("a#b.svg", drawing(kLong));
  EXPECT_EQ(run_keyline("curve.show --curve " + odd).status, 0);
  EXPECT_EQ(run_keyline("curve.show --curve " + odd + "#long").status, 0);
  expect_failure(run_keyline("curve.show --curve " + odd + "#none"), 2, "none");
  expect_failure(run_keyline("curve.show --curve " + s.path("absent#b.svg")), 3, "absent#b.svg");
}

}  // namespace
}  // namespace keyline::app_test
