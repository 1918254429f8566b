#include "keyline/lac/segment/lambda.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

struct LambdaCase {
  const char* curve;
  Piece piece;
  double lambda;
};

/// drho/ds by hand: of a clothoid kappa' / kappa^2; a logarithmic spiral's radius grows evenly; of
/// an involute its square does.
constexpr LambdaCase kClosedForms[] = {
    {"clothoid", {-1, 3, 2, 0.5}, 0.5 / 4},
    {"clothoid the other way", {-1, 3, 0.5, 2}, 0.5 / 4},
    {"clothoid to the inflection", {-1, 3, 0, -2}, (2.0 / 3) / 4},
    {"clothoid through the inflection, as sharp at both ends", {-1, 4, -2, 2}, 1.0 / 4},
    {"logarithmic spiral, radius 0.5 to 2", {1, 3, 2, 0.5}, 1.5 / 3},
    {"involute, radius 1 to 2, at the larger", {2, 3, -0.5, -1}, 3 / (2 * 3 * 2.0)},
    {"circle", {0.7, 3, 2, 2}, 0},
    {"straight line", {-1, 3, 0, 0}, 0}};

TEST(LambdaOf, MatchesClosedForms) {
  for (const LambdaCase& c : kClosedForms) {
    SCOPED_TRACE(c.curve);
    EXPECT_NEAR(lambda_of(c.piece), c.lambda, 1e-14);
  }
}

TEST(LambdaOf, IsTheSameAtEverySize) {
  for (const double size : {1e-300, 1e-170, 1e-140, 1e140, 1e170})
    EXPECT_NEAR(lambda_of({-1, 3 * size, 2 / size, 0.5 / size}), 0.125, 1e-14) << size;
}

// A logarithmic spiral's radius falls evenly to next to nothing; the square of its curvature is no
// number.
TEST(LambdaOf, IsFiniteHoweverSharpAnEndIs) {
  const double lambda = 1e6 / 3;
  EXPECT_NEAR(lambda_of({1, 3, 1e-6, 6e162}), lambda, 1e-13 * lambda);
  EXPECT_NEAR(lambda_of({1, 3, -6e162, -1e-6}), lambda, 1e-13 * lambda);
}

}  // namespace
}  // namespace keyline::lac
