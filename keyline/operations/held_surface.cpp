#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_members.h"
#include "keyline/exchange/json/json_surface.h"
#include "keyline/operations/held_curve.h"

namespace keyline::operations {

using core::Result;

struct HeldSurface::Body {
  surface::Surface surface;
};

namespace {

Result<void> check_parameters(std::span<const double> u, std::span<const double> v) {
  for (const auto& column : {u, v})
    if (!std::ranges::all_of(column, [](double x) { return std::isfinite(x); }))
      return core::fail(core::ErrorCode::bad_input, "a parameter is not finite", {}, "u, v");
  return {};
}

}  // namespace

Result<HeldSurface> HeldSurface::from_json(const nlohmann::json& value) {
  if (auto known = exchange::check_members(value, "surface"); !known)
    return std::unexpected(known.error());
  auto surface = exchange::surface_from_json(value, "surface");
  if (!surface) return std::unexpected(surface.error());
  return HeldSurface(std::make_shared<Body>(Body{std::move(*surface)}));
}

nlohmann::json HeldSurface::to_json() const { return exchange::to_json(body_->surface); }

Result<void> HeldSurface::points(std::span<const double> u, std::span<const double> v,
                                 std::span<double> out) const {
  if (auto sound = check_parameters(u, v); !sound) return sound;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const core::Point3 p = surface::evaluate(body_->surface, u[i], v[i]);
    out[3 * i] = p.x;
    out[3 * i + 1] = p.y;
    out[3 * i + 2] = p.z;
  }
  return {};
}

Result<void> HeldSurface::normals(std::span<const double> u, std::span<const double> v,
                                  std::span<double> out) const {
  if (auto sound = check_parameters(u, v); !sound) return sound;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const surface::SurfaceJet jet = surface::jet(body_->surface, u[i], v[i]);
    const core::Vector3 across = cross(jet.u, jet.v);
    const double length = norm(across);
    const core::Vector3 n = length > 0 ? across / length : across;
    out[3 * i] = n.x;
    out[3 * i + 1] = n.y;
    out[3 * i + 2] = n.z;
  }
  return {};
}

}  // namespace keyline::operations
