#include "tests/shared_data.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/section.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/numeric/random.h"

namespace keyline::acquire {
namespace {

namespace fs = std::filesystem;

enum class Kind { airfoil, outline, open };

struct SharedCase {
  const char* file;
  Kind kind;
  double noise_low;  // of every curve in the file
  double noise_high;
};

// Airfoils run from trailing edge to trailing edge; noise of coordinates rounded to 1e-5 is about
// 3e-6, of measured sections up to 3e-4, of integer pixels 0.2 to 0.8.
constexpr SharedCase kCases[] = {
    {"airfoil/e387.dat", Kind::airfoil, 2e-6, 2e-5},
    {"airfoil/eiffel371.dat", Kind::airfoil, 2e-6, 2e-5},
    {"airfoil/fx63145.dat", Kind::airfoil, 2e-6, 3e-4},
    {"airfoil/goe387.dat", Kind::airfoil, 2e-6, 4e-4},
    {"airfoil/hq17.dat", Kind::airfoil, 2e-6, 2e-4},
    {"airfoil/joukowsk.dat", Kind::airfoil, 2e-7, 5e-6},
    {"airfoil/naca2412.dat", Kind::airfoil, 1e-8, 2e-5},
    {"airfoil/su-26m.dat", Kind::airfoil, 2e-6, 4e-5},
    {"track/Monza.csv", Kind::outline, 1e-7, 1e-3},
    {"track/Norisring.csv", Kind::outline, 1e-7, 1e-3},
    {"track/Spa.csv", Kind::outline, 1e-7, 1e-3},
    {"contour/bot_open.csv", Kind::outline, 0.2, 0.8},
    {"contour/hearts_open.csv", Kind::outline, 2e-5, 1.2e-3},
    {"contour/mosquito_open.csv", Kind::outline, 2e-6, 2e-3},
    {"contour/nsfishes_open.csv", Kind::outline, 0.2, 0.8},
    {"contour/trilo_open.csv", Kind::outline, 2e-3, 4e-2},
    {"contour/olea_open.csv", Kind::open, 2e-5, 3e-3},
};

class SharedData : public testing::Test {
 protected:
  void SetUp() override { KEYLINE_NEEDS_SHARED_DATA(fs::exists(folder_), folder_); }
  fs::path folder_ = fs::path(KEYLINE_SHARED_DATA);
};

TEST_F(SharedData, ProfilesBecomeKeyLines) {
  for (const SharedCase& c : kCases) {
    const auto curves = exchange::read_points(folder_ / "1_profiles" / c.file);
    ASSERT_TRUE(curves) << c.file;
    for (const RawCurve& raw : *curves) {
      SCOPED_TRACE(std::string(c.file) + " " + raw.id);
      const auto line = acquire_key_line(raw);
      ASSERT_TRUE(line) << line.error().message;
      EXPECT_FALSE(line->report.reordered);
      EXPECT_LE(line->report.outliers, 1u);
      EXPECT_GE(line->noise, c.noise_low);
      EXPECT_LE(line->noise, c.noise_high);
      if (c.kind == Kind::outline) {
        EXPECT_TRUE(line->closed || line->ends_meet);
      } else {
        EXPECT_FALSE(line->closed);
        EXPECT_TRUE(line->corners.empty());
      }
    }
  }
}

TEST_F(SharedData, ShuffledOutlinesComeBackInOrder) {
  for (const char* file : {"contour/hearts_open.csv", "track/Norisring.csv"}) {
    const auto curves = exchange::read_points(folder_ / "1_profiles" / file);
    ASSERT_TRUE(curves) << file;
    for (const RawCurve& raw : *curves) {
      SCOPED_TRACE(std::string(file) + " " + raw.id);
      RawCurve mixed = raw;
      numeric::Random random(5);
      for (std::size_t i = mixed.points.size() - 1; i > 0; --i) {
        std::swap(mixed.points[i], mixed.points[random.index(i + 1)]);
      }
      const auto straight = acquire_key_line(raw);
      const auto line = acquire_key_line(mixed);
      ASSERT_TRUE(line);
      ASSERT_TRUE(straight);
      EXPECT_TRUE(line->report.reordered);
      EXPECT_TRUE(line->closed);
      EXPECT_EQ(line->points.size(), straight->points.size());
      EXPECT_NEAR(line->length, straight->length, 1e-9 * straight->length);
    }
  }
}

TEST_F(SharedData, CarCloudsGiveTheirCentreLine) {
  for (const char* car : {"073", "215", "240"}) {
    SCOPED_TRACE(car);
    const fs::path file =
        folder_ / "5_car3d" / ("drivaernet_N_S_WWS_WM_" + std::string(car) + ".xyz");
    const auto clouds = exchange::read_points(file);
    ASSERT_TRUE(clouds) << clouds.error().message;
    const auto section = section_plane(clouds->front(), Axis::y, 0, 0.03);
    ASSERT_TRUE(section) << section.error().message;
    const auto line = acquire_key_line(*section);
    ASSERT_TRUE(line) << line.error().message;
    EXPECT_EQ(line->plane.axis_y, (core::Vector3{0, 0, 1}));
    EXPECT_TRUE(line->report.reordered);
    EXPECT_TRUE(line->closed);
    EXPECT_GE(line->points.size() + 10, section->points.size());
    // Once round a car 4.7 m long and 1.3 m high, without going back and forth.
    EXPECT_GT(line->length, 10.0);
    EXPECT_LT(line->length, 11.5);
    EXPECT_LT(line->noise, 1e-3);
  }
}

}  // namespace
}  // namespace keyline::acquire
