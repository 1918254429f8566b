#include "keyline/lac/segment/arm.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/segment/arm_table.h"

/// Arms against integrals worked out here, in steps fine enough for ten digits.
namespace keyline::lac::detail {
namespace {

using core::Vector2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(DecayIntegral, ClosedForms) {
  EXPECT_EQ(decay_integral(0, 3), 3);
  EXPECT_NEAR(decay_integral(2, 1), (1 - std::exp(-2)) / 2, 1e-15);
  EXPECT_NEAR(decay_integral(-2, 1), (std::exp(2) - 1) / 2, 1e-14);
  EXPECT_EQ(decay_integral(2, kInfinity), 0.5);
  EXPECT_EQ(decay_integral(0, kInfinity), kInfinity);
  EXPECT_EQ(decay_integral(-1, kInfinity), kInfinity);
  EXPECT_NEAR(decay_integral(1e-12, 1), 1, 1e-11);
}

// The heavy end is that of larger curvature for slopes below 0, of smaller for others.
TEST(Arms, BeginAtTheirHeavyEnd) {
  const auto arm = [](double alpha, double k0, double k1) {
    const Arms arms = arms_of({alpha, 2, k0, k1});
    EXPECT_EQ(arms.count, 1);
    return arms.arm[0];
  };
  EXPECT_FALSE(arm(-0.5, 3, 1).backward);
  EXPECT_TRUE(arm(-0.5, 1, 3).backward);
  EXPECT_TRUE(arm(0.5, 3, 1).backward);
  EXPECT_FALSE(arm(0.5, 1, 3).backward);
  EXPECT_FALSE(arm(-0.5, 1, 1).backward);
  EXPECT_NEAR(arm(-0.5, 3, 1).range, std::log(3), 1e-15);
  EXPECT_EQ(arm(-0.5, 3, 1).a, 0.5);
  EXPECT_EQ(arm(-0.5, 3, 1).b, 1.5);
  EXPECT_EQ(arm(0.5, 3, 1).b, -0.5);
  EXPECT_EQ(arm(2, 3, 1).b, 1);
  EXPECT_EQ(arm(-0.5, 3, 0).range, kInfinity);
  EXPECT_EQ(arm(-0.5, 3, 1).length, 2);
}

// Turning is the integral of curvature, counted from the heavy end: backward with the other sign.
TEST(Arms, TurnAsThePieceDoes) {
  for (const double alpha : {-2.0, -0.4, 0.0, 0.6, 1.0, 2.5})
    for (const auto& [k0, k1] : {std::pair{1.0, 3.0}, {3.0, 1.0}, {-2.0, -0.5}}) {
      const Piece piece{alpha, 1.3, k0, k1};
      const Arm arm = arms_of(piece).arm[0];
      EXPECT_NEAR(arm.turning, (arm.backward ? -1 : 1) * total_turning(piece), 1e-13)
          << alpha << ' ' << k0;
    }
}

TEST(Arms, AreTwoAboutAnInflection) {
  const Arms arms = arms_of({-1, 3, -1, 2});
  ASSERT_EQ(arms.count, 2);
  EXPECT_NEAR(arms.arm[0].to, 1 / 3.0, 1e-15);
  EXPECT_NEAR(arms.arm[1].from, 1 / 3.0, 1e-15);
  EXPECT_NEAR(arms.arm[0].length, 1, 1e-15);
  EXPECT_NEAR(arms.arm[1].length, 2, 1e-15);
  EXPECT_NEAR(arms.arm[0].turning, -0.5, 1e-15);
  EXPECT_NEAR(arms.arm[1].turning, -2, 1e-15);  // seen from its end
  EXPECT_FALSE(arms.arm[0].backward);
  EXPECT_TRUE(arms.arm[1].backward);
}

// lambda is where the share of the arc is the one asked for.
TEST(Arm, LambdaInvertsTheArc) {
  for (const double alpha : {-3.0, -1.0, -0.2, 0.0, 0.3, 2.0})
    for (const double ratio : {1.5, 40.0}) {
      const Arm arm = arms_of({alpha, 1, ratio, 1}).arm[0];
      for (const double f : {1e-9, 0.1, 0.5, 0.9, 1 - 1e-9})
        EXPECT_NEAR(arm.arc_fraction(arm.lambda_at(f, 1 - f)), f, 1e-13) << alpha << ' ' << ratio;
      EXPECT_EQ(arm.lambda_at(0, 1), 0);
      EXPECT_EQ(arm.lambda_at(1, 0), arm.range);
    }
  const Arm endless = arms_of({-0.5, 1, 2, 0}).arm[0];
  EXPECT_NEAR(endless.lambda_at(0.75, 0.25), -std::log(0.25) / 0.5, 1e-14);
  EXPECT_NEAR(endless.lambda_at(1, 1e-30), -std::log(1e-30) / 0.5, 1e-12);
  EXPECT_NEAR(endless.lambda_at(1e-20, 1), 1e-20 / 0.5, 1e-33);
}

/// Integral of the tangent over lambda by Simpson's rule.
Vector2 simpson(const Arm& arm, double lambda) {
  constexpr int kSteps = 20000;
  Vector2 sum;
  const auto total = [](double k, double x) { return k == 0 ? x : (1 - std::exp(-k * x)) / k; };
  for (int i = 0; i <= kSteps; ++i) {
    const double x = lambda * i / kSteps;
    const double w = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps) * lambda;
    const double angle = arm.turning * total(arm.b, x) / total(arm.b, arm.range);
    const double f = w * std::exp(-arm.a * x) / total(arm.a, arm.range);
    sum = sum + f * Vector2{std::cos(angle), std::sin(angle)};
  }
  return sum;
}

TEST(Arm, VectorIsTheIntegralOfItsTangent) {
  for (const double alpha : {-2.5, -1.0, -0.3, 0.0, 0.5, 1.0, 1.7, 4.0})
    for (const double turning : {0.3, 4.0, 11.0}) {
      const Piece unit{alpha, 1, 3, 0.7};
      const Arm arm = arms_of({alpha, turning / total_turning(unit), 3, 0.7}).arm[0];
      const ArmTable table(arm);
      for (const double share : {0.2, 0.65, 1.0}) {
        const double lambda = share * arm.range;
        const Vector2 meant = simpson(arm, lambda);
        const Vector2 found = arm_vector(arm, lambda);
        EXPECT_NEAR(found.x, meant.x, 1e-11) << alpha << ' ' << turning;
        EXPECT_NEAR(found.y, meant.y, 1e-11) << alpha << ' ' << turning;
        const double f = arm.arc_fraction(lambda);
        const Vector2 tabled = table.vector_at(f, 1 - f);
        EXPECT_NEAR(tabled.x, meant.x, 1e-11) << alpha << ' ' << turning;
        EXPECT_NEAR(tabled.y, meant.y, 1e-11) << alpha << ' ' << turning;
        EXPECT_NEAR(arm_angle_at(arm, f, 1 - f), arm.turning * arm.angle_fraction(lambda), 1e-12);
      }
      EXPECT_NEAR(core::norm(table.end() - simpson(arm, arm.range)), 0, 1e-11);
    }
}

// The same by the series about an inflection, and by panels that never end.
TEST(Arm, WithAnInflectionIsBothWaysTheSame) {
  for (const double alpha : {-2.5, -1.0, -0.4}) {
    const Arm arm = arms_of({alpha, 1.2, 2.5, 0}).arm[0];
    ASSERT_LT(std::abs(arm.turning), kLargestSeriesTurning);
    const ArmTable table(arm);
    for (const double f : {0.1, 0.5, 0.99, 1.0}) {
      const Vector2 series = arm_vector_at(arm, f, 1 - f);
      const Vector2 panels = arm_vector(arm, arm.lambda_at(f, 1 - f));
      EXPECT_NEAR(series.x, panels.x, 1e-14) << alpha << ' ' << f;
      EXPECT_NEAR(series.y, panels.y, 1e-14) << alpha << ' ' << f;
      const Vector2 tabled = table.vector_at(f, 1 - f);
      EXPECT_NEAR(tabled.x, panels.x, 1e-14) << alpha << ' ' << f;
      EXPECT_NEAR(tabled.y, panels.y, 1e-14) << alpha << ' ' << f;
    }
  }
}

// Tangent angle turned * x^m: chord and its change by the angle, by Simpson's rule and differences.
TEST(InflectionArm, IsTheIntegralOfItsPower) {
  for (const double m : {1.2, 2.0, 3.5})
    for (const double turned : {-3.5, -0.5, 0.1, 2.0}) {
      const auto integral = [&](double by) {
        constexpr int kSteps = 4000;
        Vector2 sum;
        for (int i = 0; i <= kSteps; ++i) {
          const double u = double(i) / kSteps, x = u * u * u * u;  // smooth at 0
          const double w = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps);
          const double angle = (turned + by) * std::pow(x, m);
          sum = sum + w * 4 * u * u * u * Vector2{std::cos(angle), std::sin(angle)};
        }
        return sum;
      };
      const InflectionArm arm = inflection_arm(turned, m);
      EXPECT_NEAR(core::norm(arm.chord - integral(0)), 0, 1e-10);
      const Vector2 by = (integral(1e-5) - integral(-1e-5)) / 2e-5;
      EXPECT_NEAR(core::norm(arm.by_turned - by), 0, 1e-9);
    }
}

