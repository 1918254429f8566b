#include "keyline/classa/nearest.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/classa/cav.h"

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

// Ratios of lengths 5 and 5 (1 + d) lie 5 d / 2 from their mean; the tolerance is that of s = 1.
TEST(Cav, MatricesAreOneUpToTheToleranceTimesTheirSize) {
  CavOptions options;
  options.tolerance = 1e-3;
  for (const auto& [d, type] : {std::pair{1.6e-3, 3}, {2.4e-3, 4}}) {
    const core::Point2 first{1, 0};
    const core::Point2 second{1 + 5 * std::cos(0.3), 5 * std::sin(0.3)};
    const double length = 25 * (1 + d);
    const Bezier2 c{{{0, 0},
                     first,
                     second,
                     {second.x + length * std::cos(0.6), second.y + length * std::sin(0.6)}},
                    {}};
    const auto reading = read_curve(c, options);
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->matrix.type, type) << d;
  }
}

}  // namespace
}  // namespace keyline::classa
