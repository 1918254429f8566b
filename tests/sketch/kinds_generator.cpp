#include "kinds_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "keyline/core/error.h"
#include "keyline/numeric/random.h"

namespace keyline::sketch::testing {
namespace {

using core::Point2;
using core::Vector2;
using numeric::Random;

constexpr int kWide = 240;
constexpr int kHigh = 180;
constexpr Point2 kMiddle{120, 90};
constexpr double kHalf = 70;  ///< of a stroke's length

/// What is drawn, and with what.
struct Scene {
  std::vector<TrueStroke> strokes;
  std::vector<TrueStroke> ink{};  ///< what the pen left; empty: the strokes
  double dark = 0.9;
  double soft = 0;                                   ///< pixels over which ink fades
  double noise = 0;                                  ///< standard deviation of the grain
  double salt = 0;                                   ///< share of wrong pixels
  double shade = 0;                                  ///< of the paper, across the page
  std::vector<std::array<std::size_t, 2>> dashes{};  ///< of the only stroke, cut straight across:
                                                     ///< first and last point; none: all of it
};

/// An arc of that direction and curvature through a place, half a pixel between points.
TrueStroke arc(Point2 through, double direction, double curvature, double half, double width) {
  TrueStroke s{{}, width};
  for (double t = -half; t <= half; t += 0.5) {
    const double turn = 0.5 * curvature * t;  // the chord's direction
    const double reach = std::abs(turn) < 1e-9 ? t : t * std::sin(turn) / turn;
    s.points.push_back(through +
                       reach * Vector2{std::cos(direction + turn), std::sin(direction + turn)});
  }
  return s;
}

double any_direction(Random& r) { return r.uniform(0, 2 * std::numbers::pi); }
double any_bend(Random& r) { return r.uniform(-1, 1) / 110; }

TrueStroke plain(Random& r, double width) {
  return arc(kMiddle, any_direction(r), any_bend(r), kHalf, width);
}

Scene of_width(Random& r, double width) { return {{plain(r, width)}}; }

Scene crossing(Random& r, double degrees) {
  const double width = r.uniform(2, 8);
  const double first = any_direction(r);
  const double bend = any_bend(r);
  const double between = degrees * std::numbers::pi / 180;
  return {{arc(kMiddle, first, bend, kHalf, width),
           arc(kMiddle, first + between, bend + r.uniform(-0.002, 0.002), kHalf, width)}};
}

/// A stroke of which the ink has gaps: `dash` pixels of it, then `gap` of paper.
Scene broken(Random& r, double dash, double gap) {
  const double width = r.uniform(2, 8);
  Scene scene = of_width(r, width);
  const std::vector<Point2>& all = scene.strokes[0].points;
  const auto on = static_cast<std::size_t>(2 * std::max(0.0, dash - width));  // round ends
  const auto off = static_cast<std::size_t>(2 * (gap + width));
  std::size_t end = 0;
  for (std::size_t from = 0; from + on < all.size(); from += on + off) {
    end = from + on + 1;
    scene.ink.push_back(
        {{all.begin() + static_cast<long>(from), all.begin() + static_cast<long>(end)}, width});
  }
  scene.strokes[0].points.resize(end);  // the truth ends with the ink
  return scene;
}

/// A stroke of dashes that are cut straight across, as vector programs draw them.
Scene cut_across(Random& r, double width, double dash, double gap) {
  Scene scene = of_width(r, width);
  TrueStroke& stroke = scene.strokes[0];
  const auto on = static_cast<std::size_t>(std::lround(2 * dash));  // half a pixel between points
  const auto off = static_cast<std::size_t>(std::lround(2 * gap));
  for (std::size_t from = 0; from + on < stroke.points.size(); from += on + off)
    scene.dashes.push_back({from, from + on});
  stroke.points.resize(scene.dashes.back()[1] + 1);
  return scene;
}

/// Dashes of any length, and gaps of a third to twice theirs.
Scene row_of_dashes(Random& r) {
  const double width = r.uniform(2, 5);
  const double dash = r.uniform(3.5, 6) * width;
  return cut_across(r, width, dash, r.uniform(0.33, 2) * std::min(dash, 20.0));
}

/// Two round lines whose ink touches, and which do not cross.
Scene touching(Random& r) {
  const double width = r.uniform(2, 6);
  const double direction = any_direction(r);
  const Vector2 aside = {-std::sin(direction), std::cos(direction)};
  const double apart = width * r.uniform(0.6, 1);
  return {{arc(kMiddle, direction, 1 / r.uniform(35, 70), 60, width),
           arc(kMiddle - apart * aside, direction, -1 / r.uniform(35, 70), 60, width)}};
}

Scene parallels(Random& r) {
  const double width = r.uniform(3, 8);
  const double direction = any_direction(r);
  const Vector2 aside = {-std::sin(direction), std::cos(direction)};
  const double bend = any_bend(r);
  const double apart = 1.5 * width;
  return {{arc(kMiddle, direction, bend, kHalf, width),
           arc(kMiddle + apart * aside, direction, bend / (1 - bend * apart), kHalf, width)}};
}

Scene hairpin(Random& r) {
  const double width = r.uniform(2, 7);
  const double radius = width;
  TrueStroke s{{}, width};
  for (double t = -90; t < 0; t += 0.5) s.points.push_back({t, -radius});
  for (double a = -std::numbers::pi / 2; a < std::numbers::pi / 2; a += 0.5 / radius)
    s.points.push_back({radius * std::cos(a), radius * std::sin(a)});
  for (double t = 0; t > -r.uniform(60, 90); t -= 0.5) s.points.push_back({t, radius});
  const double turn = any_direction(r);
  for (Point2& p : s.points)
    p = {kMiddle.x + (p.x + 40) * std::cos(turn) - p.y * std::sin(turn),
         kMiddle.y + (p.x + 40) * std::sin(turn) + p.y * std::cos(turn)};
  return {{s}};
}

/// A stem that ends at the middle of a line.
Scene stem(Random& r) {
  const double width = r.uniform(2, 8);
  const double direction = any_direction(r);
  TrueStroke line = arc(kMiddle, direction, any_bend(r), kHalf, width);
  const double away = direction + r.uniform(0.8, 2.3);
  TrueStroke foot{{}, width};
  for (double t = 0; t <= 65; t += 0.5)
    foot.points.push_back(kMiddle + t * Vector2{std::cos(away), std::sin(away)});
  return {{line, foot}};
}

Scene tangle(Random& r) {
  const double width = r.uniform(2, 4);
  const double first = any_direction(r);
  Scene scene;
  for (int k = 0; k < 5; ++k)
    scene.strokes.push_back(arc(kMiddle + Vector2{r.uniform(-22, 22), r.uniform(-22, 22)},
                                first + k * std::numbers::pi / 5, 0.4 * any_bend(r), 62, width));
  return scene;
}

using Maker = std::function<Scene(Random&)>;

const std::vector<std::pair<std::string, Maker>>& makers() {
  const auto width = [](double w) { return [w](Random& r) { return of_width(r, w); }; };
  const auto angle = [](double a) { return [a](Random& r) { return crossing(r, a); }; };
  const auto changed = [](auto change) {
    return [change](Random& r) {
      Scene scene = of_width(r, r.uniform(2, 6));
      change(scene);
      return scene;
    };
  };
  static const std::vector<std::pair<std::string, Maker>> all = {
      {"width 1", width(1)},
      {"width 2", width(2)},
      {"width 4", width(4)},
      {"width 7", width(7)},
      {"width 10", width(10)},
      {"grey", changed([](Scene& s) { s.dark = 0.3; })},
      {"soft", changed([](Scene& s) { s.soft = 2; })},
      {"noise", changed([](Scene& s) { s.noise = 0.06; })},
      {"salt", changed([](Scene& s) { s.salt = 0.01; })},
      {"shade", changed([](Scene& s) { s.shade = 0.5; })},
      {"gap 2", [](Random& r) { return broken(r, 45, 2); }},
      {"gap 4", [](Random& r) { return broken(r, 45, 4); }},
      {"dashes", [](Random& r) { return broken(r, 18, 5); }},
      {"crossing 90", angle(90)},
      {"crossing 45", angle(45)},
      {"crossing 30", angle(30)},
      {"crossing 20", angle(20)},
      {"crossing 15", angle(15)},
      {"parallels", parallels},
      {"hairpin", hairpin},
      {"stem", stem},
      {"tangle", tangle},
      {"cut 2", [](Random& r) { return cut_across(r, r.uniform(5, 10), 40, 2); }},
      {"cut 4", [](Random& r) { return cut_across(r, r.uniform(1, 10), 40, 4); }},
      {"row of dashes", row_of_dashes},
      {"touching", touching},
  };
  return all;
}

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kWide + x); }

