#include "keyline/fairing/until_fair.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

/// Too few points for a spline to compare with: an answer is fair where it has no variation.
acquire::KeyLine three_points() {
  acquire::KeyLine line;
  line.points = {{0, 0}, {1, 0}, {2, 0}};
  line.length = 2;
  return line;
}

/// Answers whose variation a smoothness of `fair_from` ends, and what was asked for on the way.
struct Solver {
  double fair_from;
  double within_up_to = 1;
  std::vector<double> asked;
  core::Result<FairResult> operator()(const FairOptions& options, const FairResult* before) {
    EXPECT_EQ(before != nullptr, !asked.empty());
    asked.push_back(options.smoothness.value_or(-1));
    FairResult result;
    result.smoothness = asked.back();
    result.within_tolerance = asked.back() <= within_up_to;
    const double end = asked.back() >= fair_from ? 0.1 : 0.9 - 0.5 * asked.back();
    result.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 2, 0.1, end}}});
    return result;
  }
};

using Asked = std::vector<double>;

TEST(UntilFair, StopsAtTheFirstSmoothnessWhoseAnswerIsFair) {
  for (const auto& [from, asked] : {std::pair<double, Asked>{0.5, {0.5}},
                                    {0.5625, {0.5, 0.5625}},
                                    {0.7, {0.5, 0.5625, 0.625, 0.75}},
                                    {1, {0.5, 0.5625, 0.625, 0.75, 1}}}) {
    SCOPED_TRACE(from);
    Solver solver{from, 1, {}};
    const auto found = until_fair(three_points(), {}, std::ref(solver)).value();
    EXPECT_EQ(solver.asked, asked);
    EXPECT_TRUE(found.fairness.fair);
    EXPECT_EQ(found.smoothness, asked.back());
    EXPECT_EQ(found.notes.size(), from > 0.5 ? 1u : 0u);
  }
}

TEST(UntilFair, TakesTheSmoothnessAskedForFairOrNot) {
  Solver solver{1, 1, {}};
  FairOptions options;
  options.smoothness = 0.2;
  const auto found = until_fair(three_points(), options, std::ref(solver)).value();
  EXPECT_EQ(solver.asked, Asked{0.2});
  EXPECT_FALSE(found.fairness.fair);
  EXPECT_TRUE(found.notes.empty());
}

// Piece 2 of the answer that was shown is not that of an answer nearer to the points.
TEST(UntilFair, ReadsOtherwiseThePiecesOfTheAnswerWithoutThatWish) {
  Solver solver{0.625, 1, {}};
  std::vector<double> with_wish;
  FairOptions options;
  options.interpretations.emplace_back().piece = 2;
  const auto watched = [&](const FairOptions& asked, const FairResult* before) {
    if (!asked.interpretations.empty()) with_wish.push_back(asked.smoothness.value_or(-1));
    return solver(asked, before);
  };
  const auto found = until_fair(three_points(), options, watched).value();
  EXPECT_EQ(solver.asked, (Asked{0.5, 0.5625, 0.625, 0.625}));
  EXPECT_EQ(with_wish, Asked{0.625});
  EXPECT_EQ(found.smoothness, 0.625);
}

TEST(UntilFair, SolvesOnceWhereSmoothnessCountsForNothing) {
  FairOptions short_one;
  short_one.criterion = Criterion::fewest_pieces;
  FairOptions counted;
  counted.pieces = 3;
  for (const FairOptions& options : {short_one, counted}) {
    Solver solver{1, 1, {}};
    EXPECT_TRUE(until_fair(three_points(), options, std::ref(solver)));
    EXPECT_EQ(solver.asked.size(), 1u);
  }
}

/// A tolerance of less than the points' errors: every smoothness gives the same curve.
TEST(UntilFair, SolvesOnceWhereTheToleranceHoldsNoMoreThanNoise) {
  int solved = 0;
  Solver solver{2, 1, {}};
  const auto found =
      until_fair(three_points(), {}, [&](const FairOptions& options, const FairResult* before) {
        ++solved;
        auto result = solver(options, before);
        result->smoothness_counts = false;
        return result;
      });
  EXPECT_EQ(solved, 1);
  EXPECT_EQ(found->smoothness, 0.5);
}

/// Points that do not err leave all of the tolerance to the curve at any smoothness; an arc's are
/// reproduced.
TEST(UntilFair, SmoothnessCountsForNothingWithoutNoise) {
  acquire::KeyLine line;
  for (int i = 0; i < 40; ++i) line.points.push_back({std::sin(0.04 * i), std::cos(0.04 * i)});
  for (const double tolerance : {0.0, 0.01}) {
    FairOptions options;
    options.tolerance = tolerance;
    EXPECT_FALSE(fair(line, options).value().smoothness_counts) << tolerance;
  }
}

