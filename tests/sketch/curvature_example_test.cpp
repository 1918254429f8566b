// [Sketch] section 6: three quintics from concatenated line segments, driven to curvatures as a
// hand draws them into the plot. What is reached is printed; docs/curvature-driven.md shows it.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "keyline/curve/jet.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/sketch/quintics.h"

namespace keyline::sketch {
namespace {

using fit::CurvatureTarget;

/// The roof of a car in four line segments: three quadratics, raised to quintics.
std::vector<curve::Bezier2> roof() {
  return elevated(quadratics({{0, 95}, {30, 47}, {85, 10}, {150, 0}, {215, 15}}, false));
}

double rms(const std::vector<CurvatureTarget>& points) {
  double sum = 0;
  for (const CurvatureTarget& t : points) sum += t.curvature * t.curvature;
  return std::sqrt(sum / static_cast<double>(points.size()));
}

double largest_jump(const std::vector<curve::Bezier2>& pieces) {
  double largest = 0;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
    largest =
        std::max(largest, std::abs(end_curvature(pieces[i]) - start_curvature(pieces[i + 1])));
  return largest;
}

struct DriveCase {
  const char* target;
  std::vector<CurvatureTarget> points;
  double
      free;  ///< largest rms error, as a share of the target's rms: what is reached, and a little
  double held;  ///< the same with the end held
};

const std::vector<DriveCase>& cases() {
  static const std::vector<DriveCase> kCases = {
      {"level", {{0, 0.005}, {1, 0.005}}, 0.0002, 0.11},
      {"falling", {{0, 0.0065}, {0.5, 0.005}, {1, 0.0035}}, 0.0002, 0.07},
      {"one swell",
       {{0, 0.003}, {0.25, 0.005}, {0.5, 0.006}, {0.75, 0.0057}, {1, 0.004}},
       0.0015,
       0.17},
      // five lengths a piece cannot follow these
      {"two swells",
       {{0, 0.0035}, {0.2, 0.006}, {0.45, 0.004}, {0.7, 0.006}, {0.9, 0.004}, {1, 0.0035}},
       0.005,
       0.09},
      {"a step", {{0, 0.0035}, {0.49, 0.0035}, {0.51, 0.0065}, {1, 0.0065}}, 0.075, 0.36},
  };
  return kCases;
}

TEST(CurvatureExample, ThreeSegmentsFollowWhatIsSpecified) {
  const auto pieces = roof();
  ASSERT_EQ(pieces.size(), 3U);
  ASSERT_GT(largest_jump(pieces), 0.002) << "the paper starts from curvature that jumps";
  for (const DriveCase& c : cases())
    for (const bool hold : {false, true}) {
      SCOPED_TRACE(std::string(c.target) + (hold ? ", end held" : ", end free"));
      const auto driven = fit::drive_curvature({pieces, 0}, c.points, {.hold_end = hold});
      ASSERT_TRUE(driven) << driven.error().message;
      const double size = rms(c.points);
      std::printf("%-10s end %s: rms %.1f %% -> %.2f %%, largest jump %.1f %%, end moved %.1f px\n",
                  c.target, hold ? "held" : "free", 100 * driven->before / size,
                  100 * driven->after / size, 100 * largest_jump(driven->chain.pieces) / size,
                  driven->end_moved);
      EXPECT_TRUE(driven->converged);
      EXPECT_LT(driven->after, 0.7 * driven->before);
      EXPECT_LT(driven->after, (hold ? c.held : c.free) * size);
      if (hold) {
        EXPECT_LT(driven->end_moved, 1e-9);
      }
      for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t k = 1; k < 6; ++k) {  // directions stay
          const core::Vector2 d = pieces[i].control[k] - pieces[i].control[k - 1];
          const auto& q = driven->chain.pieces[i].control;
          EXPECT_NEAR(core::cross(d, q[k] - q[k - 1]), 0, 1e-9 * core::norm(d) * 100);
          EXPECT_GT(core::dot(d, q[k] - q[k - 1]), 0);
        }
    }
}

}  // namespace
}  // namespace keyline::sketch
