#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <nlohmann/json.hpp>

#include "run_keyline.h"

namespace keyline::app_test {
namespace {

/// Bytes of an 8 bit grey TIFF without compression; `grey(x, y)` from 0 to 255.
template <class Grey>
std::string tiff(int width, int height, const Grey& grey) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto put = [&](std::uint32_t value, int size) {
    for (int k = 0; k < size; ++k) bytes += static_cast<char>(value >> (8 * k));
  };
  const std::uint32_t pixels = 8 + 2 + 9 * 12 + 4;
  put(9, 2);
  const auto field = [&](std::uint32_t tag, std::uint32_t value) {
    put(tag, 2);
    put(4, 2);
    put(1, 4);
    put(value, 4);
  };
  const auto w = static_cast<std::uint32_t>(width);
  const auto h = static_cast<std::uint32_t>(height);
  field(256, w);
  field(257, h);
  field(258, 8);
  field(259, 1);
  field(262, 1);
  field(273, pixels);
  field(277, 1);
  field(278, h);
  field(279, w * h);
  put(0, 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) bytes += static_cast<char>(grey(x, y));
  return bytes;
}

std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ 61U) ^ (x >> 16);
  x *= 9U;
  x ^= x >> 4;
  x *= 0x27d4eb2dU;
  return x ^ (x >> 15);
}

int noise(int x, int y) {
  return static_cast<int>(scrambled(static_cast<std::uint32_t>(x + 7919 * y)) & 255U);
}

using Point = std::array<double, 2>;

Point on_bezier(const std::vector<Point>& control, double t) {
  std::vector<Point> p = control;
  for (std::size_t n = p.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 2; ++k) p[i][k] += t * (p[i + 1][k] - p[i][k]);
  return p[0];
}

/// The lines that examples/make_examples.py draws, at small steps.
std::vector<Point> drawn_car() {
  const std::vector<std::vector<Point>> lines = {{{70, 200}, {170, 150}, {220, 70}, {350, 68}},
                                                 {{350, 68}, {470, 66}, {540, 110}, {585, 190}},
                                                 {{70, 200}, {55, 215}, {55, 240}, {70, 250}},
                                                 {{585, 190}, {600, 215}, {600, 240}, {585, 250}},
                                                 {{222, 128}, {250, 95}, {300, 88}, {340, 88}},
                                                 {{222, 128}, {280, 126}, {320, 124}, {340, 122}},
                                                 {{356, 88}, {420, 86}, {470, 98}, {500, 120}},
                                                 {{356, 122}, {400, 121}, {460, 121}, {500, 120}},
                                                 {{70, 250}, {78, 251}, {85, 252}, {98, 252}},
                                                 {{206, 252}, {280, 254}, {380, 254}, {440, 252}},
                                                 {{548, 252}, {560, 252}, {575, 251}, {585, 250}}};
  std::vector<Point> points;
  for (const auto& line : lines)
    for (int i = 0; i <= 400; ++i) points.push_back(on_bezier(line, i / 400.0));
  for (const double centre : {152.0, 494.0})
    for (const double radius : {54.0, 40.0})
      for (int k = radius == 54 ? 315 : 0; k < 629; ++k)
        points.push_back({centre + radius * std::cos(0.01 * k), 254 + radius * std::sin(0.01 * k)});
  return points;
}

/// Close places on every quintic, y downwards as the picture has it.
std::vector<Point> traced(const nlohmann::json& result, double height) {
  std::vector<Point> points;
  for (const auto& stroke : result["strokes"])
    for (const auto& quintic : stroke["curve"]["curves"])
      for (int i = 0; i <= 300; ++i) {
        const Point p = on_bezier(quintic["points"].get<std::vector<Point>>(), i / 300.0);
        points.push_back({p[0], height - p[1]});
      }
  return points;
}

/// The share of `points` that have none of `others` within `reach`.
double share_without(const std::vector<Point>& points, const std::vector<Point>& others,
                     double reach) {
  const auto far = [&](const Point& p) {
    return std::ranges::none_of(
        others, [&](const Point& q) { return std::hypot(p[0] - q[0], p[1] - q[1]) <= reach; });
  };
  return static_cast<double>(std::ranges::count_if(points, far)) /
         static_cast<double>(points.size());
}