constexpr double kNoise = 1e-3;  // little beside the chains' length of 2

/// Answers farther off the smoother, the two smoothest by more than the noise's square root of two:
/// in units of the noise.
double rms_at(double smoothness) { return smoothness < 0.7 ? 1 + smoothness / 2 : 1.5; }

// Farther from the points than errors and a departure as large as theirs explain, only what is fair
// is worth it.
TEST(UntilFair, DepartsByMoreThanTheNoiseOnlyWhereThatIsFair) {
  for (const auto& [fair_from, taken] : {std::pair{2.0, 0.625}, {1.0, 1.0}}) {
    Solver solver{fair_from, 1, {}};
    const auto found =
        until_fair(three_points(), {}, [&](const FairOptions& options, const FairResult* before) {
          auto result = solver(options, before);
          result->noise = kNoise;
          result->tolerance = kNoise * noise_factor(3);
          result->rms_deviation = kNoise * rms_at(result->smoothness);
          return result;
        });
    EXPECT_EQ(found->smoothness, taken);
    EXPECT_EQ(found->fairness.fair, fair_from == 1);
  }
}

// Where the calmest chain does not come out near the points it is seen first whether it does at
// all.
TEST(UntilFair, LooksAtTheCalmestOnceWhereTheFirstIsMissed) {
  for (const auto& [missed_below, asked] :
       {std::pair<double, Asked>{0.55, {0.5, 1, 0.5625, 0.625, 0.75}}, {2, {0.5, 1}}}) {
    SCOPED_TRACE(missed_below);
    Solver solver{1, 1, {}};
    const auto found =
        until_fair(three_points(), {}, [&](const FairOptions& options, const FairResult* before) {
          auto result = solver(options, before);
          result->calm_missed = result->smoothness < missed_below;
          return result;
        });
    EXPECT_EQ(solver.asked, asked);
    EXPECT_EQ(found->fairness.fair, missed_below < 1);
    EXPECT_EQ(found->smoothness, missed_below < 1 ? 1 : 0.5);
  }
}

TEST(UntilFair, KeepsTheCalmestAndSaysSoWhereNoneIsFair) {
  Solver solver{2, 1, {}};
  const auto found = until_fair(three_points(), {}, std::ref(solver)).value();
  EXPECT_EQ(found.smoothness, 1);
  EXPECT_FALSE(found.fairness.fair);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("no answer"), std::string::npos);
}

TEST(UntilFair, DoesNotLeaveTheToleranceForIt) {
  Solver solver{1, 0.75, {}};
  const auto found = until_fair(three_points(), {}, std::ref(solver)).value();
  EXPECT_EQ(found.smoothness, 0.75);
  EXPECT_TRUE(found.within_tolerance);
}

/// A circle of radius 1 out of round by 0.002, neighbours alike, and said to be measured to 0.0004.
acquire::KeyLine rough_circle(int shape) {
  constexpr int n = 100;
  std::vector<double> errors;
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    double e = 0;
    for (int m = 2; m < 20; ++m)
      e += std::sin(2 * std::numbers::pi * m * i / n + shape * m * m) / std::sqrt(m);
    errors.push_back(e);
    largest = std::max(largest, std::abs(e));
  }
  acquire::KeyLine line;
  line.closed = true;
  line.noise = 0.0004;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    const double r = 1 + 0.002 * errors[i] / largest;
    line.points.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return line;
}

TEST(UntilFair, TakesWideStepsWherePointsDoNotTellTheirNoise) {
  Solver solver{0.7, 1, {}};
  acquire::KeyLine line = rough_circle(1);
  line.noise = 1e-5;  // they err by more
  const auto found = until_fair(line, {}, std::ref(solver)).value();
  EXPECT_EQ(solver.asked, (Asked{0.5, 0.75}));
  EXPECT_TRUE(found.fairness.fair);
}

// Where errors of neighbours are alike, as near as the noise is not fair; within the tolerance
// there is a fair answer.
TEST(UntilFair, RoughRoundThingsComeOutFair) {
  for (const int shape : {1, 2}) {
    SCOPED_TRACE(shape);
    const acquire::KeyLine line = rough_circle(shape);
    const FairResult found = fair(line).value();
    EXPECT_TRUE(found.fairness.fair);
    EXPECT_TRUE(found.within_tolerance);
    FairOptions near;
    near.smoothness = 0.5;
    const FairResult first = fair(line, near).value();
    EXPECT_FALSE(first.fairness.fair);
    EXPECT_GT(found.smoothness, 0.5);
    EXPECT_LT(found.fairness.answer.energy, 0.7 * first.fairness.answer.energy);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
