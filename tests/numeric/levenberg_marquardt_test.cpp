#include "keyline/numeric/levenberg_marquardt.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

bool rosenbrock(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
  r.resize(2);
  r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
  if (j) {
    j->resize(2, 2);
    *j << -20 * x[0], 10, -1, 0;
  }
  return true;
}

TEST(LevenbergMarquardt, RosenbrockFromTheUsualStart) {
  Eigen::VectorXd x(2);
  x << -1.2, 1;
  const auto report = minimize_least_squares(rosenbrock, x);
  EXPECT_EQ(report.status, LevenbergMarquardtStatus::converged);
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
}

TEST(LevenbergMarquardt, StaysInTheDomain) {
  // min (sqrt(x) - 0.01)^2, defined for x >= 0 only.
  const auto f = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    if (x[0] <= 0) return false;
    r.resize(1);
    r << std::sqrt(x[0]) - 0.01;
    if (j) {
      j->resize(1, 1);
      *j << 0.5 / std::sqrt(x[0]);
    }
    return true;
  };
  Eigen::VectorXd x(1);
  x << 4;
  EXPECT_EQ(minimize_least_squares(f, x).status, LevenbergMarquardtStatus::converged);
  EXPECT_NEAR(x[0], 1e-4, 1e-9);
}

/// (x - 2)^2 + (x + y - 1)^2 is least at (2, -1); with x at most 1 at (1, 0), with y from 0.5 on
/// too at (1, 0.5).
TEST(LevenbergMarquardt, StaysWithinBoundsAndMovesAlongThem) {
  const auto f = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r.resize(2);
    r << x[0] - 2, x[0] + x[1] - 1;
    if (j) {
      j->resize(2, 2);
      *j << 1, 0, 1, 1;
    }
    return x[0] <= 1 && r.allFinite();  // never asked beyond
  };
  LevenbergMarquardtOptions options;
  options.low = Eigen::Vector2d(-5, -HUGE_VAL);
  options.high = Eigen::Vector2d(1, HUGE_VAL);
  Eigen::VectorXd x = Eigen::Vector2d(-3, 4);
  EXPECT_EQ(minimize_least_squares(f, x, options).status, LevenbergMarquardtStatus::converged);
  EXPECT_EQ(x[0], 1);
  EXPECT_NEAR(x[1], 0, 1e-9);
  options.low[1] = 0.5;
  x = Eigen::Vector2d(7, 4);  // brought within
  minimize_least_squares(f, x, options);
  EXPECT_EQ(x[0], 1);
  EXPECT_EQ(x[1], 0.5);
}

/// An unknown leaves a bound it started at where that is what makes the cost fall.
TEST(LevenbergMarquardt, LeavesABound) {
  LevenbergMarquardtOptions options;
  options.low = Eigen::Vector2d(-1.2, -0.2);
  options.high = Eigen::Vector2d(3, 3);
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, -0.2);
  minimize_least_squares(rosenbrock, x, options);
  EXPECT_NEAR(x[0], 1, 1e-9);
  EXPECT_NEAR(x[1], 1, 1e-9);
}

// r = (x + y, (x - y - 200) / 1000): a valley along x + y = 0 down to x = 100, far beyond x <= 1.
// The first step, cut off there, leaves y at -100 and climbs out of the valley.
TEST(LevenbergMarquardt, TakesNoStepThatABoundMakesWorse) {
  const auto function = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r = Eigen::Vector2d(x[0] + x[1], (x[0] - x[1] - 200) / 1000);
    if (j) *j = (Eigen::Matrix2d() << 1, 1, 1e-3, -1e-3).finished();
    return true;
  };
  LevenbergMarquardtOptions options;
  options.low = Eigen::Vector2d(-HUGE_VAL, -HUGE_VAL);
  options.high = Eigen::Vector2d(1, HUGE_VAL);
  Eigen::VectorXd x = Eigen::Vector2d(0.9, -0.9);
  const LevenbergMarquardtReport report = minimize_least_squares(function, x, options);
  EXPECT_EQ(report.status, LevenbergMarquardtStatus::converged);
  EXPECT_EQ(x[0], 1);
  EXPECT_NEAR(x[1], -(1 + 199e-6) / (1 + 1e-6), 1e-9);  // the derivative by y is 0
  EXPECT_NEAR(report.cost, 0.5 * 199 * 199 * 1e-6, 0.01);
}

TEST(LevenbergMarquardt, RefusedStartIsReported) {
  const auto never = [](const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) {
    return false;
  };
  Eigen::VectorXd x(1);
  x << 3;
  EXPECT_EQ(minimize_least_squares(never, x).status, LevenbergMarquardtStatus::no_start);
  EXPECT_EQ(x[0], 3);
}

/// The line r = (slope x, level), whose least is at 0.
auto line(double slope, double level) {
  return [=](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r.resize(2);
    r << slope * x[0], level;
    if (j) {
      j->resize(2, 1);
      *j << slope, 0;
    }
    return true;
  };
}

