#include "keyline/lac/hermite/hermite.h"

#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/region.h"

#include "reference_table.h"
#include "tests/shared_data.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;

HandleAngles angles_of(double theta, double psi) { return {theta, psi, 1, -psi}; }

TEST(SolveG1, ReproducesTheReferenceTable) {
  const auto rows = read_reference("g1.csv");
  KEYLINE_NEEDS_SHARED_DATA(!rows.empty(), "reference tables");
  int drawn = 0;
  double worst = 0;
  for (const ReferenceRow& row : rows) {
    const auto value = [&](const char* name) { return std::stod(row.at(name)); };
    SCOPED_TRACE("alpha " + row.at("alpha") + " theta " + row.at("theta_d") + " psi " +
                 row.at("psi"));
    const double theta = value("theta_d");
    const auto solution = solve_g1(angles_of(theta, value("psi")), value("alpha"));
    if (row.at("lambda") == "none") {
      ASSERT_FALSE(solution);
      EXPECT_EQ(solution.error().code, ErrorCode::undrawable);
      continue;
    }
    ASSERT_TRUE(solution) << solution.error().message;
    ++drawn;
    const Segment& s = solution->segment;
    const auto near = [&](double got, const char* name) {
      const double error = std::abs(got - value(name)) / std::abs(value(name));
      worst = std::max(worst, error);
      EXPECT_LT(error, 1e-10) << name << ' ' << got << ' ' << row.at(name);
    };
    near(solution->lambda, "lambda");
    near(s.length, "arc_over_chord");
    near(s.curvature_start, "k0_chord");
    near(s.curvature_end, "k1_chord");
    const Point2 middle = evaluate(s, fraction_at_turning(piece_of(s), 0.5));
    near(middle.x, "mid_x");
    near(middle.y, "mid_y");
  }
  EXPECT_GT(drawn, 0);
  EXPECT_LT(worst, 2e-11);
}

/// Largest of the end's distance from where it should be (over the chord) and of its direction's.
double residual(const SegmentSolution& solution, Point2 p2, double direction) {
  const core::Pose2 end = end_pose(solution.segment);
  const double chord = distance(solution.segment.start.position, p2);
  return std::max(distance(end.position, p2) / chord,
                  std::abs(core::wrap_angle(end.direction - direction)));
}

double residual(const SegmentSolution& s) { return residual(s, {1, 0}, s.turning - s.chord_angle); }

TEST(SolveG1, MeetsRandomDrawableRequests) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  int most = 0;
  for (int n = 0; n < 20000; ++n) {
    const double alpha = -10 + 20 * unit(random);
    const double theta = std::exp(std::log(1e-6) + unit(random) * std::log(3e6));
    const core::Interval region = drawable_region(alpha, theta);
    const double psi = core::at(region, 0.001 + 0.998 * unit(random));
    const auto solution = solve_g1(angles_of(theta, psi), alpha);
    ASSERT_TRUE(solution) << alpha << ' ' << theta << ' ' << psi << solution.error().message;
    const double r = residual(*solution);
    EXPECT_LE(r, 1e-12) << alpha << ' ' << theta << ' ' << psi / theta;
    worst = std::max(worst, r);
    most = std::max(most, solution->iterations);
  }
  EXPECT_LE(most, 12);
  EXPECT_LE(worst, 5e-14);
}

TEST(SolveG1, BatchAgreesWithSingleSolves) {
  std::mt19937 random(13);
  std::normal_distribution<double> place(0, 1);
  std::vector<G1Problem> problems(2003);
  for (std::size_t n = 0; n < problems.size(); ++n) {
    G1Problem& p = problems[n];
    p = {{place(random), place(random)}, {}, {place(random), place(random)}, 4 * place(random)};
    p.p1 = mix(p.p0, p.p2, 0.5) + 0.3 * core::Vector2{place(random), place(random)};
    if (n % 50 == 0) p.p1 = p.p0;
    if (n % 51 == 0) p.alpha = n % 2 == 0 ? 0 : 1;
    if (n % 97 == 0) p.p2 = p.p0;
    if (n % 101 == 0) p.alpha = NAN;
  }
  std::vector<G1Outcome> outcomes(problems.size());
  solve_g1(problems, outcomes);
  int drawn = 0;
  for (std::size_t n = 0; n < problems.size(); ++n) {
    const G1Problem& p = problems[n];
    const auto single = solve_g1(p.p0, p.p1, p.p2, p.alpha);
    ASSERT_EQ(outcomes[n].drawn, single.has_value()) << n;
    if (!single) continue;
    ++drawn;
    const Segment& s = outcomes[n].segment;
    EXPECT_EQ(outcomes[n].reversed, single->reversed);
    EXPECT_NEAR(s.length / single->segment.length, 1, 1e-13);
    EXPECT_NEAR(distance(evaluate(s, 1), p.p2), 0, 1e-13 * distance(p.p0, p.p2)) << p.alpha;
    EXPECT_NEAR(total_turning(s), single->turning, 1e-13);
    EXPECT_NEAR(outcomes[n].lambda, single->lambda, 1e-9 * (1e-3 + single->lambda));
  }
  EXPECT_GT(drawn, 1000);
  std::vector<G1Outcome> few(1);
  EXPECT_THROW(solve_g1(problems, few), core::InvalidInput);
}

