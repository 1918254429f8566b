#include "keyline/analysis/volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"

#include "spirals.h"

namespace keyline::analysis {
namespace {

/// The chord's line is crossed at 0.139 and, a thousandth before the end, at 0.9988. Both areas by
/// mpmath's quadrature with 30 digits.
TEST(Volume, ChangesSidesNextToAnEnd) {
  const curve::Bezier2 curve{{{0.0318485243167589, 0.0639393722471532},
                              {0.0336894405761088, 0.07644643135878706},
                              {0.042238665995451195, 0.07259928967075473},
                              {0.05298800916023429, 0.06297481365369127},
                              {0.06146419956146303, 0.07915353946547601},
                              {0.04317438717115063, 0.08634077337015802},
                              {0.05495971905021837, 0.10938423184017564}},
                             {}};
  EXPECT_NEAR(volume(curve), 0.000248096756899581463, 1e-17);
  curve::Bezier2 back = curve;
  std::ranges::reverse(back.control);
  EXPECT_NEAR(volume(back), 0.000248096756899581463, 1e-17);
}

TEST(Volume, CircularSegmentAndParabola) {
  EXPECT_NEAR(volume(testing::arcs({1}, {2})), (2 - std::sin(2.0)) / 2, 1e-12);
  const curve::Bezier2 parabola{{{-1, 1}, {0, -1}, {1, 1}}, {}};
  EXPECT_NEAR(signed_volume(parabola), 4.0 / 3, 1e-14);
  EXPECT_NEAR(signed_volume(curve::Bezier2{{{1, 1}, {0, -1}, {-1, 1}}, {}}), -4.0 / 3, 1e-14);
}

/// y = sin(pi n x) over the unit interval: n half waves of the area 2 / (pi n) each.
struct Wave {
  double n;
};
curve::Jet2 jet(const Wave& w, double t) {
  const double a = std::numbers::pi * w.n;
  return {{t, std::sin(a * t)},
          {1, a * std::cos(a * t)},
          {0, -a * a * std::sin(a * t)},
          {0, -a * a * a * std::cos(a * t)}};
}
core::Point2 evaluate(const Wave& w, double t) { return jet(w, t).point; }
std::vector<double> breakpoints(const Wave&) { return {0, 1}; }

TEST(Volume, CountsEveryPartOfACurveOfManyTurns) {
  for (const double n : {3.0, 200.0, 601.0, 1500.0})
    EXPECT_NEAR(volume(Wave{n}), 2 / std::numbers::pi, 1e-11) << n;
}

}  // namespace
}  // namespace keyline::analysis
