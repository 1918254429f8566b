#include "keyline/curve/piecewise_bezier.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::curve {
namespace {

/// Lines of length 1 / n, each turned on from the last.
PiecewiseBezier bent(int n) {
  PiecewiseBezier c;
  core::Point2 p{2, 1};
  for (int i = 0; i < n; ++i) {
    const core::Point2 q = p + core::unit_vector(0.01 + 0.1 * i) / n;
    c.pieces.push_back({{p, q}, {}});
    p = q;
  }
  return c;
}

// k / n rounds, to either side: the piece that starts there is the k-th all the same.
TEST(PiecewiseBezier, ABreakpointBelongsToThePieceThatStartsThere) {
  for (int n = 1; n <= 60; ++n) {
    const PiecewiseBezier c = bent(n);
    for (int k = 0; k < n; ++k) {
      const double t = static_cast<double>(k) / n;
      const auto at = jet(c, t);
      EXPECT_NEAR(core::direction_of(at.first), core::wrap_angle(0.01 + 0.1 * k), 1e-12)
          << k << "/" << n;
      EXPECT_NEAR(norm(at.first), 1, 1e-12);  // by the parameter of the whole
      EXPECT_LT(distance(evaluate(c, t), c.pieces[static_cast<std::size_t>(k)].control[0]), 1e-13);
      const double before = std::nextafter(t, -1);
      if (k > 0) {
        EXPECT_NEAR(core::direction_of(jet(c, before).first), core::wrap_angle(0.1 * k - 0.09),
                    1e-12);
      }
    }
    EXPECT_EQ(evaluate(c, 1), c.pieces.back().control[1]);
    EXPECT_EQ(evaluate(c, 2), evaluate(c, 1));
    EXPECT_EQ(evaluate(c, -1), evaluate(c, 0));
  }
}

TEST(PiecewiseBezier, WithoutAPieceIsNone) {
  EXPECT_THROW(evaluate(PiecewiseBezier{}, 0.5), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::curve
