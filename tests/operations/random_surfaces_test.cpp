#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "own_curves.h"
#include "random_patches.h"
#include "random_values.h"
#include "worst.h"

/// Requests to surface.* drawn at random (see random_curves_test.cpp).
namespace keyline::operations {
namespace {

using namespace own;

TEST(RandomSurfaces, ValuesAreThoseOfTheirCurvesWhicheverWayTheyAreHeld) {
  Random random(own::seed(31));
  Worst worst("sav");
  for (int n = 0; n < requests(0.02); ++n) {
    const json surface =
        any_patch(random, 3 + random() % 2, 3 + random() % 3, n % 3 == 0 ? 0.0 : 0.05);
    const json request{{"op", "surface.sav"}, {"surface", surface}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      continue;
    }
    const json& result = answer["result"];
    double sum = 0;
    for (const json& c : result["curves"]) sum += c["cav"].get<double>();
    const double sav = result["sav"];
    EXPECT_NEAR(sav, sum, 1e-9 * (1 + sum));
    // Every curve's energy by quadrature: A1... are rows, then columns.
    const auto rows = surface["points"].size();
    const json columns = transposed(surface)["points"];
    for (std::size_t i = 0; i < result["curves"].size(); ++i) {
      const json& points = i < rows ? surface["points"][i] : columns[i - rows];
      const double energy = energy_of(beziers_of({{"type", "bezier"}, {"points", points}})[0]);
      EXPECT_NEAR(result["curves"][i]["energy"].get<double>() / energy, 1, 1e-7) << i;
    }
    for (const json& other : {transposed(surface), mirrored_net(surface), scaled_net(surface, 8),
                              turned_net(surface)}) {
      json again = request;
      again["surface"] = other;
      worst.expect_below(std::abs(result_of(again)["sav"].get<double>() - sav) / (1 + sav), 1e-6);
    }
  }
}

/// Places of either surface within `told` of the other.
void expect_apart_at_most(const json& a, const json& b, double told, double rounding) {
  const Patches pa = patches_of(a), pb = patches_of(b);
  constexpr int kPlaces = 6;
  double most = 0;
  for (const auto& [from, to] : {std::pair{&pa, &pb}, {&pb, &pa}})
    for (const Patch& patch : from->patches)
      for (int i = 0; i <= kPlaces; ++i)
        for (int j = 0; j <= kPlaces; ++j)
          most = std::max(
              most,
              distance_from(*to, spot(patch, i / double{kPlaces}, j / double{kPlaces}).place));
  EXPECT_LE(most, told + rounding);
}

/// Control points that an edit was to keep are where they were.
void expect_held(const json& before, const json& after, const std::string& keep, double rounding) {
  const json &given = before["points"], &now = after["points"];
  const auto same = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    EXPECT_LT(distance(vec(given[i][j]), vec(now[k][l])), rounding);
  };
  same(0, 0, 0, 0);
  const std::size_t r = now.size() - 1, c = now[0].size() - 1;
  if (keep != "start") {
    same(3, 0, r, 0);
    same(0, 3, 0, c);
    same(3, 3, r, c);
  }
  if (keep == "boundary" && r == 3 && c == 3)
    for (std::size_t i = 0; i < 4; ++i) {
      same(i, 0, i, 0);
      same(i, 3, i, 3);
      same(0, i, 0, i);
      same(3, i, 3, i);
    }
}

TEST(RandomSurfaces, EditsKeepWhatTheyHoldAndStayWithinTheirLimit) {
  Random random(own::seed(32));
  int edited = 0;
  const char* keeps[] = {"start", "corners", "joints", "boundary"};
  for (int n = 0; n < requests(0.01); ++n) {
    const json surface = any_patch(random, 4, 4, 0.03);
    const double size = net_extent(surface);
    const std::string keep = keeps[random() % 4];
    json request{{"op", "surface.edit"}, {"surface", surface}, {"keep", keep}};
    const auto kind = random() % 4;
    if (kind < 2) request["limit"] = size * power_of_ten(random, -3, -1);
    if (kind == 2) request["limit"] = "none";
    if (random() % 3 == 0) request["amount"] = uniform(random, 0, 1);
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      continue;
    }
    ++edited;
    const json& result = answer["result"];
    const double told = result["departure"];
    const double rounding = 1e-13 * (size + net_farthest(surface));
    if (kind < 2) {
      EXPECT_LE(told, request["limit"].get<double>() * (1 + 1e-12));
    }
    expect_apart_at_most(surface, result["surface"], told, rounding);
    expect_held(surface, result["surface"], keep, 1e-9 * size + rounding);
    const json fresh = answered({{"op", "surface.sav"}, {"surface", result["surface"]}});
    if (!request.contains("amount") && fresh["ok"] == true) {
      EXPECT_LE(result["after"]["sav"].get<double>(),
                result["before"]["sav"].get<double>() * (1 + 1e-9) + 1e-6);
    }
    for (const json& other : {mirrored_net(surface), scaled_net(surface, 8)}) {
      json again = request;
      again["surface"] = other;
      const double by = other == surface ? 1 : net_extent(other) / size;
      if (kind < 2) again["limit"] = by * again["limit"].get<double>();
      const json twin = result_of(again);
      // A bound is within 0.5 % of what is so; the way to a limit is halved to a thousandth.
      const double apart = 5e-3 + (kind < 2 ? 1e-3 : 0);
      EXPECT_NEAR(twin["departure"].get<double>() / by, told, apart * told + rounding);
      EXPECT_NEAR(twin["after"]["sav"].get<double>(), result["after"]["sav"].get<double>(),
                  1e-4 * (1 + result["after"]["sav"].get<double>()));
    }
  }
  EXPECT_GT(edited, requests(0.01) / 2);
}

