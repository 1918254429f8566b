#include "keyline/fairing/free_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

constexpr int kSteps = 200;
constexpr double kError = 0.003;

/// Points 0.01 apart along the x axis, whose first one errs inwards, and a line from that one on.
struct Line {
  Run run;
  RunResult result;
  RunOptions options;
  Line() {
    const double length = 0.01 * kSteps - kError;
    for (int i = 0; i <= kSteps; ++i) {
      run.points.push_back({i == 0 ? kError : 0.01 * i, i % 2 == 0 ? 1e-4 : -1e-4});
      result.points.push_back({.position = run.points.back()});
      result.point_of.push_back(static_cast<std::size_t>(i));
      result.fit.feet.push_back({0, (run.points.back().x - kError) / length});
    }
    result.chain = {{{kError, 0}, 0}, {{-1, length, 0, 0}}, false};
    result.accept = {.tolerance = 4 * kError, .noise = kError};
    options.noise = kError;
    options.tolerance = 4 * kError;
  }
};

// A line of least squares through n even values takes 2 (2n - 1) / (n (n + 1)) of an error of the
// first over to its own first value.
TEST(FreeEnds, StandWhereTwoDozenPointsSay) {
  Line line;
  place_free_ends(line.result, line.run, line.options);
  EXPECT_NEAR(line.result.chain.start.position.x, kError * 2 * 47 / (24 * 25.0), 1e-12);
  EXPECT_NEAR(lac::end_pose(line.result.chain).position.x, 2, 1e-12);
}

TEST(FreeEnds, StayWhereTheyAreHeld) {
  Line line;
  line.run.clamp_start = Clamp::g1;
  place_free_ends(line.result, line.run, line.options);
  EXPECT_EQ(line.result.chain.start.position.x, kError);
}

/// Points along the x axis at these places, a straight chain from `start` to the last of them but
/// for `end`, in pieces of these lengths and one more.
struct Placed : Line {
  Placed(const std::vector<double>& x, double start, double end = 0,
         const std::vector<double>& pieces = {}) {
    run.points.clear();
    result.points.clear();
    result.point_of.clear();
    result.fit.feet.clear();
    const double length = x.back() - end - start;
    result.chain = {{{start, 0}, 0}, {}, false};
    double left = length;
    for (const double l : pieces) {
      result.chain.pieces.push_back({-1, l, 0, 0});
      left -= l;
    }
    result.chain.pieces.push_back({-1, left, 0, 0});
    for (std::size_t i = 0; i < x.size(); ++i) {
      run.points.push_back({x[i], 0});
      result.points.push_back({.position = run.points.back()});
      result.point_of.push_back(i);
      double s = std::clamp(x[i] - start, 0.0, length);
      std::size_t p = 0;
      for (; p + 1 < result.chain.pieces.size() && s > result.chain.pieces[p].length; ++p)
        s -= result.chain.pieces[p].length;
      result.fit.feet.push_back({static_cast<int>(p), s / result.chain.pieces[p].length});
    }
    options.tolerance = 0.02;
  }
  double placed_start() {
    place_free_ends(result, run, options);
    return result.chain.start.position.x;
  }
  double placed_end() {
    place_free_ends(result, run, options);
    return lac::end_pose(result.chain).position.x;
  }
};

std::vector<double> even(int n = kSteps + 1) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(0.01 * i);
  return x;
}

constexpr double kFirst = 2 * 47 / (24 * 25.0);  // of an error of the first of 24, see above

TEST(FreeEnds, AreAlikeAtEitherEnd) {
  for (const double e : {kError, -kError}) {
    std::vector<double> x = even();
    x.front() = e;
    EXPECT_NEAR(Placed(x, e).placed_start(), e * kFirst, 1e-12);
    x = even();
    x.back() -= e;
    EXPECT_NEAR(Placed(x, 0).placed_end(), 2 - e * kFirst, 1e-12);
    EXPECT_NEAR(Placed(x, 0).placed_start(), 0, 1e-12);
  }
}

// Over several short pieces as along one.
TEST(FreeEnds, GoAcrossPieces) {
  std::vector<double> x = even();
  x.front() = kError;
  Placed first(x, kError, 0, {0.03, 0.05, 0.1});
  EXPECT_NEAR(first.placed_start(), kError * kFirst, 1e-12);
  EXPECT_EQ(first.result.chain.pieces.size(), 4U);
  EXPECT_NEAR(first.result.chain.pieces[0].length, 0.03 + kError * (1 - kFirst), 1e-12);
  x = even();
  x.back() -= kError;
  Placed last(x, 0, 0, {1.85, 0.04, 0.08});
  EXPECT_NEAR(last.placed_end(), 2 - kError * kFirst, 1e-12);
  EXPECT_NEAR(last.result.chain.pieces[1].length, 0.04, 1e-15);
}

