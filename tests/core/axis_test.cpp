#include "keyline/core/axis.h"

#include <gtest/gtest.h>

namespace keyline::core {
namespace {

TEST(Axis, ANormalIsAUnitVectorAtRightAngles) {
  for (const Vector3 v : {Vector3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {-0.6, 0, 0.8}}) {
    EXPECT_NEAR(norm(any_normal(v)), 1, 1e-15);
    EXPECT_NEAR(dot(any_normal(v), v), 0, 1e-15);
  }
}

}  // namespace
}  // namespace keyline::core
