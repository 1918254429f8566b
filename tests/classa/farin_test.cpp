#include "keyline/classa/farin.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/classa/control_matrix.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

using curve::MonotoneVerdict;

/// Found by a random search over matrices that meet every condition of Farin's with room to spare;
/// curvature falls, rises by a twentieth of its largest value, and falls again: what Cao and Wang
/// (2008) said can happen.
const SpaceMatrixCurve kCounterexample{
    {}, {-0.99, 0.09, 0.09}, {{{1.04, -0.7, -2.8}, {0.99, 4.89, -1.15}, {2.73, -0.04, 3.44}}}, 3};

TEST(Farin, ConditionsDoNotImplyMonotoneCurvature) {
  const FarinConditions farin = farin_conditions(kCounterexample);
  EXPECT_TRUE(farin.segment);
  EXPECT_TRUE(farin.expands);
  EXPECT_TRUE(farin.singular_values);
  EXPECT_GT(farin.sigma[2] * farin.sigma[2], farin.sigma[0] + 0.5);
  const curve::Bezier3 c = to_bezier(kCounterexample);
  const MonotoneVerdict verdict = certify_monotone_curvature(c);
  EXPECT_EQ(verdict.answer, MonotoneVerdict::no);
  // By sampling, with nothing in common with the certificate.
  double rise = 0;
  double lowest = curvature(c, 0.0);
  for (int i = 1; i <= 1000; ++i) {
    lowest = std::min(lowest, curvature(c, i / 1000.0));
    rise = std::max(rise, curvature(c, i / 1000.0) - lowest);
  }
  EXPECT_GT(rise, 0.05);
}

TEST(Farin, AChangeWithinTheToleranceIsLeftUndecided) {
  const curve::Bezier3 c = to_bezier(kCounterexample);
  const MonotoneVerdict no = certify_monotone_curvature(c);
  EXPECT_EQ(no.direction, -1);
  EXPECT_GT(curvature(c, no.witness + 1e-4), curvature(c, no.witness - 1e-4));
  for (const double share : {0.5, 1 - 1e-9, 1.0, 1 + 1e-9, 2.0}) {
    const MonotoneVerdict verdict = certify_monotone_curvature(c, share * no.backward);
    EXPECT_EQ(verdict.answer, share < 1 ? MonotoneVerdict::no : MonotoneVerdict::undecided);
    EXPECT_EQ(verdict.direction, no.direction);
    EXPECT_EQ(verdict.witness, no.witness);
    EXPECT_EQ(verdict.backward, no.backward);
  }
  const MonotoneVerdict back = certify_monotone_curvature(reverse(c));
  EXPECT_EQ(back.answer, MonotoneVerdict::no);
  EXPECT_EQ(back.direction, 1);
  EXPECT_NEAR(back.backward, no.backward, 1e-9);
}

// By how much curvature runs back is told in shares of itself: a curve of any size is judged alike.
TEST(Farin, HasNoSizeOfItsOwn) {
  const curve::Bezier3 c = to_bezier(kCounterexample);
  const MonotoneVerdict plain = certify_monotone_curvature(c);
  for (const double size : {1e-9, 1e9}) {
    curve::Bezier3 scaled = c;
    for (auto& p : scaled.control) p = {size * p.x, size * p.y, size * p.z};
    const MonotoneVerdict verdict = certify_monotone_curvature(scaled);
    EXPECT_EQ(verdict.answer, plain.answer) << size;
    EXPECT_NEAR(verdict.backward, plain.backward, 1e-9) << size;
  }
}