TEST(Sketch, TracesTheExampleOntoItself) {
  const Scratch s;
  const Outcome o = run_keyline("sketch " + example("sketch.png") + " -o " + s.path("a.svg") +
                                " -o " + s.path("a.json") + " --debug " + s.path("stages"));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("640 x 320 pixels, "), std::string::npos) << o.err;
  EXPECT_NE(slurp(s.path("a.svg")).find("viewBox=\"0 0 640 320\""), std::string::npos);
  for (const char* name :
       {"01-log", "02-histogram", "03-binary", "04-smoothed", "05-edges", "06-lines", "07-groups",
        "08-segments", "09-quadratics", "10-quintics", "11-curvature", "12-derivative"})
    EXPECT_TRUE(slurp(s.path("stages/" + std::string(name) + ".png")).starts_with("\x89PNG"))
        << name;
  // What was drawn is there, and nothing else: to the pen's width of 2.8 pixels, the roof being
  // drawn three times up to 1.8 beside itself.
  const auto told =
      nlohmann::json::parse(run_keyline("sketch --json --quiet " + example("sketch.png")).out);
  const std::vector<Point> lines = drawn_car();
  const std::vector<Point> curves = traced(told, 320);
  std::printf("drawn but not traced %.4f, traced but not drawn %.4f\n",
              share_without(lines, curves, 2.8), share_without(curves, lines, 2.8));
  EXPECT_LT(share_without(lines, curves, 2.8), 0.01);
  EXPECT_LT(share_without(curves, lines, 2.8), 0.01);
}

