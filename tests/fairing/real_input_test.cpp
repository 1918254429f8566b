#include "real_input.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "keyline/analysis/comb_figures.h"
#include "keyline/lac/chain/chain_graph.h"

#include "judge.h"
#include "tests/shared_data.h"

namespace keyline::fairing {
namespace {

using testing::Judgement;
using testing::RealLine;

/// KEYLINE_FULL=1 fairs everything; without it every `step`-th curve of the large families.
bool full() { return std::getenv("KEYLINE_FULL") != nullptr; }

/// Fails where the second opinion finds fault.
Judgement fair_and_judge(const RealLine& input, const FairOptions& options = {}) {
  SCOPED_TRACE(input.name);
  auto result = fair(input.line, options);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  const Judgement j = testing::judge(*result, input.line.points);
  EXPECT_EQ(j.fault, "");
  EXPECT_LE(j.length_ratio, 1.1);  // sparse points: a chain is longer than its polygon
  if (std::getenv("KEYLINE_TABLE"))
    std::printf("| %s | %zu | %d | %.2f |\n", input.name.c_str(), input.line.points.size(),
                j.pieces, j.deviation / result->tolerance);
  return j;
}

void fair_all(const std::vector<RealLine>& lines, std::size_t step = 1) {
  for (std::size_t i = 0; i < lines.size(); i += full() ? 1 : step) fair_and_judge(lines[i]);
}

class RealInput : public ::testing::Test {
 protected:
  void SetUp() override {
    KEYLINE_NEEDS_SHARED_DATA(testing::real_files_present(), KEYLINE_SHARED_DATA);
  }
};

TEST_F(RealInput, Airfoils) { fair_all(testing::profiles("airfoil")); }
TEST_F(RealInput, Tracks) { fair_all(testing::profiles("track")); }
TEST_F(RealInput, Contours) { fair_all(testing::profiles("contour"), 4); }
TEST_F(RealInput, BezierCars) { fair_all(testing::bezier_cars()); }
TEST_F(RealInput, HullStations) { fair_all(testing::hull_stations(), 4); }
TEST_F(RealInput, CarSections) { fair_all(testing::car_sections()); }

/// What lies within a tolerance lies within a larger one, with as many waves as it has. Pieces and
/// arcs let swings of the calm curve grow that were too low to be seen.
TEST_F(RealInput, ALargerToleranceTakesNoMoreWaves) {
  const acquire::KeyLine line = testing::profile("airfoil/hq17.dat").line;
  const auto waves = [&](double errors) {
    FairOptions options;
    options.tolerance = errors * line.noise;
    return fair(line, options).value().fairness.answer.waves;
  };
  EXPECT_LE(waves(4.81), waves(4.4));
  EXPECT_LE(waves(10.53), waves(9.65));
}

/// A sharp trailing edge is one place for both ends of the outline. Where it is chosen half way
/// between them whatever the curve, a wave is needed to come there; the smoothest quintic spline
/// (FITPACK) within the same tolerance has one wave.
TEST_F(RealInput, NoWaveIsBoughtByWhereEndsMeet) {
  for (const RealLine& input : testing::profiles("airfoil")) {
    if (input.name.find("goe387") == std::string::npos) continue;
    const FairResult result = fair(input.line).value();
    ASSERT_EQ(result.curves.size(), 1U);
    const auto& chain = std::get<lac::Chain>(result.curves[0]);
    EXPECT_EQ(analysis::comb_figures(lac::curvature_graph(chain)).waves, 1);
    const core::Point2 end = lac::end_pose(chain).position;
    EXPECT_LT(core::distance(end, chain.start.position), 1e-9);
    EXPECT_TRUE(result.within_tolerance);
    // Joints of one rate are solved for without regard to the noise.
    FairOptions smooth;
    smooth.joints = JointOrder::g3;
    const FairResult joined = fair(input.line, smooth).value();
    for (const std::string& note : joined.notes)
      EXPECT_EQ(note.find("the points' noise"), std::string::npos) << note;
    return;
  }
  ADD_FAILURE() << "no goe387 among the airfoils";
}

/// Tolerances at which the pieces of a bottle's calmest curve did not fit into the tenth of the
/// tolerance that was left for them, and the shortest chain stood in with 1e5 times the energy.
TEST_F(RealInput, PiecesHaveRoomAtEveryTolerance) {
  for (const RealLine& input : testing::profiles("contour")) {
    if (input.name.find("brahma") == std::string::npos) continue;
    for (const double sigmas : {1.19, 8.85, 9.65}) {
      FairOptions options;
      options.sigmas = sigmas;
      const FairResult result = fair(input.line, options).value();
      EXPECT_TRUE(result.within_tolerance) << sigmas;
      for (const std::string& note : result.notes)
        EXPECT_EQ(note.find("did not come out"), std::string::npos) << sigmas;
    }
  }
}

/// The curvature of an aerofoil turns at its nose. Waves between its few points there, each of
/// which departs by many tolerances where nothing gives way, are asked for by none of them.
TEST_F(RealInput, WavesBetweenPointsThatStandApartGo) {
  const acquire::KeyLine line = testing::profile("airfoil/e387.dat", "").line;
  for (const double errors : {1.69, 2.19, 2.85, 4.04}) {
    FairOptions options;
    options.tolerance = errors * line.noise;
    const FairResult result = fair(line, options).value();
    EXPECT_TRUE(result.within_tolerance) << errors;
    EXPECT_EQ(result.fairness.answer.waves, 1) << errors;
    EXPECT_LT(result.fairness.answer.energy, 6e7) << errors;
  }
}

/// What lies within a tolerance lies within a larger one, so that the variation falls. At 1.55
/// standard deviations pieces with bows of a third of the tolerance do not fit, and the shortest
/// chain would stand in with 2,000 times the energy. At 10.53 pieces that are tied to the trailing
/// edge were given up while a foot stood at an open joint, and the shortest stood in with 22,000.
TEST_F(RealInput, ALargerToleranceCostsNoMoreVariation) {
  struct Case {
    const char* file;
    const char* id;
    std::vector<double> errors;
  };
  for (const Case& c : {Case{"contour/bot_open.csv", "jupiler", {1.42, 1.55, 1.69}},
                        Case{"airfoil/su-26m.dat", "", {9.654, 10.533, 11.493}}}) {
    const acquire::KeyLine line = testing::profile(c.file, c.id).line;
    analysis::CombFigures before{.waves = 0, .energy = HUGE_VAL, .jolt = 0};
    for (const double errors : c.errors) {
      FairOptions options;
      options.tolerance = errors * line.noise;
      const analysis::CombFigures now = fair(line, options).value().fairness.answer;
      const int fewer = std::max(0, before.waves - now.waves);  // each is worth twice the energy
      EXPECT_LE(now.energy, std::ldexp(before.energy, fewer)) << c.file << ' ' << errors;
      before = now;
    }
  }
}

/// The shortest chain within 0.05 % of the length: what a rough version once reached; ours may not
/// need more.
TEST_F(RealInput, NoMorePiecesThanTheFirstTrials) {
  struct Case {
    const char* file;
    const char* id;
    std::size_t every;
    int most;
  };
  for (const Case& c :
       {Case{"airfoil/hq17.dat", "", 1, 10}, Case{"airfoil/e387.dat", "", 1, 8},
        Case{"contour/hearts_open.csv", "", 1, 18}, Case{"contour/trilo_open.csv", "", 1, 16},
        Case{"track/Norisring.csv", "", 2, 29}}) {
    const RealLine input = testing::profile(c.file, c.id, c.every);
    const double length = input.line.length;
    FairOptions options;
    options.criterion = Criterion::fewest_pieces;
    options.tolerance = std::max(
        5e-4 * length, default_tolerance(input.line.noise, length, input.line.points.size()));
    EXPECT_LE(fair_and_judge(input, options).pieces, c.most) << c.file;
  }
}

}  // namespace
}  // namespace keyline::fairing
