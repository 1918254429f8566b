#include "keyline/lac/space/space_steer.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/lac/segment/piece_shape.h"

/// Quick shots of space curves and how far they miss, against the exact curve.
namespace keyline::lac::detail {
namespace {

using core::Vector3;

TEST(Carried, IsTheStandardFormsPower) {
  // y^-p = x^-p + p d, signed for p < 0; an exponential for p = 0.
  EXPECT_NEAR(carried(2, 1, 0.5), 1 / (0.5 + 0.5), 1e-15);
  EXPECT_NEAR(carried(2, 2, 0.5), 1 / std::sqrt(0.25 + 1), 1e-15);
  EXPECT_NEAR(carried(-2, 2, 0.5), -1 / std::sqrt(0.25 + 1), 1e-15);
  EXPECT_NEAR(carried(2, 0, 0.5), 2 * std::exp(-0.5), 1e-15);
  EXPECT_NEAR(carried(2, -1, 3), 2 - 3, 1e-15);
  EXPECT_NEAR(carried(2, -2, 0.5), std::sqrt(3), 1e-15);
  EXPECT_NEAR(carried(2, -2, 4), -std::sqrt(4), 1e-15);
  EXPECT_TRUE(std::isnan(carried(2, 1, -0.6)));                   // 0.5 - 0.6: past the end
  EXPECT_NEAR(carried(2, -1e-9, 0.5), 2 * std::exp(-0.5), 3e-9);  // no digits lost next to 0
  EXPECT_NEAR(carried(3, -1e-11, 0.7), 3 * std::exp(-0.7), 1e-10);
  EXPECT_EQ(carried(0, -2, 8), -4);
  EXPECT_NEAR(carried(1e-200, -2, 8), -4, 1e-14);
  EXPECT_EQ(carried(2, 1, 0), 2);
  EXPECT_EQ(carried(0, 1, 5), 0);
}

/// The exact curve in the standard frame with those unknowns.
SpaceFrame exact(SpaceStandardForm form, const SpaceUnknowns& x) {
  form.lambda = x.bend / x.length;
  form.nu = start_torsion(form.beta, form.omega, x).value() / x.length;
  const SpacePiece piece = standard_piece(form, x.length).value();
  SpaceFrame end = frame_at({{}, {piece}}, 1);
  end.position = {end.position.x / x.length, end.position.y / x.length, end.position.z / x.length};
  return end;
}

const std::vector<SpaceStandardForm> kForms{{-1, -1, 0, 0.3, 0},
                                            {0.5, 1.5, 0, 0.2, 0},
                                            {-2, 0, 0, -0.4, 0},
                                            {2, -0.5, 0, 0.5, 0},
                                            {-1, -1, 0, 0, 0}};
const SpaceUnknowns kPlace{0.4, 0.9, 1.7};

TEST(SpaceShooting, EndsWhereTheCurveDoes) {
  for (const SpaceStandardForm& form : kForms) {
    const auto shot = shoot_space(form, kPlace);
    ASSERT_TRUE(shot);
    const SpaceFrame end = exact(form, kPlace);
    EXPECT_NEAR(norm(shot->chord - (end.position - core::Point3{})), 0, 1e-6);
    EXPECT_NEAR(norm(shot->tangent - end.tangent), 0, 1e-6);
  }
  // Through an inflection too.
  const auto shot = shoot_space({-2, -1, 0, 0.3, 0}, {0.9, 0.5, 2.0});
  ASSERT_TRUE(shot);
  const SpaceFrame end = exact({-2, -1, 0, 0.3, 0}, {0.9, 0.5, 2.0});
  EXPECT_NEAR(norm(shot->chord - (end.position - core::Point3{})), 0, 1e-5);
}

// Curvature that grows by 16 times next to where it would be infinite, torsion likewise from the
// other end; curvature next to a zero outside the curve.
TEST(SpaceShooting, FollowsSharpEnds) {
  for (const auto& [form, x] :
       {std::pair{SpaceStandardForm{2.8, 1, 0, -22, 0}, SpaceUnknowns{-0.357, 0.12, 0.43}},
        {{3, 2.3, 0, 0.4, 0}, {60, 1.1, 8}},
        {{-3, -0.07, 0, 3, 0}, {-900, 0.8, 0.1}}}) {
    const auto shot = shoot_space(form, x);
    ASSERT_TRUE(shot);
    const SpaceFrame end = exact(form, x);
    EXPECT_NEAR(norm(shot->chord - (end.position - core::Point3{})), 0, 1e-5) << form.alpha;
    EXPECT_NEAR(norm(shot->tangent - end.tangent), 0, 1e-5) << form.alpha;
  }
}

TEST(SpaceShooting, DerivativesAreDifferences) {
  constexpr double h = 1e-4;
  for (const SpaceStandardForm& form : kForms)
    for (int unknown = 0; unknown < 3; ++unknown) {
      const auto at = [&](double by) {
        SpaceUnknowns x = kPlace;
        (unknown == 0 ? x.bend : unknown == 1 ? x.twist : x.length) += by;
        return exact(form, x);
      };
      const SpaceFrame up = at(h), down = at(-h);
      const auto shot = shoot_space(form, kPlace);
      const Vector3 chord = (up.position - down.position) / (2 * h);
      const Vector3 tangent = (up.tangent - down.tangent) / (2 * h);
      EXPECT_NEAR(norm(shot->chord_by[unknown] - chord), 0, 5e-4) << form.alpha << unknown;
      EXPECT_NEAR(norm(shot->tangent_by[unknown] - tangent), 0, 1e-3) << form.alpha << unknown;
    }
}

// The torsion comes to the twist: its mean times the length.
TEST(SpaceShooting, TorsionIsTheTwistInAll) {
  for (const SpaceStandardForm& form : kForms) {
    const double start = start_torsion(form.beta, form.omega, kPlace).value();
    const double rate = form.omega == 0 ? 0 : form.omega * std::pow(kPlace.length, 1 - form.beta);
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double w = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps);
      sum += w * carried(start, form.beta, rate * i / kSteps);
    }
    EXPECT_NEAR(sum, kPlace.twist, 1e-9) << form.beta;
  }
  EXPECT_EQ(start_torsion(1, 0, {0, 0.7, 1}), 0.7);
  EXPECT_EQ(start_torsion(1, 0.3, {0, 0, 1}), 0);
}

}  // namespace

