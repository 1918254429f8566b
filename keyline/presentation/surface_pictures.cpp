#include "keyline/presentation/surface_pictures.h"

#include <algorithm>
#include <cmath>

#include "keyline/curve/bezier.h"
#include "keyline/curve/length.h"
#include "keyline/figure/plot.h"
#include "keyline/figure/ticks.h"
#include "keyline/surface/curvature.h"

namespace keyline::presentation {

using core::cross;
using core::dot;
using core::norm;
using core::Point3;
using core::Result;
using core::Vector3;
using figure::Drawing;
using surface::FieldKind;
using surface::JetGrid;
using surface::Lighting;
using surface::Surface;

namespace {

constexpr int kProfileSamples = 121;

struct FieldWords {
  const char* title;
  const char* unit_power;  ///< of 1/length; empty: no map
};

FieldWords words_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::gaussian:
      return {"Gaussian curvature", "²"};
    case FieldKind::mean:
      return {"Mean curvature", ""};
    case FieldKind::principal:
      return {"Larger principal curvature", ""};
    case FieldKind::zebra:
      return {"Zebra", ""};
    case FieldKind::isophote:
      return {"Isophotes", ""};
    case FieldKind::reflection:
      return {"Reflection lines", ""};
    case FieldKind::highlight:
      return {"Highlight lines", ""};
  }
  return {"", ""};
}

bool is_curvature(FieldKind k) {
  return k == FieldKind::gaussian || k == FieldKind::mean || k == FieldKind::principal;
}

int grid_of(const SurfacePicture& options, std::size_t surfaces) {
  if (options.grid > 1) return options.grid;
  return std::clamp(static_cast<int>(640 / std::sqrt(static_cast<double>(surfaces))), 17, 161);
}

/// All grids as one, to choose lights and view for all of them.
JetGrid together(const std::vector<JetGrid>& grids) {
  JetGrid all;
  for (const JetGrid& g : grids) all.jets.insert(all.jets.end(), g.jets.begin(), g.jets.end());
  all.rows = static_cast<int>(all.jets.size());
  all.columns = 1;
  return all;
}

void place_camera(figure::SurfaceView& view, const SurfacePicture& options,
                  const Lighting& lights) {
  Vector3 n = *lights.view;
  if (n.z < 0) n = -n;  // z is up for most who look
  Vector3 t = *lights.stripes - dot(*lights.stripes, n) * n;
  t = t / norm(t);
  const Vector3 b = cross(n, t);
  view.view = options.view.value_or(0.8 * n - 0.5 * b - 0.33 * t);
  view.up = norm(cross(n, view.view)) > 1e-6 * norm(view.view) ? n : b;
}

figure::SurfaceMesh mesh_of(const JetGrid& grid) {
  figure::SurfaceMesh mesh{grid.rows, grid.columns, {}, {}, {}};
  for (const surface::SurfaceJet& j : grid.jets) {
    mesh.points.push_back(j.point);
    const auto frame = surface::frame_of(j);
    mesh.normals.push_back(frame ? frame->normal : Vector3{});
  }
  return mesh;
}

/// Fields as whole numbers at their lines: 16 isophotes, 12 of the others over the range.
void count_lines(std::vector<figure::SurfaceMesh>& meshes, FieldKind kind) {
  if (kind == FieldKind::zebra || is_curvature(kind)) return;
  std::vector<double> all;
  for (const auto& m : meshes) all.insert(all.end(), m.values.begin(), m.values.end());
  const core::Interval range = usual_range(std::move(all));
  const double step =
      std::max(core::length(range), 1e-12) / (kind == FieldKind::isophote ? 16 : 12);
  for (auto& m : meshes)
    for (double& x : m.values) x /= step;
}

Vector3 mean_normal(const surface::BezierSurface& s) {
  return *surface::completed({}, surface::sample_grid(s, 9, 9)).view;
}

/// Binormal times curvature.
Vector3 bend_of(const curve::Jet3& j) {
  const double speed = norm(j.first);
  return speed > 0 ? cross(j.first, j.second) / (speed * speed * speed) : Vector3{};
}

/// Unit binormal of the curve on the whole, so turned that what bends towards the normal counts
/// positive; zero for a straight curve.
Vector3 mean_binormal(const curve::Bezier3& c, Vector3 normal) {
  Vector3 sum;
  double towards = 0;
  for (int i = 0; i <= 32; ++i) {
    const auto j = curve::jet(c, i / 32.0);
    const Vector3 bend = bend_of(j);
    sum = sum + (dot(bend, sum) < 0 ? -1.0 : 1.0) * bend;
    towards += dot(cross(sum, j.first), normal);
  }
  const double length = norm(sum);
  return length > 0 ? (towards < 0 ? -1 / length : 1 / length) * sum : Vector3{};
}

