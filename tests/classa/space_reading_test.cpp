#include "keyline/classa/space_reading.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::classa::detail {
namespace {

using core::Point3;
using core::Vector3;

/// Edges of the given lengths, each in another direction.
std::vector<Point3> polygon(const std::vector<double>& lengths) {
  std::vector<Point3> control = {{1, 2, 3}};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double a = 0.5 * static_cast<double>(i);
    const Vector3 edge{0.8 * std::cos(a), 0.8 * std::sin(a), i % 2 == 0 ? 0.6 : -0.6};
    control.push_back(control.back() + lengths[i] * edge);
  }
  return control;
}

// By the definition in cav.h: the last edge against the first, where these are as long those beside
// them, and so inwards.
TEST(SpaceReading, IsReversedWhereEdgesShrink) {
  const auto reversed = [](const std::vector<double>& lengths) {
    return read_in_space(polygon(lengths), {}).reversed;
  };
  EXPECT_TRUE(reversed({2, 1, 1.5}));
  EXPECT_TRUE(reversed({2, 9, 1.9}));
  EXPECT_FALSE(reversed({2, 0.1, 2.1}));
  EXPECT_FALSE(reversed({1.5, 1, 2}));
  EXPECT_TRUE(reversed({2, 3, 5, 1, 2}));
  EXPECT_FALSE(reversed({2, 1, 5, 3, 2}));
  EXPECT_FALSE(reversed({2, 3, 5, 3, 2}));
  EXPECT_FALSE(reversed({2, 2}));
}

// The axes span the start tangent and the chord; of a curve that ends on its start tangent's line
// some plane through it.
TEST(SpaceReading, AxesAreThoseOfTangentAndChord) {
  numeric::Random random(3);
  const auto any = [&] {
    return Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  for (int i = 0; i < 40; ++i) {
    std::vector<Point3> control = {Point3{} + any()};
    for (int k = 0; k < 3; ++k) control.push_back(control.back() + (k + 1.0) * any());
    if (i % 4 == 0) control.back() = control.front() + 5 * (control[1] - control[0]);
    CavOptions options;
    options.direction = Direction::as_given;
    const SpaceReading r = read_in_space(control, options);
    EXPECT_FALSE(r.reversed);
    EXPECT_NEAR(norm(r.x), 1, 1e-14);
    EXPECT_NEAR(norm(r.y), 1, 1e-14);
    EXPECT_NEAR(dot(r.x, r.y), 0, 1e-14);
    const double size = distance(control.front(), control.back());
    EXPECT_LT(distance(r.lifted({r.conditions.chord.x, r.conditions.chord.y}), control.back()),
              1e-13 * size);
    EXPECT_LT(norm(control[1] - control[0] - r.conditions.tangent.x * r.x), 1e-14);
    EXPECT_GE(r.conditions.chord.y, -1e-14 * size);
  }
}

}  // namespace
}  // namespace keyline::classa::detail
