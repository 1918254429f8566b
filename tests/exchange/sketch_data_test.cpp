// Real drawings through room sketch; here because reading their files is room exchange's.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "keyline/core/polygon.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/exchange/points/scap_reader.h"
#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/trace.h"

#include "tests/shared_data.h"

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
      const int n = 2 + 2 * static_cast<int>(core::polygon_length(piece.control));
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
  KEYLINE_NEEDS_SHARED_DATA(!files.empty(), kSketches);
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
    EXPECT_FALSE(trace->sheet) << "is no photo";
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

/// Pair-counting precision, recall and F1 of the groups found against the true ones, and the share
/// of all lines' length that lies farther than a pen and a half from every stroke.
struct Score {
  double precision = 1;
  double recall = 1;
  double f1 = 1;
  double off = 0;
  std::size_t bad_lines = 0;  ///< of which more than 2 % lies off
  std::size_t lines = 0;
  double milliseconds = 0;
};

void count_pairs(const Grouped& drawing, const std::vector<sketch::MeantLine>& lines,
                 Score& score) {
  std::vector<std::size_t> found(drawing.strokes.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::size_t m : lines[i].members) found[m] = i;
  double both = 0;
  double only_found = 0;
  double only_true = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      const bool t = drawing.truth[i] == drawing.truth[j];
      const bool f = found[i] == found[j];
      both += t && f ? 1 : 0;
      only_found += f && !t ? 1 : 0;
      only_true += t && !f ? 1 : 0;
    }
  if (both + only_found > 0) score.precision = both / (both + only_found);
  if (both + only_true > 0) score.recall = both / (both + only_true);
  if (both + only_found + only_true > 0) score.f1 = 2 * both / (2 * both + only_found + only_true);
}

double distance_to(core::Point2 p, core::Point2 a, core::Point2 b) {
  const core::Vector2 edge = b - a;
  const double square = dot(edge, edge);
  const double along = square > 0 ? std::clamp(dot(p - a, edge) / square, 0.0, 1.0) : 0;
  return core::distance(p, a + along * edge);
}

bool near_a_stroke(core::Point2 p, const Grouped& drawing) {
  for (const sketch::DrawnStroke& s : drawing.strokes)
    for (std::size_t i = 1; i < s.points.size(); ++i)
      if (distance_to(p, s.points[i - 1], s.points[i]) <= 1.5 * drawing.pen) return true;
  return false;
}

void count_off(const Grouped& drawing, const std::vector<sketch::MeantLine>& lines, Score& score) {
  double all = 0;
  double off = 0;
  for (const sketch::MeantLine& line : lines) {
    double own = 0;
    double own_off = 0;
    const std::size_t n = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
      const core::Point2 p = line.points[i];
      const core::Point2 q = line.points[(i + 1) % n];
      own += core::distance(p, q);
      if (!near_a_stroke(core::mix(p, q, 0.5), drawing)) own_off += core::distance(p, q);
    }
    if (own_off > 0.02 * own) ++score.bad_lines;
    all += own;
    off += own_off;
  }
  score.off = off / all;
}

Score score_of(const Grouped& drawing) {
  Score score;
  const auto start = std::chrono::steady_clock::now();
  const auto lines = sketch::consolidate(drawing.strokes, {.width = drawing.pen});
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  score.milliseconds = time.count();
  score.lines = lines.size();
  count_pairs(drawing, lines, score);
  count_off(drawing, lines, score);
  return score;
}

/// The half of the files that the constants of pass_evidence.cpp were chosen on: FNV-1a of the
/// file's name is even.
bool learnt_on(const fs::path& file) {
  std::uint32_t hash = 2166136261U;
  for (const unsigned char c : file.filename().string()) hash = (hash ^ c) * 16777619U;
  return hash % 2 == 0;
}

