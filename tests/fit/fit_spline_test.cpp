#include "keyline/fit/fit_spline.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/similarity.h"
#include "keyline/numeric/random.h"

namespace keyline::fit {
namespace {

using core::Point2;
using numeric::Random;

SplineFitOptions small_budget() {
  SplineFitOptions options;
  options.population = 40;
  options.generations = 30;
  options.trials = 4;
  options.threads = 1;
  return options;
}

/// A bonnet-like line with noise.
std::vector<Point2> wavy(int count, double noise, std::uint64_t seed = 3) {
  Random random(seed);
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i) {
    const double s = 10.0 * i / (count - 1);
    points.push_back({s + 0.3 * std::sin(s) + noise * random.normal(),
                      1.5 * std::tanh(s - 3) + 0.4 * std::sin(1.3 * s) + noise * random.normal()});
  }
  return points;
}

std::vector<Point2> flower(int count) {
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * core::kPi * i / count;
    points.push_back({3 * std::cos(a) + 0.3 * std::cos(3 * a), 2 * std::sin(a)});
  }
  return points;
}

TEST(FitFunction, RecoversTheKnotsOfASpline) {
  const std::vector<double> truth = {0.2, 0.35, 0.35, 0.7};
  LeastSquaresSpline spline{
      4, {0, 0, 0, 0, 0.2, 0.35, 0.35, 0.7, 1, 1, 1, 1}, {{0, 2, -1, 3, 0, 1, 4, -2}}, 0};
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= 200; ++i) {
    x.push_back(i / 200.0);
    y.push_back(evaluate(spline, x.back()));
  }
  SplineFitOptions options = small_budget();
  options.resolution = 1e-6;
  options.generations = 20;
  options.trials = 2;
  const auto fit = fit_function(x, y, {}, options);
  ASSERT_TRUE(fit);
  EXPECT_THAT(fit->interior_knots, testing::Pointwise(testing::DoubleNear(1e-3), truth));
  EXPECT_LT(fit->deviation, 1e-5);
}

TEST(FitFunction, KinkTakesThreeKnotsAndJumpFour) {
  Random random(1);
  std::vector<double> x;
  std::vector<double> kink;
  std::vector<double> jump;
  for (int i = 0; i <= 150; ++i) {
    const double t = i / 150.0;
    const double noise = 1e-3 * random.normal();
    x.push_back(t);
    kink.push_back(std::abs(t - 0.503) + t * t + noise);
    jump.push_back((t < 0.503 ? t * t : 1 - t) + noise);
  }
  const auto near = [](const FunctionFit& fit) {
    return std::count_if(fit.interior_knots.begin(), fit.interior_knots.end(),
                         [](double t) { return std::abs(t - 0.503) < 0.01; });
  };
  const auto kinked = fit_function(x, kink, {}, small_budget());
  const auto jumped = fit_function(x, jump, {}, small_budget());
  ASSERT_TRUE(kinked && jumped);
  EXPECT_EQ(near(*kinked), 3);
  EXPECT_EQ(near(*jumped), 4);
  EXPECT_LT(kinked->rms, 1.2e-3);
  EXPECT_LT(jumped->rms, 1.2e-3);
}

TEST(FitFunction, UnsortedAndRepeatedAbscissae) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 60; ++i) {
    const int half = (i * 37) % 60 / 2;  // each value twice, out of order
    x.push_back(half);
    y.push_back(std::sin(x.back() / 5));
  }
  const auto fit = fit_function(x, y, {}, small_budget());
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->deviation, 1e-3);
}

TEST(FitSpline, SameBytesWhateverTheThreads) {
  const auto points = wavy(120, 0.003);
  for (const int trials : {1, 4}) {
    SplineFitOptions options = small_budget();
    options.generations = 8;
    options.polish_rounds = 2;
    options.trials = trials;
    const auto one = fit_spline(points, {}, options);
    ASSERT_TRUE(one);
    for (const int threads : {2, 3, 0}) {
      options.threads = threads;
      const auto other = fit_spline(points, {}, options);
      ASSERT_TRUE(other);
      EXPECT_EQ(one->curve, other->curve);
      EXPECT_EQ(one->bic, other->bic);
      EXPECT_EQ(one->report.evaluations, other->report.evaluations);
    }
  }
}

/// Trials at once: the one that starts first is not always the same. Few generations, so that where
/// a trial starts from is seen in what it ends with.
TEST(FitSpline, SameKnotsHoweverManyTrialsRunAtOnce) {
  SplineFitOptions options = SplineFitOptions::for_fairing();
  options.trials = 6;
  options.generations = 1;
  options.population = 8;
  std::vector<Point2> points;
  for (int i = 0; i <= 20; ++i) points.push_back({0.1 * i, 0.4 * 0.01 * i * i});
  options.threads = 1;
  const auto one = fit_spline(points, {}, options);
  ASSERT_TRUE(one);
  for (int again = 0; again < 10; ++again) {
    options.threads = 2 + again % 2;
    const auto more = fit_spline(points, {}, options);
    ASSERT_TRUE(more);
    EXPECT_EQ(one->curve.knots, more->curve.knots) << options.threads;
  }
}