/// How much of the ink at a point lies before or behind a pixel: all of it on lines that are whole.
double along(const TrueStroke& s, const Scene& scene, std::size_t point, Point2 pixel) {
  if (scene.dashes.empty()) return 1;
  const std::size_t last = s.points.size() - 1;
  const Vector2 step = s.points[std::min(point + 1, last)] - s.points[point > 0 ? point - 1 : 0];
  const double ahead = core::dot(pixel - s.points[point], step) / core::norm(step);
  for (const auto& [from, to] : scene.dashes)
    if (from <= point && point <= to) {
      const double before = 0.5 * static_cast<double>(point - from) + ahead;
      const double behind = 0.5 * static_cast<double>(to - point) - ahead;
      return std::abs(ahead) > 0.3 ? 0 : std::clamp(0.5 + std::min(before, behind), 0.0, 1.0);
    }
  return 0;
}

void draw(const TrueStroke& s, const Scene& scene, std::vector<double>& cover) {
  const double fade = 0.5 + scene.soft;
  const double reach = 0.5 * s.width + fade;
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const Point2 p = s.points[i];
    const double row = kHigh - p.y;
    for (int y = std::max(0, static_cast<int>(row - reach));
         y <= std::min(kHigh - 1, static_cast<int>(row + reach)); ++y)
      for (int x = std::max(0, static_cast<int>(p.x - reach));
           x <= std::min(kWide - 1, static_cast<int>(p.x + reach)); ++x) {
        const double d = std::hypot(x + 0.5 - p.x, y + 0.5 - row);
        double& c = cover[at(x, y)];
        c = std::max(c, along(s, scene, i, {x + 0.5, kHigh - y - 0.5}) *
                            std::clamp(0.5 + (0.5 * s.width - d) / (2 * fade), 0.0, 1.0));
      }
  }
}

}  // namespace

