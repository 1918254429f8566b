#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/mirror.h"
#include "keyline/fairing/symmetric_run.h"

#include "truth.h"

/// What mirrors within its noise is told, and the answer mirrors exactly.
namespace keyline::fairing {
namespace {

using core::Point2;
using ::testing::HasSubstr;
using testing::line_through;

/// Places the shape, drawn about the x axis, about this line.
struct Placed {
  core::Pose2 axis{{3, -2}, 0.7};
  double size = 10;
  Point2 operator()(Point2 p) const {
    const core::Vector2 along = core::unit_vector(axis.direction);
    return axis.position + size * p.x * along + size * p.y * core::perpendicular_left(along);
  }
};

constexpr double kNoise = 0.005;  // of the points, in x and y

/// Points at uneven angles of a lobed outline r = 1 + 0.3 cos a + 0.15 cos 2a + `skew` sin 2a,
/// which is symmetric about the x axis where skew is 0.
std::vector<Point2> lobed(double skew, int count, double from, double to, unsigned seed,
                          const Placed& place = {}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0, kNoise);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i) {
    const double a = from + (to - from) * (i + 0.5 + jitter(random)) / count;
    const double r = 1 + 0.3 * std::cos(a) + 0.15 * std::cos(2 * a) + skew * std::sin(2 * a);
    const Point2 p = place({r * std::cos(a), r * std::sin(a)});
    points.push_back({p.x + error(random), p.y + error(random)});
  }
  return points;
}

FairOptions exactly() {
  FairOptions options;
  options.symmetric = Symmetric::from_text("auto").value();
  return options;
}

acquire::KeyLine outline(double skew = 0, unsigned seed = 7, const Placed& place = {}) {
  acquire::KeyLine line = line_through(lobed(skew, 120, 0.2, 0.2 + 2 * core::kPi, seed, place));
  line.closed = true;
  return line;
}

std::vector<Point2> polygon_of(const FairResult& result) {
  std::vector<Point2> polygon;
  for (const FairCurve& member : result.curves)
    for (int i = 0; i <= 8000; ++i)
      polygon.push_back(std::visit([&](const auto& c) { return evaluate(c, i / 8000.0); }, member));
  return polygon;
}

double distance_to(const std::vector<Point2>& polygon, Point2 p) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const core::Vector2 along = polygon[i] - polygon[i - 1];
    const double square = core::dot(along, along);
    const double u =
        square > 0 ? std::clamp(core::dot(p - polygon[i - 1], along) / square, 0.0, 1.0) : 0;
    least = std::min(least, core::distance(p, polygon[i - 1] + u * along));
  }
  return least;
}

/// The farthest that an image of the answer's lies beside the answer.
double asymmetry(const FairResult& result, core::Pose2 axis) {
  const std::vector<Point2> polygon = polygon_of(result);
  double most = 0;
  for (std::size_t i = 0; i < polygon.size(); i += 40)
    most = std::max(most, distance_to(polygon, mirrored(axis, polygon[i])));
  return most;
}

core::Pose2 axis_of(const FairResult& result) {
  return {result.symmetry->point, result.symmetry->direction};
}

TEST(Symmetry, IsFoundWithinTheNoiseAndGivenExactly) {
  const Placed place;
  const FairResult result = fair(outline(), exactly()).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_TRUE(result.symmetry->exact);
  // The line is known as well as so many points tell it.
  EXPECT_NEAR(std::remainder(result.symmetry->direction - place.axis.direction, core::kPi), 0,
              3 * kNoise / place.size);
  EXPECT_NEAR(beside(place.axis, result.symmetry->point), 0, 3 * kNoise);
  EXPECT_GT(result.symmetry->rms, 0.5 * kNoise);
  EXPECT_LT(result.symmetry->rms, 2 * kNoise);
  EXPECT_LT(asymmetry(result, axis_of(result)), 1e-7 * result.length);
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_THAT(result.notes, ::testing::Contains(HasSubstr("the answer is exactly symmetric")));
  for (const auto& joint : result.joints) EXPECT_GE(joint.order, 2);
}

TEST(Symmetry, IsNotMadeUpWhereThereIsNone) {
  const FairResult result = fair(outline(0.01), exactly()).value();
  EXPECT_FALSE(result.symmetry.has_value());
  EXPECT_GT(asymmetry(result, Placed{}.axis), 0.02);
}

TEST(Symmetry, TellsItsLineWithoutAMinusBeforeZero) {
  EXPECT_EQ(detail::told({{1, 2}, -1e-6}), "(1, 2) at 0.00 degrees");
  EXPECT_EQ(detail::told({{1, 2}, core::kPi - 1e-6}), "(1, 2) at 0.00 degrees");
  EXPECT_EQ(detail::told({{1, 2}, -0.25 * core::kPi}), "(1, 2) at -45.00 degrees");
  for (const double upright : {-0.5, 0.5, 1.5})
    EXPECT_EQ(detail::told({{1, 2}, upright * core::kPi}), "(1, 2) at 90.00 degrees");
}

TEST(Symmetry, IsOnlyToldWhereItIsNotAskedFor) {
  const FairResult result = fair(outline(), {}).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_FALSE(result.symmetry->exact);
  EXPECT_THAT(result.notes, ::testing::Contains(HasSubstr("symmetric about the line")));
  EXPECT_THAT(result.notes, ::testing::Contains(HasSubstr("symmetric: auto")));
  EXPECT_GT(asymmetry(result, axis_of(result)), 1e-5 * result.length);
}

/// An arc or a line across the line of symmetry is one piece.
TEST(Symmetry, AnArcIsNotCutInTwo) {
  const lac::Chain arc{{{0, 0}, 0.6}, {{-1, 260, -1 / 900.0, -1 / 900.0}}, false};
  const FairResult result =
      fair(line_through(testing::measure(arc, 130, 4e-4, 5)), exactly()).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_TRUE(result.symmetry->exact);
  EXPECT_EQ(result.pieces.size(), 1U);
}