TEST(FitSpline, SeedsDifferButAgreeOnQuality) {
  const auto points = wavy(120, 0.003);
  SplineFitOptions options = small_budget();
  const auto a = fit_spline(points, {}, options);
  options.seed = 2;
  const auto b = fit_spline(points, {}, options);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->bic, b->bic, 25);
}

TEST(FitSpline, MovedTurnedAndScaledDataGiveTheMovedCurve) {
  const auto points = wavy(120, 0.003);
  SplineFitOptions options = SplineFitOptions::for_fairing();
  const auto fit = fit_spline(points, {}, options);
  ASSERT_TRUE(fit);
  for (const core::Similarity2& map :
       {core::Similarity2{1, 0, {100, -50}}, core::Similarity2{1, 2.2, {0, 0}},
        core::Similarity2{1234.5, -0.7, {3, 4}}}) {
    std::vector<Point2> moved;
    for (const Point2& p : points) moved.push_back(apply(map, p));
    const auto other = fit_spline(moved, {}, options);
    ASSERT_TRUE(other);
    ASSERT_EQ(fit->interior_knots.size(), other->interior_knots.size());
    for (int i = 0; i <= 20; ++i) {
      const Point2 p = apply(map, evaluate(fit->curve, i / 20.0));
      EXPECT_LT(distance(p, evaluate(other->curve, i / 20.0)), 1e-7 * map.scale);
    }
  }
}

TEST(FitSpline, ReversedDataGiveTheReversedCurve) {
  auto points = wavy(120, 0.003);
  const SplineFitOptions options = SplineFitOptions::for_fairing();
  const auto fit = fit_spline(points, {}, options);
  std::reverse(points.begin(), points.end());
  const auto back = fit_spline(points, {}, options);
  ASSERT_TRUE(fit && back);
  ASSERT_EQ(fit->interior_knots.size(), back->interior_knots.size());
  for (int i = 0; i <= 20; ++i) {
    const Point2 p = evaluate(fit->curve, i / 20.0);
    EXPECT_LT(distance(p, evaluate(back->curve, 1 - i / 20.0)), 1e-7);
  }
}

TEST(FitSpline, PlainGaIsNoBetterThanPolished) {
  const auto points = wavy(80, 0.003);
  SplineFitOptions options = small_budget();
  const auto polished = fit_spline(points, {}, options);
  options.knots = KnotPlacement::ga;
  const auto plain = fit_spline(points, {}, options);
  ASSERT_TRUE(polished && plain);
  EXPECT_LE(polished->bic, plain->bic + 1e-6);
}

TEST(FitSpline, AllOrders) {
  for (int order = 4; order <= 6; ++order) {
    SplineFitOptions options = small_budget();
    options.order = order;
    const auto fit = fit_spline(wavy(100, 0.003), {}, options);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->curve.degree, order - 1);
    EXPECT_TRUE(curve::validate(fit->curve));
    EXPECT_LT(fit->rms, 0.0045);
  }
}

TEST(FitSpline, MustPassPointsArePassed) {
  auto points = wavy(100, 0.01);
  points[50].y += 0.05;
  SplineFitOptions options = SplineFitOptions::for_fairing();
  options.must_pass = {0, 50, 99};
  const auto fit = fit_spline(points, {}, options);
  ASSERT_TRUE(fit);
  for (const std::size_t i : options.must_pass) {
    EXPECT_LT(distance(evaluate(fit->curve, fit->parameters[i]), points[i]), 1e-5);
  }
  options.must_pass = {100};
  EXPECT_FALSE(fit_spline(points, {}, options));
}

TEST(FitSpline, NoiseDoesNotBringKnots) {
  // Far more points than the noise lets apart: their own polygon is a zigzag.
  const SplineFitOptions options = SplineFitOptions::for_fairing();
  const auto few = fit_spline(wavy(500, 0.002), {}, options);
  const auto many = fit_spline(wavy(20000, 0.002), {}, options);
  ASSERT_TRUE(few && many);
  EXPECT_LE(many->interior_knots.size(), 2 * few->interior_knots.size());
  EXPECT_NEAR(many->rms, 0.002, 0.0001);
  EXPECT_EQ(many->report.data_used, options.condense_above);
}

TEST(FitSpline, ExactDataDoNotInviteEndlessKnots) {
  const auto fit = fit_spline(wavy(1000, 0), {}, SplineFitOptions::for_fairing());
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->interior_knots.size(), 60);
  EXPECT_LT(fit->deviation, 1e-4);
  std::vector<Point2> line;
  for (int i = 0; i < 200; ++i) line.push_back({0.1 * i, 3 + 0.05 * i});
  const auto straight = fit_spline(line, {}, SplineFitOptions::for_fairing());
  ASSERT_TRUE(straight);
  EXPECT_TRUE(straight->interior_knots.empty());
}

