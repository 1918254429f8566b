#include "keyline/classa/nearest.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/classa/cav.h"
#include "keyline/classa/control_matrix.h"
#include "keyline/classa/nearest_space.h"

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
  EXPECT_FALSE(nearest_matrix_curve(Bezier2{{{0, 0}, {1, 1}}, {}}));
  EXPECT_FALSE(nearest_matrix_curve(Bezier2{{{0, 0}, {1, 1}, {0, 0}}, {}}));
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

TEST(ControlMatrix, TheFirstEdgeIsTheTangentUnlessABetaIsGiven) {
  MatrixCurve c;
  c.tangent = {1, 2};
  EXPECT_EQ(to_bezier(c).control[1], (core::Point2{1, 2}));
  EXPECT_EQ(to_bezier(c).control.back(), (core::Point2{3, 6}));
  c.beta = 0.5;
  EXPECT_EQ(to_bezier(c).control[1], (core::Point2{0.5, 1}));
}

// Three edges that turn by 1.4 each point at 2.8 at most, whatever their lengths: from there on the
// nearer end of the range is the upper one, and the lower one below what it reaches itself.
TEST(ControlMatrix, ScalesBeyondWhatIsReachedAreTheNearerEnd) {
  constexpr double kAlpha = 1.4;
  const core::Interval falling{0.01, std::cos(kAlpha)};
  const core::Interval growing{1 / std::cos(kAlpha), 100};
  for (const core::Interval& s : {falling, growing}) {
    for (const double angle : {2.8, 2.9, 3.3, 4.0, 5.5})
      EXPECT_EQ(scale_at_end_angle(kAlpha, angle, 3, s), s.high) << angle;
    for (const double share : {-0.5, 0.0, 0.5, 0.999})
      EXPECT_EQ(scale_at_end_angle(kAlpha, share * end_angle({kAlpha, s.low}, 3), 3, s), s.low);
  }
  // Windings: nine edges that turn by 0.95 each.
  const core::Interval wound{1.8, 2.5};
  for (const double s : {1.8, 2.0, 2.5})
    EXPECT_NEAR(scale_at_end_angle(0.95, end_angle({0.95, s}, 9), 9, wound), s, 1e-12);
  EXPECT_NEAR(scale_at_end_angle(0.95, end_angle({0.95, 1.8}, 9) - 0.1, 9, wound), 1.8, 1e-12);
  EXPECT_NEAR(scale_at_end_angle(0.95, end_angle({0.95, 2.5}, 9) + 0.1, 9, wound), 2.5, 1e-12);
}

// The range of s that is asked for, and 1, of the curve from the end its edges grow from: they come
// as near as equal ones do.
TEST(NearestValue, LooksInTheRangeOfSAndAtOne) {
  curve::Bezier3 growing{{{0, 0, 0}, {1, 0, 0}, {2.4, 0.8, 0.1}, {3.2, 3.2, 0.4}}, {}};
  for (const bool reversed : {false, true}) {
    const curve::Bezier3 given = reversed ? reverse(growing) : growing;
    CavOptions options;
    const auto free = nearest_value(given, options);
    ASSERT_TRUE(free);
    EXPECT_GT(reversed ? 1 / free->nearest.flat.matrix.s : free->nearest.flat.matrix.s, 1.2);
    options.s = {0.1, 0.7};
    const auto held = nearest_value(given, options);
    ASSERT_TRUE(held);
    EXPECT_NEAR(held->nearest.flat.matrix.s, 1, 1e-6);
    EXPECT_GT(held->nearest.distance, free->nearest.distance);
  }
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
