#include "keyline/figure/surface_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/core/error.h"
#include "keyline/figure/frame.h"
#include "keyline/figure/ticks.h"

namespace keyline::figure {

using core::cross;
using core::dot;
using core::norm;
using core::Point2;
using core::Point3;
using core::Vector3;

namespace {

constexpr double kTallest = 0.9;  ///< of the width
constexpr int kPixels = 2;        ///< per px of the figure
constexpr int kSamples = 2;       ///< squared, per pixel

struct Camera {
  Vector3 right, up, view;
  Vector3 light;
  Viewport port;
  Point2 flat(const Point3& p) const {
    const Vector3 v = p - Point3{};
    return {dot(v, right), dot(v, up)};
  }
};

struct Vertex {
  double x, y, depth;  ///< in samples, y down; depth grows towards the eye
  double value, shade;
};

struct Raster {
  int columns, rows;
  std::vector<double> depth;
  std::vector<std::array<float, 3>> color;
};

Camera camera_of(const SurfaceView& v) {
  const double length = norm(v.view);
  const Vector3 view = v.view / length;
  const Vector3 right = cross(v.up, view);
  const bool stands = core::is_finite(v.view) && core::is_finite(v.up) && length > 0 &&
                      norm(right) > 1e-9 * norm(v.up);
  if (!stands) throw core::InvalidInput("surface_view: the view is zero or along up");
  Camera camera{right / norm(right), {}, view, {}, {}};
  camera.up = cross(view, camera.right);
  const Vector3 light = 0.5 * view - 0.6 * camera.right + 0.5 * camera.up;
  camera.light = light / norm(light);
  return camera;
}

void check(const SurfaceView& v) {
  for (const SurfaceMesh& m : v.meshes) {
    const bool counts = m.rows >= 2 && m.columns >= 2;
    const auto n = counts ? static_cast<std::size_t>(m.rows) * m.columns : 0;
    if (!counts || m.points.size() != n || m.normals.size() != n ||
        (!m.values.empty() && m.values.size() != n))
      throw core::InvalidInput("surface_view: the lists of a mesh are not equally long");
  }
  if (!(v.width >= 160 && v.width <= 4096))
    throw core::InvalidInput("surface_view: the width is out of range");
}

double fraction(double x) { return x - std::floor(x); }

std::array<float, 3> rgb(const Color& c, double shade) {
  return {static_cast<float>(c.red * shade), static_cast<float>(c.green * shade),
          static_cast<float>(c.blue * shade)};
}

/// Colour of a sample; `slope` is the change of the value over one sample, for soft edges.
std::array<float, 3> paint(const SurfaceView& v, double value, double shade, double slope) {
  constexpr Color plaster{214, 219, 224};
  if (v.paint == SurfacePaint::lit || !std::isfinite(value)) return rgb(plaster, shade);
  if (v.paint == SurfacePaint::map) {
    const double u = v.high > v.low ? (value - v.low) / (v.high - v.low) : 0.5;
    return rgb(sequential(std::clamp(u, 0.0, 1.0)), 0.72 + 0.28 * shade);
  }
  const double phase = fraction(value);
  const double soft = std::max(slope, 1e-9);
  if (v.paint == SurfacePaint::lines) {
    const double away = std::min(phase, 1 - phase) / soft;
    return rgb(plaster, shade * std::clamp(0.25 + 0.4 * away, 0.25, 1.0));
  }
  const double edge =
      phase < 0.5 ? std::min(phase, 0.5 - phase) : -std::min(phase - 0.5, 1 - phase);
  const double white = std::clamp(0.5 + edge / soft, 0.0, 1.0);
  return rgb(Color{255, 255, 255}, (0.08 + 0.88 * white) * (0.8 + 0.2 * shade));
}

/// One triangle with linear depth, shade and value.
void fill(Raster& raster, const SurfaceView& v, const Vertex& a, const Vertex& b, const Vertex& c) {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-12) || !std::isfinite(area)) return;
  const double by_x =
      ((b.value - a.value) * (c.y - a.y) - (c.value - a.value) * (b.y - a.y)) / area;
  const double by_y =
      ((c.value - a.value) * (b.x - a.x) - (b.value - a.value) * (c.x - a.x)) / area;
  const double slope = std::hypot(by_x, by_y);
  const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - 0.5)));
  const int x1 =
      std::min(raster.columns - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) - 0.5)));
  const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - 0.5)));
  const int y1 =
      std::min(raster.rows - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) - 0.5)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5;
      const double py = y + 0.5;
      const double wb = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
      const double wc = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
      const double wa = 1 - wb - wc;
      constexpr double kSlack = -1e-9;  // neighbours share their edge without a gap
      if (wa < kSlack || wb < kSlack || wc < kSlack) continue;
      const double depth = wa * a.depth + wb * b.depth + wc * c.depth;
      const auto at = static_cast<std::size_t>(y) * raster.columns + x;
      if (depth <= raster.depth[at]) continue;
      raster.depth[at] = depth;
      raster.color[at] = paint(v, wa * a.value + wb * b.value + wc * c.value,
                               wa * a.shade + wb * b.shade + wc * c.shade, slope);
    }
  }
}

