#include "keyline/analysis/arcs_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::analysis::detail {
namespace {

/// Arcs of these curvatures with breaks between them, of length 1.
CurvatureProfile arcs(const std::vector<double>& curvatures, const std::vector<double>& breaks) {
  constexpr double kJump = 1e-10;
  CurvatureProfile p;
  double from = 0;
  double turned = 0;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    const double to = i < breaks.size() ? breaks[i] : 1;
    for (const double s : {from + (i > 0 ? kJump : 0), to}) {
      p.arc_length.push_back(s);
      p.curvature.push_back(curvatures[i]);
      p.curvature_rate.push_back(0);
      p.turning.push_back(turned + curvatures[i] * (s - from));
    }
    turned += curvatures[i] * (to - from);
    from = to;
  }
  return p;
}

// Breaks between the frame's 200 cells, and parts of one cell at either end.
TEST(FitArcs, OfArcsAreThoseArcs) {
  struct Case {
    std::vector<double> curvatures, breaks;
  };
  for (const Case& c : {Case{{6, 3, 1}, {0.2312, 0.6137}}, Case{{40, 3, 1}, {0.005, 0.5}},
                        Case{{6, 5, 1}, {0.4, 0.995}}, Case{{5, 4, 3, 1.5}, {0.1, 0.3011, 0.8}}}) {
    const int n = static_cast<int>(c.curvatures.size());
    const ArcsFit fit = fit_arcs(PieceFrame(arcs(c.curvatures, c.breaks)), n);
    ASSERT_EQ(fit.curvatures.size(), c.curvatures.size());
    ASSERT_EQ(fit.breaks.size(), c.breaks.size());
    for (std::size_t i = 0; i < c.curvatures.size(); ++i)
      EXPECT_NEAR(fit.curvatures[i], c.curvatures[i], 1e-5 * c.curvatures[i]) << n << ", " << i;
    for (std::size_t i = 0; i < c.breaks.size(); ++i)
      EXPECT_NEAR(fit.breaks[i], c.breaks[i], 1e-6) << n << ", " << i;
    EXPECT_LT(fit.deviation, 1e-8);
  }
}

// Curvature 3 - 2 s in one arc: none nearby is as near.
TEST(FitArcs, OneArcIsTheNearest) {
  const PieceFrame frame({{0, 1}, {3, 1}, {-2, -2}, {0, 2}});
  const ArcsFit fit = fit_arcs(frame, 1);
  ASSERT_EQ(fit.curvatures.size(), 1U);
  EXPECT_TRUE(fit.breaks.empty());
  const auto distance = [&](double curvature) {
    const int cells = frame.cells();
    return frame.displacement(Eigen::VectorXd::Constant(cells, curvature / cells)).norm();
  };
  EXPECT_NEAR(fit.deviation, distance(fit.curvatures[0]), 1e-12);
  EXPECT_LT(fit.deviation, distance(fit.curvatures[0] + 1e-3));
  EXPECT_LT(fit.deviation, distance(fit.curvatures[0] - 1e-3));
  EXPECT_GT(fit.deviation, 4 * fit_arcs(frame, 3).deviation);
}

TEST(FitArcs, OfALineAreEvenPartsOfIt) {
  const ArcsFit fit = fit_arcs(PieceFrame({{0, 1}, {0, 0}, {0, 0}, {0, 0}}), 3);
  EXPECT_EQ(fit.curvatures, (std::vector<double>{0, 0, 0}));
  ASSERT_EQ(fit.breaks.size(), 2U);
  EXPECT_NEAR(fit.breaks[0], 1.0 / 3, 1e-15);
  EXPECT_NEAR(fit.breaks[1], 2.0 / 3, 1e-15);
  EXPECT_NEAR(fit.deviation, 0, 1e-15);
}

}  // namespace
}  // namespace keyline::analysis::detail