std::vector<std::string> drawing_kinds() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  names.resize(names.size() - harder_kinds().size());
  return names;
}

std::vector<std::string> harder_kinds() { return {"row of dashes", "touching"}; }

TrueDrawing make_kind(const std::string& kind, std::uint64_t seed) {
  const auto& all = makers();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.first == kind; });
  if (found == all.end()) throw core::InvalidInput("no kind of drawing: " + kind);
  Random random(seed, 91 + static_cast<std::uint64_t>(found - all.begin()));
  const Scene scene = found->second(random);
  std::vector<double> cover(static_cast<std::size_t>(kWide * kHigh), 0);
  for (const TrueStroke& s : scene.ink.empty() ? scene.strokes : scene.ink) draw(s, scene, cover);
  TrueDrawing drawing{scene.strokes, {}};
  drawing.image.luminance = Raster<std::uint16_t>(kWide, kHigh);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      const double paper = 0.95 - scene.shade * x / kWide;
      double v = paper * (1 - scene.dark * cover[at(x, y)]) + scene.noise * random.normal();
      if (scene.salt > 0 && random.chance(scene.salt)) v = random.chance(0.5) ? 0 : 1;
      drawing.image.luminance.at(x, y) =
          static_cast<std::uint16_t>(std::lround(65535 * std::clamp(v, 0.0, 1.0)));
    }
  return drawing;
}

}  // namespace keyline::sketch::testing