// Arcs and lines in closed form.
TEST(Arm, OfOneCurvatureIsAnArc) {
  const Arm arc = arms_of({0.5, 2, 1.5, 1.5}).arm[0];
  EXPECT_EQ(arc.range, 0);
  for (const double f : {0.3, 1.0}) {
    const Vector2 v = arm_vector_at(arc, f, 1 - f);
    const double angle = 3 * f;
    EXPECT_NEAR(v.x, std::sin(angle) / 3, 1e-15);
    EXPECT_NEAR(v.y, (1 - std::cos(angle)) / 3, 1e-15);
    EXPECT_NEAR(arm_angle_at(arc, f, 1 - f), angle, 1e-15);
    const Vector2 tabled = ArmTable(arc).vector_at(f, 1 - f);
    EXPECT_NEAR(core::norm(tabled - v), 0, 1e-15);
  }
  const Arm line = arms_of({-1, 2, 0, 0}).arm[0];
  EXPECT_EQ(arm_vector_at(line, 0.25, 0.75), (Vector2{0.25, 0}));
}

// Panels follow one another to the end, none turns by more than is allowed.
TEST(PanelWalk, CoversItsRange) {
  for (const double alpha : {-3.0, -0.5, 0.3, 2.0})
    for (const double turning : {1.0, 12.0}) {
      const Piece unit{alpha, 1, 30, 0.5};
      const Arm arm = arms_of({alpha, turning / total_turning(unit), 30, 0.5}).arm[0];
      PanelWalk walk(arm, arm.range, 2, 1.5);
      Panel panel;
      double at = 0;
      int count = 0;
      while (walk.next(panel)) {
        EXPECT_EQ(panel.from, at);
        EXPECT_GT(panel.to, panel.from);
        at = panel.to;
        ++count;
        if (panel.straight) continue;
        const double turn =
            arm.turning * (arm.angle_fraction(panel.to) - arm.angle_fraction(panel.from));
        EXPECT_LE(std::abs(turn), 1.5 + 1e-9);
        EXPECT_LE((panel.to - panel.from) * std::max(arm.a, std::abs(arm.b)), 2 + 1e-9);
      }
      EXPECT_EQ(at, arm.range);
      EXPECT_GE(count, std::abs(turning) / 1.5);
      EXPECT_LE(count, 60);
    }
}

