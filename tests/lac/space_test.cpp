#include "keyline/lac/space/space.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"

namespace keyline::lac {
namespace {

using core::Point3;
using core::Vector3;

static_assert(curve::SpaceCurve<SpaceChain>);

TEST(SpaceCurve, ConstantCurvatureAndTorsionMakeAHelix) {
  const double k = 0.8, w = 0.5, length = 20;
  const SpaceChain helix{{}, {{-1.5, 2, length, k, k, w, w}}};
  ASSERT_TRUE(validate(helix));
  const double c = std::hypot(k, w), r = k / (c * c), rise = w / c;
  for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const double s = t * length;
    // Radius r about an axis along (w, 0, k)/c through the point (0, r, 0).
    const Vector3 axis{w / c, 0, k / c};
    const Vector3 forward = cross({0, -1, 0}, axis) * -1.0;
    const Vector3 around =
        r * (1 - std::cos(c * s)) * Vector3{0, 1, 0} + r * std::sin(c * s) * forward;
    const Point3 wanted = Point3{} + around + rise * s * axis;
    EXPECT_LT(distance(evaluate(helix, t), wanted), 1e-12 * length) << t;
  }
}

TEST(SpaceCurve, WithoutTorsionIsThePlaneCurve) {
  for (const double alpha : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
    for (const double last : {0.2, 3.0, -2.0, 0.0}) {
      if (last <= 0 && alpha >= 0) continue;
      const SpaceChain space{{}, {{alpha, 1, 2, 1.3, last, 0, 0}}};
      const Segment plane{{{0, 0}, 0}, alpha, 2, 1.3, last};
      for (const double t : {0.1, 0.5, 0.9, 1.0}) {
        const Point3 p = evaluate(space, t);
        const core::Point2 q = evaluate(plane, t);
        EXPECT_LT(distance(p, {q.x, q.y, 0}), 2e-12) << alpha << ' ' << last << ' ' << t;
      }
    }
  }
}

TEST(SpaceCurve, JetHoldsCurvatureAndTorsion) {
  const SpaceChain chain{{}, {{-1, 0.5, 2, 1, 0.4, 0.3, 0.9}, {2, -2, 3, 0.4, 0.7, 0.9, -0.2}}};
  ASSERT_TRUE(validate(chain));
  EXPECT_EQ(largest_joint_gap(chain).curvature, 0);
  EXPECT_EQ(largest_joint_gap(chain).torsion, 0);
  for (const double t : {0.05, 0.3, 0.5, 0.8}) {
    const curve::Jet3 j = jet(chain, t);
    EXPECT_NEAR(speed(j), 5, 1e-12);
    EXPECT_NEAR(curve::curvature(j), curvature(chain, t), 1e-12);
    EXPECT_NEAR(curve::torsion(j), torsion(chain, t), 1e-11);
    const double h = 1e-4;
    const Vector3 slope = (evaluate(chain, t + h) - evaluate(chain, t - h)) / (2 * h);
    EXPECT_LT(norm(slope - j.first), 1e-6);
  }
  const SpaceChain back = reverse(chain);
  for (const double t : {0.0, 0.2, 0.6, 1.0})
    EXPECT_LT(distance(evaluate(back, t), evaluate(chain, 1 - t)), 1e-12);
}

TEST(SpaceCurve, GraphsHaveTheSlopes) {
  for (const auto& [alpha, beta] : {std::pair{-1.5, 0.7}, {0.0, 2.0}, {1.0, -1.0}, {2.5, 0.0}}) {
    const SpaceGraphs g = logarithmic_graphs({alpha, beta, 1.5, 1, 0.6, 0.2, 0.5});
    EXPECT_TRUE(g.curvature_defined && g.torsion_defined);
    EXPECT_NEAR(g.curvature_slope, alpha, 1e-9);
    EXPECT_NEAR(g.torsion_slope, beta, 1e-9);
  }
  EXPECT_FALSE(logarithmic_graphs({1, 1, 1, 1, 1, 0, 0}).curvature_defined);
}

TEST(SpaceCurve, StandardFormIsWhatItSays) {
  const auto piece = standard_piece({2, -1, 0.3, 0.2, 0.5}, 1.5);
  ASSERT_TRUE(piece);
  EXPECT_NEAR(piece->curvature_end, 1 / std::sqrt(1 + 2 * 0.3 * 1.5), 1e-15);
  EXPECT_NEAR(piece->torsion_end, 0.5 - 0.2 * 1.5, 1e-15);
  EXPECT_FALSE(standard_piece({2, -1, -0.5, 0, 0}, 1.5));
  EXPECT_FALSE(standard_piece({2, -1, NAN, 0, 0}, 1.5));
}

/// Largest distance at equal arc length, sampled.
double sampled_departure(const SpaceBeziers& beziers, const SpaceChain& chain) {
  double most = 0;
  double done = 0;
  const double length = arc_length(chain);
  for (const curve::Bezier3& piece : beziers.pieces) {
    // Points 0 and 1 are a fifth of the quintic's arc length apart.
    const double h = 5 * distance(piece.control[0], piece.control[1]) / length;
    for (int i = 0; i <= 8; ++i)
      most = std::max(most, distance(evaluate(piece, i / 8.0), evaluate(chain, done + h * i / 8)));
    done += h;
  }
  EXPECT_NEAR(done, 1, 1e-12);
  return most;
}

TEST(SpaceCurve, QuinticsMeetTheTolerance) {
  const SpaceChain chains[] = {
      {{}, {{-1, 0.5, 2, 1, 0.4, 0.3, 0.9}, {2, -2, 3, 0.4, 0.7, 0.9, -0.2}}},
      {{}, {{-2.3, -1, 2, 1, -0.6, 0.3, -0.9}}},
      {{}, {{-0.5, 0, 3, 1, 0, 0.3, 0.9}}},
      {{}, {{1, 1, 3, 0.5, 0.5, 0, 0}}},
  };
  for (const SpaceChain& chain : chains) {
    ASSERT_TRUE(validate(chain));
    std::size_t before = 0;
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      const SpaceBeziers beziers = approximate_by_quintics(chain, tolerance);
      EXPECT_LE(beziers.deviation, tolerance);
      const double sampled = sampled_departure(beziers, chain);
      EXPECT_LE(sampled, beziers.deviation);
      EXPECT_LT(distance(beziers.pieces.back().control.back(), evaluate(chain, 1)), 1e-12);
      EXPECT_GE(beziers.pieces.size(), before);
      before = beziers.pieces.size();
    }
    EXPECT_LE(before, 72U);
  }
}

