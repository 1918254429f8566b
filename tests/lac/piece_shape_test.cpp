#include "keyline/lac/segment/piece_shape.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace keyline::lac::detail {
namespace {

TEST(Stepped, ChangesItsOwnVariable) {
  EXPECT_EQ(stepped(2, 0.5, {}), 2.5);
  EXPECT_NEAR(stepped(-2, std::log(3), {CurvatureStep::logarithm, 1}), -6, 1e-14);
  // Of squares with signs: 4 - 9 is -5.
  EXPECT_NEAR(stepped(2, -9, {CurvatureStep::power, 2}), -std::sqrt(5), 1e-14);
  EXPECT_NEAR(stepped(-2, 3, {CurvatureStep::power, 2}), -1, 1e-14);
}

TEST(LargestBend, IsThatOfATurnOfEight) {
  EXPECT_EQ(largest_bend(0.5), 80);
  EXPECT_EQ(largest_bend(0), 80);
  EXPECT_EQ(largest_bend(-1), 16);
  EXPECT_EQ(largest_bend(-4), 10);
  EXPECT_EQ(largest_bend(-0.01), 80);
  // From an inflection curvature k at the end turns by k alpha / (alpha - 1): 8.
  EXPECT_NEAR(total_turning(Piece{-4, 1, 0, largest_bend(-4)}), 8, 1e-13);
}

// Of a clothoid from -1 to 2 over a length of 3 the parts turn by 1/2 and 2.
TEST(AbsoluteTurning, CountsBothSides) {
  EXPECT_NEAR(absolute_turning({-1, 3, -1, 2}), 2.5, 1e-14);
  EXPECT_NEAR(absolute_turning({-1, 3, 1, 2}), 4.5, 1e-14);
  EXPECT_NEAR(absolute_turning({-1, 3, -1, -2}), 4.5, 1e-14);
}

// Of a clothoid: length (a^2 + a b + b^2) / 3.
TEST(BendingEnergy, OfClothoidsIsClosed) {
  EXPECT_NEAR(bending_energy({-1, 3, 1, 2}), 7, 1e-12);
  EXPECT_NEAR(bending_energy({-1, 3, -1, 2}), 3, 1e-12);
  // Nielsen's: k falls as an exponential, its square has the integral (a^2 - b^2) / (2 ln(a/b)).
  EXPECT_NEAR(bending_energy({0, 1, 3, 1}), 8 / (2 * std::log(3)), 1e-9);
  // Half a radian of a circle whose curvature has no square: curvature times turning.
  EXPECT_NEAR(bending_energy({-1, 0.5e-200, 1e200, 1e200}) / 0.5e200, 1, 1e-14);
}

TEST(SolveSmall, SolvesWithPivoting) {
  std::array<std::array<double, 3>, 3> a{{{0, 2, 1}, {1, 1, 1}, {2, 0, 3}}};
  // x = (1, -2, 3).
  std::array<double, 3> b{-1, 2, 11};
  ASSERT_TRUE(solve_small(a, b));
  EXPECT_NEAR(b[0], 1, 1e-14);
  EXPECT_NEAR(b[1], -2, 1e-14);
  EXPECT_NEAR(b[2], 3, 1e-14);
  std::array<std::array<double, 2>, 2> flat{{{1, 2}, {2, 4}}};
  std::array<double, 2> c{1, 2};
  EXPECT_FALSE(solve_small(flat, c));
}

/// By differences of the segment's own functions.
struct Ends {
  core::Vector2 chord;
  double turning = 0;
};
Ends ends_of(double alpha, double k0, double k1, double length = 1) {
  const Piece piece{alpha, length, k0, k1};
  return {length * (displacement(piece, 1) / length), total_turning(piece)};
}

TEST(PieceShape, LengthKeepsTheCurvatures) {
  for (const double alpha : {-2.5, -1.0, -0.4, 0.0, 0.5, 2.0, 9.0})
    for (const auto& [k0, k1] : {std::pair{0.1, 0.2},
                                 {1.0, 3.0},
                                 {-5.0, -2.0},
                                 {-1.0, 2.0},
                                 {0.0, 3.0},
                                 {9.0, 25.0},
                                 {1e-3, 7.0}}) {
      if (alpha >= 0 && k0 * k1 <= 0) continue;
      const PieceShape shape = piece_shape(alpha, k0, k1, {}, {});
      const Ends here = ends_of(alpha, k0, k1);
      EXPECT_NEAR(core::norm(shape.chord - here.chord), 0, 1e-13);
      EXPECT_NEAR(shape.turning, here.turning, 1e-12);
      constexpr double h = 1e-6;
      const core::Vector2 by =
          (ends_of(alpha, k0, k1, 1 + h).chord - ends_of(alpha, k0, k1, 1 - h).chord) / (2 * h);
      EXPECT_NEAR(core::norm(shape.chord_by_length - by), 0, 2e-7) << alpha << ' ' << k0;
    }
}

TEST(PieceShape, DerivativesAreThoseOfTheirVariables) {
  using enum CurvatureStep;
  constexpr double h = 1e-5;
  for (const double alpha : {-2.5, -1.0, -0.4, 0.5})
    for (const auto& [k0, k1] : {std::pair{1.0, 3.0}, {-0.7, 2.0}, {9.0, 25.0}})
      for (const CurvatureVariable v :
           {CurvatureVariable{linear, 1}, {logarithm, 1}, {power, 0.5}, {power, 2.5}, {power, 3}}) {
        if (alpha > 0 && k0 * k1 < 0) continue;
        const PieceShape shape = piece_shape(alpha, k0, k1, v, v);
        for (const int side : {0, 1}) {
          const auto ends = [&](double by) {
            return side == 0 ? ends_of(alpha, stepped(k0, by, v), k1)
                             : ends_of(alpha, k0, stepped(k1, by, v));
          };
          const core::Vector2 by = (ends(h).chord - ends(-h).chord) / (2 * h);
          EXPECT_NEAR(core::norm(shape.chord_by[side] - by), 0, 1e-7) << alpha << ' ' << k0;
          EXPECT_NEAR(shape.turning_by[side], (ends(h).turning - ends(-h).turning) / (2 * h), 1e-7)
              << alpha << ' ' << k0 << ' ' << v.power;
        }
      }
}

// A step through zero would be a piece that does not exist, whose integral has no end. The closed
// form is that of slope 1: kappa = 1 / (1 / k0 + s (1 / k1 - 1 / k0)).
TEST(PieceShape, NoStepGoesThroughAnInflectionThatTheSlopeDoesNotHave) {
  constexpr double k0 = 1e-21;
  constexpr double k1 = 0.0625;
  const double turning = std::log(k1 / k0) / (1 / k0 - 1 / k1);
  for (const double alpha : {0.9999999, 1.0, 1.0000001})
    for (const double sign : {-1.0, 1.0}) {
      const PieceShape shape = piece_shape(alpha, sign * k0, sign * k1, {}, {});
      EXPECT_NEAR(shape.turning / (sign * turning), 1, 1e-5) << alpha;
      EXPECT_NEAR(shape.chord.x, 1, 1e-15);
      EXPECT_NEAR(shape.turning_by[1], 0, 1e-9);
      EXPECT_GT(shape.turning_by[0], std::log(k1 * 1e6 / k1) - 1)
          << "where k0 is a millionth of k1";
      EXPECT_LT(shape.turning_by[0], std::log(k1 / k0) - 1) << "at k0";
    }
}

}  // namespace
}  // namespace keyline::lac::detail
