#include "keyline/exchange/image_reader.h"
#include "keyline/operations/base64.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

/// A wave of a soft pen, 48 × 32 pixels.
constexpr const char* kExample =
    "iVBORw0KGgoAAAANSUhEUgAAADAAAAAgBAAAAAC0T0nBAAAAjklEQVR42mP4jwMwjEogg9/2OCQK+LFLbGLALvGN"
    "gSEfm8RvBQZrbJb/S2Bgx+qqiQzM52ESuUjiWxgY6uH+YKiDix9lYLBBeJCBMQcqvpSBgQPJ5wYMDOb7gPStJAYG"
    "1vtIEj8VGBgYTUKcGBgYWPajhNVPoB4wYFmPFoi/k8Di5ucxQ3dnaWj6nMGfGAAkq7xgUI10+gAAAABJRU5ErkJg"
    "gg==";

Result<sketch::Image> image_of(const json& request) {
  const std::string file = string_or(request, "file", "");
  const std::string encoded = string_or(request, "image", "");
  if (file.empty() == encoded.empty())
    return core::fail(ErrorCode::bad_input, "a drawing is wanted, once",
                      "give either \"image\" (base64) or \"file\"", "image");
  if (!file.empty()) return exchange::read_image_file(file);
  const auto bytes = decode_base64(encoded);
  if (!bytes)
    return core::fail(ErrorCode::bad_input, "is not base64", "encode the picture's bytes", "image");
  auto image = exchange::read_image(*bytes);
  if (!image) image.error().path = "image";
  return image;
}

Result<json> run(const json& request, const Context& context) {
  auto options = trace_options(request);
  if (!options) return std::unexpected(options.error());
  options->progress = context.progress;
  const auto scale = positive_number(request, "scale");
  if (!scale) return std::unexpected(scale.error());
  auto image = image_of(request);
  if (!image) return std::unexpected(image.error());
  const auto trace = trace_picture(std::move(*image), *options);
  if (!trace) return std::unexpected(trace.error());
  return sketch_json(*trace, scale->value_or(1));
}

}  // namespace

Operation sketch_trace_operation() {
  using Type = Field::Type;
  return {
      "sketch.trace",
      "The lines of a drawing as G2 chains of quintics: points along their middle, line segments, "
      "curve, width. The unit is the pixel (or mm with scale), y up from the lower left corner.",
      {{"image", Type::string, false, "PNG, JPEG, TIFF or WebP in base64; or \"file\""},
       {"file", Type::string, false, "path of such a picture; or \"image\""},
       {"threshold", Type::number, false,
        "0 to 1 of the log picture: what is darker is ink; else by region"},
       {"thresholds", Type::any, false, "64 numbers or nulls: thresholds of the 8 x 8 regions"},
       {"log_gain", Type::number, false, "the a of y = a log x; else such that paper is 1"},
       {"flatten", Type::string, false, "auto, on or off: take the paper's own shades out"},
       {"polarity", Type::string, false, "auto, dark (lines on light) or light (lines on dark)"},
       {"edge", Type::string, false, "center (default) or outer: the ink's outer border"},
       {"scale", Type::number, false, "mm per pixel"},
       {"consolidate", Type::boolean, false, "lines drawn several times become one"},
       {"curvature", Type::string, false, "none (default), smooth or rhythm: what it is driven to"},
       {"tolerance", Type::number, false,
        "largest distance of the curve from the line, in pixels (0.5); 0: a quintic per segment"},
       {"gap", Type::number, false, "longest gap bridged, in pixels"},
       {"specks", Type::integer, false, "pieces of ink of fewer pixels are dirt"}},
      run,
      {{"image", kExample}}};
}

}  // namespace keyline::operations
