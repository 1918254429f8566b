#include "keyline/lac/segment/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

struct Numbers {
  double curvature_start, curvature_end, length, alpha;
};

double signed_power(double x, double p) { return std::copysign(std::pow(std::abs(x), p), x); }

/// kappa^-alpha is linear along the piece, whose integral has a closed form.
struct Law {
  Numbers n;
  double first = signed_power(n.curvature_start, -n.alpha);
  double last = signed_power(n.curvature_end, -n.alpha);

  double at(double v) const { return std::lerp(first, last, v); }
  double zero() const { return first * last < 0 ? first / (first - last) : first == 0 ? 0 : 1; }
  double angle(double v) const {
    const double power = 1 - 1 / n.alpha;
    const auto whole = [power](double z) { return z == 0 ? 0 : std::pow(std::abs(z), power); };
    return n.length * (whole(at(v)) - whole(first)) / (power * (last - first));
  }
};

struct Place {
  double x = 0, y = 0;
};

/// Simpson's rule over v = zero + (to - zero) u^4, in which the curve is smooth at its inflection.
Place from_zero(const Law& law, double zero, double to) {
  constexpr int kSteps = 2000;
  Place sum;
  for (int i = 0; i <= kSteps; ++i) {
    const double u = static_cast<double>(i) / kSteps;
    const double weight = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps);
    const double rate = 4 * u * u * u * (to - zero) * law.n.length * weight;
    const double angle = law.angle(zero + (to - zero) * u * u * u * u);
    sum.x += rate * std::cos(angle);
    sum.y += rate * std::sin(angle);
  }
  return sum;
}

Place place_at(const Numbers& n, double v) {
  const Law law{n};
  const Place there = from_zero(law, law.zero(), v);
  const Place start = from_zero(law, law.zero(), 0);
  return {there.x - start.x, there.y - start.y};
}

Numbers changed(Numbers n, int variable, double by) {
  double* const all[] = {&n.curvature_start, &n.curvature_end, &n.length, &n.alpha};
  *all[variable] += by;
  return n;
}

/// What the header promises of positions over the length, and of derivatives.
struct Promise {
  double position, derivative;
};

void expect_table_at(const PieceTable& table, const Numbers& n, double v, const Promise& promise) {
  SCOPED_TRACE(v);
  const bool inflects = n.curvature_start * n.curvature_end <= 0;
  const double near = promise.position * n.length;
  const PieceTable::Value value = table.at(v);
  const Place place = place_at(n, v);
  EXPECT_NEAR(value.x, place.x, near);
  EXPECT_NEAR(value.y, place.y, near);
  EXPECT_NEAR(value.angle, Law{n}.angle(v), near);
  for (int i = 0; i < kPieceVariables; ++i) {
    SCOPED_TRACE(i);
    if (inflects && i < 2 && (i == 0 ? n.curvature_start : n.curvature_end) == 0) continue;
    const double h = 1e-4;
    const Place after = place_at(changed(n, i, h), v), before = place_at(changed(n, i, -h), v);
    EXPECT_NEAR(value.dx[i], (after.x - before.x) / (2 * h), promise.derivative);
    EXPECT_NEAR(value.dy[i], (after.y - before.y) / (2 * h), promise.derivative);
  }
}

TEST(PieceTable, MeetsClosedFormsAndOwnQuadrature) {
  for (const Numbers& n : {
           Numbers{1, 0, 2, -2},
           {0, 1, 2, -2},
           {0.8, -0.5, 2, -1.5},
           {-0.3, 1, 3, -3},
           {-1, 0.4, 2, -0.5},
           {0.5, 1.2, 2, -1},
           {0.3, 2, 1, 2},
           {2, 0.3, 1, -3},
       }) {
    SCOPED_TRACE(testing::Message()
                 << n.curvature_start << ' ' << n.curvature_end << ' ' << n.alpha);
    const bool inflects = n.curvature_start * n.curvature_end <= 0;
    for (const bool fine : {false, true}) {
      SCOPED_TRACE(fine);
      PieceTable table;
      table.build(n.curvature_start, n.curvature_end, n.length, n.alpha, fine);
      const Promise promise{fine       ? 1e-11
                            : inflects ? 1e-6
                                       : 1.5e-7,
                            inflects ? 4e-4
                            : fine   ? 1e-7
                                     : 1e-6};
      for (const double v : {0.0, 0.1, 0.37, 0.5, 0.9, 1.0}) expect_table_at(table, n, v, promise);
    }
  }
}

}  // namespace
}  // namespace keyline::lac