TEST(SolveG1, HoldsAtLimitingSlopesAndAtTheBorderOfTheRegion) {
  int beyond = 0;
  for (const double alpha : {-1e3, -10.0, -1.0, -0.3, -1e-13, 0.0, 1e-13, 0.3, 0.5, 1 - 1e-13, 1.0,
                             1 + 1e-13, 1.5, 2.0, 1e3}) {
    for (const double theta : {1e-6, 1e-3, 0.5, 2.0, 3.0}) {
      const core::Interval region = drawable_region(alpha, theta);
      for (const double share :
           {1e-12, 1e-9, 1e-6, 1e-3, 0.3, 0.5, 0.7, 1 - 1e-3, 1 - 1e-6, 1 - 1e-9, 1 - 1e-12}) {
        SCOPED_TRACE(testing::Message() << alpha << ' ' << theta << ' ' << share);
        const auto solution = solve_g1(angles_of(theta, core::at(region, share)), alpha);
        if (!solution) {
          // Only where the curvature ratio leaves the doubles: slopes close to 0 and 1.
          EXPECT_EQ(solution.error().code, ErrorCode::undrawable);
          EXPECT_LT(std::min(std::abs(alpha), std::abs(alpha - 1)), 0.06);
          EXPECT_LT(std::min(share, 1 - share), 2e-3);
          ++beyond;
          continue;
        }
        EXPECT_LE(residual(*solution), 1e-12);
        EXPECT_LE(solution->iterations, 40);
      }
    }
  }
  EXPECT_GT(beyond, 0);
}

TEST(SolveG1, AnswersOutsideTheRegionWithTheNearestThatCanBeDrawn) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 200; ++n) {
    const double alpha = n % 2 == 0 ? -0.1 - 9 * unit(random) : 1.1 + 9 * unit(random);
    const double theta = 0.01 + 2.9 * unit(random);
    const core::Interval region = drawable_region(alpha, theta);
    const double psi = n % 3 == 0
                           ? region.low * 0.95 * unit(random)
                           : region.high + (theta - region.high) * (0.05 + 0.9 * unit(random));
    const auto solution = solve_g1(angles_of(theta, psi), alpha);
    ASSERT_FALSE(solution) << alpha << ' ' << theta << ' ' << psi;
    EXPECT_EQ(solution.error().code, ErrorCode::undrawable);
    EXPECT_FALSE(solution.error().hint.empty());
    const NearestDrawable nearest = nearest_drawable(alpha, theta, psi);
    EXPECT_TRUE(solve_g1(angles_of(theta, nearest.chord_angle), alpha));
    EXPECT_TRUE(solve_g1(angles_of(theta, psi), nearest.alpha))
        << nearest.alpha << ' ' << psi / theta;
    // Half a percent further out it cannot be drawn.
    const double further = nearest.alpha + 0.005 * (alpha - nearest.alpha);
    if (std::abs(nearest.alpha - 0.5) > 0.6) {
      EXPECT_FALSE(solve_g1(angles_of(theta, psi), further));
    }
  }
}

