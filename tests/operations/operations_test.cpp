#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/held_curve.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/schema.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

TEST(Operations, EveryExampleSucceeds) {
  std::filesystem::current_path(KEYLINE_SOURCE_DIR);  // files of the examples are named from there
  for (const Operation& operation : operations()) {
    EXPECT_FALSE(operation.examples.empty()) << operation.name;
    for (const std::string& example : operation.examples) {
      const auto result = perform(operation.name, json::parse(example), {});
      EXPECT_TRUE(result) << operation.name << ": " << (result ? "" : result.error().message);
    }
  }
}

TEST(Operations, EverySchemaNamesItsRequiredFields) {
  for (const Operation& operation : operations()) {
    const json schema = request_schema(operation);
    EXPECT_EQ(schema["title"], operation.name);
    for (const auto& name : schema["required"]) EXPECT_TRUE(schema["properties"].contains(name));
    for (const auto& [name, property] : schema["properties"].items())
      EXPECT_TRUE(name == "op" || property.contains("description")) << operation.name << name;
  }
}

TEST(Operations, UnknownAndMissingFieldsAreNamed) {
  const auto unknown =
      perform("lac.segment", {{"points", {{0, 0}, {1, 0}, {2, 1}}}, {"alpha", 1}, {"alpa", 2}}, {});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().path, "alpa");
  const auto missing = perform("lac.segment", {{"points", {{0, 0}, {1, 0}, {2, 1}}}}, {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().path, "alpha");
  EXPECT_EQ(missing.error().code, core::ErrorCode::bad_input);
}

// A slip in a curve would be another curve.
TEST(Operations, UnknownMembersOfValuesAreRefused) {
  const json bezier{{"type", "bezier"}, {"points", {{0, 0}, {1, 2}, {3, 0}}}};
  const auto with = [](json value, const char* name) {
    value[name] = json::array({1, 2, 1});
    return value;
  };
  const auto blamed = [](const char* name, const json& request) {
    const auto result = perform(name, request, {});
    return result ? "nothing" : result.error().path + ": " + result.error().hint;
  };
  EXPECT_EQ(blamed("curve.analyze", {{"curve", with(bezier, "weihgts")}}),
            "curve.weihgts: did you mean \"weights\"?");
  const json path{{"type", "path"}, {"curves", {bezier, with(bezier, "color")}}};
  EXPECT_EQ(blamed("curve.analyze", {{"curve", path}}),
            "curve.curves[1].color: it has points and weights");
  const json patch{{"type", "bezier-surface"},
                   {"points", {{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {1, 1, 1}}}}};
  EXPECT_EQ(blamed("surface.sav", {{"surface", with(patch, "x")}}),
            "surface.x: it has points and weights");
  EXPECT_EQ(blamed("curve.continuity", {{"curves", {bezier, with(bezier, "knots")}}}),
            "curves[1].knots: it has points and weights");
  EXPECT_EQ(HeldCurve::from_json(with(bezier, "weigths")).error().path, "curve.weigths");
  EXPECT_EQ(HeldSurface::from_json(with(patch, "weigths")).error().path, "surface.weigths");
}