namespace space {
namespace {

TEST(ChordFrame, IsOrthonormalWithItsSideInIt) {
  const ChordFrame f = chord_frame({0, 0, 2}, {1, 0, 5});
  EXPECT_EQ(f.x, (Vector3{0, 0, 1}));
  EXPECT_NEAR(norm(f.y - Vector3{1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(f.z - Vector3{0, 1, 0}), 0, 1e-15);
  for (const Vector3 chord : {Vector3{1, 0, 0}, {0, 3, 0}, {1, 1, 1}}) {
    const ChordFrame own = chord_frame(chord, chord);  // no side of its own
    EXPECT_NEAR(dot(own.x, own.y), 0, 1e-15);
    EXPECT_NEAR(norm(own.y), 1, 1e-15);
    EXPECT_NEAR(norm(cross(own.x, own.y) - own.z), 0, 1e-15);
  }
  EXPECT_NEAR(norm(into(f, from(f, {1, 2, 3})) - Vector3{1, 2, 3}), 0, 1e-14);
}

// A right angle at the start, 60 degrees at the end, turned about the chord by what is told.
TEST(SettingOf, MeasuresAnglesAndTwist) {
  const double pi = std::numbers::pi;
  for (const double twist : {0.4, 2.0, -0.4, -2.0}) {
    SpaceHermite data;
    data.start = {1, 2, 3};
    data.end = {5, 2, 3};
    data.start_tangent = {0, 7, 0};
    const double s = std::sin(pi / 3);
    data.end_tangent = {2 * std::cos(pi / 3), -2 * s * std::cos(twist), -2 * s * std::sin(twist)};
    const auto setting = setting_of(data, -1, -1, 0);
    ASSERT_TRUE(setting);
    EXPECT_NEAR(setting->wanted.first, pi / 2, 1e-14);
    EXPECT_NEAR(setting->wanted.last, pi / 3, 1e-14);
    EXPECT_NEAR(setting->wanted.twist, std::abs(twist), 1e-14);
    EXPECT_EQ(setting->mirrored, twist < 0);
    EXPECT_FALSE(setting->planar);
    EXPECT_NEAR(norm(setting->data.start_tangent), 1, 1e-15);
    data.end_tangent = {0.5, -s, 0};
    EXPECT_TRUE(setting_of(data, -1, -1, 0)->planar);
    EXPECT_FALSE(setting_of(data, -1, -1, 0)->mirrored);
  }
}

TEST(SettingOf, SaysWhatIsNoData) {
  const auto sound = [](auto change) {
    SpaceHermite data;
    data.end = {1, 0, 0};
    double alpha = -1;
    change(data, alpha);
    return setting_of(data, alpha, -1, 0).has_value();
  };
  EXPECT_TRUE(sound([](auto&, auto&) {}));
  EXPECT_FALSE(sound([](auto&, auto& a) { a = HUGE_VAL; }));
  EXPECT_FALSE(sound([](auto& d, auto&) { d.start.x = HUGE_VAL; }));
  EXPECT_FALSE(sound([](auto& d, auto&) { d.end = d.start; }));
  EXPECT_FALSE(sound([](auto& d, auto&) { d.end_tangent = {}; }));
  EXPECT_FALSE(sound([](auto& d, auto&) { d.start_tangent = {HUGE_VAL, 0, 0}; }));
}

// None where the curve is as wanted; turned by an angle, as large as that.
TEST(MissOf, IsTheAngleMissed) {
  const Invariants wanted{0.7, 0.9, 0.5};
  const Vector3 chord{std::cos(0.7), std::sin(0.7), 0};
  // The start tangent (1, 0, 0) lies clockwise of the chord: y towards it is (sin, -cos, 0).
  const ChordFrame f = chord_frame(chord, {1, 0, 0});
  const auto tangent = [&](double last, double twist) {
    const double s = std::sin(last);
    return from(f, {std::cos(last), -s * std::cos(twist), -s * std::sin(twist)});
  };
  EXPECT_NEAR(size_of(miss_of(chord, tangent(0.9, 0.5), wanted)), 0, 1e-15);
  const Miss first = miss_of({std::cos(0.8), std::sin(0.8), 0}, tangent(0.9, 0.5), wanted);
  EXPECT_NEAR(first[0], 0.1, 1e-14);
  EXPECT_NEAR(miss_of(chord, tangent(1.0, 0.5), wanted)[1], 0.1, 1e-14);
  EXPECT_NEAR(miss_of(chord, tangent(1.0, 0.5), wanted)[2], 0, 1e-14);
  const Miss around = miss_of(chord, tangent(0.9, 0.51), wanted);
  EXPECT_NEAR(around[2], 0.01 * std::sin(0.9), 1e-5);
  EXPECT_NEAR(around[1], 0, 1e-4);
}

TEST(Steer, MeetsTheDataOfAKnownCurve) {
  const SpaceStandardForm form{-1, 0.5, 0, 0.2, 0};
  const SpaceUnknowns truth{0.3, 0.6, 1.2};
  const auto shot = shoot_space(form, truth);
  ASSERT_TRUE(shot);
  const ChordFrame f = chord_frame(shot->chord, {1, 0, 0});
  const Vector3 end = into(f, shot->tangent);
  const Invariants wanted{std::acos(unit(shot->chord).x), std::acos(end.x),
                          std::atan2(-end.z, -end.y)};
  SpaceUnknowns x{0.1, 0.4, 1.0};
  int iterations = 0;
  ASSERT_TRUE(steer(form, wanted, 1e-9, x, iterations));
  EXPECT_GT(iterations, 1);
  EXPECT_NEAR(x.bend, truth.bend, 1e-6);
  EXPECT_NEAR(x.twist, truth.twist, 1e-6);
  EXPECT_NEAR(x.length, truth.length, 1e-6);
}

TEST(Steer, StepsAreTakenInShares) {
  const SpaceUnknowns x{1, 2, 3};
  const SpaceUnknowns whole = moved(x, {0.5, -1, 0.3}, 1);
  EXPECT_EQ(whole.bend, 0.5);
  EXPECT_EQ(whole.twist, 3);
  EXPECT_NEAR(whole.length, 3 * std::exp(-0.1), 1e-15);
  EXPECT_NEAR(moved(x, {0, 0, 99}, 0.5).length, 3 * std::exp(-0.5), 1e-15);
  EXPECT_TRUE(reasonable(-1, {0, 0, 1}));
  EXPECT_FALSE(reasonable(-1, {0, 0, 100}));
  EXPECT_FALSE(reasonable(-1, {0, 0, 1e-6}));
  EXPECT_FALSE(reasonable(-1, {HUGE_VAL, 0, 1}));
  EXPECT_FALSE(reasonable(-1, {0, 4 * std::numbers::pi, 1}));
  EXPECT_TRUE(reasonable(-1, {0, -12.5, 1}));
  // The curvature falls at once: many radii of the start long, and turning little.
  EXPECT_TRUE(reasonable(2, {1e4, 0, 200}));
  EXPECT_FALSE(reasonable(2, {1e4, 0, 20000}));
  EXPECT_FALSE(reasonable(2, {-0.6, 0, 1}));  // past the end
}

// Torsion (t / 2)^(-1 / 2) is infinite at one end and comes to 2 sqrt(2).
TEST(Steer, TorsionThatBecomesInfiniteComesToSoMuch) {
  const SpaceStandardForm form{-1, 2, 0, 0.25, 0};
  EXPECT_NEAR(most_twist(form, 1), 2 * std::sqrt(2), 1e-14);
  EXPECT_NEAR(most_twist({-1, 2, 0, -0.25, 0}, 1), 2 * std::sqrt(2), 1e-14);
  EXPECT_TRUE(std::isinf(most_twist({-1, 1, 0, 0.25, 0}, 1)));
  EXPECT_TRUE(std::isinf(most_twist({-1, 2, 0, 0, 0}, 1)));
  EXPECT_TRUE(start_torsion(2, 0.25, {0, 2.8, 1}));
}

// However long, a step ends within the family; a short one is that of the unknowns.
TEST(Steer, StepsStayWithinTheFamily) {
  for (const double alpha : {0.5, 2.0, 0.0, -1.5}) {
    const SpaceStandardForm form{alpha, 2, 0, 0.25, 0};
    const SpaceUnknowns x{-0.3, 2.0, 1};
    const SpaceUnknowns far = moved_within(form, x, {5, -4, 0.3}, 1);
    EXPECT_GT(1 + alpha * far.bend, alpha > 0 ? 0 : -HUGE_VAL);
    EXPECT_LT(far.twist, most_twist(form, far.length));
    EXPECT_GT(far.twist, x.twist);
    const Miss step{3e-6, -2e-6, 1e-6};
    const SpaceUnknowns near = moved_within(form, x, step, 1);
    EXPECT_NEAR(near.bend, x.bend - step[0], 1e-10);
    EXPECT_NEAR(near.twist, x.twist - step[1], 1e-10);
    EXPECT_NEAR(near.length, x.length - step[2], 1e-10);
  }
}

// Laid where it belongs, as large as it has to be, and its mirror image.
TEST(Placed, StartsAndEndsWhereTheDataDo) {
  const SpaceChain own{{}, {{-1, -1, 1.5, 0.4, 1, 0.3, 0.8}}};
  const SpaceFrame end = frame_at(own, 1);
  SpaceHermite data;
  data.start = {1, 2, 3};
  data.end = {4, 2, 7};
  data.start_tangent = unit({1, 1, 0});
  for (const bool mirrored : {false, true}) {
    const SpaceChain there = placed(own, end.position - core::Point3{}, data, mirrored);
    const SpaceFrame last = frame_at(there, 1);
    EXPECT_NEAR(distance(there.start.position, data.start), 0, 1e-14);
    EXPECT_NEAR(distance(last.position, data.end), 0, 1e-11);
    const double scale = 5 / norm(end.position - core::Point3{});
    EXPECT_NEAR(there.pieces[0].length, 1.5 * scale, 1e-14);
    EXPECT_NEAR(there.pieces[0].curvature_end, 1 / scale, 1e-14);
    EXPECT_NEAR(there.pieces[0].torsion_end, (mirrored ? -0.8 : 0.8) / scale, 1e-14);
    EXPECT_TRUE(validate(there));
  }
}

}  // namespace
}  // namespace space
}  // namespace keyline::lac::detail
