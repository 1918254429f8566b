#include "keyline/figure/surface_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/error.h"

namespace keyline::figure {
namespace {

/// The unit square at a height, seen from above, its value growing with x.
SurfaceMesh square(double z, double low, double high) {
  SurfaceMesh m{9, 9, {}, {}, {}};
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      m.points.push_back({i / 8.0, j / 8.0, z});
      m.normals.push_back({0, 0, 1});
      m.values.push_back(low + (high - low) * i / 8.0);
    }
  return m;
}

SurfaceView from_above(std::vector<SurfaceMesh> meshes, SurfacePaint paint) {
  SurfaceView v;
  v.meshes = std::move(meshes);
  v.paint = paint;
  v.view = {0, 0, 1};
  v.up = {0, 1, 0};
  v.width = 200;
  return v;
}

const Picture& picture_in(const Drawing& d) {
  for (const Item& item : d.items)
    if (const auto* p = std::get_if<Picture>(&item.value)) return *p;
  throw std::logic_error("no picture");
}

int red_at(const Picture& p, double x, double y) {
  const int column = static_cast<int>(x * p.columns);
  const int row = static_cast<int>(y * p.rows);
  return p.rgb[3 * (static_cast<std::size_t>(row) * p.columns + column)];
}

TEST(SurfaceView, ZebraIsWhiteInTheFirstHalfOfEachValue) {
  const Drawing d = surface_view(from_above({square(0, 0, 2)}, SurfacePaint::zebra));
  const Picture& p = picture_in(d);
  // the square fills the height; its x runs over the middle of the picture
  const double left = 0.5 - 0.5 * p.rows / p.columns;
  const double wide = static_cast<double>(p.rows) / p.columns;
  for (const auto& [x, white] : {std::pair{0.12, true}, {0.37, false}, {0.62, true}, {0.87, false}})
    EXPECT_EQ(red_at(p, left + x * wide, 0.5) > 128, white) << x;
}

TEST(SurfaceView, NearerPartsHideFartherOnes) {
  const auto colors = [](double z0, double z1) {
    const Drawing d =
        surface_view(from_above({square(z0, 0, 0), square(z1, 1, 1)}, SurfacePaint::map));
    return red_at(picture_in(d), 0.5, 0.5);
  };
  EXPECT_EQ(colors(0, 1), colors(-3, 5));
  EXPECT_NE(colors(0, 1), colors(1, 0));
}

TEST(SurfaceView, HasAScaleBarAndColoursWithTheirRange) {
  SurfaceView v = from_above({square(0, 0, 1)}, SurfacePaint::map);
  v.unit = "mm";
  v.width = 420;
  v.scale_title = "mean curvature";
  v.grid_lines = 4;
  const std::string svg = write_svg(surface_view(v));
  for (const char* text : {"mm", "mean curvature", "<image"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(SurfaceView, DrawsPointsAndHolesWithoutHarm) {
  SurfaceMesh point = square(0, 0, 1);
  for (auto& p : point.points) p = {1, 2, 3};
  for (auto& n : point.normals) n = {};
  for (auto& x : point.values) x = NAN;
  EXPECT_NO_THROW(surface_view(from_above({point}, SurfacePaint::zebra)));
  SurfaceMesh wild = square(0, 0, 1);
  wild.points[40].z = INFINITY;
  wild.points[41].x = NAN;
  EXPECT_NO_THROW(surface_view(from_above({wild}, SurfacePaint::lines)));
  EXPECT_NO_THROW(surface_view(from_above({}, SurfacePaint::lit)));
}

TEST(SurfaceView, RefusesWhatDoesNotFit) {
  SurfaceMesh bad = square(0, 0, 1);
  bad.normals.pop_back();
  EXPECT_THROW(surface_view(from_above({bad}, SurfacePaint::lit)), core::InvalidInput);
  SurfaceView v = from_above({square(0, 0, 1)}, SurfacePaint::lit);
  v.up = v.view;
  EXPECT_THROW(surface_view(v), core::InvalidInput);
  v = from_above({square(0, 0, 1)}, SurfacePaint::lit);
  v.width = 10;
  EXPECT_THROW(surface_view(v), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::figure
