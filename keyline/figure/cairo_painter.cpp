#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <cairo-pdf.h>
#include <cairo.h>

#include "keyline/figure/drawing.h"
#include "keyline/figure/encode.h"
#include "keyline/figure/painter.h"
#include "keyline/figure/text.h"

namespace keyline::figure {

using core::Point2;

namespace {

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Context = std::unique_ptr<cairo_t, ContextDeleter>;

cairo_status_t append(void* target, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// Image surface holding the picture's pixels.
Surface pixels_of(const Picture& picture) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.columns, picture.rows));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return surface;
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  const auto columns = static_cast<std::size_t>(picture.columns);
  for (std::size_t row = 0; row < static_cast<std::size_t>(picture.rows); ++row) {
    auto* line = reinterpret_cast<std::uint32_t*>(data + row * stride);
    const std::uint8_t* rgb = picture.rgb.data() + 3 * columns * row;
    for (std::size_t i = 0; i < columns; ++i, rgb += 3)
      line[i] = static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 |
                rgb[2];
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

class CairoPainter final : public detail::Painter {
 public:
  explicit CairoPainter(cairo_t* context) : cr_(context) {
    cairo_set_fill_rule(cr_, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    std::unique_ptr<cairo_font_options_t, void (*)(cairo_font_options_t*)> options(
        cairo_font_options_create(), cairo_font_options_destroy);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cr_, options.get());
  }

  void begin_group(const Group& group) override {
    cairo_save(cr_);
    if (!group.clip) return;
    const Box& box = *group.clip;
    cairo_rectangle(cr_, box.min.x, box.min.y, std::max(0.0, width(box)),
                    std::max(0.0, height(box)));
    cairo_clip(cr_);
  }

  void end_group(const Group&) override { cairo_restore(cr_); }

  void shape(const Shape& shape) override {
    trace(shape.path);
    if (shape.fill) {
      use(*shape.fill);
      cairo_fill_preserve(cr_);
    }
    if (shape.stroke) stroke(*shape.stroke, CAIRO_LINE_CAP_BUTT);
    cairo_new_path(cr_);
  }

  void label(const Label& label) override {
    cairo_save(cr_);
    cairo_select_font_face(cr_, "sans-serif",
                           label.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           label.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr_, label.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cr_, label.text.c_str(), &extents);
    const double share = label.anchor == Anchor::end ? 1 : label.anchor == Anchor::middle ? 0.5 : 0;
    cairo_translate(cr_, label.at.x, label.at.y);
    cairo_rotate(cr_, -label.rotation);
    cairo_translate(cr_, -share * extents.x_advance, detail::baseline_drop(label));
    cairo_move_to(cr_, 0, 0);
    if (label.halo > 0) {
      cairo_text_path(cr_, label.text.c_str());
      stroke({kPaper, 2 * label.halo, {}}, CAIRO_LINE_CAP_ROUND);
      cairo_new_path(cr_);
      cairo_move_to(cr_, 0, 0);
    }
    use(label.color);
    cairo_show_text(cr_, label.text.c_str());
    cairo_new_path(cr_);
    cairo_restore(cr_);
  }

  void dots(const Marks& marks) override {
    for (const Point2& p : marks.points) {
      cairo_move_to(cr_, p.x, p.y);
      cairo_line_to(cr_, p.x, p.y);
    }
    stroke({marks.color, marks.size, {}}, CAIRO_LINE_CAP_ROUND);
    cairo_new_path(cr_);
  }

  void picture(const Picture& picture) override {
    const Surface surface = pixels_of(picture);
    cairo_save(cr_);
    cairo_translate(cr_, picture.box.min.x, picture.box.min.y);
    cairo_scale(cr_, width(picture.box) / picture.columns, height(picture.box) / picture.rows);
    cairo_set_source_surface(cr_, surface.get(), 0, 0);
    cairo_pattern_set_extend(cairo_get_source(cr_), CAIRO_EXTEND_PAD);
    cairo_rectangle(cr_, 0, 0, picture.columns, picture.rows);
    cairo_fill(cr_);
    cairo_restore(cr_);
  }

 private:
  void use(Color c) {
    cairo_set_source_rgba(cr_, c.red / 255.0, c.green / 255.0, c.blue / 255.0,
                          std::clamp(c.alpha, 0.0, 1.0));
  }

  void stroke(const Stroke& stroke, cairo_line_cap_t cap) {
    use(stroke.color);
    cairo_set_line_width(cr_, stroke.width);
    cairo_set_line_cap(cr_, cap);
    double total = 0;
    for (const double d : stroke.dash) total += d >= 0 && std::isfinite(d) ? d : NAN;
    const bool dashed = total > 0;
    cairo_set_dash(cr_, dashed ? stroke.dash.data() : nullptr,
                   dashed ? static_cast<int>(stroke.dash.size()) : 0, 0);
    cairo_stroke_preserve(cr_);
  }

  void trace(const Path& path) {
    cairo_new_path(cr_);
    for (const PathStep& step : path.steps) {
      const auto& p = step.point;
      switch (step.verb) {
        case PathVerb::move:
          cairo_move_to(cr_, p[2].x, p[2].y);
          break;
        case PathVerb::line:
          cairo_line_to(cr_, p[2].x, p[2].y);
          break;
        case PathVerb::cubic:
          cairo_curve_to(cr_, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
          break;
        case PathVerb::close:
          cairo_close_path(cr_);
          break;
      }
    }
  }

  cairo_t* cr_;
};

/// Paints everything onto the surface; `scale` is the surface's units per unit of the drawing.
cairo_status_t paint_surface(const Drawing& drawing, cairo_surface_t* surface, double scale) {
  const Context context(cairo_create(surface));
  cairo_scale(context.get(), scale, scale);
  CairoPainter painter(context.get());
  if (drawing.background) {
    const Box page{{0, 0}, {drawing.width, drawing.height}};
    painter.shape({rectangle(grown(page, 1)), std::nullopt, drawing.background});
  }
  detail::paint(drawing, painter);
  cairo_surface_flush(surface);
  return cairo_status(context.get());
}

core::Result<std::string> finished(std::string bytes, cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return bytes;
  return core::fail(core::ErrorCode::internal, std::string("the picture could not be painted: ") +
                                                   cairo_status_to_string(status));
}

}  // namespace

core::Result<std::string> write_pdf(const Drawing& drawing) {
  constexpr double kLargest = 14400;
  const double px = detail::px_per_unit(drawing.unit);
  const double w = drawing.width * px;
  const double h = drawing.height * px;
  if (!(w >= 1 && h >= 1 && w <= kLargest && h <= kLargest))
    return core::fail(core::ErrorCode::bad_input, "the page is not between 1 px and 14400 px",
                      "choose another size of the figure");
  constexpr double kPointsPerPx = 72.0 / 96.0;
  std::string bytes;
  const Surface surface(
      cairo_pdf_surface_create_for_stream(append, &bytes, w * kPointsPerPx, h * kPointsPerPx));
  // A fixed date: the same drawing gives the same bytes.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  const std::string title = clean_text(drawing.title);
  if (!title.empty())
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_status_t status = paint_surface(drawing, surface.get(), px * kPointsPerPx);
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  return finished(std::move(bytes), status);
}

core::Result<std::string> write_png(const Drawing& drawing, double scale) {
  constexpr double kMostPixels = 64e6;
  const double px = detail::px_per_unit(drawing.unit) * scale;
  const double w = std::ceil(drawing.width * px - 1e-6);
  const double h = std::ceil(drawing.height * px - 1e-6);
  if (!(w >= 1 && h >= 1 && w <= 32767 && h <= 32767 && w * h <= kMostPixels))
    return core::fail(core::ErrorCode::bad_input, "the picture is empty or too large for a PNG",
                      "choose another size or scale");
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(w), static_cast<int>(h)));
  cairo_status_t status = paint_surface(drawing, surface.get(), px);
  std::string bytes;
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  return finished(std::move(bytes), status);
}

namespace detail {

std::string png_of_pixels(const Picture& picture) {
  std::string bytes;
  const Surface surface = pixels_of(picture);
  cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  return bytes;
}

}  // namespace detail

}  // namespace keyline::figure
