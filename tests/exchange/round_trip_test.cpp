#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "keyline/document/arc.h"
#include "keyline/exchange/document_file.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::Point2;
using document::Document;

/// What a designer sends: an S, a spiral with a cusp-like end, an arc, a line, a rational
/// quadratic, a spline.
Document drawing() {
  Document d;
  d.unit = "mm";
  const auto add = [&](const char* name, document::PlanarCurve curve) {
    d.paths.push_back({{name, "body", "#12a4ff"}, {{std::move(curve)}, false}, 0});
  };
  const auto chain = [](Point2 at, std::vector<lac::Piece> pieces) {
    return document::PlanarCurve{lac::Chain{{at, 0.3}, std::move(pieces), false}};
  };
  add("s", chain({0, 0}, {{-1, 120, -0.012, 0.015}}));
  add("spiral", chain({0, 200}, {{1, 90, 0.004, 0.05}, {2, 70, 0.05, 0.01}}));
  add("arc", chain({200, 0}, {{-1, 60, 0.02, 0.02}}));
  add("line", chain({200, 200}, {{-1, 100, 0, 0}}));
  add("conic", {curve::Bezier2{{{400, 0}, {450, 90}, {500, 0}}, {1, 0.5, 1}}});
  add("spline", {curve::BSpline2{3,
                                 {0, 0, 0, 0, 0.4, 1, 1, 1, 1},
                                 {{400, 200}, {420, 260}, {450, 140}, {480, 250}, {500, 200}},
                                 {}}});
  return d;
}

std::vector<Point2> samples(const document::Path& path, int count) {
  std::vector<Point2> points;
  for (int i = 0; i <= count; ++i) points.push_back(evaluate(path, double(i) / count));
  return points;
}

/// Largest distance of points from the polygon through others.
double distance_of(const std::vector<Point2>& points, const std::vector<Point2>& polygon) {
  double most = 0;
  for (const Point2 p : points) {
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      const core::Vector2 side = polygon[i] - polygon[i - 1];
      const double square = dot(side, side);
      const double t =
          square > 0 ? std::clamp(dot(p - polygon[i - 1], side) / square, 0.0, 1.0) : 0;
      least = std::min(least, core::distance(p, polygon[i - 1] + t * side));
    }
    most = std::max(most, least);
  }
  return most;
}

class RoundTrip : public testing::TestWithParam<const char*> {
 protected:
  RoundTrip()
      : folder_(fs::temp_directory_path() / ("keyline-trip-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~RoundTrip() override {
    ::unsetenv("KEYLINE_CAD");
    fs::remove_all(folder_);
  }
  fs::path folder_;
};

/// The curves that belong to a name: a chain may come back in parts.
std::vector<Point2> read_samples(const Document& read, const std::string& name) {
  std::vector<Point2> points;
  for (const auto& named : read.paths)
    if (named.label.name == name) {
      const auto part = samples(named.path, 4000);
      points.insert(points.end(), part.begin(), part.end());
    }
  return points;
}

TEST_P(RoundTrip, IsNotFurtherOffThanItSays) {
  const std::string extension = GetParam();
  const bool cad = extension == ".step" || extension == ".iges";
#ifdef KEYLINE_CAD_PROGRAM
  ::setenv("KEYLINE_CAD", KEYLINE_CAD_PROGRAM, 1);
#else
  if (cad) GTEST_SKIP() << "built without OCCT";
#endif
  const Document d = drawing();
  for (const double tolerance : {1e-2, 1e-5}) {
    const fs::path file = folder_ / ("a" + extension);
    auto written = format_document(d, extension, {.tolerance = tolerance});
    ASSERT_TRUE(written) << written.error().message;
    if (extension != ".csv") {  // a table is as fine as its samples
      EXPECT_LE(written->deviation, tolerance);
    }
    std::string& text = written->content;
    if (extension == ".svg") {  // the drawing alone, without the exact curves beside it
      const std::size_t from = text.find("<metadata>");
      text.erase(from, text.find("</metadata>") - from);
      text.erase(from, std::string("</metadata>").size());
    }
    std::ofstream(file, std::ios::binary) << text;
    const auto read = read_document(file);
    ASSERT_TRUE(read) << read.error().message;
    for (const auto& named : d.paths) {
      SCOPED_TRACE(named.label.name);
      const auto theirs = read_samples(*read, named.label.name);
      ASSERT_FALSE(theirs.empty());
      const auto exact = samples(named.path, 4000);
      // Between samples the polygon is off by up to 0.05 mm squared times the curvature over 8.
      constexpr double kSampling = 3e-5;
      EXPECT_LE(distance_of(samples(named.path, 60), theirs), written->deviation + kSampling);
      std::vector<Point2> some;
      for (std::size_t i = 0; i < theirs.size(); i += 67) some.push_back(theirs[i]);
      EXPECT_LE(distance_of(some, exact), written->deviation + kSampling);
    }
    const auto arc = std::find_if(read->paths.begin(), read->paths.end(),
                                  [](const auto& named) { return named.label.name == "arc"; });
    if (cad || extension == ".dxf") {
      ASSERT_EQ(arc->path.curves.size(), 1U);
      const auto* chain = std::get_if<lac::Chain>(&arc->path.curves[0].value);
      ASSERT_TRUE(chain) << "the arc is no arc any more";
      EXPECT_NEAR(chain->pieces[0].curvature_start, 0.02, 1e-14);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Values(".json", ".svg", ".dxf", ".step", ".iges", ".csv"),
                         [](const auto& format) { return std::string(format.param + 1); });

}  // namespace
}  // namespace keyline::exchange
