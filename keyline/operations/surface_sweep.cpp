#include <optional>

#include "keyline/core/angle.h"
#include "keyline/exchange/json_space.h"
#include "keyline/exchange/json_surface.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/spline_input.h"
#include "keyline/surface/sweep.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;
using core::Vector3;
using curve::BSpline3;
using nlohmann::json;

constexpr double kUsualTolerance = 1e-5;  // of the curve's size

Result<double> tolerance_of(const json& request, const char* curve) {
  const auto given = positive_number(request, "tolerance");
  if (!given) return std::unexpected(given.error());
  return given->value_or(kUsualTolerance * size_of_curve_json(request.at(curve)));
}

/// Where a planar curve's x and y lie in space.
struct Placement {
  Point3 origin;
  Vector3 x{1, 0, 0};
  Vector3 y{0, 1, 0};
};

BSpline3 placed(BSpline3 c, const Placement& place) {
  for (Point3& p : c.control) p = place.origin + p.x * place.x + p.y * place.y;
  return c;
}

/// At the start of a planar rail: x to the left of it, y upwards.
Placement across(const BSpline3& rail) {
  const auto start = curve::jet(rail, 0);
  const double speed = norm(start.first);
  const Vector3 t = speed > 0 ? start.first / speed : Vector3{1, 0, 0};
  return {start.point, {-t.y, t.x, 0}, {0, 0, 1}};
}

Result<std::optional<Placement>> placement_of(const json& request, const BSpline3* planar_rail) {
  const std::string name = string_or(request, "plane", planar_rail ? "across" : "xy");
  if (name == "xy") return Placement{};
  if (name == "xz") return Placement{{}, {1, 0, 0}, {0, 0, 1}};
  if (name == "yz") return Placement{{}, {0, 1, 0}, {0, 0, 1}};
  if (name == "across" && planar_rail) return across(*planar_rail);
  return fail(ErrorCode::bad_input, "\"" + name + "\" is no plane for this profile",
              "use xy, xz or yz; across with a planar rail only", "plane");
}

Result<BSpline3> profile_in_space(const json& request, const SplineInput& profile,
                                  const BSpline3* planar_rail) {
  if (!profile.planar) return profile.curve;
  const auto place = placement_of(request, planar_rail);
  if (!place) return std::unexpected(place.error());
  return placed(profile.curve, **place);
}

json made_json(const surface::BSplineSurface& s, double deviation) {
  return {{"surface", exchange::to_json(s)}, {"deviation", deviation}};
}

Result<json> run_sweep(const json& request, const Context&) {
  const auto tolerance = tolerance_of(request, "profile");
  if (!tolerance) return std::unexpected(tolerance.error());
  const auto profile = spline_from_json(request.at("profile"), "profile", 0.5 * *tolerance);
  if (!profile) return std::unexpected(profile.error());
  const json& way = request.at("rail");
  if (way.is_array()) {
    const auto by = exchange::point3_from_json(way, "rail");
    if (!by) return std::unexpected(by.error());
    const auto place = profile_in_space(request, *profile, nullptr);
    if (!place) return std::unexpected(place.error());
    const auto s = surface::extrude(*place, *by - Point3{});
    if (!s) return std::unexpected(s.error());
    return made_json(*s, profile->deviation);
  }
  const auto rail = spline_from_json(way, "rail", 0.25 * *tolerance);
  if (!rail) return std::unexpected(rail.error());
  const auto place = profile_in_space(request, *profile, rail->planar ? &rail->curve : nullptr);
  if (!place) return std::unexpected(place.error());
  if (boolean_or(request, "turn", true)) {
    const auto made = surface::sweep(*place, rail->curve, 0.25 * *tolerance);
    if (!made) return std::unexpected(made.error());
    return made_json(made->surface, made->deviation + profile->deviation + rail->deviation);
  }
  const auto s = surface::translate(*place, rail->curve);
  if (!s) return std::unexpected(s.error());
  return made_json(*s, profile->deviation + rail->deviation);
}

Result<surface::Axis3> axis_of(const json& request) {
  surface::Axis3 axis{{0, 0, 0}, {0, 1, 0}};
  const json& value = request.at("axis");
  if (!value.is_object())
    return fail(ErrorCode::bad_input, "an axis is wanted here",
                "give {\"point\":[x,y,z], \"direction\":[x,y,z]}", "axis");
  if (value.contains("point")) {
    const auto p = exchange::point3_from_json(value["point"], "axis.point");
    if (!p) return std::unexpected(p.error());
    axis.point = *p;
  }
  if (value.contains("direction")) {
    const auto d = exchange::point3_from_json(value["direction"], "axis.direction");
    if (!d) return std::unexpected(d.error());
    axis.direction = *d - Point3{};
  }
  return axis;
}