// A last point that lies beyond the chain's end draws it out, as far as it stays within the
// tolerance itself.
TEST(FreeEnds, TheLastPointKeepsTheTolerance) {
  for (const bool last : {false, true}) {
    std::vector<double> x = even();
    (last ? x.back() : x.front()) += last ? kError : -kError;
    const auto end = [&](double tolerance) {
      Placed line(x, 0, last ? kError : 0);
      line.options.tolerance = tolerance;
      return last ? 2 - line.placed_end() : line.placed_start();
    };
    EXPECT_NEAR(end(2 * kError), -kError * kFirst, 1e-12) << last;
    EXPECT_NEAR(end(1.01 * kError * (1 - kFirst)), -kError * kFirst, 1e-12) << last;
    EXPECT_NEAR(end(0.99 * kError * (1 - kFirst)), 0, 1e-12) << last;
  }
}

// Two dozen points that all say it: by twice the noise at most.
TEST(FreeEnds, MoveByTwiceTheNoiseAtMost) {
  Placed late(even(), 0.02);
  late.options.tolerance = 0.03;
  EXPECT_NEAR(late.placed_start(), 0.02 - 2 * kError, 1e-12);
  EXPECT_NEAR(Placed(even(), 0.5 * kError).placed_start(), 0, 1e-12);
  std::vector<double> x = even();
  for (std::size_t i = 1; i < x.size(); ++i) x[i] += 0.02;  // the first is far too early
  Placed line(x, 0);
  line.options.noise = 0.02;  // which so much noise explains
  EXPECT_NEAR(line.placed_start(), 0.02 * (1 - kFirst), 1e-12);
}

// Half of the end's piece at most.
TEST(FreeEnds, LeaveHalfOfTheirPiece) {
  std::vector<double> x = even();
  x.front() = -kError;
  const double move = kError * (1 - kFirst);
  EXPECT_NEAR(Placed(x, -kError, 0, {2.05 * move}).placed_start(), -kError * kFirst, 1e-12);
  EXPECT_EQ(Placed(x, -kError, 0, {1.95 * move}).placed_start(), -kError);
  x.front() = kError;
  EXPECT_NEAR(Placed(x, kError, 0, {2.05 * move}).placed_start(), kError * kFirst, 1e-12);
  EXPECT_EQ(Placed(x, kError, 0, {1.95 * move}).placed_start(), kError);
}

// An eighth of the points, a dozen at least.
TEST(FreeEnds, FewPointsTellNothing) {
  std::vector<double> x = even(96);
  x.front() = kError;
  EXPECT_NEAR(Placed(x, kError).placed_start(), kError * 2 * 23 / (12 * 13.0), 1e-12);
  x = even(95);
  x.front() = kError;
  EXPECT_EQ(Placed(x, kError).placed_start(), kError);
}

// With b i^2 beside their even steps places are a parabola's. Of 24 values 0, 1, … a parabola of
// least squares takes 0.31885 of an error of the first over, a line that and -84.33 b. Of an error
// e in the first the bend is (b / e + 0.0019231) 1162.8 of its standard errors: that of Legendre's
// polynomial i^2 - 23 i + 84.33, whose square is 43853.
TEST(FreeEnds, AParabolaWherePointsSpeedUp) {
  const auto found = [](double share) {
    std::vector<double> x;
    for (int i = 0; i <= kSteps; ++i) x.push_back(0.01 * i + share * kError * i * i);
    x.front() = kError;
    return Placed(x, kError).placed_start() / kError;
  };
  EXPECT_NEAR(found(0.0001), kFirst - 84.3333 * 0.0001, 1e-5);  // 2.35 of its errors
  EXPECT_NEAR(found(0.0004), 0.318846, 1e-5);                   // 2.70
  EXPECT_NEAR(found(0.05), 0.318846, 1e-5);
  EXPECT_NEAR(found(-0.0035), kFirst + 84.3333 * 0.0035, 1e-5);  // -1.83
  EXPECT_NEAR(found(-0.0043), 0.318846, 1e-5);                   // -2.76
}

