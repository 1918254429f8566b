#include <optional>

#include "keyline/core/angle.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/spline_input.h"
#include "keyline/operations/values.h"
#include "keyline/surface/sweep.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;
using core::Vector3;
using curve::BSpline3;

constexpr double kUsualTolerance = 1e-5;  // of the curve's size

enum class ProfilePlane { xy, xz, yz, across };
constexpr auto choices(const ProfilePlane*) {
  return core::words<ProfilePlane>({{ProfilePlane::xy, "xy"},
                                    {ProfilePlane::xz, "xz"},
                                    {ProfilePlane::yz, "yz"},
                                    {ProfilePlane::across, "across"}});
}

/// A curve to make a surface of.
struct Profile {
  AnyCurve profile;
  std::optional<ProfilePlane> plane;
  std::optional<double> tolerance;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Profile::profile>("a curve, planar or in space").needed(),
        core::field<&Profile::plane>(
            "where a planar profile lies; across: x to the left of a planar rail's start, y "
            "upwards, the default with such a rail, else xy"),
        core::field<&Profile::tolerance>(
            "largest deviation, of log-aesthetic curves and along a rail; 1e-5 of the profile's "
            "size unless given")
            .in("length")
            .within(core::kPositive));
  }
  double allowed() const { return tolerance.value_or(kUsualTolerance * size_of(profile)); }
};

struct SurfaceAnswer {
  surface::Surface surface;
  double deviation = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SurfaceAnswer::surface>("a B-spline surface"),
        core::field<&SurfaceAnswer::deviation>("bound of the distance from the exact one")
            .in("length"));
  }
};

Result<SurfaceAnswer> made_surface(Result<surface::BSplineSurface> made, double deviation) {
  if (!made) return std::unexpected(std::move(made.error()));
  return SurfaceAnswer{std::move(*made), deviation};
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

Result<BSpline3> in_space(const Profile& request, const SplineInput& profile,
                          const BSpline3* planar_rail) {
  if (!profile.planar) return profile.curve;
  switch (request.plane.value_or(planar_rail ? ProfilePlane::across : ProfilePlane::xy)) {
    case ProfilePlane::xy:
      return profile.curve;
    case ProfilePlane::xz:
      return placed(profile.curve, {{}, {1, 0, 0}, {0, 0, 1}});
    case ProfilePlane::yz:
      return placed(profile.curve, {{}, {0, 1, 0}, {0, 0, 1}});
    case ProfilePlane::across:
      break;
  }
  if (planar_rail) return placed(profile.curve, across(*planar_rail));
  return fail(ErrorCode::bad_input, "\"across\" is no plane for this profile",
              "use xy, xz or yz; across with a planar rail only", "plane");
}

std::unexpected<core::Failure> of_member(core::Failure failure, const std::string& member) {
  failure.path = failure.path.empty() ? member : member + "." + failure.path;
  return std::unexpected(std::move(failure));
}

struct SweepRequest {
  Profile profile;
  std::variant<Point3, AnyCurve> rail;
  bool turn = true;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&SweepRequest::profile>(),
        core::field<&SweepRequest::rail>("a vector [x, y, z], or a curve").needed(),
        core::field<&SweepRequest::turn>(
            "false: the profile keeps its direction instead of turning with the rail"));
  }
};

Result<SurfaceAnswer> run_sweep(const SweepRequest& request, const Context&) {
  const double tolerance = request.profile.allowed();
  const auto profile = spline_of(request.profile.profile, 0.5 * tolerance);
  if (!profile) return of_member(profile.error(), "profile");
  if (const auto* by = std::get_if<Point3>(&request.rail)) {
    const auto place = in_space(request.profile, *profile, nullptr);
    if (!place) return std::unexpected(place.error());
    return made_surface(surface::extrude(*place, *by - Point3{}), profile->deviation);
  }
  const auto rail = spline_of(std::get<AnyCurve>(request.rail), 0.25 * tolerance);
  if (!rail) return of_member(rail.error(), "rail");
  const auto place = in_space(request.profile, *profile, rail->planar ? &rail->curve : nullptr);
  if (!place) return std::unexpected(place.error());
  const double given = profile->deviation + rail->deviation;
  if (!request.turn) return made_surface(surface::translate(*place, rail->curve), given);
  auto made = surface::sweep(*place, rail->curve, 0.25 * tolerance);
  if (!made) return std::unexpected(made.error());
  return SurfaceAnswer{std::move(made->surface), made->deviation + given};
}

