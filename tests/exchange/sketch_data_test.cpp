// Real drawings through room sketch; here because reading their files is room exchange's.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "keyline/exchange/image_reader.h"
#include "keyline/exchange/scap_reader.h"
#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/trace.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

const fs::path kSketches = fs::path(KEYLINE_SHARED_DATA) / "2_sketches";

std::vector<fs::path> files_in(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

struct Coverage {
  double ink = 0;    ///< share of ink near a curve
  double curve = 0;  ///< share of the curves' length on ink
};

/// Ink near curves (half the stroke's width there and a pixel), and curve on ink (or beside it: a
/// line one pixel wide has no inside).
Coverage coverage_of(const sketch::TraceResult& trace, const sketch::Binary& ink) {
  sketch::Binary near(ink.width, ink.height);
  double on = 0;
  double length = 0;
  const auto is_ink = [&](double x, double y) {
    const int u = static_cast<int>(std::floor(x));
    const int v = static_cast<int>(std::floor(y));
    return ink.contains(u, v) && ink.at(u, v);
  };
  for (const sketch::Stroke& stroke : trace.strokes) {
    std::size_t at = 0;  // the point of the stroke beside the curve's
    for (const curve::Bezier2& piece : stroke.curve) {
      const int n = 2 + 2 * static_cast<int>(core::distance(piece.control[0], piece.control[5]));
      for (int i = 0; i < n; ++i) {
        const core::Point2 p = evaluate(piece, (i + 0.5) / n);
        const double y = ink.height - p.y;
        ++length;
        on += is_ink(p.x, y) || is_ink(p.x + 0.5, y) || is_ink(p.x - 0.5, y) ||
                      is_ink(p.x, y + 0.5) || is_ink(p.x, y - 0.5)
                  ? 1
                  : 0;
        while (at + 1 < stroke.points.size() &&
               core::distance(stroke.points[at + 1], p) <= core::distance(stroke.points[at], p))
          ++at;
        const double reach = 0.5 * std::max(stroke.widths[at], stroke.width) + 1;
        for (int v = static_cast<int>(y - reach) - 1; v <= y + reach; ++v)
          for (int u = static_cast<int>(p.x - reach) - 1; u <= p.x + reach; ++u)
            if (ink.contains(u, v) && std::hypot(u + 0.5 - p.x, v + 0.5 - y) <= reach)
              near.at(u, v) = 1;
      }
    }
  }
  double all = 0;
  double covered = 0;
  for (std::size_t i = 0; i < ink.data.size(); ++i) {
    all += ink.data[i];
    covered += ink.data[i] & near.data[i];
  }
  return {covered / all, on / length};
}

TEST(SketchData, PicturesAreCoveredWithoutAnyOption) {
  std::vector<fs::path> files = files_in(kSketches / "raster", ".png");
  for (const fs::path& file : files_in(kSketches / "derived_raster", ".png")) files.push_back(file);
  if (files.empty()) GTEST_SKIP() << "no drawings in " << kSketches;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    const auto image = read_image_file(file);
    ASSERT_TRUE(image) << image.error().message;
    sketch::Binary ink;
    sketch::TraceOptions options;
    options.stage = [&](const sketch::Stage& stage) {
      if (stage.name != "smoothed") return;
      ink = sketch::Binary(stage.picture.width, stage.picture.height);
      for (std::size_t i = 0; i < ink.data.size(); ++i) ink.data[i] = stage.picture.data[i] ? 0 : 1;
    };
    const auto trace = sketch::trace(*image, options);
    ASSERT_TRUE(trace) << trace.error().message;
    const Coverage coverage = coverage_of(*trace, ink);
    std::size_t segments = 0;
    std::size_t pieces = 0;
    for (const auto& stroke : trace->strokes) {
      segments += stroke.segments.size() - (stroke.closed ? 0 : 1);
      pieces += stroke.curve.size();
    }
    std::printf("%-34s %3zu strokes, %4zu segments, %3zu quintics; ink %.1f %%, curve %.1f %%\n",
                file.filename().c_str(), trace->strokes.size(), segments, pieces,
                100 * coverage.ink, 100 * coverage.curve);
    EXPECT_GE(coverage.ink, 0.97);
    EXPECT_GE(coverage.curve, 0.97);
  }
}