/// Curvature as it shows in the curve's mean plane: that of a planar curve, with its sign.
figure::Series profile_of(const surface::NetworkCurve& c, Vector3 normal, std::size_t index) {
  const curve::Bezier3 bezier{c.control, {}};
  const Vector3 binormal = mean_binormal(bezier, normal);
  figure::Series series;
  series.name = c.name;
  series.color = figure::palette(index);
  double length = 0;
  Point3 before = c.control.front();
  for (int i = 0; i < kProfileSamples; ++i) {
    const auto j = curve::jet(bezier, i / (kProfileSamples - 1.0));
    length += core::distance(before, j.point);
    before = j.point;
    series.points.push_back({length, dot(bend_of(j), binormal)});
  }
  return series;
}

figure::Plot profile_plot(const surface::BezierSurface& s, bool rows, const std::string& title,
                          const std::string& unit) {
  figure::Plot plot;
  plot.title = title;
  plot.subtitle = rows ? "rows" : "columns";
  plot.width = 470;
  plot.height = 280;
  plot.x.title = unit.empty() ? "arc length" : "arc length [" + unit + "]";
  plot.y.title = unit.empty() ? "curvature" : "curvature [1/" + unit + "]";
  const Vector3 normal = mean_normal(s);
  for (const surface::NetworkCurve& c : surface::network_curves(s.net))
    if (c.is_row == rows) plot.series.push_back(profile_of(c, normal, plot.series.size()));
  return plot;
}

}  // namespace

core::Interval usual_range(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return {0, 1};
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 50;
  return {values[cut], values[values.size() - 1 - cut]};
}

double stripes_for(const std::vector<Surface>& surfaces) {
  constexpr double kPairs = 8;  // over the whole picture
  std::vector<JetGrid> grids;
  for (const Surface& s : surfaces) grids.push_back(surface::sample_grid(s, 33, 33));
  Lighting lights = surface::completed({}, together(grids));
  lights.stripe_count = 1;
  std::vector<double> all;
  for (const JetGrid& grid : grids)
    if (const auto field = surface::interrogate(grid, FieldKind::zebra, lights))
      all.insert(all.end(), field->values.begin(), field->values.end());
  const double range = core::length(usual_range(std::move(all)));
  return std::clamp(std::round(kPairs / std::max(range, 1e-6)), 12.0, 400.0);
}

namespace {

/// How the values of the meshes are painted, and their scale.
void paint_field(FieldKind field, const SurfacePicture& options, figure::SurfaceView& view) {
  const FieldWords words = words_of(field);
  if (view.title.empty()) view.title = words.title;
  view.paint = field == FieldKind::zebra ? figure::SurfacePaint::zebra
               : is_curvature(field)     ? figure::SurfacePaint::map
                                         : figure::SurfacePaint::lines;
  count_lines(view.meshes, field);
  std::vector<double> all;
  for (const auto& m : view.meshes) all.insert(all.end(), m.values.begin(), m.values.end());
  const core::Interval range = options.range.value_or(usual_range(std::move(all)));
  view.low = range.low;
  view.high = range.high;
  view.scale_title =
      options.unit.empty() ? words.title : std::string("1/") + options.unit + words.unit_power;
}

}  // namespace

Result<Drawing> surface_picture(const std::vector<Surface>& surfaces,
                                const SurfacePicture& options) {
  std::vector<JetGrid> grids;
  const int n = grid_of(options, surfaces.size());
  for (const Surface& s : surfaces) grids.push_back(surface::sample_grid(s, n, n, 0));
  figure::SurfaceView view;
  view.title = options.title;
  view.unit = options.unit;
  view.width = options.width;
  Lighting lights = surface::completed(options.lighting, together(grids));
  lights.stripe_count = options.stripe_count.value_or(stripes_for(surfaces));
  place_camera(view, options, surface::completed({}, together(grids)));
  if (options.field == FieldKind::zebra)
    view.subtitle = figure::short_number(2 * lights.stripe_count, 4) + " stripes to the half turn";
  for (const JetGrid& grid : grids) {
    view.meshes.push_back(mesh_of(grid));
    if (!options.field) continue;
    Lighting common = lights;
    if (*options.field == FieldKind::highlight && !options.lighting.light) common.light.reset();
    auto field = surface::interrogate(grid, *options.field, common);
    if (!field) return std::unexpected(field.error());
    view.meshes.back().values = std::move(field->values);
  }
  if (!options.field) {
    view.grid_lines = 4;
    return figure::surface_view(view);
  }
  paint_field(*options.field, options, view);
  return figure::surface_view(view);
}

Drawing network_profiles(const surface::BezierSurface& s, const std::string& title,
                         const std::string& unit) {
  return figure::tile({figure::draw(profile_plot(s, true, title, unit)),
                       figure::draw(profile_plot(s, false, title, unit))},
                      2);
}

}  // namespace keyline::presentation
