#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/numeric/random.h"

#include "truth.h"

/// What the options ask for is what comes out.
namespace keyline::fairing {
namespace {

using testing::line_through;

const lac::Chain kBow{{{0, 0}, 0.2}, {{-1, 40, 0.005, 0.04}, {0.8, 35, 0.04, 0.01}}, false};

acquire::KeyLine bow() { return line_through(testing::measure(kBow, 160, 2e-4, 3)); }

const lac::Chain& only_chain(const FairResult& result) {
  return std::get<lac::Chain>(result.curves.at(0));
}

TEST(FairOptions, ClampsHold) {
  FairOptions options;
  options.clamp.start = Clamp::g1;
  options.clamp.end = Clamp::g2;
  const FairResult result = fair(bow(), options).value();
  const lac::Chain& chain = only_chain(result);
  const curve::BSpline2& spline = result.splines[0];
  EXPECT_LE(core::distance(evaluate(chain, 0), evaluate(spline, 0)), 1e-9 * result.length);
  EXPECT_LE(core::distance(evaluate(chain, 1), evaluate(spline, 1)), 1e-9 * result.length);
  const auto turn = [&](double t) {
    return std::remainder(lac::tangent_angle(chain, t) - curve::tangent_angle(spline, t),
                          2 * 3.141592653589793);
  };
  EXPECT_NEAR(turn(0), 0, 1e-9);
  EXPECT_NEAR(turn(1), 0, 1e-9);
  EXPECT_NEAR(lac::curvature(chain, 1), curve::curvature(spline, 1), 1e-9);
}

TEST(FairOptions, SigmasAreTheToleranceInNoise) {
  acquire::KeyLine line = bow();
  FairOptions options;
  options.sigmas = 4;
  const FairResult result = fair(line, options).value();
  EXPECT_DOUBLE_EQ(result.tolerance, 4 * line.noise);
  options.tolerance = 0.1;
  EXPECT_EQ(fair(line, options).error().path, "sigmas");
  options.tolerance = 0;
  line.noise = 0;
  EXPECT_EQ(fair(line, options).error().path, "sigmas");
}

TEST(FairOptions, MustPassPasses) {
  FairOptions options;
  options.must_pass = {50, 100};
  const FairResult result = fair(bow(), options).value();
  for (const std::size_t j : options.must_pass)
    EXPECT_LE(std::abs(result.offsets[j]), 0.05 * result.tolerance);
}

/// Ends that are to be passed hold the curve and cost it nothing else: it is the calmest still.
TEST(FairOptions, MustPassPassesAtBothEndsOfNoisyPoints) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    numeric::Random random(seed);
    std::vector<core::Point2> points;
    for (int i = 0; i < 60; ++i) {
      const double t = core::kPi * i / 59;
      points.push_back(
          {3 * std::cos(t) + 0.004 * random.normal(), std::sin(t) + 0.004 * random.normal()});
    }
    FairOptions options;
    options.must_pass = {0, 59};
    const FairResult result = fair(testing::line_through(points), options).value();
    EXPECT_FALSE(result.calm_missed) << seed;
    EXPECT_LE(core::distance(evaluate(only_chain(result), 0), points.front()), 1e-9) << seed;
    EXPECT_LE(core::distance(evaluate(only_chain(result), 1), points.back()), 1e-9) << seed;
  }
}

/// Through an inflection no slopes but those below 0 pass.
TEST(FairOptions, SlopesThatCouldNotBeKeptAreTold) {
  const auto told = [](core::Interval slopes) {
    std::vector<core::Point2> points;
    for (int i = 0; i <= 80; ++i) points.push_back({0.1 * i, std::sin(0.1 * i)});
    FairOptions options;
    options.slopes = slopes;
    const FairResult result = fair(testing::line_through(points), options).value();
    return std::ranges::any_of(result.notes, [](const std::string& note) {
      return note.find("outside the range asked for") != std::string::npos;
    });
  };
  EXPECT_TRUE(told({0.5, 2}));
  EXPECT_FALSE(told({-2, 2}));
}

TEST(FairOptions, WantedNumberOfPieces) {
  FairOptions options;
  options.pieces = 4;
  EXPECT_EQ(fair(bow(), options).value().pieces.size(), 4U);
}

TEST(FairOptions, SlopeAskedForIsHeld) {
  FairOptions options;
  options.interpretations = {{.piece = 0, .rhythm = {}, .slope = -0.5}};
  const FairResult result = fair(bow(), options).value();
  EXPECT_EQ(only_chain(result).pieces[0].alpha, -0.5);
}

