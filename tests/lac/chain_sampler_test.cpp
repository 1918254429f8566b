#include "keyline/lac/chain/chain_sampler.h"

#include <random>

#include <gtest/gtest.h>

#include "keyline/numeric/prepared_power_mean.h"

namespace keyline::lac {
namespace {

Chain random_chain(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Chain chain{{{between(-5, 5), between(-5, 5)}, between(-3, 3)}, {}, false};
  double curvature = between(-2, 2);
  for (int i = 0; i < 4; ++i) {
    const double next = between(-2, 2);
    const bool through_zero = curvature * next < 0;
    chain.pieces.push_back(
        {through_zero ? between(-2, -0.3) : between(-3, 3), between(0.1, 3), curvature, next});
    curvature = next;
  }
  return chain;
}

TEST(ChainSampler, AgreesWithTheCurveItself) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    const Chain chain = random_chain(random);
    const ChainSampler sampler(chain);
    const double whole = arc_length(chain);
    std::vector<double> at;
    for (int i = 0; i < 40; ++i)
      at.push_back(std::uniform_real_distribution<double>(-0.1, whole + 0.1)(random));
    std::vector<double> curvatures(at.size()), angles(at.size());
    std::vector<core::Point2> points(at.size());
    sampler.curvatures(at, curvatures);
    sampler.tangent_angles(at, angles);
    sampler.points(at, points);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double t = at[i] / whole;
      EXPECT_NEAR(curvatures[i], curvature(chain, t), 1e-11);
      EXPECT_NEAR(angles[i], tangent_angle(chain, t), 1e-12);
      EXPECT_LT(core::distance(points[i], evaluate(chain, t)), 1e-12);
    }
  }
}

TEST(ChainSampler, ThePreparedMeanIsTheMean) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double a = std::exp(between(-5, 5));
    const double b = i % 10 == 0 ? a : i % 11 == 0 ? 0 : std::exp(between(-5, 5));
    const double p = i % 7 == 0 ? 0 : between(-4, 4);
    const double u = i % 13 == 0 ? 0 : between(0, 1);
    EXPECT_EQ(numeric::PowerMean(a, b, p)(u), numeric::power_mean(a, b, p, u));
  }
}

}  // namespace
}  // namespace keyline::lac
