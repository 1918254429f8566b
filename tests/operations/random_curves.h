#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "own_curves.h"
#include "random_values.h"

/// Curves of all kinds drawn at random, and how far such curves are from each other.
namespace keyline::own {

inline std::string digest(const json& request) { return request.dump().substr(0, 1200); }

inline json one_or_more(Random& random) {
  if (random() % 3 == 0) return any_bspline(random);
  return any_bezier(random);
}

/// Curvature at many places of a planar curve; those next to a cusp too.
inline std::vector<double> curvatures(const std::vector<Bezier>& curve, int each) {
  std::vector<double> all;
  for (const Spot& s : spots(curve, each)) all.push_back(curvature(s));
  return all;
}

/// The largest distance of the places from the curve.
inline double farthest_from(const std::vector<Bezier>& curve, const std::vector<Vec>& places) {
  double most = 0;
  for (const Vec& p : places) most = std::max(most, distance_from(curve, p));
  return most;
}
inline std::vector<Vec> places_along(const std::vector<Bezier>& curve, int each) {
  std::vector<Vec> all;
  for (const Spot& s : spots(curve, each)) all.push_back(s.place);
  return all;
}

inline json any_path(Random& random) {
  const Frame2 frame = any_frame(random);
  json path{{"type", "path"}, {"curves", json::array()}, {"closed", false}};
  json at = frame(0, 0);
  const std::size_t count = 2 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    json points = any_points(random, 3 + random() % 3, frame, random() % 2 == 0);
    const double dx = at[0].get<double>() - points[0][0].get<double>();
    const double dy = at[1].get<double>() - points[0][1].get<double>();
    for (json& p : points) p = {p[0].get<double>() + dx, p[1].get<double>() + dy};
    points[0] = at;
    at = points.back();
    path["curves"].push_back({{"type", "bezier"}, {"points", points}});
  }
  return path;
}

inline json any_log_aesthetic(Random& random) {
  const Frame2 frame = any_frame(random);
  json curve{{"type", "log-aesthetic"},
             {"start", frame(0, 0)},
             {"direction", frame.angle},
             {"pieces", json::array()}};
  double k = uniform(random, 0.1, 2);
  const std::size_t count = 1 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    const double next = k * power_of_ten(random, -0.7, 0.7);
    curve["pieces"].push_back({{"alpha", uniform(random, -2, 2)},
                               {"length", frame.size * uniform(random, 0.3, 1)},
                               {"curvature", {k / frame.size, next / frame.size}}});
    k = next;
  }
  return curve;
}

inline json any_curve(Random& random) {
  switch (random() % 4) {
    case 0:
      return any_bspline(random);
    case 1:
      return any_log_aesthetic(random);
    case 2:
      return any_path(random);
    default:
      return any_bezier(random);
  }
}

/// Places of either within so much of the other.
inline void expect_together(const json& a, const json& b, double allowed) {
  const auto pa = beziers_of(a), pb = beziers_of(b);
  EXPECT_LE(farthest_from(pb, places_of(a, 60)), allowed);
  EXPECT_LE(farthest_from(pa, places_of(b, 60)), allowed);
}

inline double extent(const json& curve) {
  double most = 0;
  const auto all = places_of(curve, 40);
  for (const Vec& p : all) most = std::max(most, distance(p, all[0]));
  return most;
}

inline double farthest(const json& curve) {
  double most = 0;
  for (const Vec& p : places_of(curve, 40)) most = std::max(most, size(p));
  return most;
}

}  // namespace keyline::own
