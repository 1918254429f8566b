#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>
#include <sstream>

#include <sys/wait.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "keyline/core/point.h"
#include "keyline/exchange/svg/svg_reader.h"
#include "keyline/operations/operation.h"

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

using nlohmann::json;

TEST(Commands, HelpAndVersion) {
  const std::string version = run_keyline("--version").out;
  EXPECT_THAT(version, testing::MatchesRegex("keyline [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  for (const char* name : {"fair", "analyze", "draw", "edit", "convert", "batch", "operations"}) {
    const Outcome o = run_keyline(std::string(name) + " --help");
    EXPECT_EQ(o.status, 0);
    EXPECT_NE(o.out.find("--threads"), std::string::npos) << name;
    EXPECT_NE(o.out.find("Example: "), std::string::npos) << name;
    EXPECT_EQ(run_keyline(std::string(name) + " --version").out, version) << name;
  }
}

/// What a field of an operation is called, in the help, in completion, and as an option.
TEST(Commands, EveryFieldOfWhatTheyPerformIsAnOption) {
  const std::set<std::string_view> from_files{"curve", "points",  "line",     "weights",
                                              "file",  "surface", "surfaces", "curves"};
  const std::string completion = run_keyline("completion bash").out;
  const auto line_of = [&](const std::string& name) {
    const std::size_t at = completion.find("    " + name + ") ");
    return at == std::string::npos ? "" : completion.substr(at, completion.find('\n', at) - at);
  };
  for (const auto& [command, operation] : {std::pair{"fair", "fair"},
                                           {"analyze", "curve.analyze"},
                                           {"edit", "surface.edit_together"},
                                           {"offset", "curve.offset"},
                                           {"trim", "curve.trim"},
                                           {"lac.spline", "lac.spline"}}) {
    const std::string help = run_keyline(std::string(command) + " --help").out;
    const std::string words = line_of(command) + " ";
    const auto& declared = *operations::find_operation(operation);
    int fields = 0;
    core::visit_fields(*declared.request, declared.request->make().get(),
                       [&](const core::Field& field, const void*) {
                         if (from_files.contains(field.name)) return;
                         std::string name(field.name);
                         std::ranges::replace(name, '_', '-');
                         const bool flag = help.find("--[no-]" + name) != std::string::npos;
                         EXPECT_TRUE(flag || help.find("--" + name) != std::string::npos)
                             << command << ' ' << name;
                         EXPECT_NE(words.find("--" + name), std::string::npos) << words;
                         ++fields;
                       });
    EXPECT_GT(fields, 0) << command;
  }
}

TEST(Commands, OptionsAreReadAsPeopleTypeThem) {
  const std::string fair = "fair --quiet --json ";
  const std::string scan = example("clothoid.csv");
  const std::string plain = run_keyline(fair + scan).out;
  EXPECT_EQ(run_keyline(fair + "--no-keep-corners --keep-corners " + scan).out, plain);
  EXPECT_EQ(run_keyline("fair " + scan + " --keep-cor yes --quiet --json").out, plain);
  const std::string help = run_keyline("fair --help").out;  // what is found by itself can be denied
  EXPECT_NE(help.find("--[no-]closed "), std::string::npos) << help;
  EXPECT_EQ(help.find("--[no-]keep-order"), std::string::npos) << help;
  EXPECT_EQ(run_keyline("fair -- " + scan).status, 0);
  // numbers are taken up to the file, which is none
  EXPECT_EQ(run_keyline(fair + "--must-pass 0 5,9 " + scan).status, 0);
  expect_failure(run_keyline(fair + "--keep yes " + scan), 2, "--keep");  // corners, order, strays
  expect_failure(run_keyline(fair + "--pieces"), 2, "a value is missing");
  expect_failure(run_keyline(fair + "-o"), 2, "a value is missing");
  expect_failure(run_keyline("edit --quiet --keep corners " + example("cubic.json")), 2,
                 "--keep: this is for surfaces");
  expect_failure(run_keyline("lac.region word"), 2, "word: this word belongs to no option");
}

// Several key-lines are at work at a time; what is written and said does not tell.
TEST(Commands, FairOfManyIsTheSameWithAnyNumberOfThreads) {
  const Scratch s;
  std::string text;
  for (int name = 0; name < 6; ++name)
    for (int i = 0; i < 20 + 10 * ((5 * name) % 6); ++i)  // the first are not the first to end
      text += "arc" + std::to_string(name) + "," + std::to_string(0.05 * i) + "," +
              std::to_string(0.01 * i * i * (1 + 0.1 * name)) + "\n";
  const std::string input = s.write("many.csv", text);
  const auto with = [&](const std::string& threads) {
    const std::string output = s.path("out.json");
    Outcome o = run_keyline("fair " + input + " --threads " + threads + " -o " + output);
    o.out += slurp(output);
    return o;
  };
  const Outcome one = with("1");
  ASSERT_EQ(one.status, 0) << one.err;
  std::size_t last = 0;
  for (int name = 0; name < 6; ++name) {
    const std::size_t at = one.out.find("arc" + std::to_string(name) + "\n");
    ASSERT_NE(at, std::string::npos) << name;
    EXPECT_GE(at, last);
    last = at;
  }
  for (const char* threads : {"2", "5"}) {
    const Outcome more = with(threads);
    EXPECT_EQ(more.out, one.out) << threads;
    EXPECT_EQ(more.err, one.err) << threads;
  }
}

TEST(Commands, CurvesComeInTheFormsAskedFor) {
  for (const std::string& command :
       {"fair " + example("clothoid.csv"), "reverse " + example("cubic.json"),
        std::string("draw --points 0,0 2,0 3,1.5")}) {
    const std::string forms =
        R"( --quiet --json --samples 11 --bezier '{"degree":5,"tolerance":0.01}')";
    const Outcome o = run_keyline(command + forms);
    ASSERT_EQ(o.status, 0) << command << o.err;
    const json result = json::parse(o.out);
    EXPECT_EQ(result["polyline"]["points"].size(), 11U) << command;
    EXPECT_LE(result["bezier"]["deviation"].get<double>(), 0.01) << command;
  }
}

TEST(Convert, DrawsCurvesElseSurfacesAndSaysWhereThereAreNone) {
  const Scratch s;
  const Outcome drawn = run_keyline("convert --quiet " + example("cubic.json") + " -o " +
                                    s.path("a.png") + " -o " + s.path("a.html"));
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_TRUE(slurp(s.path("a.png")).starts_with("\x89PNG"));
  EXPECT_NE(slurp(s.path("a.html")).find("<table"), std::string::npos);
  const std::string surface = "convert --quiet " + example("panel-a.json") + " -o ";
  EXPECT_EQ(run_keyline(surface + s.path("b.png")).status, 0);
  EXPECT_TRUE(slurp(s.path("b.png")).starts_with("\x89PNG"));
  expect_failure(run_keyline(surface + s.path("b.svg")), 2, "there is no planar curve to draw");
  EXPECT_FALSE(std::filesystem::exists(s.path("b.svg")));
}

TEST(Commands, WhatAPointFileLeavesOutIsSaidByAll) {
  const Scratch s;
  const std::string file =
      s.write("points", "1 0\n0.75 0.04\n0.5 0.06\n0 0\n0.5 -0.04\n1 0\nProfiltyp: Tropfen\n");
  for (const std::string& command : {"list " + file, "convert " + file + " -o " + s.path("a.svg"),
                                     "analyze " + file, "fair " + file}) {
    SCOPED_TRACE(command);
    const Outcome o = run_keyline(command);
    EXPECT_EQ(o.status, 0) << o.err;
    const std::string said = o.out + o.err;
    const std::size_t first = said.find("line 7: Profiltyp: Tropfen");
    EXPECT_NE(first, said.npos) << said;
    EXPECT_EQ(said.find("Tropfen", first + 30), said.npos) << said;
  }
}

TEST(Commands, AFailureNamesAFileAsItIs) {
  const Scratch s;
  s.write("points", "");
  expect_failure(run_keyline("list points", "cd " + s.path("") + " &&"), 2, "keyline: points: ");
}

TEST(Commands, WhatMakesNoCurveWritesNoFile) {
  const Scratch s;
  const std::string file = example("cubic.json");
  for (const std::string& command : {"compare " + file + " " + file, "list " + file,
                                     std::string("curve.continuity --curves []")}) {
    SCOPED_TRACE(command);
    expect_failure(run_keyline(command + " -o " + s.path("a.svg")), 2, "makes no curve");
    EXPECT_EQ(s.count(), 0U);
  }
}

TEST(Commands, SelectingNothingTellsWhatThereIs) {
  expect_failure(run_keyline("list --select nobody " + example("outlines.csv")), 2,
                 "there are pebble, ");
  expect_failure(run_keyline("list --select nobody " + example("sketch.png")), 2,
                 "there are stroke1, ");
  expect_failure(run_keyline("list --select nobody " + example("cubic.json")), 2,
                 "give a number from 1 to 1");
  EXPECT_EQ(run_keyline("list --quiet --select 1 " + example("sketch.png")).status, 0);
}

TEST(Convert, DrawsTheLinesOfAHullAndAnalyzeTakesItsOffsetsAsPoints) {
  const Scratch s;
  const std::string hull =
      s.write("hull.csv",
              "waterline,0,1,2,3,4,5,6\n0,,0.1,0.3,0.5,0.5,0.2,0\n1,0.1,0.8,1.6,2,1.9,1.3,0.4\n"
              "2,0.3,1.2,2,2.4,2.3,1.9,1\n3,0.5,1.5,2.2,2.5,2.45,2.2,1.6\n");
  EXPECT_EQ(
      run_keyline("convert --quiet " + hull + " -o " + s.path("a.svg") + " -o " + s.path("a.png"))
          .status,
      0);
  EXPECT_NE(slurp(s.path("a.svg")).find("waterline-3"), std::string::npos);
  const Outcome o = run_keyline("analyze --quiet --json --select waterline-3 " + hull);
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(json::parse(o.out)["curvature"]["max"], json::parse(o.out)["curvature"]["min"]);
  const Outcome faired = run_keyline("fair " + hull);
  EXPECT_EQ(faired.status, 0) << faired.err;
  EXPECT_NE(faired.out.find("waterline-3\npiece"), std::string::npos) << faired.out;
}

TEST(Commands, FairWritesEveryFormat) {
  const Scratch s;
  const Outcome o =
      run_keyline("fair --quiet --json " + example("bonnet-scan.csv") + " -o " + s.path("a.svg") +
                  " -o " + s.path("a.json") + " -o " + s.path("a.csv"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const json result = json::parse(o.out);
  json written = json::parse(slurp(s.path("a.json")));
  EXPECT_EQ(written["unit"], "mm");
  written.erase("unit");
  EXPECT_EQ(result["curve"], written);
  EXPECT_LE(result["deviation"]["max"].get<double>(), result["tolerance"].get<double>());
  EXPECT_LE(result["pieces"].size(), 12U);
  EXPECT_NE(slurp(s.path("a.svg")).find("<svg"), std::string::npos);
  EXPECT_TRUE(slurp(s.path("a.csv")).starts_with("x,y,arc_length,curvature\n"));
}

TEST(Commands, SvgReadsBackAsTheExactChain) {
  const Scratch s;
  ASSERT_EQ(run_keyline("fair --quiet " + example("clothoid.csv") + " -o " + s.path("a.svg") +
                        " -o " + s.path("a.json"))
                .status,
            0);
  ASSERT_EQ(run_keyline("convert --quiet " + s.path("a.svg") + " -o " + s.path("b.json")).status,
            0);
  EXPECT_EQ(slurp(s.path("a.json")), slurp(s.path("b.json")));
}

/// A section that touches the centre plane half way up, as beside a bulb.
TEST(Commands, HalfBreadthsStayOnTheirSide) {
  const Scratch s;
  const std::string hull =
      s.write("hull.csv",
              "waterline,0,1\n0,0,1\n1,0.46,1\n2,0.92,1\n3,0.84,1\n4,0,1\n5,0.08,1\n6,1.2,1\n"
              "7,2.2,1\n8,3.1,1\n");
  const auto least = [&](const std::string& more) {
    const Outcome o = run_keyline("fair --quiet --json --samples 4001 --tolerance 0.02 " + more +
                                  " --select station-1 " + hull);
    const json answer = json::parse(o.out);
    double value = HUGE_VAL;
    for (const json& p : answer["polyline"]["points"]) value = std::min(value, p[0].get<double>());
    return value;
  };
  EXPECT_LT(least("--keep-inside 'x>=-1'"), -0.01);
  EXPECT_GE(least(""), -1e-8);
}

/// A waterline at height 2, a half breadth every metre.
TEST(Commands, AFairedCurveOfAHullStaysInItsPlane) {
  const Scratch s;
  const std::string hull =
      s.write("hull.csv",
              "waterline,0,1,2,3,4,5,6\n0,,0.1,0.3,0.5,0.5,0.2,0\n1,0.1,0.8,1.6,2,1.9,1.3,0.4\n"
              "2,0.3,1.2,2,2.4,2.3,1.9,1\n3,0.5,1.5,2.2,2.5,2.45,2.2,1.6\n");
  const std::string given = s.path("given.json");
  const std::string faired = s.path("faired.json");
  ASSERT_EQ(
      run_keyline("convert --quiet --unit m --select waterline-3 " + hull + " -o " + given).status,
      0);
  const Outcome o =
      run_keyline("fair --quiet --unit m --select waterline-3 " + hull + " -o " + faired);
  ASSERT_EQ(o.status, 0) << o.err;
  const json before = json::parse(slurp(given));
  const json after = json::parse(slurp(faired));
  EXPECT_EQ(after["unit"], "m");
  const auto curve_of = [](const json& document) {
    return document.contains("curves") ? document["curves"].at(0)["curve"] : document["curve"];
  };
  const json points = curve_of(before)["points"];
  const json control = curve_of(after)["points"];
  for (const json& p : control) {
    ASSERT_EQ(p.size(), 3U) << after.dump();
    EXPECT_NEAR(p[2].get<double>(), 2, 1e-12);
  }
  // Its ends are the table's, within the tolerance.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(control.front()[k].get<double>(), points.front()[k].get<double>(), 0.05);
    EXPECT_NEAR(control.back()[k].get<double>(), points.back()[k].get<double>(), 0.05);
  }
}

/// The drawing's page, layer and colours stay; the faired curve lies over the one given.
TEST(Commands, AFairedDrawingLiesOverTheOriginal) {
  const Scratch scratch;
  const std::string given = scratch.write(
      "drawing.svg",
      "<svg xmlns='http://www.w3.org/2000/svg' width='120mm' height='60mm' viewBox='-20 0 240 120'>"
      "<g id='roof' transform='translate(20 10) scale(1 2)' fill='none' stroke='#cc2200' "
      "stroke-width='3'><path id='line' d='M0 30C40 0 100 0 160 36'/></g></svg>");
  const std::string faired = scratch.path("faired.svg");
  const Outcome o = run_keyline("fair " + given + " -o " + faired);
  ASSERT_EQ(o.status, 0) << o.err;
  const auto before = exchange::read_svg(slurp(given));
  const auto after = exchange::read_svg(slurp(faired));
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->unit, "mm");
  ASSERT_TRUE(after->page);
  EXPECT_EQ(after->page->low, before->page->low);
  EXPECT_EQ(after->page->high, before->page->high);
  ASSERT_EQ(after->curves.size(), 1U);
  EXPECT_EQ(after->curves[0].layer, "roof");
  EXPECT_EQ(after->curves[0].color, "#cc2200");
  EXPECT_DOUBLE_EQ(after->curves[0].stroke_width, before->curves[0].stroke_width);
  // 0.01 % of the length is the tolerance of points without noise; the ends are the drawing's.
  const auto& first = before->curves[0].pieces.front().control.front();
  const auto& last = before->curves[0].pieces.back().control.back();
  EXPECT_LT(core::distance(after->curves[0].pieces.front().control.front(), first), 0.05);
  EXPECT_LT(core::distance(after->curves[0].pieces.back().control.back(), last), 0.05);
}

TEST(Commands, SameBytesWithOneThreadAndTwo) {
  const std::string fair = "fair --quiet --json " + example("bottle.csv");
  const Outcome one = run_keyline(fair + " --threads 1");
  const Outcome two = run_keyline(fair + " --threads 2");
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
}

TEST(Commands, TheSearchOfTheSplineIsChosen) {
  const std::string fair = "fair --quiet --json " + example("bonnet-scan.csv");
  const Outcome polished = run_keyline(fair);
  for (const char* search : {" --knots ga --population 40 --generations 20 --trials 2",
                             " --parameter centripetal", " --order 6"}) {
    const Outcome o = run_keyline(fair + search);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_NE(json::parse(o.out)["spline"], json::parse(polished.out)["spline"]) << search;
  }
  expect_failure(run_keyline(fair + " --knots loose"), 2, "is no choice here");
  expect_failure(run_keyline(fair + " --trials 0"), 2, "from 1 to 100000");
}

TEST(Commands, SeveralFilesAreOneKeyLine) {
  const Outcome o = run_keyline("fair --quiet --json " + example("bonnet.csv") + " " +
                                example("windscreen.csv") + " " + example("roof.csv"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NEAR(json::parse(o.out)["length"].get<double>(), 1240, 15);
}

TEST(Commands, IdColumnMakesSeveralCurves) {
  const Outcome o = run_keyline("fair --quiet --json " + example("outlines.csv"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["curves"].size(), 2U);
}

TEST(Commands, SectionOfACloudAndRowOfALattice) {
  EXPECT_EQ(
      run_keyline("fair --quiet --section y=0 --band 0.03 " + example("car-cloud.xyz")).status, 0);
  EXPECT_EQ(run_keyline("fair --quiet --row 5 " + example("car-lattice.xyz")).status, 0);
}

TEST(Commands, BatchAnswersEveryLineInOrder) {
  const Scratch s;
  const std::string requests = s.write(
      "requests", R"({"op":"lac.segment","id":1,"points":[[0,0],[2,0],[3,1.5]],"alpha":-1})"
                  "\nnot json\n\n"
                  R"({"op":"lac.segment","id":3,"points":[[0,0],[2,0],[4,0.01]],"alpha":"x"})"
                  "\n"
                  R"({"op":"operation that is none","id":4})");
  const Outcome o = run_keyline("batch <" + requests);
  ASSERT_EQ(o.status, 0);
  std::istringstream lines(o.out);
  std::string line;
  std::vector<json> answers;
  while (std::getline(lines, line)) answers.push_back(json::parse(line));
  ASSERT_EQ(answers.size(), 4U);
  EXPECT_EQ(answers[0]["ok"], true);
  EXPECT_EQ(answers[1]["error"]["code"], "bad-input");
  EXPECT_EQ(answers[2]["error"]["path"], "alpha");
  EXPECT_EQ(answers[3]["id"], 4);
}

TEST(Commands, OperationsPrintsSchemas) {
  const json list = json::parse(run_keyline("operations --json").out);
  EXPECT_GE(list.size(), 5U);
  for (const json& item : list) {
    const Outcome o = run_keyline("operations " + item["name"].get<std::string>());
    EXPECT_EQ(json::parse(o.out)["title"], item["name"]);
  }
  expect_failure(run_keyline("operations nothing"), 2, "nothing");
}

TEST(Commands, DrawTellsTheSegment) {
  const Outcome o = run_keyline("draw --points 0,0 2,0 3,1.5 --alpha -1 --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["curve"]["type"], "log-aesthetic");
  expect_failure(run_keyline("draw --points 0,0 1,0 1,0.01 --alpha -1"), 1, "");
}

}  // namespace
}  // namespace keyline::app_test