/// Matt plaster: the middle tones spread, so that little curvature shows.
double shade_of(double cosine) { return std::min(1.0, 0.34 + 0.85 * cosine * cosine); }

std::vector<Vertex> vertices_of(const SurfaceMesh& m, const Camera& camera, Point2 corner,
                                double samples) {
  std::vector<Vertex> list;
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    const Point2 page = to_page(camera.port, camera.flat(m.points[i]));
    Vector3 n = m.normals[i];
    if (dot(n, camera.view) < 0) n = -n;  // both sides are lit
    list.push_back({(page.x - corner.x) * samples, (page.y - corner.y) * samples,
                    dot(m.points[i] - Point3{}, camera.view),
                    m.values.empty() ? std::numeric_limits<double>::quiet_NaN() : m.values[i],
                    shade_of(std::max(0.0, dot(n, camera.light)))});
  }
  return list;
}

void fill(Raster& raster, const SurfaceView& v, const SurfaceMesh& m,
          const std::vector<Vertex>& at) {
  for (int i = 0; i + 1 < m.rows; ++i) {
    for (int j = 0; j + 1 < m.columns; ++j) {
      const std::size_t k = static_cast<std::size_t>(i) * m.columns + j;
      fill(raster, v, at[k], at[k + 1], at[k + m.columns]);
      fill(raster, v, at[k + 1], at[k + m.columns + 1], at[k + m.columns]);
    }
  }
}

Picture picture_of(const Raster& raster, const Box& box, const std::string& text) {
  Picture picture{box, raster.columns / kSamples, raster.rows / kSamples, {}, text};
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.columns; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (int dy = 0; dy < kSamples; ++dy)
          for (int dx = 0; dx < kSamples; ++dx)
            sum += raster.color[static_cast<std::size_t>(y * kSamples + dy) * raster.columns +
                                x * kSamples + dx][channel];
        picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(sum / (kSamples * kSamples))));
      }
  return picture;
}

/// Whether the point is not hidden, up to a little of the model's size.
bool visible(const Raster& raster, const Vertex& p, double slack) {
  const int x = static_cast<int>(p.x);
  const int y = static_cast<int>(p.y);
  if (x < 0 || y < 0 || x >= raster.columns || y >= raster.rows) return true;
  return p.depth + slack >= raster.depth[static_cast<std::size_t>(y) * raster.columns + x];
}

/// Lines of constant u and v over a mesh, where they can be seen.
void add_grid(Group& group, const SurfaceView& v, const SurfaceMesh& m, const Raster& raster,
              const std::vector<Vertex>& at, Point2 corner, double samples, double slack) {
  const auto line = [&](int fixed, int count, bool row) {
    std::vector<Point2> points;
    for (int k = 0; k < count; ++k) {
      const Vertex& p = at[row ? static_cast<std::size_t>(fixed) * m.columns + k
                               : static_cast<std::size_t>(k) * m.columns + fixed];
      const bool seen = visible(raster, p, slack);
      points.push_back(seen ? Point2{corner.x + p.x / samples, corner.y + p.y / samples}
                            : Point2{NAN, NAN});
    }
    group.add(Shape{polyline(points), Stroke{with_alpha(kInk, 0.45), 0.7, {}}, {}});
  };
  for (int i = 0; i < v.grid_lines; ++i) {
    const double share = v.grid_lines > 1 ? static_cast<double>(i) / (v.grid_lines - 1) : 0.5;
    line(static_cast<int>(std::lround(share * (m.rows - 1))), m.columns, true);
    line(static_cast<int>(std::lround(share * (m.columns - 1))), m.rows, false);
  }
}