TEST(RandomSurfaces, CurvaturesAreThoseOfTheirDerivatives) {
  Random random(own::seed(33));
  Worst worst("curvature");
  for (int n = 0; n < requests(0.04); ++n) {
    json surface = any_patch(random, 2 + random() % 4, 2 + random() % 4, 0.1);
    if (random() % 3 == 0)
      for (std::size_t i = 0; i < surface["points"].size(); ++i) {
        surface["weights"].push_back(json::array());
        for (std::size_t j = 0; j < surface["points"][0].size(); ++j)
          surface["weights"][i].push_back(uniform(random, 0.5, 2));
      }
    json request{{"op", "surface.interrogate"}, {"surface", surface}, {"grid", {5, 4}}};
    SCOPED_TRACE(request.dump());
    const auto field = [&](const char* kind) {
      request["kind"] = kind;
      return result_of(request)["values"];
    };
    const json gaussian = field("gaussian"), mean = field("mean"), principal = field("principal");
    const Vec light{uniform(random, -1, 1), uniform(random, -1, 1), 1};
    request["light"] = light;
    const json isophote = field("isophote");
    request["view"] = light;
    request["stripes"] = {1, 0.2, 0};
    const json zebra = field("zebra");
    const Patch patch = patches_of(surface).patches[0];
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const SurfaceSpot s = spot(patch, static_cast<double>(i) / 4, static_cast<double>(j) / 3);
        const Vec across = cross(s.u, s.v);
        const Vec normal = (1 / size(across)) * across;
        const double e = dot(s.u, s.u), f = dot(s.u, s.v), g = dot(s.v, s.v);
        const double l = dot(s.uu, normal), m = dot(s.uv, normal), q = dot(s.vv, normal);
        const double area = e * g - f * f;
        const double k = (l * q - m * m) / area, h = (e * q - 2 * f * m + g * l) / (2 * area);
        const double root = std::sqrt(std::max(0.0, h * h - k));
        const double most = std::abs(h) + root;
        worst.expect_below(std::abs(gaussian[i][j].get<double>() - k) / (most * most), 1e-8);
        worst.expect_below(std::abs(mean[i][j].get<double>() - h) / most, 1e-8);
        EXPECT_NEAR(principal[i][j][0].get<double>(), h + root, 1e-5 * most);
        EXPECT_NEAR(principal[i][j][1].get<double>(), h - root, 1e-5 * most);
        const Vec to_light = (1 / size(light)) * light;
        EXPECT_NEAR(isophote[i][j].get<double>(), dot(normal, to_light), 1e-9);
        const Vec ray = (2 * dot(normal, to_light)) * normal - to_light;
        const Vec stripes = (1 / std::hypot(1, 0.2)) * Vec{1, 0.2, 0};
        EXPECT_NEAR(
            zebra[i][j].get<double>(),
            12 * (0.5 + std::asin(std::clamp(dot(ray, stripes), -1.0, 1.0)) / std::numbers::pi),
            1e-6);
      }
  }
}

