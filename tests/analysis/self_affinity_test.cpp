#include "keyline/analysis/self_affinity.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/analysis/profile.h"
#include "keyline/lac/segment/segment.h"

namespace keyline::analysis {
namespace {

template <class F>
CurvatureProfile profile_of(double length, F curvature) {
  CurvatureProfile p;
  constexpr int kSamples = 1001;
  for (int i = 0; i < kSamples; ++i) {
    const double u = static_cast<double>(i) / (kSamples - 1);
    p.arc_length.push_back(length * u);
    p.curvature.push_back(curvature(u));
  }
  return complete(p).value();
}

/// The rest of a curve whose radius to the power alpha is 1 + c u corresponds to its parent with
/// the length divided by 1 + c/2 and the radius by its root of order alpha.
TEST(SelfAffinity, LogAestheticCurvesCorrespondToTheirParents) {
  for (const double alpha : {-2.0, -1.0, -0.5, 0.5, 1.0, 2.0}) {
    SCOPED_TRACE(alpha);
    const double c = std::pow(3.0, alpha) - 1;
    const auto affine =
        self_affinity(profile_of(5, [&](double u) { return std::pow(1 + c * u, -1 / alpha); }));
    ASSERT_TRUE(affine);
    EXPECT_LT(affine->deviation, 1e-6);  // the profile is linear between its 1001 samples
    EXPECT_NEAR(affine->length_scale, 1 / (1 + c / 2), 1e-4);
    EXPECT_NEAR(affine->radius_scale, std::pow(1 + c / 2, -1 / alpha), 1e-4);
  }
}

TEST(SelfAffinity, OtherCurvesDoNot) {
  const auto curvature = [](double u) { return 2 + std::cos(std::numbers::pi * u); };
  const auto affine = self_affinity(profile_of(1, curvature));
  ASSERT_TRUE(affine);
  // scipy's bounded minimiser on the formula itself, 101 points
  EXPECT_NEAR(affine->deviation, 0.0792712, 1e-5);
  EXPECT_NEAR(affine->length_scale, 1.3284276, 1e-4);
  EXPECT_NEAR(affine->radius_scale, 0.5629188, 1e-4);
}

TEST(SelfAffinity, SizeSideAndDirectionChangeNothing) {
  const auto curvature = [](double u) { return 2 + std::cos(std::numbers::pi * u); };
  const auto affine = self_affinity(profile_of(1, curvature));
  const auto other =
      self_affinity(profile_of(250, [&](double u) { return -curvature(1 - u) / 250; }));
  ASSERT_TRUE(affine && other);
  EXPECT_NEAR(other->deviation, affine->deviation, 1e-9);
}

TEST(SelfAffinity, ACurveUpToItsInflectionIsReadWithoutIt) {
  const auto affine = self_affinity(profile_of(1, [](double u) { return 1 - u; }));
  ASSERT_TRUE(affine);
  EXPECT_LT(affine->deviation, 1e-3);  // log radius runs to infinity between the last two samples
}

TEST(SelfAffinity, ArcsAndLinesHaveNone) {
  EXPECT_FALSE(self_affinity(profile_of(1, [](double) { return 2.0; })));
  EXPECT_FALSE(self_affinity(profile_of(1, [](double) { return 0.0; })));
}

}  // namespace
}  // namespace keyline::analysis
