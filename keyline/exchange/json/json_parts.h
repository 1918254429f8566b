#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/core/text.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/polyline.h"
#include "keyline/exchange/json/json_curve.h"
#include "keyline/exchange/json/json_space.h"

/// What the readers of JSON values share: places, members, and the curves that are the same in the
/// plane and in space. For .cpp files of this room only.
namespace keyline::exchange::detail {

inline constexpr std::size_t kMostPoints = 20'000'000;

/// "where.key" and "where[3]".
std::string in(const std::string& where, const std::string& key);
std::string in(const std::string& where, std::size_t index);

/// j[key], or bad_input saying that it is missing.
core::Result<const nlohmann::json*> member(const nlohmann::json& j, const char* key,
                                           const std::string& where);
core::Result<double> number_member(const nlohmann::json& j, const char* key,
                                   const std::string& where);
core::Result<std::vector<double>> numbers(const nlohmann::json& j, const std::string& where);
/// "weights", empty where there are none.
core::Result<std::vector<double>> weights_of(const nlohmann::json& j, const std::string& where);
/// "closed" of an object, false where it is absent.
core::Result<bool> closed_of(const nlohmann::json& j, const std::string& where);
/// "type" of an object.
core::Result<std::string> type_of(const nlohmann::json& j, const std::string& where);
/// The failure of a value's validate() with the place of the value in front.
std::unexpected<core::Failure> placed(core::Failure failure, const std::string& where);

template <class Point>
nlohmann::json points_json(const std::vector<Point>& points) {
  nlohmann::json list = nlohmann::json::array();
  for (const Point& p : points) list.push_back(to_json(p));
  return list;
}

template <class Point>
nlohmann::json curve_json(const curve::Polyline<Point>& c) {
  return {{"type", "polyline"}, {"points", points_json(c.points)}};
}

template <class Point>
nlohmann::json curve_json(const curve::Bezier<Point>& c) {
  nlohmann::json j{{"type", "bezier"}, {"points", points_json(c.control)}};
  if (!c.weights.empty()) j["weights"] = c.weights;
  return j;
}

template <class Point>
nlohmann::json curve_json(const curve::BSpline<Point>& c) {
  nlohmann::json j{{"type", "bspline"},
                   {"degree", c.degree},
                   {"knots", c.knots},
                   {"points", points_json(c.control)}};
  if (!c.weights.empty()) j["weights"] = c.weights;
  return j;
}

inline core::Result<core::Point2> coordinates(const nlohmann::json& j, const std::string& where,
                                              core::Point2) {
  return point_from_json(j, where);
}
inline core::Result<core::Point3> coordinates(const nlohmann::json& j, const std::string& where,
                                              core::Point3) {
  return point3_from_json(j, where);
}

template <class Point>
core::Result<std::vector<Point>> read_points(const nlohmann::json& j, const std::string& where,
                                             std::size_t least) {
  if (!j.is_array() || j.size() < least || j.size() > kMostPoints)
    return core::fail(core::ErrorCode::bad_input,
                      "a list of at least " + std::to_string(least) + " points is wanted here",
                      "give [[x, y], …]", where);
  std::vector<Point> points;
  points.reserve(j.size());
  for (std::size_t i = 0; i < j.size(); ++i) {
    const auto p = coordinates(j[i], in(where, i), Point{});
    if (!p) return std::unexpected(p.error());
    if (j[i].size() != j[0].size())  // a decimal comma makes two numbers of one
      return core::fail(core::ErrorCode::bad_input,
                        core::counted(j[i].size(), "coordinate") + " where the first point has " +
                            std::to_string(j[0].size()),
                        "give every point the same", in(where, i));
    points.push_back(*p);
  }
  return points;
}

template <class Point>
core::Result<std::vector<Point>> points_member(const nlohmann::json& j, const std::string& where) {
  const auto m = member(j, "points", where);
  if (!m) return std::unexpected(m.error());
  return read_points<Point>(**m, in(where, "points"), 2);
}

template <class Point>
core::Result<curve::Polyline<Point>> read_polyline(const nlohmann::json& j,
                                                   const std::string& where) {
  auto points = points_member<Point>(j, where);
  if (!points) return std::unexpected(points.error());
  return curve::Polyline<Point>{std::move(*points)};
}

template <class Point>
core::Result<curve::Bezier<Point>> read_bezier(const nlohmann::json& j, const std::string& where) {
  auto points = points_member<Point>(j, where);
  if (!points) return std::unexpected(points.error());
  auto weights = weights_of(j, where);
  if (!weights) return std::unexpected(weights.error());
  return curve::Bezier<Point>{std::move(*points), std::move(*weights)};
}

/// "degree" of a spline, 1 to 30.
core::Result<int> degree_of(const nlohmann::json& j, const std::string& where);

template <class Point>
core::Result<curve::BSpline<Point>> read_bspline(const nlohmann::json& j,
                                                 const std::string& where) {
  auto points = points_member<Point>(j, where);
  if (!points) return std::unexpected(points.error());
  auto weights = weights_of(j, where);
  if (!weights) return std::unexpected(weights.error());
  const auto degree = degree_of(j, where);
  if (!degree) return std::unexpected(degree.error());
  const auto knots = member(j, "knots", where);
  if (!knots) return std::unexpected(knots.error());
  auto values = numbers(**knots, in(where, "knots"));
  if (!values) return std::unexpected(values.error());
  return curve::BSpline<Point>{*degree, std::move(*values), std::move(*points),
                               std::move(*weights)};
}

}  // namespace keyline::exchange::detail