/// Fastest change of curvature along the chain, by differences of our own.
double measured_rate(const FairResult& result) {
  double most = 0;
  for (const lac::Segment& s : lac::segments(only_chain(result))) {
    const int n = 4000;
    for (int i = 0; i < n; ++i) {
      const double rise = lac::curvature(s, (i + 1.0) / n) - lac::curvature(s, 1.0 * i / n);
      most = std::max(most, std::abs(rise) * n / s.length);
    }
  }
  return most;
}

TEST(FairOptions, CurvatureChangesNoFasterThanAskedFor) {
  const FairResult plain = fair(bow()).value();
  EXPECT_NEAR(plain.rate, measured_rate(plain), 1e-3 * plain.rate);
  FairOptions options;
  options.max_rate = 0.5 * plain.rate;
  const FairResult slow = fair(bow(), options).value();
  EXPECT_LE(measured_rate(slow), *options.max_rate);
  EXPECT_GT(slow.rate, 0.98 * *options.max_rate);
  EXPECT_THAT(slow.notes, ::testing::Contains(::testing::HasSubstr("how fast curvature may")));
  EXPECT_TRUE(slow.within_tolerance);
}

/// A tolerance of many standard deviations leaves the noise to bind, a tight one binds itself.
TEST(FairOptions, WhatBindsIsTold) {
  FairOptions options;
  options.sigmas = 30;
  options.smoothness = 0;
  EXPECT_THAT(fair(bow(), options)->notes,
              ::testing::Contains(::testing::HasSubstr("calmer: the points' noise")));
  options.sigmas = 2.2;
  const auto errors = ::testing::Contains(::testing::HasSubstr("the curve follows their errors"));
  const std::vector<std::string> tight = fair(bow(), options)->notes;
  EXPECT_THAT(tight, ::testing::Contains(::testing::HasSubstr("calmer: the tolerance at")));
  EXPECT_THAT(tight, ::testing::Not(errors));
  options.sigmas = 0.5;
  EXPECT_THAT(fair(bow(), options)->notes, errors);
}

TEST(FairOptions, ARateThatTheToleranceDoesNotAllowIsRefused) {
  FairOptions options;
  options.max_rate = 0.02 * fair(bow()).value().rate;
  const auto refused = fair(bow(), options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, core::ErrorCode::undrawable);
  EXPECT_EQ(refused.error().path, "max_rate");
  EXPECT_NE(refused.error().message.find("without a limit it is"), std::string::npos);
  options.pieces = 3;
  EXPECT_EQ(fair(bow(), options).error().code, core::ErrorCode::bad_input);
}

/// [Fairing], 4, curve B: points of a single R, replaced by a line of slope 2/3 "in the meaning of
/// correcting what was produced in the facilitation".
TEST(FairOptions, ASingleRBecomesSlopeTwoThirds) {
  const lac::Chain screen{{{0, 0}, 0.6}, {{-1, 260, -1 / 900.0, -1 / 900.0}}, false};
  const acquire::KeyLine line = line_through(testing::measure(screen, 130, 4e-4, 5));
  const FairResult single = fair(line).value();
  ASSERT_EQ(single.pieces.size(), 1U);
  EXPECT_EQ(single.pieces[0].rhythm, analysis::Rhythm::arc);
  FairOptions options;
  options.interpretations = {{.piece = 0, .rhythm = {}, .slope = 2.0 / 3}};
  const FairResult chosen = fair(line, options).value();
  EXPECT_DOUBLE_EQ(only_chain(chosen).pieces[0].alpha, 2.0 / 3);
  EXPECT_EQ(chosen.pieces[0].rhythm, analysis::Rhythm::plus);
  EXPECT_TRUE(chosen.pieces[0].overridden);
  EXPECT_TRUE(chosen.within_tolerance);
}

/// Slopes of pieces that are nearly arcs are not told by the points: they stay moderate.
TEST(FairOptions, SlopesThatThePointsDoNotTellStayModerate) {
  for (int seed = 1; seed <= 4; ++seed) {
    const lac::Chain roof{
        {{0, 0}, 0.2}, {{-1, 200, -2e-3, -1e-3}, {-1, 220, -1e-3, -1.25e-3}}, false};
    const FairResult result = fair(line_through(testing::measure(roof, 200, 5e-4, seed))).value();
    EXPECT_TRUE(result.within_tolerance);
    for (const lac::Piece& piece : only_chain(result).pieces)
      EXPECT_LE(std::abs(piece.alpha + 1), 4) << seed;
  }
}