struct Grouped {
  std::vector<sketch::DrawnStroke> strokes;
  std::vector<int> truth;
  double pen = 1;
};

/// Pair-counting F1 of the groups found against the true ones.
double f1_of(const Grouped& drawing, std::size_t& lines_found) {
  std::vector<std::size_t> found(drawing.strokes.size());
  const auto lines = sketch::consolidate(drawing.strokes, {.width = drawing.pen});
  lines_found = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::size_t m : lines[i].members) found[m] = i;
  double both = 0;
  double one = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      const bool t = drawing.truth[i] == drawing.truth[j];
      const bool f = found[i] == found[j];
      both += t && f ? 1 : 0;
      one += t != f ? 1 : 0;
    }
  return 2 * both / (2 * both + one);
}

/// The same drawing otherwise: every second stroke turned round, a third as large, three times as
/// large, every second point left out.
Grouped changed(const Grouped& drawing, int how) {
  Grouped other = drawing;
  for (std::size_t i = 0; i < other.strokes.size(); ++i) {
    auto& points = other.strokes[i].points;
    if (how == 1 && i % 2 == 0) std::reverse(points.begin(), points.end());
    if (how == 2)
      for (core::Point2& p : points) p = {3 * p.x, 3 * p.y};
    if (how == 4)
      for (core::Point2& p : points) p = {p.x / 3, p.y / 3};
    if (how != 3 || points.size() < 8) continue;
    std::vector<core::Point2> fewer;
    for (std::size_t k = 0; k < points.size(); k += 2) fewer.push_back(points[k]);
    points = fewer;
  }
  return other;
}

TEST(SketchData, ConsolidationFindsTheTrueGroups) {
  const auto files = files_in(kSketches / "strokes", ".scap");
  if (files.empty()) GTEST_SKIP() << "no strokes in " << kSketches;
  const int variants = std::getenv("KEYLINE_FULL") ? 5 : 1;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    const auto drawing = read_scap(text.str());
    ASSERT_TRUE(drawing) << drawing.error().message << drawing.error().path;
    Grouped truth{{}, {}, drawing->pen};
    for (const ScapStroke& s : drawing->strokes) {
      if (s.points.size() < 2) continue;
      truth.strokes.push_back({s.points, false});
      truth.truth.push_back(s.group);
    }
    const bool single = std::set<int>(truth.truth.begin(), truth.truth.end()).size() == 1;
    std::printf("%-18s %3zu strokes:", file.filename().c_str(), truth.strokes.size());
    for (int how = 0; how < variants; ++how) {
      std::size_t lines = 0;
      const double f1 = f1_of(changed(truth, how), lines);
      std::printf(" %2zu lines, F1 %.3f", lines, f1);
      EXPECT_GE(f1, single ? 0.9 : 0.6);
    }
    std::printf("\n");
  }
}

TEST(SketchData, ScapFilesAreReadAndRefused) {
  const auto good = read_scap("#10 20\n@1.5\n{\n#3 7\n1 2 0\n3 4 0\n}\n\n#7 [0, 1) --> #3\n");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->strokes.size(), 1U);
  EXPECT_EQ(good->strokes[0].group, 7);
  EXPECT_EQ(good->pen, 1.5);
  for (const char* bad : {"", "#1 1\n", "{\n1 nan\n}\n", "{\n{\n", "1 2\n", "{\n#1 1\n1 x\n}",
                          "}\n", "@0\n{\n1 2\n}"}) {
    SCOPED_TRACE(bad);
    const auto result = read_scap(bad);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, core::ErrorCode::bad_input);
  }
}

}  // namespace
}  // namespace keyline::exchange
