#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/exchange/json/json_curve.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/svg/svg_reader.h"
#include "keyline/operations/fair.h"
#include "keyline/presentation/analyze_report.h"
#include "keyline/presentation/fair_report.h"
#include "keyline/presentation/pictures.h"
#include "keyline/report/html_report.h"

namespace keyline::presentation {
namespace {

using core::Point2;
using testing::Contains;
using testing::HasSubstr;

struct Faired {
  acquire::KeyLine line;
  fairing::FairResult result;
};

Faired faired(const std::vector<Point2>& points, const fairing::FairOptions& options = {}) {
  acquire::RawCurve raw;
  for (const Point2 p : points) raw.points.push_back({p.x, p.y, 0});
  Faired made;
  made.line = acquire::acquire_key_line(raw).value();
  made.result = fairing::fair(made.line, options).value();
  return made;
}

Faired faired_example(const std::string& name, const fairing::FairOptions& options = {}) {
  const auto raw = exchange::read_points(std::string(KEYLINE_SOURCE_DIR "/examples/") + name);
  Faired made;
  made.line = acquire::acquire_key_line(raw.value().front()).value();
  made.result = fairing::fair(made.line, options).value();
  return made;
}

std::vector<Point2> circle(int n, bool whole) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) {
    const double angle = (whole ? 2 : 0.5) * std::numbers::pi * i / (whole ? n : n - 1);
    points.push_back({10 * std::cos(angle), 10 * std::sin(angle)});
  }
  return points;
}

const report::Section& section(const report::Report& report, const std::string& title) {
  const auto found = std::find_if(report.sections.begin(), report.sections.end(),
                                  [&](const auto& s) { return s.title == title; });
  if (found == report.sections.end()) throw std::runtime_error("no section " + title);
  return *found;
}

TEST(FairReport, HoldsEveryPieceJointAndNote) {
  const Faired f = faired_example("bottle.csv");
  const report::Report report = fair_report(
      f.line, f.result, {.unit = "mm", .command = "keyline fair", .options = {{"seed", "1"}}});
  const auto& pieces = section(report, "Pieces and their rhythm").tables.at(0);
  ASSERT_EQ(pieces.rows.size(), f.result.pieces.size());
  EXPECT_EQ(pieces.rows.front().front(), "0");
  const auto& joints = section(report, "Continuity").tables.at(0);
  EXPECT_EQ(joints.rows.size(), f.result.joints.size());
  for (const std::string& note : f.result.notes)
    EXPECT_THAT(report.notes, Contains(testing::Field(&report::ReportNote::text, note)));
  EXPECT_EQ(report.verdict, report::Verdict::good);
  EXPECT_EQ(report.options.front().first, "seed");
}

TEST(FairReport, SaysWhatToLookAtAgain) {
  // An arc, a quarter of the bend within a hundred-and-fiftieth of the way, the rest of it, an arc.
  Faired f = faired(circle(60, false));
  const lac::Chain chain{{{0, 0}, 0},
                         {{-1, 100, 0.01, 0.01}, {-3, 1, 0.01, 0.02}, {-1, 100, 0.02, 0.02}}};
  f.result.curves = {chain};
  f.result.pieces.assign(3, {});
  for (int i = 0; i < 3; ++i) f.result.pieces[i].piece = i;
  f.result.pieces[1].start = 100;
  f.result.pieces[1].seen = false;
  f.result.pieces[2].start = 101;
  const auto look_at = [&](core::Interval slopes) {
    const report::Report report = fair_report(f.line, f.result, {}, slopes);
    std::vector<std::string> texts;
    for (const auto& row : section(report, "Pieces and their rhythm").tables.at(0).rows)
      texts.push_back(row.back());
    return texts;
  };
  EXPECT_THAT(look_at({-3, 3}),
              testing::ElementsAre("", "near-step, too short to see, slope at its limit", ""));
  EXPECT_THAT(look_at({-4, 3}), testing::ElementsAre("", "near-step, too short to see", ""));
  const report::Report report = fair_report(f.line, f.result);
  EXPECT_THAT(section(report, "Curvature").figures.at(1).caption, HasSubstr("near-step"));
}

TEST(FairReport, IsTheSameBytesTwice) {
  const Faired f = faired_example("bottle.csv");
  EXPECT_EQ(report::html_report(fair_report(f.line, f.result)),
            report::html_report(fair_report(f.line, f.result)));
}

TEST(FairReport, SaysWhereTheToleranceIsMissed) {
  Faired f = faired(circle(40, false));
  f.result.tolerance = 0.5;
  f.result.offsets[7] = 0.8;
  f.result.max_deviation = 0.8;
  f.result.worst_point = 7;
  f.result.within_tolerance = false;
  const report::Report report = fair_report(f.line, f.result);
  EXPECT_EQ(report.verdict, report::Verdict::bad);
  EXPECT_THAT(report.verdict_line, HasSubstr("1 of 40 points lies beyond"));
  EXPECT_THAT(report.verdict_line, HasSubstr("point 7"));
}

TEST(FairReport, CancelledWorkIsNotPassed) {
  Faired f = faired(circle(40, false));
  f.result.cancelled = true;
  EXPECT_EQ(fair_report(f.line, f.result).verdict, report::Verdict::caution);
}