TEST(Symmetry, AboutAGivenLine) {
  const Placed upright{{{2, 0}, core::kPi / 2}, 10};
  FairOptions options;
  options.symmetric = Symmetric::from_text("x=2").value();
  const FairResult result = fair(outline(0, 7, upright), options).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_LT(asymmetry(result, {{2, 5}, core::kPi / 2}), 1e-7 * result.length);
  EXPECT_TRUE(result.within_tolerance);

  options.symmetric = Symmetric::from_text("x=2.3").value();
  const auto refused = fair(outline(0, 7, upright), options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().path, "symmetric");
  EXPECT_THAT(refused.error().message, HasSubstr("not symmetric about that line"));
}

// Both ends of an exact arch are one point of its half.
TEST(Symmetry, OfAnExactOpenLineIsCalm) {
  for (const double width : {1.0, 2.0, 3.5}) {
    std::vector<core::Point2> points;
    for (int i = 0; i < 40; ++i) {
      const double t = (i - 19.5) / 19.5;
      points.push_back({2 * t, std::cos(width * t) + 0.2 * std::pow(t, 4)});
    }
    const FairResult result = fair(line_through(points), exactly()).value();
    ASSERT_TRUE(result.symmetry.has_value()) << width;
    EXPECT_FALSE(result.calm_missed) << width;
    EXPECT_TRUE(result.fairness.fair) << width;
    EXPECT_LT(asymmetry(result, axis_of(result)), 1e-7 * result.length) << width;
  }
}

TEST(Symmetry, OfAnOpenLineWhoseEndsChangePlaces) {
  // From 100 degrees before the tip to 100 degrees after it; ends stay free.
  const auto points = lobed(0, 80, -1.75, 1.75, 11);
  const FairResult result = fair(line_through(points), exactly()).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_LT(asymmetry(result, axis_of(result)), 1e-7 * result.length);
  EXPECT_TRUE(result.within_tolerance);
}

/// A heart: corners on its line of symmetry at both ends of a half, noise on every point.
acquire::KeyLine heart() {
  std::mt19937_64 random(5);
  std::normal_distribution<double> error(0, 0.002);
  acquire::KeyLine line;
  const int n = 60;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < n; ++i) {
      const double t = side == 0 ? 1.0 * i / n : 1 - 1.0 * i / n;  // 0: notch, 1: tip
      const double a = core::kPi * t;
      const double x = 4 * std::sin(a) * (1 - 0.3 * t);
      const double y = 6 * (1 - t) + 1.5 * std::sin(a) - 2;
      line.points.push_back({(side == 0 ? x : -x) + error(random), y + error(random)});
    }
  acquire::KeyLine judged = line_through(line.points);
  judged.closed = true;
  judged.corners = {0, static_cast<std::size_t>(n)};
  return judged;
}

TEST(Symmetry, KeepsCornersThatStandOnTheLine) {
  const FairResult result = fair(heart(), exactly()).value();
  ASSERT_TRUE(result.symmetry.has_value());
  EXPECT_EQ(result.curves.size(), 2U);
  EXPECT_LT(asymmetry(result, axis_of(result)), 1e-7 * result.length);
  EXPECT_TRUE(result.within_tolerance);
  for (const FairCurve& member : result.curves)
    EXPECT_LT(std::abs(beside(axis_of(result), std::get<lac::Chain>(member).start.position)),
              1e-9 * result.length);
}

TEST(Symmetry, DoesNotDependOnSizeOrPlace) {
  const FairResult one = fair(outline(), {}).value();
  acquire::KeyLine moved = outline();
  std::vector<Point2> points;
  for (const Point2 p : moved.points) points.push_back({-1000 * p.y + 500, 1000 * p.x});
  moved = line_through(points);
  moved.closed = true;
  const FairResult other = fair(moved, {}).value();
  ASSERT_TRUE(one.symmetry.has_value());
  ASSERT_TRUE(other.symmetry.has_value());
  EXPECT_NEAR(std::remainder(other.symmetry->direction - one.symmetry->direction - core::kPi / 2,
                             core::kPi),
              0, 1e-6);
  EXPECT_NEAR(other.symmetry->rms, 1000 * one.symmetry->rms, 1e-3 * other.symmetry->rms);
}

TEST(Symmetry, DoesNotGoWithWhatWouldBreakIt) {
  FairOptions options;
  options.symmetric = Symmetric::from_text("y=0").value();
  options.pieces = 8;
  const auto refused = fair(outline(), options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().path, "symmetric");
  EXPECT_THAT(refused.error().message, HasSubstr("the shortest chain"));
}

TEST(Symmetry, IsReadFromText) {
  EXPECT_EQ(Symmetric::from_text("auto").value().mode, SymmetricMode::found);
  EXPECT_EQ(Symmetric::from_text("off").value().mode, SymmetricMode::off);
  const Symmetric level = Symmetric::from_text("y=-2.5").value();
  EXPECT_EQ(level.mode, SymmetricMode::line);
  EXPECT_EQ(level.point, (Point2{0, -2.5}));
  EXPECT_EQ(level.direction, 0);
  const Symmetric slanted = Symmetric::from_text("1,2:45").value();
  EXPECT_EQ(slanted.point, (Point2{1, 2}));
  EXPECT_DOUBLE_EQ(slanted.direction, core::kPi / 4);
  for (const char* wrong : {"", "line", "x", "x=", "z=1", "x=a", "1,2", "1:2", "1,2:", "1,nan:3"})
    EXPECT_FALSE(Symmetric::from_text(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace keyline::fairing
