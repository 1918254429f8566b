#include "keyline/classa/nearest.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::classa {
namespace {

using curve::Bezier2;

// Two edges are those of one matrix, whatever they are: turned by alpha and s times as long.
TEST(NearestMatrixCurve, OfTwoEdgesIsTheCurveItself) {
  for (const double alpha : {0.7, -0.4})
    for (const double s : {0.6, 1.4}) {
      const Bezier2 given{
          {{1, 2}, {3, 2}, {3 + 2 * s * std::cos(alpha), 2 + 2 * s * std::sin(alpha)}}, {}};
      const auto nearest = nearest_matrix_curve(given);
      ASSERT_TRUE(nearest);
      EXPECT_NEAR(nearest->matrix.alpha, alpha, 1e-6);
      EXPECT_NEAR(nearest->matrix.s, s, 1e-6);
      EXPECT_LT(nearest->distance, 1e-6);
    }
}

TEST(NearestMatrixCurve, OfNoShapeIsNone) {
  EXPECT_FALSE(nearest_matrix_curve({{{0, 0}, {1, 1}}, {}}));
  EXPECT_FALSE(nearest_matrix_curve({{{0, 0}, {1, 1}, {0, 0}}, {}}));
}

// s >= 1 / cos(alpha) or s <= cos(alpha) ([Oya] Eq. 5); a matrix that shrinks edges to nothing is
// none.
TEST(ControlMatrix, ClassAIsOneOfTwoRangesOfS) {
  const double alpha = 0.5;
  const double c = std::cos(alpha);
  EXPECT_TRUE(is_class_a({alpha, 1.001 / c}, 0));
  EXPECT_FALSE(is_class_a({alpha, 0.999 / c}, 0));
  EXPECT_TRUE(is_class_a({alpha, 0.999 * c}, 0));
  EXPECT_FALSE(is_class_a({alpha, 1.001 * c}, 0));
  EXPECT_FALSE(is_class_a({alpha, 0}, 0));
  EXPECT_FALSE(is_class_a({alpha, -2 / c}, 0));
  EXPECT_FALSE(is_class_a({2, 5}, 0));
}

}  // namespace
}  // namespace keyline::classa