TEST(Sketch, APhotoIsMappedBackToItsSheet) {
  const Outcome o = run_keyline("sketch --json " + example("photo.png"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("a photo of a sheet, corners "), std::string::npos) << o.err;
  auto told = nlohmann::json::parse(o.out);
  const double width = told["size"][0];
  const double height = told["size"][1];
  EXPECT_NEAR(width / height, 2, 0.04);
  std::vector<Point> curves = traced(told, height);
  for (Point& p : curves) p = {640 / width * p[0], 320 / height * p[1]};
  const std::vector<Point> lines = drawn_car();
  std::printf("drawn but not traced %.4f, traced but not drawn %.4f\n",
              share_without(lines, curves, 3.5), share_without(curves, lines, 3.5));
  EXPECT_LT(share_without(lines, curves, 3.5), 0.02);  // a photo's pixel is 1.4 of the drawing's
  EXPECT_LT(share_without(curves, lines, 3.5), 0.02);

  std::string corners;
  for (const auto& p : told["sheet"]) corners += " " + p[0].dump() + "," + p[1].dump();
  const Outcome given = run_keyline("sketch --json " + example("photo.png") + " --sheet" + corners);
  ASSERT_EQ(given.status, 0) << given.err;
  EXPECT_EQ(nlohmann::json::parse(given.out)["size"], told["size"]);
  const Outcome off = run_keyline("sketch --json " + example("photo.png") + " --rectify off");
  ASSERT_EQ(off.status, 0) << off.err;
  const auto as_it_is = nlohmann::json::parse(off.out);
  EXPECT_EQ(as_it_is["size"][0], 760);
  EXPECT_FALSE(as_it_is.contains("sheet"));
  expect_failure(run_keyline("sketch " + example("photo.png") + " --rectify off --sheet" + corners),
                 2, "leave one of them out");
  expect_failure(run_keyline("sketch " + example("photo.png") + " --sheet 0,0 0,9 9,9 9,0"), 2,
                 "no sheet's");
}

TEST(Sketch, PrintsWhatTheOperationAnswers) {
  const Outcome o = run_keyline("sketch " + example("sketch.png") + " --json --quiet --dpi 120");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const auto j = nlohmann::json::parse(o.out);
  EXPECT_EQ(j["unit"], "mm");
  EXPECT_NEAR(j["size"][0], 640 * 25.4 / 120, 1e-9);
  ASSERT_GT(j["strokes"].size(), 0U);
  for (const auto& stroke : j["strokes"]) {
    EXPECT_GE(stroke["points"].size(), 2U);
    EXPECT_GE(stroke["segments"].size(), 2U);
    EXPECT_EQ(stroke["curve"]["type"], "path");  // also of one quintic, as docs/contract.md has it
    EXPECT_EQ(stroke["curve"]["curves"][0]["points"].size(), 6U);
    EXPECT_GT(stroke["width"], 0.1);
  }
}

TEST(Sketch, WritesPicturesAndAReport) {
  const Scratch s;
  const Outcome o =
      run_keyline("sketch --quiet " + example("sketch.png") + " -o " + s.path("a.png") + " -o " +
                  s.path("a.pdf") + " -o " + s.path("a.html"));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_TRUE(slurp(s.path("a.png")).starts_with("\x89PNG"));
  EXPECT_TRUE(slurp(s.path("a.pdf")).starts_with("%PDF"));
  EXPECT_NE(slurp(s.path("a.html")).find("Traced drawing"), std::string::npos);
}

TEST(Sketch, TakesVectorStrokesAndOutlinesAndTargets) {
  const Scratch s;
  const std::string scap = s.write(
      "a.scap",
      "#100 100\n@1\n{\n#1 1\n10 10 0\n30 12 0\n60 10 0\n}\n{\n#2 1\n20 12 0\n80 11 0\n}\n");
  const Outcome merged = run_keyline("sketch " + scap + " --consolidate --json");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_NE(merged.err.find("1 stroke:"), std::string::npos) << merged.err;
  for (const char* options : {"--edge outer", "--curvature smooth", "--curvature rhythm",
                              "--per-segment", "--threshold 0.9", "--flatten off --specks 20"}) {
    const Outcome o = run_keyline("sketch " + example("sketch.png") + " --json " + options);
    EXPECT_EQ(o.status, 0) << options << o.err;
  }
}

TEST(Sketch, TellsWhatOfADrawingIsNoStroke) {
  const Scratch s;
  const std::string stroke = "{\n#1 1\n10 10\n30 12\n60 10\n}\n";
  EXPECT_EQ(run_keyline("sketch " + s.write("a.scap", "#100 100\n" + stroke)).err.find("left out"),
            std::string::npos);
  const Outcome empty = run_keyline("sketch " + s.write("b.scap", "#100 100\n{\n}\n" + stroke));
  EXPECT_NE(empty.err.find("left out: line 2: a stroke without points"), std::string::npos)
      << empty.err;
  const Outcome text = run_keyline(
      "sketch " + s.write("a.svg",
                          "<svg xmlns='http://www.w3.org/2000/svg' width='99mm' height='99mm'>\n"
                          "<text>A</text><path d='M0 0C9 9 20 9 40 0' stroke='black'/></svg>"));
  EXPECT_NE(text.err.find("left out: line 2: text: 1 element"), std::string::npos) << text.err;
}

/// The guide's example: four passes of a shoulder, three of an arch, a sill, as its generator says.
/// The passes cross each other, so that all ink lies near the lines: there is nothing to warn of.
TEST(Sketch, MakesOneLineOfThePassesOfTheExample) {
  const std::string picture = "sketch --json --quiet " + example("passes.png");
  EXPECT_GE(nlohmann::json::parse(run_keyline(picture).out)["strokes"].size(), 5U);
  const auto lines = nlohmann::json::parse(run_keyline(picture + " --consolidate").out);
  EXPECT_EQ(lines["strokes"].size(), 3U);
  EXPECT_GT(lines["explained"].get<double>(), 0.98);
  const auto told = run_keyline("sketch --json --consolidate " + example("passes.png")).err;
  EXPECT_EQ(told.find("warning"), std::string::npos) << told;
}

TEST(Sketch, FollowsACurvatureDrawnAsPoints) {
  const Scratch s;
  std::string stroke = "#200 200\n@2\n{\n#1 1\n";  // a spiral, its curvature growing evenly
  for (double t = 0, x = 20, y = 20; t <= 1.2; t += 0.02) {
    stroke += std::to_string(x) + " " + std::to_string(y) + " 0\n";
    x += 3 * std::cos(0.4 * t + 0.5 * t * t);
    y += 3 * std::sin(0.4 * t + 0.5 * t * t);
  }
  const std::string scap = s.write("a.scap", stroke + "}\n");
  const Outcome o =
      run_keyline("sketch " + scap + " --json --target 0,0,-0.004 0,0.5,-0.0067 0,1,-0.0094");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("line 0 moved by up to"), std::string::npos) << o.err;
  const auto error = nlohmann::json::parse(o.out)["strokes"][0]["curvature_error"];
  EXPECT_LT(error["after"], error["before"]);
  EXPECT_LT(error["after"], 0.15 * 0.0067);  // of the curvature asked for; one quintic
  expect_failure(run_keyline("sketch " + scap + " --target 0,0,0.01 3,1,0.01"), 2,
                 "there are lines 0 to 0");
  expect_failure(run_keyline("sketch " + scap + " --target 0,0,0.01 0,1.5,0.01"), 2, "0 to 1");
  expect_failure(run_keyline("sketch " + scap + " --target 0,0,0.01"), 2, "a single place");
  expect_failure(run_keyline("sketch " + scap + " --curvature smooth --rhythm stable"), 2,
                 "leave one of them out");
}