// Every other point off by s along the line: their spread about it is nearly s, and 1.4 of the
// noise is the most that is still even.
TEST(FreeEnds, UnevenPointsTellNothing) {
  std::vector<double> x = even();
  constexpr double s = 0.002;
  for (std::size_t i = 1; i < x.size(); ++i) x[i] += i % 2 == 0 ? s : -s;
  double sum = 0, first = 0, xx = 0, xy = 0;  // regression of the 24 by hand
  for (int i = 0; i < 24; ++i) {
    const double u = i - 11.5, y = x[static_cast<std::size_t>(i)];
    sum += y / 24;
    xx += u * u;
    xy += u * y;
  }
  double square = 0;
  for (int i = 0; i < 24; ++i)
    square += std::pow(x[static_cast<std::size_t>(i)] - sum - (i - 11.5) * xy / xx, 2);
  const double spread = std::sqrt(square / 22);
  first = sum - 11.5 * xy / xx;
  Placed line(x, 0);
  line.options.noise = 1.01 * spread / 1.4;
  EXPECT_NEAR(line.placed_start(), first, 1e-12);
  Placed uneven(x, 0);
  uneven.options.noise = 0.99 * spread / 1.4;
  EXPECT_NEAR(uneven.placed_start(), 0, 1e-12);
}

// Shortened or lengthened a clothoid stays the clothoid that it is.
TEST(FreeEnds, StayOnTheirCurve) {
  const lac::Piece whole{-1, 2.1, 0.2, 0.5};
  const lac::Chain full{{{0, 0}, 0.1}, {whole}, false};
  for (const double e : {kError, -kError}) {
    Placed line(even(), 0);
    line.run.tie_end = core::Point2{};
    line.result.chain = lac::part(full, (0.05 - e) / 2.1, 1);
    for (std::size_t i = 0; i < line.run.points.size(); ++i) {
      const double s = i == 0 ? 0.05 - e : 0.05 + 0.01 * static_cast<double>(i);
      line.run.points[i] = lac::evaluate(full, s / 2.1);
      line.result.fit.feet[i].fraction = (s - 0.05 + e) / (2.05 + e);
    }
    place_free_ends(line.result, line.run, line.options);
    const double start = (0.05 - e * kFirst) / 2.1;
    const lac::Chain& chain = line.result.chain;
    EXPECT_NEAR(core::distance(chain.start.position, lac::evaluate(full, start)), 0, 1e-9) << e;
    EXPECT_NEAR(chain.pieces[0].curvature_start, lac::curvature(whole, start), 1e-9) << e;
    EXPECT_NEAR(core::distance(lac::end_pose(chain).position, lac::end_pose(full).position), 0,
                1e-12);
  }
}

TEST(FreeEnds, StayWhereNothingIsToBeGained) {
  std::vector<double> x = even();
  x.front() = kError;
  x.back() -= kError;
  const auto stays = [&](auto change) {
    Placed line(x, kError);
    change(line);
    place_free_ends(line.result, line.run, line.options);
    const double at_end = lac::end_pose(line.result.chain).position.x;
    return std::pair{std::abs(line.result.chain.start.position.x - kError) < 1e-9,
                     std::abs(at_end - 2 + kError) < 1e-9};
  };
  const std::pair none{false, false}, both{true, true}, start{true, false}, end{false, true};
  EXPECT_EQ(stays([](auto&) {}), none);
  EXPECT_EQ(stays([](auto& l) { l.run.closed = true; }), both);
  EXPECT_EQ(stays([](auto& l) { l.run.inside.resize(1); }), both);
  EXPECT_EQ(stays([](auto& l) { l.result.exact = true; }), both);
  EXPECT_EQ(stays([](auto& l) { l.result.accept.tolerance = 7 * kError; }), both);  // not noisy
  EXPECT_EQ(stays([](auto& l) { l.run.clamp_start = Clamp::g0; }), start);
  EXPECT_EQ(stays([](auto& l) { l.run.clamp_end = Clamp::g0; }), end);
  EXPECT_EQ(stays([](auto& l) { l.run.must_pass = {0, 90}; }), start);
  EXPECT_EQ(stays([](auto& l) { l.run.must_pass = {kSteps}; }), end);
  EXPECT_EQ(stays([](auto& l) { l.run.must_pass = {1, 90, kSteps - 1}; }), none);
  EXPECT_EQ(stays([](auto& l) { l.run.tie_start = core::Point2{}; }), start);
  EXPECT_EQ(stays([](auto& l) { l.run.tie_end = core::Point2{}; }), end);
  EXPECT_EQ(stays([](auto& l) { l.run.start_on_axis = HalfEnd::corner; }), start);
  EXPECT_EQ(stays([](auto& l) { l.run.end_on_axis = HalfEnd::square; }), end);
}

}  // namespace
}  // namespace keyline::fairing::detail