// A unit square: the start of a closed curve is no end.
TEST(Operations, ClosedCurvesAreSplitOverTheirStart) {
  const auto parts = [](const json& curve, const json& more) {
    json request{{"curve", curve}};
    request.update(more);
    const auto result = perform("curve.split", request, {});
    return result ? (*result)["parts"] : json(result.error().path);
  };
  const json line{{"type", "polyline"}, {"points", {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}}};
  const json ring{{"type", "path"}, {"curves", {line}}, {"closed", true}};
  for (const json& square : {line, ring}) {
    const json two = parts(square, {{"at", {0.125, 0.625}}});
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[1]["curve"]["points"],
              json::parse("[[0.5, 1.0], [0.0, 1.0], [0.0, 0.0], [0.5, 0.0]]"));
    const json opened = parts(square, {{"at", 0.125}});
    ASSERT_EQ(opened.size(), 1U);
    EXPECT_EQ(opened[0]["curve"]["points"].size(), 6U);
    EXPECT_EQ(parts(square, {{"at", {0, 0.5}}}).size(), 2U);
    EXPECT_EQ(parts(square, {{"corners", true}}).size(), 4U);
    EXPECT_EQ(parts(square, {{"corners", true}, {"at", 1}}).size(), 4U);
    EXPECT_EQ(perform("curve.analyze", {{"curve", square}}, {}).value()["corners"].size(), 4U);
  }
  const json open{{"type", "polyline"}, {"points", {{0, 0}, {1, 0}, {1, 1}}}};
  EXPECT_EQ(parts(open, {{"at", 0}}), "at");
  EXPECT_EQ(parts(open, {{"at", 0.5}}).size(), 2U);
}

TEST(Operations, PathOfABadPointIsExact) {
  const auto result =
      perform("lac.segment", {{"points", {{0, 0}, {1, "a"}, {2, 1}}}, {"alpha", 1}}, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "points[1][1]");
}

TEST(Answer, LinesThatAreNotJsonGetAnAnswerToo) {
  const json answer = json::parse(answer_line("{nonsense", {}));
  EXPECT_EQ(answer["ok"], false);
  EXPECT_EQ(answer["error"]["code"], "bad-input");
}