/// Within less than their errors the points ask for every wave: one smoothness is as good as
/// another.
TEST(FairOptions, SmoothnessCountsUnlessTheToleranceHoldsNoMoreThanNoise) {
  acquire::KeyLine line = bow();
  FairOptions options;
  EXPECT_TRUE(fair(line, options).value().smoothness_counts);
  options.tolerance = 0.5 * line.noise;
  EXPECT_FALSE(fair(line, options).value().smoothness_counts);
}

/// A wave that the points ask for goes where it is not wanted and the tolerance holds it; else the
/// answer says how many stay.
TEST(FairOptions, WavesBeyondThoseWantedGoWhileTheToleranceHolds) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 200; ++i) {
    const double t = 1.5 * i / 200;
    const double r = 100 + 0.2 * std::sin(12 * t);
    points.push_back({r * std::cos(t), r * std::sin(t)});
  }
  const auto waves = [&](double tolerance, std::optional<int> wanted) {
    FairOptions options;
    options.tolerance = tolerance;
    options.waves = wanted;
    return fair(line_through(points), options).value();
  };
  const auto turns = [](const FairResult& result) {
    int count = 0;
    double before = 0;
    for (const lac::Piece& piece : only_chain(result).pieces) {
      const double rise = piece.curvature_end - piece.curvature_start;
      count += rise * before < 0;
      if (rise != 0) before = rise;
    }
    return count;
  };
  EXPECT_GE(turns(waves(0.05, {})), 4);
  const FairResult calm = waves(0.5, 0);
  EXPECT_EQ(turns(calm), 0);
  EXPECT_TRUE(calm.within_tolerance);
  const FairResult held = waves(0.05, 0);
  EXPECT_TRUE(held.within_tolerance);
  EXPECT_GE(turns(held), 3);
  bool told = false;
  for (const std::string& note : held.notes)
    told = told || note.find("waves wanted") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(FairOptions, InflectionForbidsAPositiveSlopeAndSaysSo) {
  const lac::Chain s{{{0, 0}, 0}, {{-1, 80, 0.02, -0.02}}, false};
  FairOptions options;
  options.interpretations = {{.piece = 0, .rhythm = {}, .slope = 0.7}};
  const FairResult result = fair(line_through(lac::sample(s, 120)), options).value();
  EXPECT_LT(only_chain(result).pieces[0].alpha, 0);
  bool told = false;
  for (const std::string& note : result.notes)
    told = told || note.find("inflection") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(FairOptions, CornersEndChainsThatMeet) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 60; ++i) points.push_back({i / 60.0, 0.05 * std::sin(i / 20.0)});
  const core::Point2 corner = points.back();
  for (int i = 1; i <= 60; ++i) points.push_back({corner.x - 0.004 * i, corner.y + i / 60.0});
  const FairResult result = fair(line_through(points)).value();
  ASSERT_EQ(result.curves.size(), 2U);
  const auto& first = std::get<lac::Chain>(result.curves[0]);
  const auto& second = std::get<lac::Chain>(result.curves[1]);
  EXPECT_LE(core::distance(lac::end_pose(first).position, second.start.position), 1e-9);
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_EQ(result.pieces.back().rhythm, analysis::Rhythm::straight);
}

TEST(FairOptions, CancelledWorkSaysSo) {
  FairOptions options;
  options.progress.cancellation = core::CancellationToken::make();
  options.progress.cancellation.request_stop();
  const auto result = fair(bow(), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, core::ErrorCode::cancelled);
}

/// Stopped at its n-th report, early, amid the knots, amid the pieces: nothing yet, or a chain that
/// is whole.
TEST(FairOptions, CancelledAtAnyStageKeepsTheBest) {
  const acquire::KeyLine line = line_through(testing::measure(testing::random_chain(5), 120, 0, 1));
  std::vector<double> reports;
  FairOptions watched;
  watched.progress.sink = [&](double fraction, std::string_view) { reports.push_back(fraction); };
  ASSERT_TRUE(fair(line, watched));
  ASSERT_GE(reports.size(), 10U);
  const std::size_t n = reports.size();
  int kept = 0;
  for (const std::size_t stop : {std::size_t{1}, n / 4, n / 2, 3 * n / 4, n - 1}) {
    FairOptions options;
    options.progress.cancellation = core::CancellationToken::make();
    std::size_t calls = 0;
    options.progress.sink = [&](double, std::string_view) {
      if (++calls >= stop) options.progress.cancellation.request_stop();
    };
    const auto result = fair(line, options);
    if (!result) {
      EXPECT_EQ(result.error().code, core::ErrorCode::cancelled) << stop;
      continue;
    }
    ++kept;
    EXPECT_TRUE(result->cancelled) << stop;
    EXPECT_TRUE(lac::validate(only_chain(*result))) << stop;
    for (const auto& joint : result->joints) EXPECT_LE(joint.relative_curvature_jump, 1e-9);
  }
  EXPECT_GE(kept, 2);
}

