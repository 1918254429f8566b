#pragma once

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/polyline.h"

/// Curves the tests of room curve share.
namespace keyline::curve {

/// Unit circle from (1, 0) to (0, 1).
inline Bezier2 quarter_circle() { return {{{1, 0}, {1, 1}, {0, 1}}, {1, std::sqrt(0.5), 1}}; }

/// Uniform in [low, high), the same on every platform.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed + 1) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }

 private:
  std::mt19937 engine_;
};

inline Bezier2 random_bezier(unsigned seed, int degree, bool rational = false) {
  Draw draw(seed);
  Bezier2 c;
  for (int i = 0; i <= degree; ++i) {
    c.control.push_back({draw(-1, 1), draw(-1, 1)});
    if (rational) c.weights.push_back(draw(0.3, 3));
  }
  return c;
}

/// Random spline with some double knots; not clamped for every third seed.
inline BSpline2 random_spline(unsigned seed, int degree, int count, bool rational = false) {
  Draw draw(seed);
  const bool clamped = seed % 3 != 0;
  BSpline2 c;
  c.degree = degree;
  double u = draw(-3, 3);
  int repeated = 0;
  for (int i = 0; i < count + degree + 1; ++i) {
    const bool inside = i > degree + 1 && i < count;
    const bool at_end = (i > 0 && i <= degree) || i > count;
    const bool repeat = inside ? repeated + 1 < degree && draw(0, 1) < 0.3 : clamped && at_end;
    if (!repeat) u += draw(0.1, 2);
    repeated = repeat ? repeated + 1 : 0;
    c.knots.push_back(u);
  }
  for (int i = 0; i < count; ++i) {
    c.control.push_back({draw(-1, 1), draw(-1, 1)});
    if (rational) c.weights.push_back(draw(0.3, 3));
  }
  return c;
}

/// First to third derivative at t against central differences of the one below.
template <class C>
void expect_jets_match_differences(const C& c, double t) {
  const double h = 1e-5;
  const Jet2 at = jet(c, t);
  const Jet2 low = jet(c, t - h);
  const Jet2 high = jet(c, t + h);
  const auto close = [](core::Vector2 a, core::Vector2 b) {
    EXPECT_LT(norm(a - b), 1e-5 * (1 + norm(a) + norm(b)));
  };
  EXPECT_LT(distance(at.point, evaluate(c, t)), 1e-14);
  close(at.first, (high.point - low.point) / (2 * h));
  close(at.second, (high.first - low.first) / (2 * h));
  close(at.third, (high.second - low.second) / (2 * h));
}

}  // namespace keyline::curve