// A short clothoid of curvature k(s): of its sixth derivative p T + q N, with p and q polynomials
// in k and k', Frenet's equations with all signs positive bound |C6|; h^6/46080 of it is the
// deviation.
TEST(SpaceCurve, DeviationOfOneQuinticIsThatOfItsSixthDerivative) {
  using Polynomial = std::array<double, 6>;  // in s, about the end
  const double last = 1.5, rate = 0.8, h = 0.3;
  const auto grown = [&](const Polynomial& own, const Polynomial& other) {
    Polynomial sum{};
    for (std::size_t i = 0; i + 1 < own.size(); ++i) {
      sum[i] += static_cast<double>(i + 1) * own[i + 1] + last * other[i];
      sum[i + 1] += rate * other[i];
    }
    return sum;
  };
  Polynomial along{1}, across{};
  for (int order = 2; order <= 6; ++order) {
    const Polynomial next = grown(along, across);
    across = grown(across, along);
    along = next;
  }
  const double wanted = std::pow(h, 6) / 46080 * std::hypot(along[0], across[0]);
  const SpaceChain chain{{}, {{-1, 1, h, last - rate * h, last, 0, 0}}};
  const SpaceBeziers made = approximate_by_quintics(chain, 1e-5);
  ASSERT_EQ(made.pieces.size(), 1U);
  EXPECT_NEAR(made.deviation, wanted, 1e-9 * wanted + 1e-12);
  EXPECT_LE(sampled_departure(made, chain), made.deviation);
}

TEST(SpaceCurve, RefusesWhatIsNone) {
  SpaceChain chain{{}, {{1, 1, 1, 1, -1, 0, 0}}};
  EXPECT_EQ(validate(chain).error().path, "pieces[0]");
  chain.pieces[0] = {2, 1, 1, 1, INFINITY, 0, 0};
  EXPECT_FALSE(validate(chain));
  chain.pieces[0] = {-1, 1, 1, 1, 2, 1, -1};
  EXPECT_FALSE(validate(chain));
  chain.pieces[0] = {-1, 1, 1, 1, 2, 1, 1};
  EXPECT_TRUE(validate(chain));
  chain.start.binormal = {0, 0, -1};
  EXPECT_EQ(validate(chain).error().path, "frame");
  EXPECT_FALSE(validate(SpaceChain{}));
}

}  // namespace
}  // namespace keyline::lac