/// Scaled columns: one step leaves damping / (1 + damping) of the way, whatever the slope.
TEST(LevenbergMarquardt, OneStepIsAsLongAsTheDampingSays) {
  for (const double slope : {1.0, 5.0, 0.01}) {
    Eigen::VectorXd x(1);
    x << 3;
    LevenbergMarquardtOptions options;
    options.max_iterations = 1;
    options.initial_damping = 0.25;
    const auto report = minimize_least_squares(line(slope, 0), x, options);
    EXPECT_EQ(report.status, LevenbergMarquardtStatus::iteration_limit);
    EXPECT_EQ(report.iterations, 1);
    EXPECT_NEAR(x[0], 0.6, 1e-15);
    EXPECT_NEAR(report.cost, 0.36 * slope * slope / 2, 1e-14 * slope * slope);
  }
}

/// The second step's damping is a third of the first's: a line keeps to what was foreseen.
TEST(LevenbergMarquardt, DampingFallsWhereStepsAreForeseen) {
  Eigen::VectorXd x(1);
  x << 1;
  LevenbergMarquardtOptions options;
  options.max_iterations = 2;
  options.initial_damping = 0.3;
  minimize_least_squares(line(1, 0), x, options);
  EXPECT_NEAR(x[0], (0.3 / 1.3) * (0.1 / 1.1), 1e-15);
}

// x^2 from 1 with damping 1/4: s = -1 / (1 + 1/4) of the scaled column, to x = 1 + s / 2 = 0.6. The
// cost falls by (1 - 0.6^4) / 2 where (1 - damping s) (-s) / 2 = 0.48 were foreseen; the damping
// falls by 1 - (2 gain - 1)^3 ([Nielsen 1999]).
TEST(LevenbergMarquardt, DampingFollowsTheGain) {
  const ResidualFunction square = [](const Eigen::VectorXd& x, Eigen::VectorXd& r,
                                     Eigen::MatrixXd* j) {
    r.resize(1);
    r[0] = x[0] * x[0];
    if (j) {
      j->resize(1, 1);
      (*j)(0, 0) = 2 * x[0];
    }
    return true;
  };
  Eigen::VectorXd x(1);
  x << 1;
  LevenbergMarquardtOptions options;
  options.max_iterations = 2;
  options.initial_damping = 0.25;
  minimize_least_squares(square, x, options);
  const double gain = (1 - std::pow(0.6, 4)) / 2 / 0.48;
  const double damping = 0.25 * (1 - std::pow(2 * gain - 1, 3));
  EXPECT_NEAR(x[0], 0.6 - 0.3 / (1 + damping), 1e-14);
}

// The first step of the same takes 1 - 0.6^4 = 87 % of the cost away.
TEST(LevenbergMarquardt, EndsWhereAStepGainsTooLittle) {
  const ResidualFunction square = [](const Eigen::VectorXd& x, Eigen::VectorXd& r,
                                     Eigen::MatrixXd* j) {
    r = x.cwiseAbs2();
    if (j) *j = 2 * x;
    return true;
  };
  for (const auto& [tolerance, steps] : {std::pair{0.875, 1}, {0.865, 2}}) {
    Eigen::VectorXd x(1);
    x << 1;
    LevenbergMarquardtOptions options;
    options.max_iterations = 2;
    options.initial_damping = 0.25;
    options.cost_tolerance = tolerance;
    const auto report = minimize_least_squares(square, x, options);
    EXPECT_EQ(report.iterations, steps);
  }
}

/// The cosine between residual and column at x is x / sqrt(x^2 + 1): at 0.1 it is 0.0995.
TEST(LevenbergMarquardt, FlatStartsAreLeftAlone) {
  Eigen::VectorXd x(1);
  LevenbergMarquardtOptions options;
  for (const bool flat : {true, false}) {
    x << 0.1;
    options.gradient_tolerance = flat ? 0.1 : 0.099;
    const auto report = minimize_least_squares(line(4, 4), x, options);
    EXPECT_EQ(report.status, LevenbergMarquardtStatus::converged);
    EXPECT_EQ(report.iterations == 0, flat);
    EXPECT_EQ(x[0] == 0.1, flat);
    EXPECT_GE(report.cost, 8);
  }
}

TEST(LevenbergMarquardt, RankDeficientProblemsEnd) {
  const auto f = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r.resize(2);
    r << x[0] + x[1] - 2, 0.5;
    if (j) {
      j->resize(2, 2);
      *j << 1, 1, 0, 0;
    }
    return true;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  const auto report = minimize_least_squares(f, x);
  EXPECT_NEAR(report.cost, 0.125, 1e-12);
  EXPECT_NEAR(x[0] + x[1], 2, 1e-6);
}

}  // namespace
}  // namespace keyline::numeric
