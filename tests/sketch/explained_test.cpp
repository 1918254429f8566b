#include "keyline/sketch/explained.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::sketch {
namespace {

using core::Point2;

// One quintic may go nearly once round: its ends say nothing of its length.
TEST(Explained, InkAllAlongAPieceWhoseEndsAreNear) {
  const curve::Bezier2 round{{{98, 60}, {10, 40}, {-10, 260}, {210, 260}, {190, 40}, {102, 60}},
                             {}};
  Stroke stroke;
  stroke.curve = {round};
  stroke.width = 2;
  Binary ink(200, 220);
  for (int i = 0; i <= 4000; ++i) {
    const Point2 p = evaluate(round, i / 4000.0);
    ink.at(static_cast<int>(p.x), static_cast<int>(p.y)) = 1;
    stroke.points.push_back(p);
    stroke.widths.push_back(2);
  }
  EXPECT_EQ(explained_ink(ink, std::vector<Stroke>{stroke}), 1);
}

}  // namespace
}  // namespace keyline::sketch
