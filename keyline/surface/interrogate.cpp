#include "keyline/surface/interrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/angle.h"
#include "keyline/surface/curvature.h"
#include "keyline/surface/directions.h"

namespace keyline::surface {
namespace {

using core::cross;
using core::dot;
using core::ErrorCode;
using core::fail;
using core::norm;
using core::Point3;
using core::Result;
using core::Vector3;
using detail::across;
using detail::any_across;
using detail::unit;

constexpr std::size_t kMeanOf = 4096;  ///< places that means over a grid are taken of
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Lights {
  Vector3 view, light, stripes;
  Point3 origin;
  double stripe_count, spacing;
};

Point3 middle_of(const JetGrid& grid) {
  Vector3 sum;
  for (const SurfaceJet& j : grid.jets) sum = sum + (j.point - Point3{});
  return Point3{} + sum / static_cast<double>(grid.jets.size());
}

double extent_of(const JetGrid& grid, const Point3& middle) {
  double most = 0;
  for (const SurfaceJet& j : grid.jets) most = std::max(most, core::distance(j.point, middle));
  return 2 * most;
}

Vector3 reflected(Vector3 view, Vector3 normal) { return 2 * dot(view, normal) * normal - view; }

double zebra(const Lights& l, Vector3 normal) {
  const Vector3 ray = reflected(l.view, normal);
  const double latitude = std::atan2(dot(ray, l.stripes), norm(cross(ray, l.stripes)));
  return l.stripe_count * (0.5 + latitude / core::kPi);
}

double reflection(const Lights& l, const Point3& point, Vector3 normal) {
  const Vector3 ray = reflected(l.view, normal);
  const double towards = dot(ray, l.view);
  if (!(towards > 1e-9)) return kNone;
  const Vector3 from = l.origin - point;
  const double distance = dot(from, l.view) / towards;
  if (distance < 0) return kNone;
  const Vector3 at = distance * ray - from;  // where the ray meets the plane, from origin
  return dot(at, l.stripes) / l.spacing;
}

double highlight(const Lights& l, const Point3& point, Vector3 normal) {
  const Vector3 both = cross(l.light, normal);
  const double sine = norm(both);
  if (!(sine > 1e-12)) return kNone;
  return dot(both, l.origin - point) / sine;
}

double value_at(FieldKind kind, const Lights& l, const SurfaceJet& j, const SurfaceFrame& f) {
  switch (kind) {
    case FieldKind::zebra:
      return zebra(l, f.normal);
    case FieldKind::isophote:
      return std::clamp(dot(f.normal, l.light), -1.0, 1.0);
    case FieldKind::reflection:
      return reflection(l, j.point, f.normal);
    case FieldKind::highlight:
      return highlight(l, j.point, f.normal);
    case FieldKind::gaussian:
    case FieldKind::mean:
    case FieldKind::principal:
      break;
  }
  const auto k = curvature_of(j);
  if (kind == FieldKind::gaussian) return k->gaussian;
  return kind == FieldKind::mean ? k->mean : k->largest;
}

bool usable(const std::optional<Vector3>& v) {
  return !v || (core::is_finite(*v) && norm(*v) > 0 && std::isfinite(norm(*v)));
}

Result<void> check(const Lighting& l) {
  const char* hint = "give a vector [x, y, z] that is not zero";
  const char* what = "the direction has no length or is not finite";
  if (!usable(l.view)) return fail(ErrorCode::bad_input, what, hint, "view");
  if (!usable(l.light)) return fail(ErrorCode::bad_input, what, hint, "light");
  if (!usable(l.stripes)) return fail(ErrorCode::bad_input, what, hint, "stripes");
  if (l.origin && !core::is_finite(*l.origin))
    return fail(ErrorCode::bad_input, "the origin is not finite", "give a point", "origin");
  if (!(l.stripe_count > 0 && std::isfinite(l.stripe_count)))
    return fail(ErrorCode::bad_input, "the number of stripes is not greater than zero",
                "give for example 12", "stripe_count");
  if (!(l.spacing >= 0 && std::isfinite(l.spacing)))
    return fail(ErrorCode::bad_input, "the spacing is negative or not finite",
                "give a length, or leave it out", "spacing");
  return {};
}

}  // namespace

Lighting completed(const Lighting& given, const JetGrid& grid) {
  Lighting l = given;
  const std::size_t step = 1 + grid.jets.size() / kMeanOf;
  Vector3 normals;
  Vector3 along;
  double count = 0;
  for (std::size_t i = 0; i < grid.jets.size(); i += step, ++count) {
    const auto f = frame_of(grid.jets[i]);
    if (!f) continue;
    normals = normals + f->normal;
    along = along + f->e1;
  }
  if (!l.view) l.view = norm(normals) > 1e-6 * count ? normals : Vector3{0, 0, 1};
  l.view = unit(*l.view);
  if (!l.stripes) {
    const Vector3 v = across(along, *l.view);
    l.stripes = norm(v) > 1e-6 * count ? v : any_across(*l.view);
  }
  l.stripes = unit(*l.stripes);
  l.light = unit(l.light.value_or(*l.view));
  const Point3 middle = middle_of(grid);
  const double extent = extent_of(grid, middle);
  if (!l.origin) l.origin = middle + extent * *l.view;
  if (l.spacing == 0) l.spacing = extent > 0 ? extent / 12 : 1;
  return l;
}

Result<Field> interrogate(const JetGrid& grid, FieldKind kind, const Lighting& lighting) {
  if (auto sound = check(lighting); !sound) return std::unexpected(sound.error());
  Lighting full = completed(lighting, grid);
  if (kind == FieldKind::highlight && !lighting.light)
    full.light = cross(*full.view, *full.stripes);
  Lights l{*full.view,   unit(*full.light), *full.stripes,
           *full.origin, full.stripe_count, full.spacing};
  if (kind == FieldKind::reflection) {
    const Vector3 stacked = across(l.stripes, l.view);
    if (!(norm(stacked) > 1e-9))
      return fail(ErrorCode::bad_input, "the stripes are stacked along the view",
                  "give a direction across the view", "stripes");
    l.stripes = unit(stacked);
  }
  Field field{grid.rows, grid.columns, {}, {}, {0, 0}};
  field.values.reserve(grid.jets.size());
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const SurfaceJet& j : grid.jets) {
    const auto frame = frame_of(j);
    const double value = frame ? value_at(kind, l, j, *frame) : kNone;
    const double second = frame && kind == FieldKind::principal ? curvature_of(j)->smallest : value;
    field.values.push_back(value);
    if (kind == FieldKind::principal) field.second.push_back(second);
    if (!std::isfinite(value)) continue;
    low = std::min(low, second);
    high = std::max(high, value);
  }
  for (double& x : field.values)
    if (!std::isfinite(x)) x = kNone;
  if (low <= high) field.range = {low, high};
  return field;
}

}  // namespace keyline::surface