TEST(FitSpline, ClosedCurvesCloseSmoothly) {
  SplineFitOptions options = SplineFitOptions::for_fairing();
  options.closed = true;
  for (const int count : {40, 300, 2000}) {
    const auto fit = fit_spline(flower(count), {}, options);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(curve::validate(fit->curve));
    EXPECT_LT(fit->deviation, count == 40 ? 2e-2 : 2e-3);  // 40 carry few knots
    const auto start = jet(fit->curve, 0.0);
    const auto end = jet(fit->curve, 1.0);
    EXPECT_LT(distance(start.point, end.point), 1e-10);
    EXPECT_LT(norm(start.first - end.first), 1e-8);
    EXPECT_LT(norm(start.second - end.second), 1e-5);
  }
}

/// Points too few for knots by the criterion still make a loop, and the criterion is a number.
TEST(FitSpline, FewPointsOfALoopMakeALoop) {
  SplineFitOptions options = SplineFitOptions::for_fairing();
  options.closed = true;
  std::vector<Point2> circle;
  for (int i = 0; i < 8; ++i) circle.push_back({std::cos(0.785398 * i), std::sin(0.785398 * i)});
  for (const int order : {4, 5, 6}) {
    options.order = order;
    const auto fit = fit_spline(circle, {}, options);
    ASSERT_TRUE(fit) << order;
    EXPECT_TRUE(std::isfinite(fit->bic)) << order;
    EXPECT_LT(fit->deviation, 0.3) << order;
    EXPECT_GT(distance(evaluate(fit->curve, 0.0), evaluate(fit->curve, 0.5)), 1.5) << order;
  }
  options.order = 7;
  const auto none = fit_spline(circle, {}, options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, core::ErrorCode::bad_input);
}

TEST(FitSpline, CancellationKeepsTheBestFound) {
  SplineFitOptions options;
  options.generations = 100000;
  options.trials = 2;
  options.threads = 2;
  options.progress.cancellation = core::CancellationToken::make();
  double last = 0;
  std::string text;
  int calls = 0;
  options.progress.sink = [&](double fraction, std::string_view doing) {
    EXPECT_GE(fraction, last);
    last = fraction;
    text = doing;
    if (++calls == 20) options.progress.cancellation.request_stop();
  };
  const auto fit = fit_spline(wavy(80, 0.003), {}, options);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->report.status, SplineFitStatus::cancelled);
  EXPECT_LT(fit->report.generations, 100);
  EXPECT_TRUE(curve::validate(fit->curve));
  EXPECT_THAT(text, testing::StartsWith("knots: best BIC -"));
}

TEST(FitSpline, BadInputIsRefused) {
  const SplineFitOptions options = SplineFitOptions::for_fairing();
  const auto refused = [&](const std::vector<Point2>& points) {
    const auto fit = fit_spline(points, {}, options);
    return !fit && fit.error().code == core::ErrorCode::bad_input && !fit.error().message.empty();
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({{0, 0}}));
  EXPECT_TRUE(refused({{0, 0}, {1, 0}, {2, 0}, {3, 1}}));
  EXPECT_TRUE(refused(std::vector<Point2>(20, Point2{3, 4})));
  auto points = wavy(20, 0);
  points[7].y = std::nan("");
  EXPECT_TRUE(refused(points));
  points[7].y = INFINITY;
  EXPECT_TRUE(refused(points));
  points[7].y = 1e308;
  points[8].y = -1e308;
  EXPECT_TRUE(refused(points));
  EXPECT_TRUE(refused({{0, 0}, {0, 0}, {0, 0}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}));
  EXPECT_FALSE(fit_spline(wavy(20, 0), std::vector<double>(19, 1.0), options));
  EXPECT_FALSE(fit_spline(wavy(20, 0), std::vector<double>(20, -1.0), options));
  SplineFitOptions wrong = options;
  wrong.order = 1;
  EXPECT_FALSE(fit_spline(wavy(20, 0), {}, wrong));
  wrong = options;
  wrong.population = 0;
  EXPECT_FALSE(fit_spline(wavy(20, 0), {}, wrong));
  const std::vector<double> same(10, 1.0);
  EXPECT_FALSE(fit_function(same, same, {}, options));
}

TEST(FitSpline, HugeAndTinyCoordinates) {
  const auto points = wavy(60, 0.003);
  for (const double scale : {1e-150, 1e-12, 1e12, 1e150}) {
    std::vector<Point2> scaled;
    for (const Point2& p : points) scaled.push_back({p.x * scale, p.y * scale});
    const auto fit = fit_spline(scaled, {}, SplineFitOptions::for_fairing());
    ASSERT_TRUE(fit) << scale;
    EXPECT_LT(fit->deviation, 0.02 * scale);
  }
  // Squares of residuals are 0, or no numbers: there is no criterion.
  const std::vector<double> x = {0, 1, 2, 3, 4, 5};
  for (const double scale : {1e-170, 1e170}) {
    std::vector<double> y = {0, 1, 3, 2, 1, 0};
    for (double& value : y) value *= scale;
    const auto none = fit_function(x, y, {}, SplineFitOptions::for_fairing());
    ASSERT_FALSE(none) << scale;
    EXPECT_EQ(none.error().code, core::ErrorCode::bad_input);
    EXPECT_TRUE(none.error().message.contains(scale < 1 ? "squares" : "too far apart"));
  }
}

}  // namespace
}  // namespace keyline::fit
