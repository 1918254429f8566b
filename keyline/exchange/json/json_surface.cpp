#include "keyline/exchange/json/json_surface.h"

#include <array>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_parts.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using detail::in;
using detail::kMostPoints;
using detail::member;
using nlohmann::json;
using surface::BezierSurface;
using surface::BSplineSurface;
using surface::Net;
using surface::Surface;

json rows_json(const Net& net) {
  json rows = json::array();
  for (int i = 0; i < net.rows; ++i) {
    json row = json::array();
    for (int j = 0; j < net.columns; ++j) row.push_back(to_json(net.at(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

void add_weights(json& j, const Net& net, const std::vector<double>& weights) {
  if (weights.empty()) return;
  json rows = json::array();
  for (int i = 0; i < net.rows; ++i) {
    json row = json::array();
    for (int k = 0; k < net.columns; ++k) row.push_back(weights[net.index(i, k)]);
    rows.push_back(std::move(row));
  }
  j["weights"] = std::move(rows);
}

/// Rows of equal length, each entry read by `read`.
template <class T, class Read>
Result<std::vector<T>> read_rows(const json& j, const std::string& where, const Read& read) {
  if (!j.is_array() || j.empty() || !j[0].is_array() || j[0].empty())
    return fail(ErrorCode::bad_input, "a list of rows is wanted here", "give [[…], [… ], …]",
                where);
  std::vector<T> list;
  for (std::size_t i = 0; i < j.size(); ++i) {
    if (!j[i].is_array() || j[i].size() != j[0].size())
      return fail(ErrorCode::bad_input, "this row is not as long as the first",
                  "give rows of " + std::to_string(j[0].size()), in(where, i));
    if (list.size() + j[i].size() > kMostPoints)
      return fail(ErrorCode::bad_input, "the net is too large", "split the surface", where);
    for (std::size_t k = 0; k < j[i].size(); ++k) {
      const auto value = read(j[i][k], in(in(where, i), k));
      if (!value) return std::unexpected(value.error());
      list.push_back(*value);
    }
  }
  return list;
}

struct Controls {
  Net net;
  std::vector<double> weights;
};

Result<Controls> read_controls(const json& j, const std::string& where) {
  const auto rows = member(j, "points", where);
  if (!rows) return std::unexpected(rows.error());
  auto points = read_rows<core::Point3>(**rows, in(where, "points"), point3_from_json);
  if (!points) return std::unexpected(points.error());
  if (core::is_too_small(*points)) return core::size_too_small(in(where, "points"));
  Controls c;
  c.net = {static_cast<int>((*rows)->size()), static_cast<int>((**rows)[0].size()),
           std::move(*points)};
  if (const auto it = j.find("weights"); it != j.end()) {
    auto weights = read_rows<double>(*it, in(where, "weights"), number_from_json);
    if (!weights) return std::unexpected(weights.error());
    if (it->size() != (*rows)->size() || (*it)[0].size() != (**rows)[0].size())
      return fail(ErrorCode::bad_input, "the rows of weights are not those of the points",
                  "give one weight per point", in(where, "weights"));
    c.weights = std::move(*weights);
  }
  return c;
}

Result<std::array<int, 2>> read_degrees(const json& j, const std::string& where) {
  if (!j.is_array() || j.size() != 2)
    return fail(ErrorCode::bad_input, "two degrees are wanted here", "give [p, q]", where);
  std::array<int, 2> degree{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto n = detail::degree_from_json(j[i], in(where, i));
    if (!n) return std::unexpected(n.error());
    degree[i] = *n;
  }
  return degree;
}

Result<Surface> read_spline(const json& j, const std::string& where, Controls controls) {
  const auto degrees = member(j, "degree", where);
  if (!degrees) return std::unexpected(degrees.error());
  const auto degree = read_degrees(**degrees, in(where, "degree"));
  if (!degree) return std::unexpected(degree.error());
  const auto vectors = member(j, "knots", where);
  if (!vectors) return std::unexpected(vectors.error());
  if (!(*vectors)->is_array() || (*vectors)->size() != 2)
    return fail(ErrorCode::bad_input, "two knot vectors are wanted here", "give [[…], […]]",
                in(where, "knots"));
  BSplineSurface s{*degree, {}, std::move(controls.net), std::move(controls.weights)};
  for (std::size_t i = 0; i < 2; ++i) {
    auto knots = detail::numbers((**vectors)[i], in(in(where, "knots"), i));
    if (!knots) return std::unexpected(knots.error());
    s.knots[i] = std::move(*knots);
  }
  return Surface{std::move(s)};
}

Result<Surface> read_by_type(const json& j, const std::string& type, const std::string& where) {
  if (type != "bezier-surface" && type != "bspline-surface")
    return fail(ErrorCode::bad_input, "\"" + type + "\" is not a surface type",
                "use bezier-surface or bspline-surface", in(where, "type"));
  auto controls = read_controls(j, where);
  if (!controls) return std::unexpected(controls.error());
  if (type == "bspline-surface") return read_spline(j, where, std::move(*controls));
  return Surface{BezierSurface{std::move(controls->net), std::move(controls->weights)}};
}

}  // namespace

json to_json(const BezierSurface& s) {
  json j{{"type", "bezier-surface"}, {"points", rows_json(s.net)}};
  add_weights(j, s.net, s.weights);
  return j;
}

json to_json(const BSplineSurface& s) {
  json j{{"type", "bspline-surface"},
         {"degree", s.degree},
         {"knots", s.knots},
         {"points", rows_json(s.net)}};
  add_weights(j, s.net, s.weights);
  return j;
}

json to_json(const Surface& s) {
  return std::visit([](const auto& x) { return to_json(x); }, s);
}

bool is_surface_json(const json& j) {
  if (!j.is_object()) return false;
  const auto it = j.find("type");
  return it != j.end() && (*it == "bezier-surface" || *it == "bspline-surface");
}

Result<Surface> surface_from_json(const json& j, const std::string& where) {
  const auto type = detail::type_of(j, where, "a surface");
  if (!type) return std::unexpected(type.error());
  auto s = read_by_type(j, *type, where);
  if (!s) return s;
  if (auto sound = surface::validate(*s); !sound) return detail::placed(sound.error(), where);
  return s;
}

}  // namespace keyline::exchange