TEST(RandomSurfaces, JointsAreAsTheyWereMade) {
  Random random(own::seed(34));
  for (int n = 0; n < requests(0.02); ++n) {
    // Two patches cut from one, so that all is equal across; then one is lifted or turned up.
    const json whole = any_patch(random, 4, 4, 0.05);
    const double u = uniform(random, 0.3, 0.7);
    const auto [first, second] = cut_along_u(whole, u);
    const double extent_ = net_extent(whole), size_ = extent_ + net_farthest(whole);
    json request{{"op", "surface.continuity"},
                 {"surfaces", {first, second}},
                 {"edges", {"u1", "u0"}},
                 {"places", 21},
                 {"gap", 1e-9 * size_}};
    SCOPED_TRACE(request.dump());
    EXPECT_EQ(result_of(request)["order"], "G3");
    json twins = request;
    std::swap(twins["surfaces"][0], twins["surfaces"][1]);
    twins["edges"] = {"u0", "u1"};
    EXPECT_EQ(result_of(twins)["order"], "G3");
    // A gap of a known size, straight up out of the tangent plane at one place of the edge.
    const double lift = extent_ * power_of_ten(random, -4, -2);
    request["surfaces"][1] = with_net(second, [lift](json p) {
      p[2] = p[2].get<double>() + lift;
      return p;
    });
    json result = result_of(request);
    EXPECT_EQ(result["order"], "none");
    EXPECT_LE(result["gap"].get<double>(), lift * (1 + 1e-9));
    EXPECT_GT(result["gap"].get<double>(), 0.5 * lift);
    // The second patch's next row moved: the fold is the angle between both outward directions.
    request["surfaces"][1] = second;
    for (json& p : request["surfaces"][1]["points"][1]) p[2] = p[2].get<double>() + lift;
    result = result_of(request);
    EXPECT_EQ(result["order"], "G0");
    const Patch a = patches_of(first).patches[0];
    const Patch b = patches_of(request["surfaces"][1]).patches[0];
    double most = 0;
    for (int k = 0; k <= 20; ++k) {
      const SurfaceSpot from = spot(a, 1, k / 20.0), to = spot(b, 0, k / 20.0);
      const Vec edge = (1 / size(from.v)) * from.v;
      const Vec out = from.u - dot(from.u, edge) * edge, in = to.u - dot(to.u, edge) * edge;
      most = std::max(most, std::atan2(size(cross(out, in)), dot(out, in)));
    }
    EXPECT_NEAR(result["angle"], most, 1e-7 + 1e-6 * most);
  }
}

