#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "random_patches.h"

/// surface.edit_together, asked at random (see random_requests_test.cpp).
namespace keyline::operations {
namespace {

using namespace own;

constexpr double kOpen = 1e-5;  ///< largest gap that still joins, as share of the model's size

/// Parameter of the place of the edge at u that lies nearest to a point: edges that were let go
/// slide along each other.
double nearest_along(const Patches& s, double u, const Vec& p) {
  double v = 0, step = 1.0 / 64;
  const auto away = [&](double x) { return distance(spot(s.patches[0], u, x).place, p); };
  for (int k = 1; k <= 64; ++k)
    if (away(k / 64.0) < away(v)) v = k / 64.0;
  for (; step > 1e-9; step /= 2)
    for (const double x : {std::max(v - step, 0.0), std::min(v + step, 1.0)})
      if (away(x) < away(v)) v = x;
  return v;
}

/// Largest fold along the edge u = 1 of one and u = 0 of the other, from the places of either:
/// where the edges slid, what stands beside an end depends on whose it is.
std::array<double, 2> folds(const Patches& a, const Patches& b) {
  std::array<double, 2> most{};
  for (int k = 0; k <= 40; ++k)
    for (const std::size_t way : {0U, 1U}) {
      const double u = way == 0 ? 1 : 0;
      const Patches& other = way == 0 ? b : a;
      const SurfaceSpot from = spot((way == 0 ? a : b).patches[0], u, k / 40.0);
      const SurfaceSpot to = spot(other.patches[0], 1 - u, nearest_along(other, 1 - u, from.place));
      const Vec m = cross(from.u, from.v), n = cross(to.u, to.v);
      most[way] = std::max(most[way], std::atan2(size(cross(m, n)), dot(m, n)));
    }
  return most;
}

/// Distance of the edge u = 1 of one from the edge u = 0 of the other, both ways.
double gap(const Patches& a, const Patches& b) {
  constexpr int kPlaces = 40, kParts = 400;
  const auto edge = [](const Patches& s, double u, int parts) {
    std::vector<Vec> all;
    for (int k = 0; k <= parts; ++k)
      all.push_back(spot(s.patches[0], u, k / static_cast<double>(parts)).place);
    return all;
  };
  const auto farthest = [](const std::vector<Vec>& from, const std::vector<Vec>& to) {
    double most = 0;
    for (const Vec& p : from) {
      double nearest = INFINITY;
      for (std::size_t k = 0; k + 1 < to.size(); ++k) {
        const Vec along = to[k + 1] - to[k];
        const double share = std::clamp(dot(p - to[k], along) / dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, distance(p, to[k] + share * along));
      }
      most = std::max(most, nearest);
    }
    return most;
  };
  return std::max(farthest(edge(a, 1, kPlaces), edge(b, 0, kParts)),
                  farthest(edge(b, 0, kPlaces), edge(a, 1, kParts)));
}

double apart(const Patches& a, const Patches& b) {
  double most = 0;
  constexpr int kPlaces = 6;
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; j <= kPlaces; ++j) {
      const double u = i / double{kPlaces}, v = j / double{kPlaces};
      most = std::max({most, distance_from(b, spot(a.patches[0], u, v).place),
                       distance_from(a, spot(b.patches[0], u, v).place)});
    }
  return most;
}

/// Corners of the model stay; those where patches meet may move where a joint is held, unless
/// corners are kept (that both of a joint move alike its gap tells).
void expect_corners(const json& given, const json& now, bool first, bool all, double rounding) {
  const std::size_t last = now["points"].size() - 1, c = now["points"][0].size() - 1;
  for (const std::size_t row : {std::size_t{0}, std::size_t{3}})
    for (const std::size_t column : {std::size_t{0}, std::size_t{3}}) {
      if ((row == 3) == first && !all) continue;
      const json& there = now["points"][row == 0 ? 0 : last][column == 0 ? 0 : c];
      EXPECT_LT(distance(vec(given["points"][row][column]), vec(there)), rounding);
    }
}

/// Joint of both as they are now: what is held is, and what is told is so.
void expect_joint(const json& now, const json& joints, const std::string& hold, bool may_open,
                  double joining, double rounding) {
  const Patches a = patches_of(now[0]), b = patches_of(now[1]);
  const json& told = joints["after"];
  if (!may_open) {
    EXPECT_LT(gap(a, b), rounding);
  }
  const double open = gap(a, b);  // both are of places: neither is the largest to the last digit
  EXPECT_NEAR(told["gap"].get<double>(), open, 0.05 * open + 1e-5 * net_extent(now[0]) + rounding);
  if (std::abs(open - joining) > 0.1 * joining) {
    EXPECT_EQ(joints["lost"], open > joining && joints["before"]["G0"] == 1 ? 1 : 0) << open;
  }
  if (told["G0"] == 1) {  // the largest of its own places
    const auto [low, high] = std::ranges::minmax(folds(a, b));
    EXPECT_GE(told["angle"].get<double>(), 0.99 * low - 1e-6);
    EXPECT_LE(told["angle"].get<double>(), 1.01 * high + 1e-6);
  }
  if (hold != "free") {
    EXPECT_LT(std::ranges::max(folds(a, b)), 1e-5);
  }
}

TEST(RandomModels, AreEditedTogetherWithTheirJointHeld) {
  Random random(own::seed(55));
  int edited = 0;
  const int count = requests(0.002);
  const char* holds[] = {"free", "G1", "G2"};
  for (int n = 0; n < count; ++n) {
    const json whole = any_patch(random, 4, 4, 0.03);
    auto [first, second] = cut_along_u(whole, uniform(random, 0.3, 0.7));
    const double size_ = net_extent(whole), rounding = 1e-13 * (size_ + net_farthest(whole));
    const std::string hold = holds[n % 3];
    json request{{"op", "surface.edit_together"}, {"surfaces", {first, second}}, {"joints", hold}};
    const auto kind = random() % 4;
    if (kind < 2) request["limit"] = size_ * power_of_ten(random, -3, -1);
    if (kind == 2) request["limit"] = "none";
    const bool corners = random() % 3 == 0;
    if (corners) request["keep"] = "corners";
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      continue;
    }
    ++edited;
    const json& result = answer["result"];
    json now = json::array();
    for (std::size_t i = 0; i < 2; ++i) {
      const json& one = result["surfaces"][i];
      const json& given = request["surfaces"][i];
      if (!one.contains("edit") || one["edit"].is_null()) {
        EXPECT_FALSE(one["why"].get<std::string>().empty());
        now.push_back(given);
        continue;
      }
      now.push_back(one["edit"]["surface"]);
      const double told = one["edit"]["departure"];
      EXPECT_LE(apart(patches_of(given), patches_of(now[i])), told + rounding);
      if (kind != 2) {
        const double limit =
            kind < 2 ? request["limit"].get<double>() : 0.01 * box_diagonal({first, second});
        EXPECT_LE(told, limit * (1 + 1e-12));
      }
      expect_corners(given, now[i], i == 0, hold == "free" || corners, 1e-9 * size_ + rounding);
    }
    // Free patches stop at the limit each for itself (docs/limits.md), edges go with the patch.
    const bool may_open = hold == "free" && (kind != 2 || corners);
    expect_joint(now, result["joints"], hold, may_open, kOpen * box_diagonal({first, second}),
                 1e-9 * size_ + rounding);
  }
  EXPECT_GT(edited, count / 2);
}

}  // namespace
}  // namespace keyline::operations
