#include <algorithm>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_keyline.h"

/// The commands on curves one has (docs/guide/curves.md), as a person at the terminal meets them.
namespace keyline::app_test {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A clothoid whose curvature grows from 0 to 0.5 within a length of 2: its variation, the length
/// cubed times the integral of the squared rate, is 8 * 2 * 0.25^2 = 1.
const std::string kClothoid =
    R"({"name":"clothoid","curve":{"type":"log-aesthetic","start":[0,0],"direction":0,)"
    R"("pieces":[{"alpha":-1,"length":2,"curvature":[0,0.5]}]}})";
const std::string kArc =
    R"({"name":"arc","curve":{"type":"log-aesthetic","start":[5,5],"direction":0,)"
    R"("pieces":[{"alpha":-1,"length":2,"curvature":[0.5,0.5]}]}})";
const std::string kLine = R"({"name":"line","curve":{"type":"polyline","points":[[9,9],[10,9]]}})";

std::string document(const std::string& curves, const std::string& unit = "") {
  return R"({"unit":")" + unit + R"(","curves":[)" + curves + "]}";
}

// x' = 3 (1 - 2t)^2, y' = 3 (1 - 2t), both zero at t = 1/2.
TEST(CurvesOfFiles, WithACuspAreTheLeastCalm) {
  const Scratch s;
  const std::string cusp =
      R"({"name":"cusp","curve":{"type":"bezier","points":[[0,0],[1,1],[0,1],[1,0]]}})";
  const Outcome alone = run_keyline("analyze " + s.write("cusp.json", document(cusp)));
  ASSERT_EQ(alone.status, 0) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("to infinity"));
  EXPECT_THAT(alone.out, HasSubstr("variation inf, jolt inf"));
  const Outcome both =
      run_keyline("analyze " + s.write("both.json", document(kClothoid + "," + cusp)));
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out, ContainsRegex("least calm first\n *variation .*\n *inf .* cusp\n"));
}

TEST(CurvesOfFiles, AreToldTheLeastCalmFirst) {
  const Scratch s;
  const std::string file = s.write("all.json", document(kArc + "," + kLine + "," + kClothoid));
  const Outcome told = run_keyline("analyze " + file);
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, ContainsRegex("all 3 curves, the least calm first\n"
                                      " *variation .*\n"
                                      " *1 .* clothoid\n"
                                      " *0 .* arc\n"
                                      " *0 .* line\n$"));
  const json shown = json::parse(run_keyline("analyze --json " + file).out);
  EXPECT_NEAR(shown["curves"][2]["comb"]["energy"].get<double>(), 1, 1e-9);
  const Outcome one = run_keyline("analyze " + s.write("one.json", document(kClothoid)));
  EXPECT_THAT(one.out, HasSubstr("comb: 0 waves, variation 1, jolt"));
  EXPECT_THAT(one.out, Not(HasSubstr("the least calm first")));
}

TEST(CurvesOfFiles, AreNamedBehindTheirFile) {
  const Scratch s;
  const std::string file = s.write("all.json", document(kArc + "," + kLine + "," + kClothoid));
  expect_failure(run_keyline("blend " + file), 2,
                 file +
                     ": 3 curves given; give 2: the curve to leave and the curve to join; "
                     "FILE#NAME takes one of a file's");
  const Outcome two = run_keyline("compare --json " + file + "#arc " + file + "#1");
  ASSERT_EQ(two.status, 0) << two.err;
  EXPECT_NEAR(json::parse(two.out)["largest"].get<double>(), 0, 1e-12);
}

