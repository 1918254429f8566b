#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "own_curves.h"
#include "random_values.h"

/// Patches drawn at random, and the same ones held otherwise.
namespace keyline::own {

/// A patch like a panel: a grid, bent and disturbed, of any size, anywhere.
inline json any_patch(Random& random, std::size_t rows, std::size_t columns, double disturbed) {
  const double size = power_of_ten(random, -1, 3);
  const double a = uniform(random, -0.1, 0.1), b = uniform(random, -0.1, 0.1);
  const double c = uniform(random, -0.05, 0.05);
  const Vec at{uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3)};
  json net = json::array();
  for (std::size_t i = 0; i < rows; ++i) {
    json row = json::array();
    for (std::size_t j = 0; j < columns; ++j) {
      const auto u = static_cast<double>(i), v = static_cast<double>(j);
      const Vec p{u + disturbed * uniform(random, -1, 1), v + disturbed * uniform(random, -1, 1),
                  a * u * u + b * v * v + c * u * v + disturbed * uniform(random, -1, 1)};
      const Vec placed = size * (at + p);
      row.push_back({placed[0], placed[1], placed[2]});
    }
    net.push_back(row);
  }
  return {{"type", "bezier-surface"}, {"points", net}};
}

inline double net_extent(const json& surface) {
  double most = 0;
  for (const json& row : surface["points"])
    for (const json& p : row) most = std::max(most, distance(vec(p), vec(surface["points"][0][0])));
  return most;
}

inline double box_diagonal(const std::vector<json>& surfaces) {
  own::Vec low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const json& surface : surfaces)
    for (const json& row : surface["points"])
      for (const json& p : row)
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], p[k].get<double>());
          high[k] = std::max(high[k], p[k].get<double>());
        }
  return distance(low, high);
}

inline double net_farthest(const json& surface) {
  double most = 0;
  for (const json& row : surface["points"])
    for (const json& p : row) most = std::max(most, size(vec(p)));
  return most;
}

template <class F>
inline json with_net(json surface, const F& f) {
  for (json& row : surface["points"])
    for (json& p : row) p = f(p);
  return surface;
}
inline json transposed(const json& surface) {
  json turned = surface;
  turned["points"] = json::array();
  for (std::size_t j = 0; j < surface["points"][0].size(); ++j) {
    json row = json::array();
    for (const json& r : surface["points"]) row.push_back(r[j]);
    turned["points"].push_back(row);
  }
  return turned;
}
inline json mirrored_net(const json& surface) {
  return with_net(surface, [](json p) {
    p[2] = -p[2].get<double>();
    return p;
  });
}
inline json scaled_net(const json& surface, double by) {
  return with_net(surface, [by](json p) {
    for (json& x : p) x = by * x.get<double>();
    return p;
  });
}
/// Both parameters the other way round.
inline json turned_net(json surface) {
  std::reverse(surface["points"].begin(), surface["points"].end());
  for (json& row : surface["points"]) std::reverse(row.begin(), row.end());
  return surface;
}

/// A bicubic patch as two that meet at u.
inline std::pair<json, json> cut_along_u(const json& whole, double u) {
  json first = whole, second = whole;
  for (std::size_t j = 0; j < 4; ++j) {
    std::array<std::array<Vec, 4>, 4> b{};
    for (std::size_t i = 0; i < 4; ++i) b[0][i] = vec(whole["points"][i][j]);
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t i = 0; i + k < 4; ++i) b[k][i] = (1 - u) * b[k - 1][i] + u * b[k - 1][i + 1];
    for (std::size_t i = 0; i < 4; ++i) {
      first["points"][i][j] = b[i][0];
      second["points"][i][j] = b[3 - i][i];
    }
  }
  return {first, second};
}

}  // namespace keyline::own