/// The same drawing otherwise: 1 every second stroke turned round, 2 three times as large with its
/// pen, 3 every second point left out, 4 three times as large with the pen forgotten, 5 a third.
Grouped changed(const Grouped& drawing, int how) {
  Grouped other = drawing;
  const double scale = how == 2 || how == 4 ? 3 : how == 5 ? 1.0 / 3 : 1;
  if (how == 2) other.pen *= scale;
  for (std::size_t i = 0; i < other.strokes.size(); ++i) {
    auto& points = other.strokes[i].points;
    if (how == 1 && i % 2 == 0) std::reverse(points.begin(), points.end());
    for (core::Point2& p : points) p = {scale * p.x, scale * p.y};
    if (how != 3 || points.size() < 8) continue;
    std::vector<core::Point2> fewer;
    for (std::size_t k = 0; k < points.size(); k += 2) fewer.push_back(points[k]);
    points = fewer;
  }
  return other;
}

Grouped read_drawing(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  const auto drawing = read_scap(text.str());
  EXPECT_TRUE(drawing) << file;
  if (!drawing) return {};
  Grouped truth{{}, {}, drawing->pen};
  for (const ScapStroke& s : drawing->strokes) {
    if (s.points.size() < 2) continue;
    truth.strokes.push_back({s.points, false});
    truth.truth.push_back(s.group);
  }
  return truth;
}

// The bars of what consolidation has to reach, on the half it was not learnt on above all.
TEST(SketchData, ConsolidationFindsTheTrueGroups) {
  const auto files = files_in(kSketches / "strokes", ".scap");
  KEYLINE_NEEDS_SHARED_DATA(!files.empty(), kSketches);
  const int variants = std::getenv("KEYLINE_FULL") ? 6 : 1;
  for (const bool learnt : {true, false}) {
    double sum = 0;
    double off = 0;
    double count = 0;
    std::printf("%s\n", learnt ? "learnt on" : "not learnt on");
    for (const fs::path& file : files) {
      if (learnt_on(file) != learnt) continue;
      SCOPED_TRACE(file.filename().string());
      const Grouped truth = read_drawing(file);
      for (int how = 0; how < variants; ++how) {
        const Grouped drawing = changed(truth, how);
        const Score score = score_of(drawing);
        std::printf(
            "  %-16s %d %4zu strokes %3zu lines  P %.3f R %.3f F1 %.3f  off %.2f %%  %.0f ms\n",
            file.filename().c_str(), how, drawing.strokes.size(), score.lines, score.precision,
            score.recall, score.f1, 100 * score.off, score.milliseconds);
        sum += score.f1;
        if (how < 4) off += score.off;
        ++count;
        if (how < 4) {
          EXPECT_GE(score.f1, 0.75);
          EXPECT_LE(score.off, 0.006);  // where it goes over from one stroke to another
          EXPECT_EQ(score.bad_lines, 0U);
        } else {
          EXPECT_GE(score.f1, 0.55);  // a drawing that says a wrong pen
        }
      }
    }
    std::printf("  mean F1 %.3f\n", sum / count);
    EXPECT_GE(sum / count, 0.9);
    EXPECT_LE(off / count, 0.005);
  }
}

// Strokes end beside others, and one goes on beside itself: no step or hook where the line changes.
TEST(SketchData, RoundLinesHaveNoSharpTurn) {
  for (const char* name : {"loop.scap", "infinity.scap"}) {
    SCOPED_TRACE(name);
    const fs::path file = kSketches / "strokes" / name;
    KEYLINE_NEEDS_SHARED_DATA(fs::exists(file), file);
    const Grouped drawing = read_drawing(file);
    const auto lines = sketch::consolidate(drawing.strokes, {.width = drawing.pen});
    ASSERT_EQ(lines.size(), 1U);
    const std::vector<core::Point2>& p = lines[0].points;
    for (std::size_t i = 4; i + 4 < p.size(); ++i)
      EXPECT_LT(std::abs(core::angle_between(p[i] - p[i - 4], p[i + 4] - p[i])), 0.5) << i;
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
