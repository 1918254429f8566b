#include "keyline/surface/surface.h"

namespace keyline::surface {

core::Result<void> validate(const Surface& s) {
  return std::visit([](const auto& x) { return validate(x); }, s);
}

core::Point3 evaluate(const Surface& s, double u, double v) {
  return std::visit([=](const auto& x) { return evaluate(x, u, v); }, s);
}

SurfaceJet jet(const Surface& s, double u, double v) {
  return std::visit([=](const auto& x) { return jet(x, u, v); }, s);
}

const Net& net_of(const Surface& s) {
  return std::visit([](const auto& x) -> const Net& { return x.net; }, s);
}

bool is_rational(const Surface& s) {
  return std::visit([](const auto& x) { return is_rational(x); }, s);
}

std::vector<double> breakpoints_u(const Surface& s) {
  const auto* spline = std::get_if<BSplineSurface>(&s);
  return spline ? breakpoints_u(*spline) : std::vector<double>{0, 1};
}

std::vector<double> breakpoints_v(const Surface& s) {
  const auto* spline = std::get_if<BSplineSurface>(&s);
  return spline ? breakpoints_v(*spline) : std::vector<double>{0, 1};
}

Surface transposed(const Surface& s) {
  return std::visit([](const auto& x) { return Surface{transposed(x)}; }, s);
}

PatchGrid patches_of(const Surface& s) {
  if (const auto* spline = std::get_if<BSplineSurface>(&s)) return to_beziers(*spline);
  return {1, 1, {std::get<BezierSurface>(s)}};
}

}  // namespace keyline::surface