TEST(FairReport, LivesWithDegenerateCurves) {
  std::vector<Point2> straight;
  for (int i = 0; i < 30; ++i) straight.push_back({1.0 * i, 0.5 * i});
  for (const auto& points :
       {straight, std::vector<Point2>{{0, 0}, {1, 1}}, std::vector<Point2>{{0, 0}, {1, 1}, {2, 1}},
        circle(60, true), circle(60, false)}) {
    const Faired f = faired(points);
    const std::string page = report::html_report(fair_report(f.line, f.result));
    EXPECT_THAT(page, HasSubstr("Piece"));
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_TRUE(figure::write_png(fair_picture(f.line, f.result), 0.5));
  }
}

TEST(FairReport, ShowsKeptPartsWithoutNumbers) {
  fairing::FairOptions options;
  options.region = core::Interval{0.3, 0.7};
  const Faired f = faired_example("clothoid.csv", options);
  ASSERT_EQ(f.result.curves.size(), 3U);
  const report::Report report = fair_report(f.line, f.result);
  EXPECT_EQ(section(report, "Continuity").tables.at(0).rows.size(), f.result.joints.size());
  EXPECT_EQ(section(report, "Continuity").tables.at(0).rows.back().front(),
            std::to_string(f.result.pieces.size() - 1) + "\u2013kept");
  EXPECT_THAT(report.numbers.front().note, HasSubstr("2 parts kept"));
}

TEST(FairReport, DrawsNoMoreThanTwoThousandPoints) {
  Faired f = faired(circle(50, false));
  std::vector<Point2> many;
  for (int i = 0; i < 30000; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / 29999;
    many.push_back({10 * std::cos(angle), 10 * std::sin(angle)});
  }
  f.line.points = many;
  f.result.offsets.assign(many.size(), 0);
  f.result.offsets[12345] = 0.2;  // right of the curve is outside
  const report::Report report = fair_report(f.line, f.result);
  EXPECT_LT(report::html_report(report).size(), 600'000U);
  EXPECT_THAT(section(report, "Before and after").figures.at(0).caption, HasSubstr("30000"));
}

TEST(FairReport, RefusesTheResultOfAnotherKeyLine) {
  Faired f = faired(circle(40, false));
  f.line.points.pop_back();
  EXPECT_THROW(fair_report(f.line, f.result), core::InvalidInput);
}

TEST(FairReport, SheetsManyPieces) {
  Faired f = faired(circle(40, false));
  lac::Chain chain;
  f.result.pieces.clear();
  f.result.joints.clear();
  for (int i = 0; i < 50; ++i) {
    const double from = 0.1 + 0.05 * (i % 2);
    chain.pieces.push_back({-1, 0.3 + 0.001 * i, from, 0.25 - from});
    fairing::FairPiece piece;
    piece.piece = i;
    piece.length = 0.3;
    piece.rhythm = analysis::Rhythm::minus;
    f.result.pieces.push_back(piece);
  }
  f.result.curves = {chain};
  const report::Report report = fair_report(f.line, f.result);
  const auto& graphs = section(report, "Logarithmic curvature graphs and diagrams");
  EXPECT_EQ(graphs.figures.size(), 7U);  // 40 of 50 pieces, six to a sheet
}

TEST(JoinedReport, TakesTheWorstVerdict) {
  const Faired f = faired(circle(40, false));
  std::vector<report::Report> reports(2, fair_report(f.line, f.result));
  reports[1].verdict = report::Verdict::bad;
  const report::Report all = joined_report(reports, "Both");
  EXPECT_EQ(all.verdict, report::Verdict::bad);
  EXPECT_EQ(all.title, "Both");
  EXPECT_EQ(all.sections.size(), 2 * (1 + reports[0].sections.size()));
  EXPECT_TRUE(joined_report({}, "None").sections.empty());
}

document::Path bezier_path() {
  return {{{curve::Bezier2{{{0, 0}, {1, 0}, {2, 0.3}, {2.6, 1.2}}, {}}}}, false};
}

TEST(AnalyzeReport, HoldsEveryPieceAndTheVerdict) {
  const document::Path path = bezier_path();
  const auto analysis = operations::analyze_path(path);
  ASSERT_TRUE(analysis);
  const report::Report report = analyze_report(*analysis, path, {.unit = "mm"});
  const auto& pieces = section(report, "Pieces and their rhythm").tables.at(0);
  EXPECT_EQ(pieces.rows.size(), analysis->pieces.size());
  const bool monotone = analysis->monotone.value == analysis::MonotoneAnswer::Value::yes;
  EXPECT_EQ(report.verdict == report::Verdict::good, monotone);
  EXPECT_EQ(report::html_report(report),
            report::html_report(analyze_report(*analysis, path, {.unit = "mm"})));
  EXPECT_TRUE(figure::write_png(analyze_picture(*analysis, path), 0.5));
}

TEST(AnalyzeReport, LivesWithLinesArcsAndCorners) {
  const document::Path line{{{curve::Bezier2{{{0, 0}, {3, 4}}, {}}}}, false};
  const document::Path arc{{{lac::Chain{{}, {{-1, 5, 0.2, 0.2}}, false}}}, false};
  const document::Path corner{
      {{curve::Bezier2{{{0, 0}, {3, 0}}, {}}}, {curve::Bezier2{{{3, 0}, {3, 2}}, {}}}}, false};
  for (const document::Path& path : {line, arc, corner}) {
    const auto analysis = operations::analyze_path(path);
    ASSERT_TRUE(analysis) << analysis.error().message;
    const std::string page = report::html_report(analyze_report(*analysis, path));
    EXPECT_EQ(page.find("nan"), std::string::npos);
  }
  EXPECT_FALSE(operations::analyze_path(line, -1));
}

}  // namespace
}  // namespace keyline::presentation
