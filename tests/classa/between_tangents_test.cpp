#include "keyline/classa/between_tangents.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/monotone.h"

namespace keyline::classa {
namespace {

using Complex = std::complex<double>;

// Curves built from their matrix as a geometric series are found again from their ends alone.
TEST(BetweenTangents, FindsTheCurveThatTheEndsAreTakenFrom) {
  for (const double alpha : {0.1, 0.5, 0.75})
    for (const double scale : {1.5, 2.0, 0.5})
      for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << alpha << " " << scale << " " << side);
        const Complex z = std::polar(scale, side * alpha);
        const Complex first{3, -1};
        const Complex end = first * (1.0 + z + z * z);
        const Complex last = first * z * z;
        const auto c = class_a_between(EndTangents{{2, 5},
                                                   {first.real(), first.imag()},
                                                   {2 + end.real(), 5 + end.imag()},
                                                   {last.real(), last.imag()}});
        ASSERT_TRUE(c);
        EXPECT_EQ(c->degree, 3);
        EXPECT_NEAR(c->matrix.alpha, side * alpha, 1e-12);
        EXPECT_NEAR(c->matrix.s, scale, 1e-8);
        const curve::Bezier2 b = to_bezier(*c);
        EXPECT_NEAR(b.control[3].x, 2 + end.real(), 1e-7);
        EXPECT_NEAR(b.control[3].y, 5 + end.imag(), 1e-7);
      }
}

// The chord leaves 1.2 of the middle of a quarter turn: too near for a cubic, whose least scale
// is 1/cos(pi/4), and not for a higher degree.
TEST(BetweenTangents, TakesTheDegreeThatReaches) {
  const double ahead = 0.5 * core::kPi / 2 * 1.2;
  const core::Vector2 chord = core::unit_vector(ahead);
  const EndTangents ends{{0, 0}, {1, 0}, {chord.x, chord.y}, {0, 1}};
  BetweenRange cubic;
  cubic.highest_degree = 3;
  EXPECT_FALSE(class_a_between(ends, cubic));
  const auto c = class_a_between(ends);
  ASSERT_TRUE(c);
  EXPECT_GT(c->degree, 3);
  EXPECT_TRUE(is_class_a(c->matrix));
  const curve::Bezier2 b = to_bezier(*c);
  EXPECT_NEAR(b.control.back().x, chord.x, 1e-9);
  EXPECT_NEAR(b.control.back().y, chord.y, 1e-9);
  const core::Vector2 last = b.control.back() - b.control[b.control.size() - 2];
  EXPECT_NEAR(last.x / norm(last), 0, 1e-9);
  EXPECT_EQ(curve::certify_monotone_curvature(b).answer, curve::MonotoneVerdict::Answer::yes);
}

TEST(BetweenTangents, SaysWhereThereIsNone) {
  EXPECT_FALSE(class_a_between(EndTangents{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));  // an arc
  EXPECT_FALSE(class_a_between(EndTangents{{0, 0}, {1, 1}, {2, 0}, {1, 1}}));  // an S
  EXPECT_FALSE(class_a_between(EndTangents{{0, 0}, {1, 0}, {1, 0}, {1, 0}}));  // a line
  EXPECT_FALSE(class_a_between(EndTangents{{0, 0}, {1, 0}, {0, 0}, {0, 1}}));  // no way
  EXPECT_FALSE(
      class_a_between(EndTangents{{0, 0}, {1, 0}, {1, 1e-4}, {0, 1}}));  // beside the tangent
}

}  // namespace
}  // namespace keyline::classa
