#include "keyline/lac/chain/departure.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

namespace keyline::lac {
namespace {

Chain any_chain(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Chain chain;
  double k = 2 * unit(random) - 1;
  for (int i = 0; i < 3; ++i) {
    const double next = k + unit(random) - 0.5;
    const double alpha = k * next > 0 ? 4 * unit(random) - 2 : -0.3 - 2 * unit(random);
    chain.pieces.push_back({alpha, 0.3 + unit(random), k, next});
    k = next;
  }
  return chain;
}

TEST(DepartureBound, IsAboveEveryDistanceAtEqualFractionsAndNotFarAbove) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 40; ++n) {
    const Chain a = any_chain(random);
    Chain b = any_chain(random);
    if (n % 2 == 0) {  // close to one another
      b = a;
      for (Piece& p : b.pieces) p.length *= 1 + 1e-4 * unit(random);
    }
    double most = 0;
    for (int i = 0; i <= 20011; ++i) {
      const double t = i / 20011.0;
      most = std::max(most, distance(evaluate(a, t), evaluate(b, t)));
    }
    const double bound = departure_bound(a, b);
    EXPECT_GE(bound, most) << n;
    EXPECT_LE(bound, 1.006 * most + 1e-9) << n;
    EXPECT_NEAR(departure_bound(b, a), bound, 0.02 * bound);
  }
}

// Arcs to either side of a line, ending on it at every sixty-fourth of its length, where the two
// are looked at first: the distance is their height, which lies between.
TEST(DepartureBound, SeesWhatRisesBetweenItsPlaces) {
  constexpr double kCurvature = 1.5, kLength = 0.4;
  const double turn = kCurvature * kLength / 2;
  Chain waves{{{0, 0}, -turn}, {}, false};
  for (int i = 0; i < 64; ++i) {
    const double k = i % 2 == 0 ? kCurvature : -kCurvature;
    waves.pieces.push_back({-1, kLength, k, k});
  }
  const Chain line{{{0, 0}, 0}, {{-1, 64 * 2 * std::sin(turn) / kCurvature, 0, 0}}, false};
  const double height = (1 - std::cos(turn)) / kCurvature;
  const double bound = departure_bound(waves, line);
  EXPECT_GE(bound, height - 1e-12);
  EXPECT_LE(bound, 1.01 * height);
}

// Between two segments with the same ends the largest distance lies anywhere inside.
TEST(DepartureBound, HoldsBetweenItsPlaces) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> unit(-1, 1);
  int drawn = 0;
  for (int n = 0; n < 40; ++n) {
    const core::Point2 corner{1 + 0.05 * unit(random), -0.5 + 0.3 * unit(random)};
    const auto a = solve_g1({0, 0}, corner, {2, 0.1}, 2 * unit(random));
    const auto b = solve_g1({0, 0}, corner, {2, 0.1}, 2 * unit(random));
    if (!a || !b) continue;
    ++drawn;
    double most = 0;
    for (int i = 0; i <= 20011; ++i) {
      const double t = i / 20011.0;
      most = std::max(most, distance(evaluate(a->segment, t), evaluate(b->segment, t)));
    }
    const double bound = departure_bound(chain_of(a->segment), chain_of(b->segment));
    EXPECT_GE(bound, most);
    EXPECT_LE(bound, 1.006 * most + 1e-9);
  }
  EXPECT_GE(drawn, 20);
}

// Nothing in the bound has a size of its own.
TEST(DepartureBound, GrowsAsTheChainsDo) {
  std::mt19937 random(19);
  for (int n = 0; n < 10; ++n) {
    const Chain a = any_chain(random);
    const Chain b = any_chain(random);
    const double bound = departure_bound(a, b);
    for (const double scale : {1e-3, 40.0, 1e6}) {
      const auto scaled = [scale](Chain chain) {
        for (Piece& p : chain.pieces) {
          p.length *= scale;
          p.curvature_start /= scale;
          p.curvature_end /= scale;
        }
        return chain;
      };
      EXPECT_NEAR(departure_bound(scaled(a), scaled(b)), scale * bound, 1e-9 * scale * bound);
    }
  }
}

// An arc and the one with the same ends on the other side of the chord do not leave in one
// direction; the bound does not need them to.
TEST(DepartureBound, TwoArcsAreApartByTheirHeights) {
  const double h = 0.4;
  const Chain left{{{0, 0}, -h}, {{-1, 2 * h, 1, 1}}, false};
  const Chain right{{{0, 0}, h}, {{-1, 2 * h, -1, -1}}, false};
  const double apart = 2 * (1 - std::cos(h));
  EXPECT_GE(departure_bound(left, right), apart);
  EXPECT_NEAR(departure_bound(left, right), apart, 0.006 * apart);
}

TEST(DepartureBound, OfACurveAndItsPartsIsNextToNothing) {
  const Segment s{{{1, 2}, 0.3}, -1.5, 2, 0.2, 1.1};
  Chain two{s.start, {part(piece_of(s), 0, 0.3), part(piece_of(s), 0.3, 1)}, false};
  EXPECT_LT(departure_bound(chain_of(s), two), 1e-9);
  EXPECT_EQ(departure_bound({{}, {{2, 1, 1, INFINITY}}, false}, {{}, {{2, 1, 1, 2}}, false}),
            INFINITY);
}

}  // namespace
}  // namespace keyline::lac
