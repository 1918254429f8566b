#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/coordinate.h"
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
/// "type" of an object; `what` is named in the failure of anything else.
core::Result<std::string> type_of(const nlohmann::json& j, const std::string& where,
                                  const char* what = "a curve");
/// j[key], a pair of numbers.
core::Result<std::array<double, 2>> pair_member(const nlohmann::json& j, const char* key,
                                                const std::string& where);
/// A point's coordinates, two or three; the third is 0 where it is left out. `hint` shows one.
core::Result<std::array<double, 3>> coordinates_of(const nlohmann::json& j,
                                                   const std::string& where, const char* hint);
/// The failure of a value's validate() with the place of the value in front.
std::unexpected<core::Failure> placed(core::Failure failure, const std::string& where);

/// j[key], a list of one or more, each item read by read(item, where). `items` names them in the
/// failure of anything else.
template <class Read>
auto list_member(const nlohmann::json& j, const char* key, const char* items,
                 const std::string& where, const Read& read)
    -> core::Result<std::vector<typename decltype(read(j, where))::value_type>> {
  const auto list = member(j, key, where);
  if (!list) return std::unexpected(list.error());
  const std::string place = in(where, key);
  if (!(*list)->is_array() || (*list)->empty())
    return core::fail(core::ErrorCode::bad_input,
                      std::string("a list of ") + items + " is wanted here", "give at least one",
                      place);
  std::vector<typename decltype(read(j, where))::value_type> all;
  all.reserve((*list)->size());
  for (std::size_t i = 0; i < (*list)->size(); ++i) {
    auto item = read((**list)[i], in(place, i));
    if (!item) return std::unexpected(std::move(item.error()));
    all.push_back(std::move(*item));
  }
  return all;
}

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

/// "points" of a curve: two or more, all with as many coordinates as the first.
template <class Point>
core::Result<std::vector<Point>> points_member(const nlohmann::json& j, const std::string& where) {
  const auto m = member(j, "points", where);
  if (!m) return std::unexpected(m.error());
  const nlohmann::json& list = **m;
  const std::string place = in(where, "points");
  if (!list.is_array() || list.size() < 2 || list.size() > kMostPoints)
    return core::fail(core::ErrorCode::bad_input, "a list of at least 2 points is wanted here",
                      "give [[x, y], …]", place);
  std::vector<Point> points;
  points.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto p = coordinates(list[i], in(place, i), Point{});
    if (!p) return std::unexpected(p.error());
    if (list[i].size() != list[0].size())  // a decimal comma makes two numbers of one
      return core::fail(core::ErrorCode::bad_input,
                        core::counted(list[i].size(), "coordinate") +
                            " where the first point has " + std::to_string(list[0].size()),
                        "give every point the same", in(place, i));
    points.push_back(*p);
  }
  if (core::is_too_small(points)) return core::size_too_small(place);
  return points;
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

/// A degree, 1 to curve::kMaxBezierDegree.
core::Result<int> degree_from_json(const nlohmann::json& j, const std::string& where);

template <class Point>
core::Result<curve::BSpline<Point>> read_bspline(const nlohmann::json& j,
                                                 const std::string& where) {
  auto points = points_member<Point>(j, where);
  if (!points) return std::unexpected(points.error());
  auto weights = weights_of(j, where);
  if (!weights) return std::unexpected(weights.error());
  const auto given = member(j, "degree", where);
  if (!given) return std::unexpected(given.error());
  const auto degree = degree_from_json(**given, in(where, "degree"));
  if (!degree) return std::unexpected(degree.error());
  const auto knots = member(j, "knots", where);
  if (!knots) return std::unexpected(knots.error());
  auto values = numbers(**knots, in(where, "knots"));
  if (!values) return std::unexpected(values.error());
  return curve::BSpline<Point>{*degree, std::move(*values), std::move(*points),
                               std::move(*weights)};
}

}  // namespace keyline::exchange::detail
