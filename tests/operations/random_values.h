#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "own_numerics.h"

/// Curves drawn at random.
namespace keyline::own {

using Random = std::mt19937_64;

/// Of each kind that are asked for: so many, and in a full run 1,000.
inline int refusals(int plain) { return std::getenv("KEYLINE_FULL") ? 1000 : plain; }

inline double sign(Random& random) { return random() % 2 == 0 ? 1 : -1; }
inline double power_of_ten(Random& random, double low, double high) {
  return std::pow(10, uniform(random, low, high));
}

/// Any slope, whole ones and those next to 0 and 1 often.
inline double any_slope(Random& random) {
  switch (random() % 6) {
    case 0:
      return static_cast<double>(random() % 5) - 2;
    case 1:
      return sign(random) * power_of_ten(random, -8, 0);
    case 2:
      return 1 + sign(random) * power_of_ten(random, -8, 0);
    default:
      return uniform(random, -4, 4);
  }
}

/// A place, an attitude and a size: what of a curve must not matter.
struct Frame2 {
  double x = 0, y = 0, angle = 0, size = 1;
  json operator()(double a, double b) const {
    return {x + size * (a * std::cos(angle) - b * std::sin(angle)),
            y + size * (a * std::sin(angle) + b * std::cos(angle))};
  }
};
inline Frame2 any_frame(Random& random) {
  const double size = power_of_ten(random, -2, 3);
  return {uniform(random, -3, 3) * size, uniform(random, -3, 3) * size,
          uniform(random, -std::numbers::pi, std::numbers::pi), size};
}

/// Control points one after the other: turning little by little (a calm curve) or anyhow.
inline json any_points(Random& random, std::size_t count, const Frame2& frame, bool calm) {
  json points = json::array({frame(0, 0)});
  double a = 0, b = 0, heading = 0;
  const double turn = uniform(random, -0.5, 0.5), growth = uniform(random, 0.7, 1.4);
  double step = 0.3;
  while (points.size() < count) {
    a += step * std::cos(heading);
    b += step * std::sin(heading);
    points.push_back(frame(a, b));
    heading += calm ? turn : uniform(random, -2, 2);
    step *= calm ? growth : uniform(random, 0.6, 1.6);
  }
  return points;
}

inline json any_bezier(Random& random, std::size_t least = 2, std::size_t most = 7) {
  const std::size_t degree = least + random() % (most - least + 1);
  return {{"type", "bezier"},
          {"points", any_points(random, degree + 1, any_frame(random), random() % 2 == 0)}};
}

inline json any_bspline(Random& random) {
  const std::size_t degree = 2 + random() % 4, inner = 1 + random() % 4;
  json knots = json::array();
  for (std::size_t i = 0; i <= degree; ++i) knots.push_back(0.0);
  double at = 0;
  for (std::size_t i = 0; i < inner; ++i) knots.push_back(at += uniform(random, 0.1, 1));
  at += uniform(random, 0.1, 1);
  for (std::size_t i = 0; i <= degree; ++i) knots.push_back(at);
  return {{"type", "bspline"},
          {"degree", degree},
          {"knots", knots},
          {"points", any_points(random, degree + 1 + inner, any_frame(random), random() % 2 == 0)}};
}

/// Numbers of every point by a function of one point.
template <class F>
json with_points(json curve, const F& f) {
  if (curve.contains("curves")) {
    for (json& c : curve["curves"]) c = with_points(c, f);
    return curve;
  }
  for (json& p : curve["points"]) p = f(p);
  return curve;
}
inline json mirrored(const json& curve) {
  return with_points(curve, [](json p) {
    p[1] = -p[1].get<double>();
    return p;
  });
}
inline json scaled(const json& curve, double by) {
  return with_points(curve, [by](json p) {
    for (json& x : p) x = by * x.get<double>();
    return p;
  });
}
/// Of beziers, bsplines and polylines.
inline json reversed(json curve) {
  if (curve.contains("curves")) {
    json turned = json::array();
    for (auto c = curve["curves"].rbegin(); c != curve["curves"].rend(); ++c)
      turned.push_back(reversed(*c));
    curve["curves"] = turned;
    return curve;
  }
  json points = json::array(), knots = json::array();
  for (auto p = curve["points"].rbegin(); p != curve["points"].rend(); ++p) points.push_back(*p);
  curve["points"] = points;
  if (!curve.contains("knots")) return curve;
  const double whole = curve["knots"].front().get<double>() + curve["knots"].back().get<double>();
  for (auto k = curve["knots"].rbegin(); k != curve["knots"].rend(); ++k)
    knots.push_back(whole - k->get<double>());
  curve["knots"] = knots;
  return curve;
}

}  // namespace keyline::own
