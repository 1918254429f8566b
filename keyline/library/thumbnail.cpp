#include "keyline/library/thumbnail.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "keyline/curve/bounding_box.h"

namespace keyline::library {
namespace {

using Lines = std::vector<std::vector<core::Point2>>;

constexpr int kSamples = 64;

/// Equal parts of every smooth stretch, so that corners stay sharp.
template <class C>
std::vector<core::Point2> samples(const C& curve, auto&& project) {
  const std::vector<double> breaks = breakpoints(curve);
  const int stretches = std::max<int>(1, static_cast<int>(breaks.size()) - 1);
  const int each = std::max(1, kSamples / stretches);
  const int step = std::max(1, stretches / kSamples);
  std::vector<core::Point2> line;
  for (int i = 0; i < stretches; i += step)
    for (int k = 0; k < each; ++k)
      line.push_back(project(evaluate(curve, breaks[i] + (breaks[i + 1] - breaks[i]) * k / each)));
  line.push_back(project(evaluate(curve, 1.0)));
  return line;
}

/// The plane seen from (1, 1, 1), z up.
core::Point2 from_corner(core::Point3 p) {
  const double c = std::sqrt(3.0) / 2;
  return {c * (p.y - p.x), p.z - (p.x + p.y) / 2};
}

Lines lines_of(const document::Document& thing) {
  Lines lines;
  for (const auto& named : thing.paths)
    lines.push_back(samples(named.path, [](core::Point2 p) { return p; }));
  for (const auto& named : thing.space_curves) lines.push_back(samples(named.curve, from_corner));
  constexpr int kSide = 16;
  for (const auto& named : thing.surfaces) {
    for (const bool along_u : {true, false}) {
      for (const double fixed : {0.0, 0.5, 1.0}) {
        auto& line = lines.emplace_back();
        for (int i = 0; i <= kSide; ++i) {
          const double t = static_cast<double>(i) / kSide;
          line.push_back(from_corner(along_u ? surface::evaluate(named.surface, t, fixed)
                                             : surface::evaluate(named.surface, fixed, t)));
        }
      }
    }
  }
  return lines;
}

/// Whole tenths of a pixel, each point relative to the last: a few bytes a point.
void draw(std::string& path, const std::vector<core::Point2>& line, const curve::Box2& box) {
  constexpr double kInside = 900;
  constexpr double kMiddle = 480;
  const double size = std::max({curve::width(box), curve::height(box), 1e-300});
  const core::Point2 center = core::mix(box.low, box.high, 0.5);
  int x = 0;
  int y = 0;
  bool first = true;
  for (const core::Point2 p : line) {
    const int to_x = static_cast<int>(std::lround(kMiddle + kInside * ((p.x - center.x) / size)));
    const int to_y = static_cast<int>(std::lround(kMiddle - kInside * ((p.y - center.y) / size)));
    if (!first && to_x == x && to_y == y) continue;
    path += first ? 'M' : 'l';
    path += std::to_string(first ? to_x : to_x - x) + ' ' + std::to_string(first ? to_y : to_y - y);
    x = to_x;
    y = to_y;
    first = false;
  }
}

}  // namespace

std::string thumbnail(const document::Document& thing) {
  const Lines lines = lines_of(thing);
  curve::Box2 box;
  bool first = true;
  for (const auto& line : lines)
    for (const core::Point2 p : line) {
      box = first ? curve::Box2{p, p} : curve::united(box, p);
      first = false;
    }
  std::string path;
  for (const auto& line : lines) draw(path, line, box);
  return R"(<svg xmlns="http://www.w3.org/2000/svg" width="96" height="96" viewBox="0 0 960 960">)"
         R"(<path fill="none" stroke="currentColor" stroke-width="20" d=")" +
         path + R"("/></svg>)";
}

}  // namespace keyline::library
