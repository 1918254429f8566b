#include "keyline/sketch/enlargement.h"

#include <numeric>

namespace keyline::sketch {

int enlargement(const Image& image) {
  const Raster<std::uint16_t>& level = image.luminance;
  int times = 0;  // gcd(0, n) is n
  for (int y = 0; y < level.height && times != 1; ++y)
    for (int x = 0; x < level.width; ++x) {
      const std::uint16_t v = level.at(x, y);
      if (x > 0 && v != level.at(x - 1, y)) times = std::gcd(times, x);
      if (y > 0 && v != level.at(x, y - 1)) times = std::gcd(times, y);
    }
  if (times == 0) return 1;
  return std::gcd(times, std::gcd(level.width, level.height));
}

Image reduced(const Image& image, int times) {
  Image small;
  small.luminance = Raster<std::uint16_t>(image.width() / times, image.height() / times);
  small.pixels_per_mm = image.pixels_per_mm / times;
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small.luminance.at(x, y) = image.luminance.at(x * times, y * times);
  return small;
}

void enlarge(TraceResult& trace, int times) {
  const auto grow = [times](core::Point2& p) { p = {times * p.x, times * p.y}; };
  trace.width *= times;
  trace.height *= times;
  for (DrawnStroke& pass : trace.passes)
    for (core::Point2& p : pass.points) grow(p);
  for (Stroke& stroke : trace.strokes) {
    for (core::Point2& p : stroke.points) grow(p);
    for (core::Point2& p : stroke.segments) grow(p);
    for (auto& axis : stroke.axes)
      for (core::Point2& p : axis) grow(p);
    for (auto* pieces : {&stroke.quadratics, &stroke.curve})
      for (curve::Bezier2& piece : *pieces)
        for (core::Point2& p : piece.control) grow(p);
    for (fit::CurvatureTarget& target : stroke.target) target.curvature /= times;
    if (stroke.driven)
      stroke.driven = DriveReport{stroke.driven->before / times, stroke.driven->after / times};
    stroke.width *= times;
    for (double& width : stroke.widths) width *= times;
  }
}

}  // namespace keyline::sketch