// Moments of a panel: the integrals of e^{-a x} times the tangent, and of the angle times that.
TEST(PanelMoments, AreTheirIntegrals) {
  for (const double alpha : {-1.5, -0.2, 0.4, 3.0}) {
    const Arm arm = arms_of({alpha, 1, 3, 0.7}).arm[0];
    const Panel panel{0.2 * arm.range, 0.7 * arm.range, false};
    constexpr int kSteps = 4000;
    Vector2 zeroth, first;
    for (int i = 0; i <= kSteps; ++i) {
      const double x = panel.from + (panel.to - panel.from) * i / kSteps;
      const double w = (i == 0 || i == kSteps ? 1
                        : i % 2               ? 4
                                              : 2) /
                       (3.0 * kSteps) * (panel.to - panel.from);
      const double angle = arm.turning * arm.angle_fraction(x);
      const Vector2 f = w * std::exp(-arm.a * x) * Vector2{std::cos(angle), std::sin(angle)};
      zeroth = zeroth + f;
      first = first + angle * f;
    }
    const PanelMoments m = panel_moments(arm, panel);
    EXPECT_NEAR(core::norm(m.zeroth - zeroth), 0, 1e-12) << alpha;
    EXPECT_NEAR(core::norm(m.first - first), 0, 1e-12) << alpha;
  }
}

}  // namespace
}  // namespace keyline::lac::detail
