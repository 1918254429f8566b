#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "own_numerics.h"

/// surface.sweep, surface.revolve and surface.loft.
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::result_of;

TEST(SurfaceSweeps, TakeLogAestheticQuasiAndFreeProfiles) {
  const json segment{{"op", "lac.segment"}, {"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", -1}};
  const json lac = result_of(segment)["curve"];
  const json quasi = result_of({{"op", "lac.quasi"},
                                {"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                                {"alpha", 0},
                                {"degree", 8},
                                {"form", "taylor-angle"}})["curve"];
  const json free{{"type", "bspline"},
                  {"degree", 2},
                  {"knots", {0, 0, 0, 1, 2, 2, 2}},
                  {"points", {{0, 0}, {1, 0.5}, {2, 0}, {3, 1}}}};
  for (const json& profile : {lac, quasi, free}) {
    for (const json& rail : {json({0, 0, 4}), lac, free}) {
      const json r = result_of(
          {{"op", "surface.sweep"}, {"profile", profile}, {"rail", rail}, {"tolerance", 1e-3}});
      EXPECT_EQ(r["surface"]["type"], "bspline-surface");
      EXPECT_LE(r["deviation"].get<double>(), 1e-3);
    }
    const json turned = result_of({{"op", "surface.revolve"},
                                   {"profile", profile},
                                   {"axis", {{"point", {0, -1, 0}}, {"direction", {1, 0, 0}}}}});
    EXPECT_LE(turned["deviation"].get<double>(), 1e-4);
  }
  const json loft =
      result_of({{"op", "surface.loft"}, {"sections", {lac, quasi, free}}, {"heights", {0, 1, 3}}});
  EXPECT_EQ(loft["surface"]["degree"][0], 2);
}

/// The tolerance that is found unasked is a share of the profile's size, not of its distance from
/// the origin: moved, a surface has as many points and keeps as near to the exact one.
TEST(SurfaceSweeps, MovedFarAwayAreAsExact) {
  const auto sweep = [](double x) {
    return result_of(
        {{"op", "surface.sweep"},
         {"profile",
          {{"type", "bezier"}, {"points", {{x + 1, 0}, {x + 2, 0.5}, {x + 1, 1.4}, {x + 2, 2}}}}},
         {"rail",
          {{"type", "bezier"},
           {"points", {{x, 0, 0}, {x + 2, 0, 3}, {x + 3, 3, 3}, {x + 3, 6, 5}}}}}});
  };
  const json here = sweep(0);
  const json there = sweep(1 << 17);
  EXPECT_EQ(there["surface"]["points"].size(), here["surface"]["points"].size());
  EXPECT_NEAR(there["deviation"].get<double>(), here["deviation"].get<double>(), 1e-8);
  EXPECT_LE(there["deviation"].get<double>(), 1e-5 * 2);
}

TEST(SurfaceSweeps, SayWhatIsWrong) {
  const json line{{"type", "polyline"}, {"points", {{0, 0}, {1, 1}}}};
  const auto path = [](const json& request) {
    const json answer = own::answered(request);
    EXPECT_EQ(answer["ok"], false) << request;
    return answer.value("error", json::object()).value("path", "");
  };
  EXPECT_EQ(path({{"op", "surface.sweep"}, {"profile", line}, {"rail", {0, 0, 0}}}), "rail");
  EXPECT_EQ(path({{"op", "surface.sweep"}, {"profile", 3}, {"rail", {0, 0, 1}}}), "profile");
  EXPECT_EQ(
      path({{"op", "surface.sweep"}, {"profile", line}, {"rail", {0, 0, 1}}, {"plane", "across"}}),
      "plane");
  EXPECT_EQ(path({{"op", "surface.revolve"}, {"profile", line}, {"axis", 1}}), "axis");
  EXPECT_EQ(
      path({{"op", "surface.revolve"}, {"profile", line}, {"axis", {{"direction", {0, 0, 0}}}}}),
      "axis");
  EXPECT_EQ(path({{"op", "surface.loft"}, {"sections", {line}}}), "sections");
  EXPECT_EQ(path({{"op", "surface.loft"}, {"sections", {line, line}}, {"heights", {1}}}),
            "heights");
  EXPECT_EQ(path({{"op", "surface.loft"}, {"sections", {line, {{"type", "polyline"}}}}}),
            "sections[1].points");
}

}  // namespace
}  // namespace keyline::operations
