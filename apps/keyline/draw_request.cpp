#include "draw_request.h"

#include <charconv>
#include <optional>

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<json> point_of(const std::string& text, std::size_t coordinates) {
  json point = json::array();
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const auto value = number(std::string_view(text).substr(from, to - from));
    if (!value)
      return core::fail(ErrorCode::bad_input, "\"" + text + "\" is no point",
                        coordinates == 3 ? "give points as x,y,z" : "give points as x,y",
                        "--points");
    point.push_back(*value);
    from = to + 1;
  }
  if (point.size() == coordinates) return point;
  return core::fail(ErrorCode::bad_input,
                    "\"" + text + "\" has " + std::to_string(point.size()) + " coordinates",
                    coordinates == 3 ? "give points as x,y,z" : "give points as x,y", "--points");
}

Result<json> points_of(const DrawCommand& command) {
  json points = json::array();
  for (const std::string& text : command.points) {
    auto point = point_of(text, command.space ? 3 : 2);
    if (!point) return std::unexpected(point.error());
    points.push_back(std::move(*point));
  }
  return points;
}

std::unexpected<core::Failure> wrong(const std::string& message, const std::string& hint,
                                     const std::string& option) {
  return core::fail(ErrorCode::bad_input, message, hint, option);
}

Result<void> want(const json& points, std::size_t count, const std::string& what) {
  if (points.size() == count) return {};
  return wrong(std::to_string(points.size()) + " points are given", "give " + what, "--points");
}

json one_slope(const DrawCommand& c) { return c.alpha.empty() ? -1.0 : c.alpha[0]; }

Result<DrawRequest> spline_request(const DrawCommand& c, const json& points) {
  json request{{"points", points}, {"closed", c.closed}};
  if (!c.alpha.empty()) request["alpha"] = c.alpha;
  if (!c.directions.empty()) request["directions"] = c.directions;
  if (!c.curvatures.empty()) request["curvatures"] = c.curvatures;
  return DrawRequest{"lac.spline", std::move(request)};
}

Result<DrawRequest> space_request(const DrawCommand& c, const json& points) {
  if (auto right = want(points, 4, "P0 T0 T2 P2: ends and points along their tangents"); !right)
    return std::unexpected(right.error());
  json tangents = json::array({json::array(), json::array()});
  for (std::size_t i = 0; i < 3; ++i) {
    tangents[0].push_back(points[1][i].get<double>() - points[0][i].get<double>());
    tangents[1].push_back(points[3][i].get<double>() - points[2][i].get<double>());
  }
  return DrawRequest{"lac.space",
                     {{"start", points[0]},
                      {"end", points[3]},
                      {"tangents", std::move(tangents)},
                      {"alpha", one_slope(c)},
                      {"beta", c.beta},
                      {"omega", c.omega}}};
}

Result<DrawRequest> volume_request(const DrawCommand& c, const json& points) {
  if (auto right = want(points, 2, "P0 and P2"); !right) return std::unexpected(right.error());
  if (c.directions.size() != 1)
    return wrong("a volume needs the direction at the start", "give one angle", "--directions");
  return DrawRequest{"lac.volume",
                     {{"points", points},
                      {"direction", c.directions[0]},
                      {"alpha", one_slope(c)},
                      {"volume", *c.volume}}};
}

Result<DrawRequest> hermite_request(const DrawCommand& c, const json& points) {
  if (auto right = want(points, 2, "the two ends"); !right) return std::unexpected(right.error());
  json request{{"start", points[0]},
               {"end", points[1]},
               {"directions", c.directions},
               {"alpha", one_slope(c)}};
  if (!c.curvatures.empty()) request["curvatures"] = c.curvatures;
  return DrawRequest{"lac.hermite", std::move(request)};
}

Result<DrawRequest> quasi_request(const DrawCommand& c, const json& points) {
  json request{{"points", points}, {"alpha", one_slope(c)}, {"form", c.form}};
  if (c.form != "rational-cubic") request["degree"] = c.degree;
  if (c.about == "auto") request["about"] = c.about;
  if (!c.about.empty() && c.about != "auto") {
    const auto about = number(c.about);
    if (!about) return wrong("\"" + c.about + "\" is no number", "give 0 to 1, or auto", "--about");
    request["about"] = *about;
  }
  return DrawRequest{"lac.quasi", std::move(request)};
}

Result<DrawRequest> compound_request(const DrawCommand& c, const json& points) {
  if (!c.ratio) return wrong("two slopes need a ratio", "give one between 0 and 1", "--ratio");
  return DrawRequest{"lac.compound", {{"points", points}, {"alpha", c.alpha}, {"ratio", *c.ratio}}};
}

}  // namespace

Result<DrawRequest> draw_request(const DrawCommand& c) {
  const auto points = points_of(c);
  if (!points) return std::unexpected(points.error());
  if (c.spline) return spline_request(c, *points);
  if (c.space) return space_request(c, *points);
  if (c.closed) return wrong("only a spline can be closed", "add --spline", "--closed");
  if (c.alpha.size() > 2 || (c.alpha.size() == 2 && !c.form.empty()))
    return wrong("too many slopes", "give one, or two with --ratio", "--alpha");
  if (c.volume) return volume_request(c, *points);
  if (!c.directions.empty()) return hermite_request(c, *points);
  if (!c.curvatures.empty())
    return wrong("curvatures need directions", "add --directions start,end", "--curvatures");
  if (auto right = want(*points, 3, "the handles P0 P1 P2"); !right)
    return std::unexpected(right.error());
  if (!c.form.empty()) return quasi_request(c, *points);
  if (c.alpha.size() == 2) return compound_request(c, *points);
  if (c.ratio) return wrong("a ratio needs two slopes", "give --alpha a0,a1", "--ratio");
  return DrawRequest{"lac.segment", {{"points", *points}, {"alpha", one_slope(c)}}};
}

}  // namespace keyline::app