TEST(SolveG1, MovesTurnsScalesAndMirrorsWithItsHandles) {
  const Point2 p[3] = {{0, 0}, {0.6, -0.4}, {1.3, 0.2}};
  for (const double alpha : {-2.0, -1.0, 0.0, 0.5, 1.0, 3.0}) {
    const auto unit = solve_g1(p[0], p[1], p[2], alpha);
    ASSERT_TRUE(unit) << alpha;
    for (const double scale : {1e-150, 1e-3, 1e150}) {
      const core::Similarity2 map{scale, 2.3, {0.7 * scale, -scale}};
      const auto moved = solve_g1(apply(map, p[0]), apply(map, p[1]), apply(map, p[2]), alpha);
      ASSERT_TRUE(moved);
      EXPECT_NEAR(moved->segment.length / scale, unit->segment.length, 1e-14);
      EXPECT_NEAR(moved->segment.curvature_start * scale, unit->segment.curvature_start, 1e-12);
      EXPECT_NEAR(moved->segment.curvature_end * scale, unit->segment.curvature_end, 1e-12);
      EXPECT_LE(distance(evaluate(moved->segment, 1), apply(map, p[2])), 1e-14 * scale);
    }
    const auto mirror = [](Point2 q) { return Point2{q.x, -q.y}; };
    const auto mirrored_curve = solve_g1(mirror(p[0]), mirror(p[1]), mirror(p[2]), alpha);
    ASSERT_TRUE(mirrored_curve);
    EXPECT_EQ(mirrored_curve->segment.curvature_start, -unit->segment.curvature_start);
    EXPECT_EQ(mirrored_curve->reversed, unit->reversed);
    const auto back = solve_g1(p[2], p[1], p[0], alpha);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->segment.curvature_start, -unit->segment.curvature_end, 1e-13);
    EXPECT_NE(back->reversed, unit->reversed);
    EXPECT_NEAR(back->lambda, unit->lambda, 1e-13);
    EXPECT_LE(residual(*back, p[0], core::direction_of(p[0] - p[1])), 1e-14);
  }
}

// The circle's involute, slope 2, from its cusp on: its handles stand on the region's border, to
// rounding of their coordinates.
TEST(SolveG1, DrawsInvolutesFromTheirCusp) {
  for (int i = 1; i <= 1000; ++i) {
    const double t = 1 + 2e-3 * i, c = std::cos(t), s = std::sin(t), size = std::exp(0.01 * i);
    const Point2 end{c + t * s - 1, s - t * c};
    const core::Vector2 x = size * core::unit_vector(i), y = core::perpendicular_left(x);
    const Point2 handle = Point2{} + (end.x - end.y * c / s) * x;
    const Point2 last = Point2{} + end.x * x + end.y * y;
    SCOPED_TRACE(i);
    const auto forth = solve_g1({}, handle, last, 2), back = solve_g1(last, handle, {}, 2);
    ASSERT_TRUE(forth && back);
    EXPECT_NEAR(forth->segment.length / (size * t * t / 2), 1, 1e-13);
    EXPECT_NEAR(forth->segment.curvature_end * size * t, 1, 1e-13);
    EXPECT_NEAR(back->segment.length / forth->segment.length, 1, 1e-13);
  }
}

TEST(SolveG1, RadiusGrowsUnlessReversed) {
  const auto growing = solve_g1({0, 0}, {0.4, 0.3}, {1, 0.25}, -1);
  ASSERT_TRUE(growing);
  EXPECT_FALSE(growing->reversed);
  EXPECT_LT(std::abs(growing->segment.curvature_end), std::abs(growing->segment.curvature_start));
}