Result<json> run_revolve(const json& request, const Context&) {
  const auto tolerance = tolerance_of(request, "profile");
  if (!tolerance) return std::unexpected(tolerance.error());
  const auto profile = spline_from_json(request.at("profile"), "profile", *tolerance);
  if (!profile) return std::unexpected(profile.error());
  const auto place = profile_in_space(request, *profile, nullptr);
  if (!place) return std::unexpected(place.error());
  const auto axis = axis_of(request);
  if (!axis) return std::unexpected(axis.error());
  const auto s = surface::revolve(*place, *axis, number_or(request, "angle", 2 * core::kPi));
  if (!s) return std::unexpected(s.error());
  return made_json(*s, profile->deviation);
}

Result<json> run_loft(const json& request, const Context&) {
  const json& sections = request.at("sections");
  if (!sections.is_array() || sections.size() < 2)
    return fail(ErrorCode::bad_input, "a list of at least two curves is wanted here",
                "give two or more sections", "sections");
  const auto given = positive_number(request, "tolerance");
  if (!given) return std::unexpected(given.error());
  const std::vector<double> heights = numbers_of(request, "heights");
  if (!heights.empty() && heights.size() != sections.size())
    return fail(ErrorCode::bad_input, "there are not as many heights as sections",
                "give one height for each section", "heights");
  std::vector<BSpline3> curves;
  double deviation = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double tolerance = given->value_or(kUsualTolerance * size_of_curve_json(sections[i]));
    auto c = spline_from_json(sections[i], "sections[" + std::to_string(i) + "]", tolerance);
    if (!c) return std::unexpected(c.error());
    if (!heights.empty())
      for (Point3& p : c->curve.control) p.z += heights[i];
    deviation = std::max(deviation, c->deviation);
    curves.push_back(std::move(c->curve));
  }
  const auto s = surface::loft(curves);
  if (!s) return std::unexpected(s.error());
  return made_json(*s, deviation);
}

const json kProfile{{"type", "bezier"}, {"points", {{1, 0}, {1.5, 0.5}, {1.2, 1.4}, {1.6, 2}}}};

}  // namespace

Operation surface_sweep_operation() {
  using Type = Field::Type;
  return {"surface.sweep",
          "A profile carried along a direction or a rail, as a B-spline surface with the bound of "
          "its distance from the exact one.",
          {{"profile", Type::any, true, "a curve, planar or in space"},
           {"rail", Type::any, true, "a vector [x, y, z], or a curve"},
           {"plane", Type::string, false,
            "where a planar profile lies: xy, xz, yz, or across (x to the left of a planar rail's "
            "start, y upwards), the default with such a rail"},
           {"turn", Type::boolean, false,
            "false: the profile keeps its direction instead of turning with the rail"},
           {"tolerance", Type::number, false, "largest deviation; 1e-5 of the profile's size"}},
          run_sweep,
          {{"profile", kProfile}, {"rail", {0, 0, 3}}}};
}

Operation surface_revolve_operation() {
  using Type = Field::Type;
  return {"surface.revolve",
          "A profile turned about an axis: exact for Bezier and B-spline profiles.",
          {{"profile", Type::any, true, "a curve, planar or in space"},
           {"axis", Type::any, true, "{\"point\", \"direction\"}; the y axis where left out"},
           {"angle", Type::number, false, "radians from -2 pi to 2 pi; a full turn unless given"},
           {"plane", Type::string, false, "where a planar profile lies: xy (default), xz, yz"},
           {"tolerance", Type::number, false, "for log-aesthetic profiles; 1e-5 of their size"}},
          run_revolve,
          {{"profile", kProfile}, {"axis", json::object()}, {"angle", 1.5}}};
}

Operation surface_loft_operation() {
  using Type = Field::Type;
  return {"surface.loft",
          "A surface through section curves in their order, cubic from section to section.",
          {{"sections", Type::any, true, "two or more curves, planar or in space"},
           {"heights", Type::numbers, false, "added to z of each section, for planar ones"},
           {"tolerance", Type::number, false, "for log-aesthetic sections; 1e-5 of their size"}},
          run_loft,
          {{"sections", {kProfile, kProfile}}, {"heights", {0, 2}}}};
}

}  // namespace keyline::operations