TEST(RandomSurfaces, SweepsCarryTheirProfile) {
  Random random(own::seed(35));
  for (int n = 0; n < requests(0.03); ++n) {
    json profile = random() % 2 == 0 ? any_bezier(random, 2, 5) : any_bspline(random);
    const auto line = beziers_of(profile);
    const double length = length_of(line);
    const Vec by{uniform(random, -1, 1) * length, 0.5 * length, uniform(random, 0.2, 1) * length};
    json request{{"op", "surface.sweep"}, {"profile", profile}, {"rail", by}};
    SCOPED_TRACE(request.dump());
    const json straight = result_of(request);
    EXPECT_EQ(straight["deviation"], 0.0);
    const Patches carried = patches_of(straight["surface"]);
    const double rounding = 1e-9 * length + 1e-13 * size(spot(line[0], 0).place);
    for (int k = 0; k < 6; ++k) {
      const Bezier& c = line[random() % line.size()];
      const double share = uniform(random, 0, 1);
      const Vec p = spot(c, uniform(random, 0, 1)).place + share * by;
      EXPECT_LT(distance_from(carried, p), rounding);
    }
    // Turned about an axis: the circle of every point of it.
    const Vec on{uniform(random, -1, 1) * length, 2 * length, 0};
    const double angle = uniform(random, 0.2, 6.2);
    const json turned = result_of({{"op", "surface.revolve"},
                                   {"profile", profile},
                                   {"axis", {{"point", on}, {"direction", {1, 0, 0}}}},
                                   {"angle", angle}});
    const Patches round = patches_of(turned["surface"]);
    for (int k = 0; k < 6; ++k) {
      const Vec p = spot(line[random() % line.size()], uniform(random, 0, 1)).place;
      const double a = uniform(random, 0, angle), y = p[1] - on[1], z = p[2] - on[2];
      const Vec there{p[0], on[1] + std::cos(a) * y - std::sin(a) * z,
                      on[2] + std::sin(a) * y + std::cos(a) * z};
      EXPECT_LT(distance_from(round, there), rounding + 1e-9 * std::abs(y));
    }
    // Through sections: each lies on the loft.
    json sections = json::array(), heights = json::array();
    const std::size_t count = 2 + random() % 3;
    double height = 0;
    for (std::size_t i = 0; i < count; ++i) {
      sections.push_back(with_points(profile, [&](json p) {
        for (json& x : p) x = x.get<double>() + 0.05 * length * uniform(random, -1, 1);
        return p;
      }));
      height += i == 0 ? 0 : length * uniform(random, 0.6, 1);  // a loft that folds has two feet
      heights.push_back(height);
    }
    const json skinning{{"op", "surface.loft"}, {"sections", sections}, {"heights", heights}};
    SCOPED_TRACE(skinning.dump());
    const Patches skin = patches_of(result_of(skinning)["surface"]);
    for (std::size_t i = 0; i < count; ++i) {
      const auto section = beziers_of(sections[i]);
      Vec p = spot(section[random() % section.size()], uniform(random, 0, 1)).place;
      p[2] += heights[i].get<double>();
      EXPECT_LT(distance_from(skin, p), rounding);
    }
  }
}

/// Rows and columns of a patch as curves.
json row_of(const json& surface, std::size_t i) {
  return {{"type", "bezier"}, {"points", surface["points"][i]}};
}

TEST(RandomSurfaces, NetworksPassTheirCurves) {
  Random random(own::seed(36));
  for (int n = 0; n < requests(0.01); ++n) {
    const json made = any_patch(random, 4, 4, 0.1);
    const json columns = transposed(made);
    const json request{{"op", "surface.network"},
                       {"along_u", {row_of(made, 0), row_of(made, 3)}},
                       {"along_v", {row_of(columns, 0), row_of(columns, 3)}},
                       {"tolerance", 1e-4 * net_extent(made)}};
    SCOPED_TRACE(request.dump());
    const json result = result_of(request);
    EXPECT_LE(result["deviation"].get<double>(), request["tolerance"].get<double>());
    const Patches skin = patches_of(result["surface"]);
    for (const char* way : {"along_u", "along_v"})
      for (const json& curve : request[way])
        for (const double t : {0.0, 0.13, 0.5, 0.77, 1.0})
          EXPECT_LE(
              distance_from(skin, spot(beziers_of(curve)[0], t).place),
              result["deviation"].get<double>() + 1e-12 * (net_extent(made) + net_farthest(made)));
    // A patch of rows along a column has them as they are, moved to start on it.
    json rows = json::array();
    for (std::size_t i = 0; i < 4; ++i) rows.push_back(row_of(made, i));
    const json patch =
        result_of({{"op", "surface.patch"}, {"rows", rows}, {"column", row_of(columns, 0)}});
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(patch["moved"][i].get<double>(), 1e-12 * net_farthest(made));
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_LT(distance(vec(patch["surface"]["points"][i][j]), vec(made["points"][i][j])),
                  1e-12 * net_farthest(made));
    }
  }
}

}  // namespace
}  // namespace keyline::operations