/// Line, arc, line, as drawn with a compass.
TEST(FairOptions, LinesAndArcsOfTheDataComeOut) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 40; ++i) points.push_back({0.05 * i, 0});
  for (int i = 1; i <= 60; ++i) {
    const double t = 3.141592653589793 * i / 60;
    points.push_back({2 + std::sin(t), 1 - std::cos(t)});
  }
  for (int i = 1; i <= 40; ++i) points.push_back({2 - 0.05 * i, 2});
  const FairResult result = fair(line_through(points)).value();
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_EQ(result.pieces.front().rhythm, analysis::Rhythm::straight);
  EXPECT_EQ(result.pieces.back().rhythm, analysis::Rhythm::straight);
  bool arc = false;
  for (const FairPiece& piece : result.pieces) arc = arc || piece.rhythm == analysis::Rhythm::arc;
  EXPECT_TRUE(arc);
  EXPECT_EQ(result.fairness.answer.waves, 1);
  EXPECT_TRUE(result.fairness.fair);
}

/// Half a bottle with noise: straight foot, wall, neck and lip come out exactly straight, between
/// them a shoulder of slope -1 (an S through its inflection).
TEST(FairOptions, StraightWallsOfABottleAreStraight) {
  const auto curves = exchange::read_points(KEYLINE_SOURCE_DIR "/examples/bottle.csv").value();
  const FairResult result = fair(acquire::acquire_key_line(curves.front()).value()).value();
  EXPECT_TRUE(result.within_tolerance);
  std::vector<double> straight;
  for (const FairPiece& piece : result.pieces) {
    if (piece.rhythm == analysis::Rhythm::straight) straight.push_back(piece.length);
  }
  for (const lac::Piece& piece : only_chain(result).pieces)
    EXPECT_TRUE(piece.curvature_start == piece.curvature_end || piece.alpha < 0) << piece.alpha;
  ASSERT_EQ(straight.size(), 4U);
  EXPECT_NEAR(straight[0], 36, 1);
  EXPECT_NEAR(straight[1], 110, 4);  // the bend grows out of the wall a little sooner
  EXPECT_NEAR(straight[2], 45, 2);
  EXPECT_LE(result.pieces.size(), 11U);
}

/// A bow that is no chain of such pieces: seven follow it nearly to the rounding of its points, as
/// they follow any smooth curve. Fewer within the tolerance are the answer.
TEST(FairOptions, NearnessThatAnyCurveGivesIsNotExactness) {
  for (const double height : {98.51113, 98.511178, 90.0, 103.0}) {
    std::vector<core::Point2> points;
    for (int i = 0; i < 59; ++i) {
      const double u = i / 58.0;
      const double z = height * std::sin(0.9 * core::kPi * u + 0.2) + 20 * u * u * u;
      points.push_back({std::round(1e6 * u) / 1e3, std::round(1e3 * z) / 1e3});
    }
    const FairResult result = fair(line_through(points)).value();
    EXPECT_TRUE(result.within_tolerance) << height;
    EXPECT_LE(result.pieces.size(), 7U) << height;
  }
}

/// Exactly an arc but for two places, moved by a thousandth of the tolerance: the chain that is
/// looked for with every fifth point alone reproduces those, not all.
TEST(FairOptions, PointsThatTheSearchLeavesOutAreReproducedToo) {
  for (const double moved : {0.0, 3e-6}) {
    acquire::KeyLine line;
    for (int i = 0; i <= 1000; ++i) {
      const double radius = i == 302 || i == 707 ? 1 + moved : 1;
      line.points.push_back({radius * std::cos(2e-3 * i), radius * std::sin(2e-3 * i)});
    }
    line.length = 2;
    FairOptions options;
    options.tolerance = 3e-3;
    options.symmetric.mode = SymmetricMode::off;
    const FairResult result = fair(line, options).value();
    EXPECT_TRUE(result.within_tolerance);
    const bool told = std::ranges::any_of(result.notes, [](const std::string& note) {
      return note.find("reproduced to rounding") != std::string::npos;
    });
    EXPECT_EQ(told, moved == 0) << moved;
  }
}

/// More points than the fit takes one by one: every single one passes all the same.
TEST(FairOptions, EachOfManyPointsPasses) {
  const acquire::KeyLine line =
      line_through(testing::measure(testing::random_chain(3), 2500, 1e-3, 4));
  const FairResult result = fair(line).value();
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_LE(result.max_deviation, result.tolerance);
}

}  // namespace
}  // namespace keyline::fairing
