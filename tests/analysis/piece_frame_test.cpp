#include "keyline/analysis/piece_frame.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::analysis::detail {
namespace {

/// Curvature 3 - s - s^2 along a length of 1, of which four samples are known.
CurvatureProfile falling() {
  CurvatureProfile p;
  for (const double s : {0.0, 0.3, 0.5, 1.0}) {
    p.arc_length.push_back(s);
    p.curvature.push_back(3 - s - s * s);
    p.curvature_rate.push_back(-1 - 2 * s);
    p.turning.push_back(3 * s - s * s / 2 - s * s * s / 3);
  }
  return p;
}

// A cubic is what turning is between samples: each cell's is exact, whichever way it runs or turns.
TEST(PieceFrame, CellsTurnAsTheCurveDoes) {
  CurvatureProfile right = falling();
  for (auto* column : {&right.curvature, &right.curvature_rate, &right.turning})
    for (double& value : *column) value = -value;
  const PieceFrame frame(falling()), back(reversed(falling())), mirrored(right);
  EXPECT_FALSE(frame.reversed());
  EXPECT_TRUE(back.reversed());
  EXPECT_EQ(frame.sign(), 1);
  EXPECT_EQ(back.sign(), -1);
  EXPECT_EQ(mirrored.sign(), -1);
  double before = 0;
  for (int i = 0; i < PieceFrame::kCells; ++i) {
    const double s = (i + 1.0) / PieceFrame::kCells;
    const double turned = 3 * s - s * s / 2 - s * s * s / 3;
    for (const PieceFrame* one : {&frame, &back, &mirrored})
      EXPECT_NEAR(one->turning()[i], turned - before, 1e-13) << i;
    before = turned;
  }
  EXPECT_NEAR(frame.mean_curvature(0, 100), 3 - 0.25 - 1.0 / 12, 1e-12);
  EXPECT_NEAR(frame.coarse().turning().sum(), before, 1e-12);
  EXPECT_NEAR(frame.coarse().turning()[0], frame.turning().head(5).sum(), 1e-14);
}

// Of two arcs of nearly one curvature: the distances of their places, the second moved and turned
// by what makes the squares least.
TEST(PieceFrame, DisplacementIsWhatIsLeftOfAMove) {
  constexpr double kCurvature = 2.5, kMore = 1e-5;
  constexpr int n = PieceFrame::kCells;
  const PieceFrame frame({{0, 1}, {kCurvature, kCurvature}, {0, 0}, {0, kCurvature}});
  const auto arc = [](double curvature, int i) {
    const double angle = curvature * i / n;
    return core::Vector2{std::sin(angle), 1 - std::cos(angle)} / curvature;
  };
  core::Vector2 centre, move;
  for (int i = 0; i <= n; ++i) {
    centre = centre + arc(kCurvature, i) / (n + 1.0);
    move = move + (arc(kCurvature + kMore, i) - arc(kCurvature, i)) / (n + 1.0);
  }
  double turned = 0, size = 0;
  for (int i = 0; i <= n; ++i) {
    const core::Vector2 from = arc(kCurvature, i) - centre;
    turned += core::cross(from, arc(kCurvature + kMore, i) - arc(kCurvature, i) - move);
    size += core::dot(from, from);
  }
  double squares = 0;
  for (int i = 0; i <= n; ++i) {
    const core::Vector2 left =
        arc(kCurvature + kMore, i) - arc(kCurvature, i) - move -
        (turned / size) * core::perpendicular_left(arc(kCurvature, i) - centre);
    squares += core::dot(left, left);
  }
  const Eigen::VectorXd model = Eigen::VectorXd::Constant(n, (kCurvature + kMore) / n);
  const double expected = std::sqrt(squares / (n + 1));
  EXPECT_NEAR(frame.displacement(model).norm(), expected, 1e-4 * expected);
  EXPECT_EQ(frame.displacement(frame.turning()).norm(), 0);
}

}  // namespace
}  // namespace keyline::analysis::detail