struct Axis {
  Point3 point;
  Point3 direction{0, 1, 0};
  static constexpr auto describe() {
    return core::fields(core::field<&Axis::point>("on it; the origin unless given"),
                        core::field<&Axis::direction>("of it; [0, 1, 0] unless given"));
  }
};

struct RevolveRequest {
  Profile profile;
  Axis axis;
  double angle = 2 * core::kPi;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&RevolveRequest::profile>(),
        core::field<&RevolveRequest::axis>("to turn about; {} for the y axis").needed(),
        core::field<&RevolveRequest::angle>("of the turn")
            .in("radian")
            .within(core::from_to(-2 * core::kPi, 2 * core::kPi)));
  }
};

Result<SurfaceAnswer> run_revolve(const RevolveRequest& request, const Context&) {
  const auto profile = spline_of(request.profile.profile, request.profile.allowed());
  if (!profile) return of_member(profile.error(), "profile");
  const auto place = in_space(request.profile, *profile, nullptr);
  if (!place) return std::unexpected(place.error());
  const surface::Axis3 axis{request.axis.point, request.axis.direction - Point3{}};
  return made_surface(surface::revolve(*place, axis, request.angle), profile->deviation);
}

struct LoftRequest {
  std::vector<AnyCurve> sections;
  std::vector<double> heights;
  std::optional<double> tolerance;
  static constexpr auto describe() {
    return core::fields(
        core::field<&LoftRequest::sections>("two or more curves, planar or in space")
            .count(2)
            .needed(),
        core::field<&LoftRequest::heights>("added to z of each section, for planar ones")
            .in("length"),
        core::field<&LoftRequest::tolerance>(
            "for log-aesthetic sections; 1e-5 of their size unless given")
            .in("length")
            .within(core::kPositive));
  }
};

Result<SurfaceAnswer> run_loft(const LoftRequest& request, const Context&) {
  const std::size_t count = request.sections.size();
  if (!request.heights.empty() && request.heights.size() != count)
    return fail(ErrorCode::bad_input, "there are not as many heights as sections",
                "give one height for each section", "heights");
  std::vector<BSpline3> curves;
  double deviation = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double tolerance =
        request.tolerance.value_or(kUsualTolerance * size_of(request.sections[i]));
    auto c = spline_of(request.sections[i], tolerance);
    if (!c) return of_member(c.error(), "sections[" + std::to_string(i) + "]");
    if (!request.heights.empty())
      for (Point3& p : c->curve.control) p.z += request.heights[i];
    deviation = std::max(deviation, c->deviation);
    curves.push_back(std::move(c->curve));
  }
  return made_surface(surface::loft(curves), deviation);
}

}  // namespace

Operation surface_sweep_operation() {
  return declare<run_sweep>(
      {.name = "surface.sweep",
       .summary = "A profile carried along a direction or a rail, as a B-spline surface with the "
                  "bound of its distance from the exact one.",
       .examples = {R"({"profile":{"type":"bezier","points":[[1,0],[1.5,0.5],[1.2,1.4],[1.6,2]]},
                        "rail":[0,0,3]})"}});
}

Operation surface_revolve_operation() {
  return declare<run_revolve>(
      {.name = "surface.revolve",
       .summary = "A profile turned about an axis: exact for Bezier and B-spline profiles.",
       .examples = {R"({"profile":{"type":"bezier","points":[[1,0],[1.5,0.5],[1.2,1.4],[1.6,2]]},
                        "axis":{},"angle":1.5})"}});
}

Operation surface_loft_operation() {
  return declare<run_loft>(
      {.name = "surface.loft",
       .summary = "A surface through section curves in their order, cubic from section to section.",
       .examples = {R"({"sections":[
           {"type":"bezier","points":[[1,0],[1.5,0.5],[1.2,1.4],[1.6,2]]},
           {"type":"bezier","points":[[1,0],[1.5,0.5],[1.2,1.4],[1.6,2]]}],"heights":[0,2]})"}});
}

}  // namespace keyline::operations
