#include <cmath>
#include <fstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "run_keyline.h"
#include "tests/shared_data.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

const std::string kExamples = KEYLINE_SOURCE_DIR "/examples/";

TEST(Surfaces, AnalyzePrintsSavByCurveAndNamesTheWorst) {
  const Outcome o = run_keyline("analyze --quiet --json " + kExamples + "panel-b.json");
  ASSERT_EQ(o.status, 0) << o.err;
  const json r = json::parse(o.out);
  EXPECT_EQ(r["curves"].size(), 8U);
  EXPECT_EQ(r["worst"], "A2");
  EXPECT_NEAR(r["sav"].get<double>(), 116.1, 0.1);
  const Outcome table = run_keyline("analyze " + kExamples + "panel-b.json");
  EXPECT_NE(table.out.find("SAV 116"), std::string::npos);
  EXPECT_NE(table.out.find("A8"), std::string::npos);
}

TEST(Surfaces, AnalyzeGoesByPatchAndBySurface) {
  const Outcome o = run_keyline("analyze --quiet --json " + kExamples + "skin.json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["patches"].size(), 6U);
  const Scratch s;
  json several{{"unit", "mm"}, {"surfaces", json::array()}};
  for (const char* name : {"panel-a.json", "panel-c.json"})
    several["surfaces"].push_back(
        {{"name", name}, {"surface", json::parse(slurp(kExamples + name))}});
  several["curves"] = json::array({{{"curve", json::parse(slurp(kExamples + "cubic.json"))}}});
  const std::string file = s.write("both.json", several.dump());
  EXPECT_NE(run_keyline("analyze --json " + file).err.find("1 curve of the file left out"),
            std::string::npos);
  const Outcome both = run_keyline("analyze --quiet --json " + file);
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(json::parse(both.out)["surfaces"].size(), 2U);
}

TEST(Surfaces, AnalyzeDrawsReportAndPictures) {
  const Scratch s;
  const std::string outputs = " -o " + s.path("p.html") + " -o " + s.path("p.png") + " -o " +
                              s.path("p.svg") + " -o " + s.path("p.pdf") + " -o " +
                              s.path("p.json");
  const Outcome o = run_keyline("analyze --quiet " + kExamples + "panel-c.json" + outputs);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(s.count(), 5U);
  const std::string html = slurp(s.path("p.html"));
  for (const char* text : {"Zebra", "Gaussian curvature", "Network curves", "A8"})
    EXPECT_NE(html.find(text), std::string::npos) << text;
}

TEST(Surfaces, PicturesCanBeChosen) {
  const Scratch s;
  const std::string panel = kExamples + "panel-c.json";
  const Outcome o = run_keyline("analyze --quiet " + panel +
                                " --show isophote,reflection,highlight,principal --view 1,1,2 -o " +
                                s.path("p.svg"));
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string svg = slurp(s.path("p.svg"));
  for (const char* text : {"Isophotes", "Reflection lines", "Highlight lines"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(run_keyline("analyze --quiet " + panel + " --show stripes").status, 2);
  EXPECT_EQ(run_keyline("analyze --quiet " + panel + " --view 0,0,0").status, 2);
}

/// Real patches: every one has a value or says why not.
TEST(Surfaces, StepFilesOfOthersAreValuedPatchByPatch) {
  const std::string file = KEYLINE_SHARED_DATA "/4_cad/step/wigley.step";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(file), file);
  const Outcome o = run_keyline("analyze --quiet --json " + file);
  if (o.status == 2 && o.err.find("OCCT") != std::string::npos) GTEST_SKIP() << o.err;
  ASSERT_EQ(o.status, 0) << o.err;
  const json r = json::parse(o.out);
  EXPECT_GE(r["patches"].size(), 3U);
  for (const json& p : r["patches"]) EXPECT_TRUE(p["worst"].is_string());
}

TEST(Surfaces, EditHoldsCornersAndComesBackAsTheEditedPatch) {
  const Scratch s;
  const std::string file = s.path("e.json");
  const Outcome o = run_keyline("edit --quiet --json --keep corners " + kExamples +
                                "panel-c.json -o " + file + " -o " + s.path("e.html"));
  ASSERT_EQ(o.status, 0) << o.err;
  const json r = json::parse(o.out);
  EXPECT_NEAR(r["before"]["sav"].get<double>(), 407.3, 0.1);
  EXPECT_LT(r["after"]["sav"].get<double>(), 1);
  const json given = json::parse(slurp(kExamples + "panel-c.json"))["points"];
  const json made = json::parse(slurp(file))["points"];
  for (const std::size_t i : {0U, 3U})
    for (const std::size_t j : {0U, 3U})
      for (const std::size_t k : {0U, 1U, 2U})
        EXPECT_NEAR(made[i][j][k].get<double>(), given[i][j][k].get<double>(), 1e-9);
  const json again = json::parse(run_keyline("analyze --quiet --json " + file).out);
  EXPECT_LT(again["sav"].get<double>(), 1);
}

TEST(Surfaces, EditOfASplineIsASplineAndTellsItsJoints) {
  const Scratch s;
  const std::string file = s.path("skin.json");
  const Outcome o = run_keyline("edit --limit none " + kExamples + "skin.json -o " + file + " -o " +
                                s.path("skin.html") + " -o " + s.path("skin.svg"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("6 patches  SAV 659"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("joints 7"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("zebra at joints, in degrees: jumps 0 to"), std::string::npos) << o.out;
  EXPECT_NE(slurp(s.path("skin.html")).find("Zebra turns"), std::string::npos);
  EXPECT_EQ(o.out.find("as given: nothing"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("hundredth"), std::string::npos) << o.out;
  // Unasked nothing goes farther than a hundredth of the size, as half of the way would; that is
  // said.
  const Outcome held =
      run_keyline("edit --amount 0.5 " + kExamples + "skin.json -o " + s.path("held.html"));
  const std::size_t said = held.out.find("as given: nothing");  // once
  EXPECT_NE(said, std::string::npos) << held.out;
  EXPECT_EQ(said, held.out.rfind("as given: nothing")) << held.out;
  EXPECT_NE(held.out.find("a hundredth of the size,"), std::string::npos) << held.out;
  EXPECT_NE(slurp(s.path("held.html")).find("Limit of the departure"), std::string::npos);
  EXPECT_EQ(json::parse(slurp(file))["type"], "bspline-surface");
}

// Two patches of a wavy spline. Let go, their only joint folds: stripes jump there, and meet
// nowhere that they could turn. Held, each choice told has to be better than all nearer ones.
TEST(Surfaces, EditTellsTornJointsAndChoicesAlone) {
  const Scratch s;
  const std::vector<std::vector<int>> heights = {
      {0, 14, 15, 0}, {22, 40, 38, 21}, {33, 56, 50, 30}, {30, 49, 52, 33}, {5, 21, 24, 9}};
  json points;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j)
      points[i][j] = {100 * i, 120 * j,
                      heights[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]};
  const std::string file = s.path("two.json");
  std::ofstream(file) << json{{"type", "bspline-surface"},
                              {"degree", {3, 3}},
                              {"knots", json::parse("[[0,0,0,0,0.5,1,1,1,1],[0,0,0,0,1,1,1,1]]")},
                              {"points", points}};
  const Outcome torn = run_keyline("edit " + file + " --joints free");
  EXPECT_NE(torn.out.find("1 of 1 tangent joints are lost, so that stripes jump"),
            std::string::npos)
      << torn.out;
  EXPECT_NE(torn.out.find("turns nowhere"), std::string::npos) << torn.out;
  EXPECT_EQ(torn.out.find("so that stripes turn"), std::string::npos) << torn.out;
  const json held = json::parse(run_keyline("edit --quiet --json " + file).out);
  const json& choices = held["tradeoff"];
  ASSERT_GE(choices.size(), 3U);
  for (std::size_t i = 1; i < choices.size(); ++i) {
    EXPECT_GE(choices[i]["departure"], choices[i - 1]["departure"]);
    EXPECT_LT(choices[i]["sav"], choices[i - 1]["sav"]);  // no stripe turns in any of them
  }
}

// Cubics over a plane that are sums of one along and one across: the surface through them is the
// sum.
TEST(Surfaces, NetworkOfTwoFilesIsASurface) {
  const Scratch s;
  const std::string file = s.path("hood.json");
  const std::string along = kExamples + "hood-along.json ";
  const std::string across = kExamples + "hood-across.json ";
  const Outcome o = run_keyline("network --json " + along + across + "-o " + file);
  ASSERT_EQ(o.status, 0) << o.err;
  const json r = json::parse(o.out);
  EXPECT_LT(r["deviation"].get<double>(), 0.12);  // 1e-4 of 1,200 mm
  EXPECT_EQ(r["joints"]["G2"], r["joints"]["joints"]);
  const json made = json::parse(slurp(file));
  EXPECT_EQ(made["type"], "bspline-surface");
  EXPECT_EQ(made["unit"], "mm");
  const json& corner = made["points"].back().back();
  EXPECT_NEAR(corner[0].get<double>(), 1200, 1e-6);
  EXPECT_NEAR(corner[1].get<double>(), 900, 1e-6);
  EXPECT_NEAR(corner[2].get<double>(), 60, 1e-6);
  const Outcome told = run_keyline("network " + along + across);
  const std::string n = std::to_string(r["joints"]["joints"].get<int>());
  EXPECT_GT(r["joints"]["joints"], 0);
  EXPECT_NE(told.out.find("joints " + n + "  largest gap 0  largest fold 0 degrees  G0 " + n +
                          "  G1 " + n + "  G2 " + n),
            std::string::npos)
      << told.out;
  EXPECT_NE(told.out.find("zebra at joints, in degrees: jumps 0"), std::string::npos) << told.out;
  const std::string page = s.path("hood.html");
  EXPECT_EQ(
      run_keyline("network " + along + across + "-o " + page + " -o " + s.path("hood.png")).status,
      0);
  EXPECT_NE(slurp(page).find("<svg"), std::string::npos);
  EXPECT_NE(slurp(page).find("SAV"), std::string::npos);
  EXPECT_EQ(slurp(s.path("hood.png")).substr(1, 3), "PNG");
  const Outcome one = run_keyline("network " + along);
  EXPECT_EQ(one.status, 2);
  EXPECT_NE(one.err.find("two files"), std::string::npos) << one.err;
  const Outcome missed = run_keyline("network " + along + along);
  EXPECT_EQ(missed.status, 2);
  EXPECT_NE(missed.err.find("hood-along.json: curve 1"), std::string::npos) << missed.err;
  const Outcome help = run_keyline("network --help");
  EXPECT_NE(help.out.find("--gap"), std::string::npos) << help.out;
  EXPECT_NE(help.out.find("hood-along.json"), std::string::npos) << help.out;
}

TEST(Surfaces, EditTakesConditions) {
  const Outcome o =
      run_keyline("edit --quiet --json --condition s=1.3..1.4 --condition A1:s=1.35 " + kExamples +
                  "panel-c.json");
  ASSERT_EQ(o.status, 0) << o.err;
  const json r = json::parse(o.out);
  EXPECT_NEAR(r["after"]["curves"][0]["s"].get<double>(), 1.35, 1e-5);
  for (const json& c : r["after"]["curves"]) EXPECT_LE(c["s"].get<double>(), 1.4 + 1e-5);
  const Outcome none = run_keyline("edit --quiet --keep boundary --condition A1:s=1.2..1.3 " +
                                   kExamples + "panel-c.json");
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("A1"), std::string::npos) << none.err;
  EXPECT_EQ(run_keyline("edit --condition A1:s " + kExamples + "panel-c.json").status, 2);
  EXPECT_EQ(run_keyline("edit --condition A9:s=1.2 " + kExamples + "panel-c.json").status, 2);
}

TEST(Surfaces, FailuresAreOneLine) {
  const Outcome keep = run_keyline("edit --quiet --keep all " + kExamples + "panel-c.json");
  EXPECT_EQ(keep.status, 2);
  const Outcome format =
      run_keyline("analyze --quiet " + kExamples + "panel-c.json -o /tmp/nothing.gif");
  EXPECT_EQ(format.status, 2);
  const Scratch s;
  const std::string bad =
      s.write("bad.json", R"({"type":"bezier-surface","points":[[[0,0,0],[1,0,0]],[[0,1,0]]]})");
  const Outcome net = run_keyline("analyze --quiet " + bad);
  EXPECT_EQ(net.status, 2);
  EXPECT_NE(net.err.find("points[1]"), std::string::npos) << net.err;
}

}  // namespace
}  // namespace keyline::app_test
