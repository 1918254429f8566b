#include "keyline/numeric/levenberg_marquardt.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(LevenbergMarquardt, RosenbrockFromTheUsualStart) {
  const auto f = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r.resize(2);
    r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
    if (j) {
      j->resize(2, 2);
      *j << -20 * x[0], 10, -1, 0;
    }
    return true;
  };
  Eigen::VectorXd x(2);
  x << -1.2, 1;
  const auto report = minimize_least_squares(f, x);
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

TEST(LevenbergMarquardt, RefusedStartIsReported) {
  const auto never = [](const Eigen::VectorXd&, Eigen::VectorXd&, Eigen::MatrixXd*) {
    return false;
  };
  Eigen::VectorXd x(1);
  x << 3;
  EXPECT_EQ(minimize_least_squares(never, x).status, LevenbergMarquardtStatus::no_start);
  EXPECT_EQ(x[0], 3);
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