void add_length_bar(Drawing& drawing, const SurfaceView& v, double scale, Point2 left) {
  const double length = round_number_below(0.3 * drawing.width / scale);
  Path bar;
  bar.move_to(left).line_to({left.x + length * scale, left.y});
  for (const double x : {left.x, left.x + length * scale})
    bar.move_to({x, left.y - 3}).line_to({x, left.y + 3});
  drawing.add(Shape{bar, Stroke{kSoftInk, 1.2, {}}, {}});
  drawing.add(Label{.at = {left.x + length * scale + 6, left.y},
                    .text = short_number(length, 3) + (v.unit.empty() ? "" : "\u00A0" + v.unit),
                    .size = detail::kTextSize,
                    .color = kSoftInk,
                    .baseline = Baseline::middle});
}

void add_colors(Drawing& drawing, const SurfaceView& v, Point2 corner) {
  constexpr int kSteps = 128;
  const double wide = 0.5 * (drawing.width - 2 * detail::kPad);
  Picture bar{.box = {corner, {corner.x + wide, corner.y + 10}}, .columns = kSteps, .rows = 1};
  for (int i = 0; i < kSteps; ++i) {
    const Color c = sequential((i + 0.5) / kSteps);
    bar.rgb.insert(bar.rgb.end(), {c.red, c.green, c.blue});
  }
  bar.text = "colour scale";
  drawing.add(std::move(bar));
  const auto label = [&](double x, double y, Anchor anchor, std::string text, Baseline baseline) {
    drawing.add(Label{.at = {x, y},
                      .text = std::move(text),
                      .size = detail::kTextSize,
                      .color = kSoftInk,
                      .anchor = anchor,
                      .baseline = baseline});
  };
  label(corner.x, corner.y + 14, Anchor::start, short_number(v.low, 3), Baseline::top);
  label(corner.x + wide, corner.y + 14, Anchor::end, short_number(v.high, 3), Baseline::top);
  label(corner.x + wide + 10, corner.y + 5, Anchor::start,
        detail::shortened(v.scale_title, wide - 10, detail::kTextSize), Baseline::middle);
}

Box model_box(const SurfaceView& v, const Camera& camera) {
  Box box;
  for (const SurfaceMesh& m : v.meshes)
    for (const Point3& p : m.points) include(box, camera.flat(p));
  return is_empty(box) ? Box{{0, 0}, {1, 1}} : box;
}

}  // namespace

Drawing surface_view(const SurfaceView& v) {
  check(v);
  Camera camera = camera_of(v);
  Drawing drawing;
  drawing.width = v.width;
  drawing.title = v.title;
  drawing.description = v.subtitle;
  const double top = detail::add_heading(drawing, v.title, v.subtitle, {}) + 4;
  const Box model = model_box(v, camera);
  const double wide = v.width - 2 * detail::kPad;
  const double shape = width(model) > 0 ? height(model) / width(model) : kTallest;
  const double tall = std::ceil(wide * std::clamp(shape, 0.25, kTallest));
  const Box page{{detail::kPad, top}, {detail::kPad + wide, top + tall}};
  camera.port = fit_viewport(model, page);
  const double samples = kPixels * kSamples;
  Raster raster{static_cast<int>(wide * kPixels) * kSamples,
                static_cast<int>(tall * kPixels) * kSamples,
                {},
                {}};
  const auto count = static_cast<std::size_t>(raster.columns) * raster.rows;
  raster.depth.assign(count, -std::numeric_limits<double>::infinity());
  raster.color.assign(count, {255, 255, 255});
  std::vector<std::vector<Vertex>> vertices;
  for (const SurfaceMesh& m : v.meshes) {
    vertices.push_back(vertices_of(m, camera, page.min, samples));
    fill(raster, v, m, vertices.back());
  }
  drawing.add(picture_of(raster, page, v.title));
  Group lines{"lines", {}, {}};
  const double slack = 0.01 * (width(model) + height(model));
  for (std::size_t i = 0; i < v.meshes.size(); ++i)
    add_grid(lines, v, v.meshes[i], raster, vertices[i], page.min, samples, slack);
  drawing.add(std::move(lines));
  double y = page.max.y + 16;
  add_length_bar(drawing, v, camera.port.scale, {detail::kPad + 2, y});
  if (v.paint == SurfacePaint::map) add_colors(drawing, v, {detail::kPad, y += 16});
  drawing.height = std::ceil(y + (v.paint == SurfacePaint::map ? 34 : 14));
  return drawing;
}

}  // namespace keyline::figure