TEST(Sketch, TakesWishesByNumberAndShowsTheNumbers) {
  const Scratch s;
  const std::string scap = s.write(
      "a.scap",
      "#100 100\n@1\n{\n#1 1\n10 10 0\n30 12 0\n60 10 0\n}\n{\n#2 1\n20 12 0\n80 11 0\n}\n");
  const Outcome kept = run_keyline("sketch " + scap + " --consolidate --keep 1 --json --overlay " +
                                   s.path("look.png"));
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_TRUE(slurp(s.path("look.png")).starts_with("\x89PNG"));
  const auto strokes = nlohmann::json::parse(kept.out)["strokes"];
  ASSERT_EQ(strokes.size(), 2U);
  EXPECT_NE(strokes[0]["members"], strokes[1]["members"]);
  expect_failure(run_keyline("sketch " + scap + " --consolidate --join 0,7"), 2,
                 "there is no stroke 7");
  expect_failure(run_keyline("sketch " + scap + " --keep 1"), 2, "nothing is consolidated");
  expect_failure(run_keyline("sketch " + scap + " --overlay a.jpg"), 2, "PNG");
}

TEST(Sketch, SaysWhereThereIsNoLine) {
  const Scratch s;
  const auto flat = [](int level) { return [level](int, int) { return level; }; };
  const std::string says = "nothing in the picture looks like a line";
  expect_failure(run_keyline("sketch " + s.write("a.tif", tiff(1, 1, flat(0)))), 1, says);
  expect_failure(run_keyline("sketch " + s.write("b.tif", tiff(200, 200, flat(255)))), 1, says);
  expect_failure(run_keyline("sketch " + s.write("c.tif", tiff(200, 200, flat(0)))), 1, says);
  expect_failure(run_keyline("sketch " + s.write("d.tif", tiff(400, 300, noise))), 1, says);
  const auto salt = [](int x, int y) { return noise(x, y) < 20 ? 0 : 255; };
  expect_failure(run_keyline("sketch " + s.write("e.tif", tiff(400, 300, salt))), 1, says);
}

TEST(Sketch, WarnsOfAPhotographInBoundedTime) {
  const Scratch s;
  // hills and light, some texture: much darkness, hardly a line
  const auto photograph = [](int x, int y) {
    const double hill = 300 + 80 * std::sin(0.01 * x) + 40 * std::sin(0.037 * x + 1);
    const double light =
        y < hill ? 200 - 0.2 * y : 60 + 30 * std::sin(0.05 * x) * std::sin(0.07 * y);
    return static_cast<int>(light) + noise(x / 3, y / 3) % 24;
  };
  const std::string file = s.write("p.tif", tiff(1200, 800, photograph));
  const Outcome o = run_keyline("sketch --json " + file, "ulimit -t 60;");  // of the processor
  EXPECT_TRUE(o.status == 1 || o.err.find("warning: ") != std::string::npos) << o.status << o.err;
}

TEST(Sketch, RefusesWhatIsNoPicture) {
  const Scratch s;
  expect_failure(run_keyline("sketch " + s.write("a.png", "just text\n")), 2, "is no PNG");
  expect_failure(run_keyline("fair " + s.write("b.png", "just text\n")), 2, "is no PNG");
  expect_failure(run_keyline("sketch " + s.path("absent.png")), 3, "cannot be opened");
  std::filesystem::create_directory(s.path("folder.png"));
  expect_failure(run_keyline("sketch " + s.path("folder.png")), 3, "is a directory");
  std::string bomb = tiff(2, 2, noise);
  for (const std::size_t at : {18U, 30U}) bomb.replace(at, 4, std::string("\x40\x9c\0\0", 4));
  expect_failure(run_keyline("sketch " + s.write("bomb.tif", bomb)), 2, "64 megapixels");
  expect_failure(run_keyline("sketch " + example("sketch.png") + " --thresholds 0.5,0.6"), 2,
                 "give 64");
  expect_failure(run_keyline("sketch " + example("sketch.png") + " --threshold 2"), 2,
                 "from 0 to 1");
  expect_failure(run_keyline("sketch " + example("sketch.png") + " --debug /proc/no"), 3, "folder");
}

TEST(Sketch, FairTakesADrawing) {
  const Scratch s;
  const Outcome o =
      run_keyline("fair " + example("sketch.png") + " --select stroke1 -o " + s.path("a.svg"));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("stroke1"), std::string::npos);
  EXPECT_NE(slurp(s.path("a.svg")).find("viewBox=\"0 0 640 320\""), std::string::npos)
      << "curves lie on the drawing";
}

// A vertex of its corners lies on a point of the line.
TEST(Sketch, APathThereAndBackIsALine) {
  const Scratch s;
  const std::string drawing = s.write(
      "back.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" height="440" width="659.485" viewBox="0 0 1280 854"
stroke-width="1.94091"><path d="M146 737l 0 4 0-4z" fill="#e5e5e5"/></svg>)");
  const Outcome o = run_keyline("sketch " + drawing + " --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(nlohmann::json::parse(o.out)["strokes"].size(), 1U);
}

}  // namespace
}  // namespace keyline::app_test