// What is certified turns where curvature does, found by looking at curvature alone.
TEST(Farin, TurnsWhereCurvatureDoes) {
  numeric::Random random(7);
  int tried = 0;
  for (int n = 0; n < 60; ++n) {
    curve::Bezier3 c;
    for (int k = 0; k <= 3 + n % 3; ++k)
      c.control.push_back(
          {k + random.uniform(-0.3, 0.3), random.uniform(-1, 1), random.uniform(-1, 1)});
    // Each largest or least curvature inside: between two places, to a billionth.
    constexpr int kPlaces = 200;
    for (int i = 2; i + 2 < kPlaces; ++i) {
      const auto at = [&](int j) { return curvature(c, static_cast<double>(j) / kPlaces); };
      const double sign = at(i) > at(i - 1) ? 1 : -1;
      if (!(sign * (at(i) - at(i - 2)) > 0 && sign * (at(i) - at(i + 2)) > 0 &&
            sign * (at(i) - at(i + 1)) > 0))
        continue;
      double low = (i - 1.0) / kPlaces, high = (i + 1.0) / kPlaces;
      for (int k = 0; k < 40; ++k) {
        const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
        (sign * curvature(c, a) > sign * curvature(c, b) ? high : low) =
            sign * curvature(c, a) > sign * curvature(c, b) ? b : a;
      }
      const double turn = 0.5 * (low + high);
      const auto answer = [&](double from, double to) {
        return certify_monotone_curvature(subcurve(c, from, to)).answer;
      };
      constexpr double kNear = 1e-3, kFar = 3e-3;
      EXPECT_EQ(answer(turn - kFar, turn - kNear), MonotoneVerdict::yes) << n << " " << turn;
      EXPECT_EQ(answer(turn + kNear, turn + kFar), MonotoneVerdict::yes) << n << " " << turn;
      EXPECT_EQ(answer(turn - kNear, turn + kNear), MonotoneVerdict::no) << n << " " << turn;
      ++tried;
    }
  }
  EXPECT_GT(tried, 40);
}

/// A planar matrix in space is judged as in the plane.
TEST(Farin, AgreesWithThePlanarCertificate) {
  numeric::Random random(4);
  for (int i = 0; i < 100; ++i) {
    const ControlMatrix m{random.uniform(0.05, 1), random.uniform(0.8, 2)};
    if (std::abs(m.s * std::cos(m.alpha) - 1) < 1e-3) continue;
    const double c = m.s * std::cos(m.alpha);
    const double s = m.s * std::sin(m.alpha);
    const SpaceMatrixCurve turned{{1, 2, 3}, {0, 1, 0}, {{{1, 0, 0}, {0, c, -s}, {0, s, c}}}, 4};
    const MatrixCurve flat{{0, 0}, {1, 0}, 1, m, 4};
    const auto space = certify_monotone_curvature(to_bezier(turned));
    const auto plane = curve::certify_monotone_curvature(to_bezier(flat));
    EXPECT_EQ(space.answer, plane.answer) << m.alpha << " " << m.s;
  }
}

TEST(Farin, StraightAndBad) {
  const SpaceMatrixCurve straight{{}, {1, 1, 1}, {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}, 3};
  EXPECT_EQ(certify_monotone_curvature(to_bezier(straight)).answer, MonotoneVerdict::yes);
  SpaceMatrixCurve bad = kCounterexample;
  bad.tangent = {};
  EXPECT_FALSE(validate(bad));
  bad = kCounterexample;
  bad.matrix[1][1] = NAN;
  EXPECT_FALSE(validate(bad));
  bad = kCounterexample;
  bad.matrix[1][1] = 1e200;
  EXPECT_FALSE(validate(bad));
}

// Control points on a line whose coordinates were rounded, large ones and small: curvature is 0.
TEST(Farin, StraightUpToTheRoundingOfItsPoints) {
  for (const double size : {1e6, 1e-6}) {
    curve::Bezier3 c;
    for (const double t : {0.0, 0.1, 0.4, 1.0})
      c.control.push_back(
          {size * (0.7 + 0.3 * t), size * (-0.9 + 0.7 * t), size * (0.3 - 0.13 * t)});
    EXPECT_EQ(certify_monotone_curvature(c).answer, MonotoneVerdict::yes) << size;
  }
}

}  // namespace
}  // namespace keyline::classa