TEST(SolveG1, BadInputIsNormalInput) {
  const double nan = std::nan("");
  const auto code = [](Point2 a, Point2 b, Point2 c, double alpha) {
    const auto solution = solve_g1(a, b, c, alpha);
    return solution ? std::optional<ErrorCode>() : solution.error().code;
  };
  EXPECT_EQ(code({0, 0}, {1, 1}, {2, 0}, nan), ErrorCode::bad_input);
  EXPECT_EQ(code({0, 0}, {1, 1}, {2, 0}, INFINITY), ErrorCode::bad_input);
  EXPECT_EQ(code({0, nan}, {1, 1}, {2, 0}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({0, 0}, {1, 1}, {0, 0}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({1, 1}, {1, 1}, {1, 1}, 1), ErrorCode::bad_input);
  EXPECT_EQ(code({0, 0}, {3, 0}, {1, 0}, 1), ErrorCode::undrawable);  // turns back on itself
  EXPECT_EQ(code({0, 0}, {-1, 0}, {1, 0}, 1), ErrorCode::undrawable);
  for (const Point2 middle : {Point2{0, 0}, Point2{2, 0}, Point2{0.7, 0}}) {
    const auto line = solve_g1({0, 0}, middle, {2, 0}, 1);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->segment, (Segment{{{0, 0}, 0}, 1, 2, 0, 0}));
  }
  const auto circle = solve_g1({0, 0}, {1, 1}, {2, 0}, 0.3);
  ASSERT_TRUE(circle);
  EXPECT_EQ(circle->segment.curvature_start, circle->segment.curvature_end);
}

// Turned round, a curve has its other chord angle: the nearest answers are the same ones.
TEST(NearestDrawable, IsDrawableAndTheSameFromEitherEnd) {
  for (const double alpha : {-3.0, -1.0, -0.3, 1.4, 2.0, 5.0})
    for (const double theta : {0.4, 1.5, 2.8}) {
      const core::Interval region = drawable_region(alpha, theta);
      for (const double share : {0.01, 0.3, 0.9}) {
        const double psi = region.high + share * (theta - region.high);
        if (!(psi > region.high)) continue;
        const NearestDrawable n = nearest_drawable(alpha, theta, psi);
        const NearestDrawable other = nearest_drawable(alpha, theta, theta - psi);
        EXPECT_NEAR(other.alpha, n.alpha, 1e-8 * (1 + std::abs(alpha)));
        EXPECT_NEAR(other.chord_angle, theta - n.chord_angle, 1e-12);
        EXPECT_FALSE(solve_g1(angles_of(theta, psi), alpha));
        EXPECT_TRUE(solve_g1(angles_of(theta, n.chord_angle), alpha));
        // The slope's region holds the angle, that of one a little nearer to the wanted does not.
        EXPECT_LT(psi, drawable_region(n.alpha, theta).high + 1e-12);
        const double nearer = n.alpha + 1e-3 * (alpha - n.alpha);
        EXPECT_TRUE(n.alpha == 0 || n.alpha == 1 || psi > drawable_region(nearer, theta).high)
            << alpha << " " << theta << " " << psi << " " << n.alpha;
      }
      // Inside its region a slope is its own nearest.
      EXPECT_EQ(nearest_drawable(alpha, theta, 0.5 * theta).alpha, alpha);
    }
}

TEST(DrawableRegion, ClosedForms) {
  for (const double theta : {0.1, 1.0, 2.5}) {
    for (const double alpha : {0.0, 0.5, 1.0}) {
      EXPECT_EQ(drawable_region(alpha, theta).high, theta);
      EXPECT_EQ(drawable_region(alpha, theta).low, 0);
    }
    // Involute from its cusp: chord of (e^{i theta} (1 - i theta) - 1).
    const double x = std::cos(theta) + theta * std::sin(theta) - 1;
    const double y = std::sin(theta) - theta * std::cos(theta);
    EXPECT_NEAR(drawable_region(2, theta).high, std::atan2(y, x), 3e-15);
  }
  // Small angles: psi*/theta -> |1-alpha| / |1 - 2 alpha| (alpha < 0), alpha / (2 alpha - 1).
  EXPECT_NEAR(drawable_region(-1, 1e-5).high / 1e-5, 2.0 / 3, 1e-9);
  EXPECT_NEAR(drawable_region(-3, 1e-5).high / 1e-5, 4.0 / 7, 1e-9);
  EXPECT_NEAR(drawable_region(4, 1e-5).high / 1e-5, 4.0 / 7, 1e-9);
  EXPECT_THROW(drawable_region(NAN, 1), core::InvalidInput);
  EXPECT_THROW(drawable_region(1, 4), core::InvalidInput);
}

// The bounds an error names are where drawing starts and stops: on both sides of each the solver is
// asked itself.
TEST(SolveG1, TheRegionAnErrorNamesIsTheOneThatCanBeDrawn) {
  for (const double alpha : {-1.0, -0.3, 2.0, 5.0})
    for (const double theta : {0.7, 1.9}) {
      SCOPED_TRACE(std::to_string(alpha) + ' ' + std::to_string(theta));
      const auto refused = solve_g1(HandleAngles{theta, 0.999 * theta}, alpha);
      ASSERT_FALSE(refused);
      const std::string& text = refused.error().message;
      double low = 0;
      double high = 0;
      ASSERT_EQ(
          std::sscanf(text.c_str() + text.find("between"), "between %lf and %lf", &low, &high), 2);
      EXPECT_NEAR(low + high, theta, 1e-8);
      const double little = 1e-3 * theta;
      EXPECT_TRUE(solve_g1(HandleAngles{theta, low + little}, alpha));
      EXPECT_TRUE(solve_g1(HandleAngles{theta, high - little}, alpha));
      EXPECT_FALSE(solve_g1(HandleAngles{theta, low - little}, alpha));
      EXPECT_FALSE(solve_g1(HandleAngles{theta, high + little}, alpha));
    }
}

}  // namespace
}  // namespace keyline::lac