// A helix of one turn, radius 3 and rise 6 pi, and a line of length 13: list measures in space,
// too.
TEST(CurvesOfFiles, InSpaceHaveALength) {
  const Scratch s;
  const std::string curves =
      R"({"curve":{"type":"log-aesthetic-space","start":[3,0,0],)"
      R"("frame":[[0,0.70710678118654752,0.70710678118654752],[-1,0,0],)"
      R"([0,-0.70710678118654752,0.70710678118654752]],"pieces":[{"alpha":1,"beta":1,)"
      R"("length":26.657297628950054,"curvature":[0.16666666666666666,0.16666666666666666],)"
      R"("torsion":[0.16666666666666666,0.16666666666666666]}]}},)"
      R"({"curve":{"type":"polyline","points":[[0,0,0],[3,4,12]]}})";
  const std::string file = s.write("space.json", "{\"curves\":[" + curves + "]}");
  const json things = json::parse(run_keyline("list --json " + file).out)["things"];
  ASSERT_EQ(things.size(), 2U);
  EXPECT_NEAR(things[0].value("length", 0.0), 6 * std::numbers::sqrt2 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(things[1].value("length", 0.0), 13, 1e-9);
}

TEST(CurvesOfFiles, KeepTheirLayerColourAndStroke) {
  const Scratch s;
  const std::string file = s.write(
      "in.json", document(R"({"name":"hood","layer":"body","color":"#c00000","stroke_width":0.5,)"
                          R"("curve":{"type":"bezier","points":[[0,0],[1,2],[3,1]]}})"));
  const std::string scaled = s.path("out.json");
  ASSERT_EQ(run_keyline("transform --scale 2 " + file + " -o " + scaled).status, 0);
  const json curve = json::parse(slurp(scaled))["curves"][0];
  EXPECT_EQ(curve["name"], "hood");
  EXPECT_EQ(curve["layer"], "body");
  EXPECT_EQ(curve["color"], "#c00000");
  EXPECT_EQ(curve["stroke_width"], 1);
  const std::string turned = s.path("turned.json");
  ASSERT_EQ(run_keyline("reverse " + file + " -o " + turned).status, 0);
  EXPECT_EQ(json::parse(slurp(turned))["curves"][0]["stroke_width"], 0.5);
}

TEST(CurvesOfFiles, OfTwoUnitsAreRefused) {
  const Scratch s;
  const std::string in_mm = s.write("mm.json", document(kArc, "mm"));
  const std::string in_inches = s.write("in.json", document(kArc, "in"));
  const std::string in_none = s.write("none.json", document(kArc));
  expect_failure(run_keyline("compare " + in_mm + " " + in_inches), 2,
                 in_inches + ": is in in, " + in_mm +
                     " in mm; bring it to mm first: keyline transform --scale 25.4 --unit mm");
  // …which is true: what is brought so agrees
  const std::string brought = s.path("brought.json");
  const Outcome scaled =
      run_keyline("transform --scale 25.4 --unit mm " + in_inches + " -o " + brought);
  EXPECT_EQ(scaled.status, 0);
  EXPECT_NE(scaled.err.find("the file's own unit, in: its numbers are taken as mm"),
            std::string::npos)
      << scaled.err;
  EXPECT_EQ(run_keyline("compare " + in_mm + " " + brought).status, 0);
  for (const std::string& files : {in_mm + " " + in_none, in_none + " " + in_mm}) {
    const std::string joined = s.path("joined.json");
    EXPECT_EQ(run_keyline("blend --at 0 1 " + files + " -o " + joined).status, 0);
    EXPECT_EQ(json::parse(slurp(joined))["unit"], "mm") << files;
  }
}

TEST(CurvesOfFiles, AreToldWhenNoFileTakesThem) {
  const Scratch s;
  const std::string file = s.write("one.json", document(kClothoid));
  const Outcome cut = run_keyline("split --at 0.25 0.5 " + file);
  EXPECT_EQ(cut.status, 0);
  EXPECT_EQ(cut.out, "clothoid\n");
  EXPECT_THAT(cut.err, HasSubstr("3 shapes made; -o FILE writes them"));
  EXPECT_EQ(run_keyline("split --quiet --at 0.25 " + file).err, "");
}

TEST(Units, AreThoseOfATablesHeader) {
  struct Case {
    const char* header;
    const char* options;
    const char* unit;
  };
  constexpr Case kCases[] = {
      {"x [mm],y [mm]", "", "mm"},          {"x_cm,y_cm", "", "cm"},
      {"# X (in),Y (in)", "", "in"},        {"n [m],x,y", "", ""},
      {"x [furlong],y [furlong]", "", ""},  {"x [mm],y", "", "mm"},
      {"x [mm],y [mm]", "--unit ft", "ft"}, {"a [m],b [m],x,y", "--columns a b", "m"}};
  const Scratch s;
  for (const Case& c : kCases) {
    SCOPED_TRACE(std::string(c.header) + " " + c.options);
    const std::string file =
        s.write("table.csv", std::string(c.header) + "\n" +
                                 (std::ranges::count(std::string_view(c.header), ',') == 1
                                      ? "1,0\n2,3\n3,5\n4,1\n"
                                      : "1,0,5,6\n2,3,5,7\n3,5,5,8\n4,1,5,9\n"));
    const std::string written = s.path("written.json");
    ASSERT_EQ(run_keyline("convert " + file + " " + c.options + " -o " + written).status, 0);
    EXPECT_EQ(json::parse(slurp(written)).value("unit", ""), c.unit);
  }
  const std::string both = s.write("both.csv", "x [mm],y [in]\n1,0\n2,3\n3,5\n4,1\n");
  expect_failure(run_keyline("convert " + both + " -o " + s.path("both.json")), 2,
                 "the header gives the coordinates two units, mm and in");
  const std::string one = s.write("one.csv", "x_mm,y_mm\n0,0\n1,0\n2,0\n");
  const std::string other = s.write("other.csv", "x_in,y_in\n2,0\n3,0\n4,0\n");
  expect_failure(run_keyline("fair " + one + " " + other), 2,
                 other + ": is in in, " + one +
                     " in mm; bring it to mm first: keyline transform --scale 25.4 --unit mm");
}

TEST(Fair, SaysOnTheTerminalWhatTheReportSays) {
  const Outcome told = run_keyline("fair " + example("clothoid.csv"));
  EXPECT_EQ(told.status, 0);
  EXPECT_THAT(told.err, HasSubstr(" - near enough and fair\n"));
}

}  // namespace
}  // namespace keyline::app_test
