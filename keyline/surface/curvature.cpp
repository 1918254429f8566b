#include "keyline/surface/curvature.h"

#include <cmath>

#include "keyline/core/axis.h"

namespace keyline::surface {

using core::cross;
using core::dot;
using core::norm;
using core::Vector3;

namespace {

/// norm() without hypot's care where squares neither overflow nor vanish.
double quick_norm(const Vector3& v) {
  const double squared = dot(v, v);
  return squared > 1e-200 && squared < 1e200 ? std::sqrt(squared) : norm(v);
}

}  // namespace

std::optional<SurfaceFrame> frame_of(const SurfaceJet& jet) {
  constexpr double kParallel = 1e-9;
  constexpr double kRounding = 1e-13;
  const double lu = quick_norm(jet.u);
  const double lv = quick_norm(jet.v);
  // differences of equal points are no more than rounding of their coordinates
  const double rounding = kRounding * quick_norm(jet.point - core::Point3{});
  if (!(lu > rounding && lv > rounding)) return std::nullopt;
  const Vector3 e1 = jet.u / lu;
  const Vector3 n = cross(e1, jet.v / lv);
  const double sine = quick_norm(n);
  // a side that is next to nothing beside the other is a collapsed edge up to rounding
  if (!(sine > kParallel) || std::fmin(lu, lv) < kParallel * std::fmax(lu, lv)) return std::nullopt;
  const Vector3 normal = n / sine;
  return SurfaceFrame{e1, cross(normal, e1), normal};
}

CurvatureForm curvature_form(const SurfaceJet& jet, const SurfaceFrame& f) {
  // Parameter directions that give the tangent vectors e1 and e2: solve J [du, dv] = e.
  const double a = dot(jet.u, f.e1);
  const double b = dot(jet.u, f.e2);
  const double c = dot(jet.v, f.e1);
  const double d = dot(jet.v, f.e2);
  const double det = a * d - b * c;
  const double u1 = d / det;
  const double v1 = -b / det;
  const double u2 = -c / det;
  const double v2 = a / det;
  const double l = dot(jet.uu, f.normal);
  const double m = dot(jet.uv, f.normal);
  const double n = dot(jet.vv, f.normal);
  return {l * u1 * u1 + 2 * m * u1 * v1 + n * v1 * v1,
          l * u1 * u2 + m * (u1 * v2 + u2 * v1) + n * v1 * v2,
          l * u2 * u2 + 2 * m * u2 * v2 + n * v2 * v2};
}

std::optional<SurfaceCurvature> curvature_of(const SurfaceJet& jet) {
  const auto frame = frame_of(jet);
  if (!frame) return std::nullopt;
  const CurvatureForm form = curvature_form(jet, *frame);
  const double half = 0.5 * (form.xx - form.yy);
  const double radius = std::hypot(half, form.xy);
  const double angle = core::principal_angle(form.xx, form.xy, form.yy);
  SurfaceCurvature k;
  k.mean = 0.5 * (form.xx + form.yy);
  k.gaussian = form.xx * form.yy - form.xy * form.xy;
  k.largest = k.mean + radius;
  k.smallest = k.mean - radius;
  k.largest_direction = std::cos(angle) * frame->e1 + std::sin(angle) * frame->e2;
  k.smallest_direction = std::cos(angle) * frame->e2 - std::sin(angle) * frame->e1;
  return k;
}

SurfaceJet jet_with_normal(const Surface& s, double u, double v) {
  constexpr double kInwards = 1e-3;
  const SurfaceJet here = jet(s, u, v);
  if (frame_of(here)) return here;
  return jet(s, u + kInwards * (0.5 - u), v + kInwards * (0.5 - v));
}

}  // namespace keyline::surface