TEST(Answer, DeeplyNestedLinesGetAnAnswerToo) {
  const std::string deep = std::string(300'000, '[') + std::string(300'000, ']');
  const json answer = json::parse(answer_line(R"({"op":"lac.segment","id":)" + deep + "}", {}));
  EXPECT_EQ(answer["ok"], false);
  EXPECT_EQ(answer["error"]["code"], "bad-input");
}

TEST(Answer, GivesTheIdBack) {
  const json request{{"op", "lac.segment"},
                     {"id", {{"a", 7}}},
                     {"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                     {"alpha", -1}};
  const json good = answer(request, {});
  EXPECT_EQ(good["id"], (json{{"a", 7}}));
  EXPECT_EQ(good["ok"], true);
  EXPECT_EQ(good["result"]["curve"]["type"], "log-aesthetic");
  const json bad = answer({{"op", "no.such"}, {"id", 3}}, {});
  EXPECT_EQ(bad["id"], 3);
  EXPECT_EQ(bad["error"]["code"], "unsupported");
}

TEST(DerivedForms, AreAddedWithTheirBound) {
  const auto result = perform("lac.segment",
                              {{"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                               {"alpha", -1},
                               {"samples", 11},
                               {"bezier", {{"degree", 3}, {"tolerance", 1e-4}}},
                               {"nurbs", {{"tolerance", 1e-3}}}},
                              {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ((*result)["polyline"]["points"].size(), 11);
  EXPECT_LE((*result)["bezier"]["deviation"].get<double>(), 1e-4);
  EXPECT_LE((*result)["nurbs"]["deviation"].get<double>(), 1e-3);
}

TEST(DerivedForms, AreExactQuinticOrCubicByWhatIsAskedFor) {
  json request{{"points", {{0, 0}, {2, 0}, {3, 1.5}}},
               {"alpha", -1},
               {"bezier", {{"degree", 5}, {"tolerance", 1e-9}}}};
  const auto quintics = perform("lac.segment", request, {});
  request["bezier"]["degree"] = 3;
  const auto cubics = perform("lac.segment", request, {});
  ASSERT_TRUE(quintics && cubics);
  EXPECT_LE((*quintics)["bezier"]["deviation"].get<double>(), 1e-9);
  EXPECT_LT((*quintics)["bezier"]["curves"].size(), (*cubics)["bezier"]["curves"].size());
  request["form"] = "taylor-angle";
  request["degree"] = 6;
  request["bezier"]["degree"] = 7;
  const auto raised = perform("lac.quasi", request, {});
  ASSERT_TRUE(raised) << raised.error().message;
  EXPECT_EQ((*raised)["bezier"]["curves"].size(), 1U);
  EXPECT_EQ((*raised)["bezier"]["curves"][0]["points"].size(), 8U);
  EXPECT_EQ((*raised)["bezier"]["deviation"], 0);
}

TEST(DerivedForms, ToleranceBelowRoundingIsRefusedSoon) {
  for (const char* name : {"bezier", "nurbs"}) {
    const auto result = perform("lac.segment",
                                {{"points", {{0, 0}, {1, 0}, {2, 1}}},
                                 {"alpha", 1},
                                 {name, {{"degree", 3}, {"tolerance", 1e-15}}}},
                                {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, core::ErrorCode::not_converged);
    EXPECT_EQ(result.error().path, std::string(name) + ".tolerance");
  }
}

TEST(DerivedForms, SchemaNamesThem) {
  const json schema = request_schema(*find_operation("fair"));
  EXPECT_EQ(schema["additionalProperties"], false);
  for (const char* name : {"samples", "bezier", "nurbs", "threads"})
    EXPECT_TRUE(schema["properties"].contains(name)) << name;
  EXPECT_FALSE(request_schema(*find_operation("curve.cav"))["properties"].contains("samples"));
}

TEST(Request, EveryFailureHasARemedy) {
  const auto volume = perform(
      "lac.volume",
      {{"points", {{0, 0}, {2, 0}}}, {"direction", 0.6}, {"alpha", -1}, {"volume", -1}}, {});
  EXPECT_EQ(volume.error().hint, "area between curve and chord, 0 or more");
  const auto few = perform("fit.spline", {{"points", {{0, 0}}}}, {});
  EXPECT_EQ(few.error().hint, "give more points, or a smaller order");
  // a room that names none
  const json points = {{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}};
  const auto weighed =
      perform("fit.spline", {{"points", points}, {"weights", {1, 1, 1, 1, -1}}}, {});
  EXPECT_EQ(weighed.error().hint, "keyline operations fit.spline tells what it takes");
}

TEST(Request, ThreadsAreCheckedAndChangeNothing) {
  json request{{"points", {{0, 0}, {1, 0.1}, {2, 0.3}, {3, 0.7}, {4, 1.2}}}};
  const auto usual = perform("fair", request, {});
  request["threads"] = 1;
  const auto one = perform("fair", request, {});
  ASSERT_TRUE(usual && one);
  EXPECT_EQ(*usual, *one);
  request["threads"] = -1;
  EXPECT_EQ(perform("fair", request, {}).error().path, "threads");
}

TEST(Fair, AClosedPathHasACornerWhereItBegins) {
  const auto side = [](double x0, double y0, double x1, double y1) {
    return json{{"type", "bezier"}, {"points", {{x0, y0}, {x1, y1}}}};
  };
  const json square = {
      {"type", "path"},
      {"closed", true},
      {"curves", {side(0, 0, 8, 0), side(8, 0, 8, 6), side(8, 6, 0, 6), side(0, 6, 0, 0)}}};
  const auto result = perform("fair", {{"curve", square}}, {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ((*result)["pieces"].size(), 4U);
  EXPECT_LT((*result)["deviation"]["max"].get<double>(), 1e-9);
}

TEST(Continuity, SeesACornerAndASmoothJoint) {
  const auto line = [](double x0, double y0, double x1, double y1) {
    return json{{"type", "polyline"}, {"points", {{x0, y0}, {x1, y1}}}};
  };
  const auto result = perform(
      "curve.continuity",
      {{"curves", json::array({line(0, 0, 1, 0), line(1, 0, 2, 0), line(2, 0, 2, 1)})}}, {});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ((*result)["joints"][0]["order"], "G3");
  EXPECT_EQ((*result)["joints"][1]["order"], "G0");
  EXPECT_EQ((*result)["order"], "G0");
}

}  // namespace
}  // namespace keyline::operations
