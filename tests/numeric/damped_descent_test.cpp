#include "keyline/numeric/damped_descent.h"

#include <vector>

#include <gtest/gtest.h>

/// How the damping moves, by hand.
namespace keyline::numeric {
namespace {

TEST(FactorDamping, MovesByItsFactorsWithinItsLimits) {
  FactorDamping damping{.value = 1, .raise = 5, .lower = 0.25, .least = 0.1, .most = 20};
  EXPECT_TRUE(damping.on_refused());
  EXPECT_EQ(damping.value, 5);
  damping.on_taken(1);
  EXPECT_EQ(damping.value, 1.25);
  damping.on_taken(1);
  damping.on_taken(1);
  EXPECT_EQ(damping.value, 0.1);
  damping.value = 4;
  EXPECT_FALSE(damping.on_refused());  // 20: as much as is never tried
  damping.value = 2;
  EXPECT_TRUE(damping.on_unsolved());  // by ten, whatever the factors
  EXPECT_EQ(damping.value, 20);
  EXPECT_FALSE(damping.on_unsolved());
  damping.value = 0;
  EXPECT_TRUE(damping.on_unsolved());
  EXPECT_EQ(damping.value, 1e-8);
}

TEST(FactorDamping, MayRestAfterARefusal) {
  FactorDamping damping{.value = 1, .raise = 4, .lower = 0.5, .after_refusal = true};
  damping.on_refused();
  damping.on_taken(1);
  EXPECT_EQ(damping.value, 4);
  damping.on_taken(1);
  EXPECT_EQ(damping.value, 2);
}

// [Nielsen 1999]: a step taken multiplies by max(1/3, 1 - (2 gain - 1)^3) and sets the growth to 2;
// refused ones multiply by 2, 4, 8, …
TEST(GainDamping, FollowsNielsen) {
  GainDamping damping{.value = 1};
  for (const double value : {2.0, 8.0, 64.0}) {
    EXPECT_TRUE(damping.on_refused());
    EXPECT_EQ(damping.value, value);
  }
  damping.on_taken(0.25);
  EXPECT_EQ(damping.value, 64 * 1.125);
  EXPECT_TRUE(damping.on_unsolved());
  EXPECT_EQ(damping.value, 144);
  damping.on_taken(0.5);
  EXPECT_EQ(damping.value, 144);
  damping.on_taken(1);
  EXPECT_DOUBLE_EQ(damping.value, 48);
  damping.value = 1e-15;
  damping.on_taken(1);
  EXPECT_EQ(damping.value, 1e-15);
  damping.value = 1e16;
  EXPECT_FALSE(damping.on_refused());
  damping = {.value = 0.5e16};
  EXPECT_TRUE(damping.on_refused());
}

TEST(DampedDescent, EndsWhereItSettlesOrNothingIsLeft) {
  const std::vector<StepEnd> way{StepEnd::refused, StepEnd::taken, StepEnd::unsolved,
                                 StepEnd::settled};
  std::vector<double> asked;
  const auto step = [&](double damping) -> StepOutcome {
    asked.push_back(damping);
    return {way.at(asked.size() - 1)};
  };
  FactorDamping damping{.value = 1};
  const DescentEnd whole = damped_descent(damping, 9, step);
  EXPECT_EQ(asked, (std::vector<double>{1, 10, 1, 10}));
  EXPECT_EQ(whole.steps, 4);
  EXPECT_TRUE(whole.settled);
  EXPECT_FALSE(whole.exhausted);

  asked.clear();
  damping = {.value = 1};
  const DescentEnd part = damped_descent(damping, 3, step);
  EXPECT_EQ(part.steps, 3);
  EXPECT_FALSE(part.settled);

  damping = {.value = 1};
  const auto never = [](double) { return StepOutcome{}; };
  const DescentEnd none = damped_descent(damping, 99, never);
  EXPECT_EQ(none.steps, 9);  // 10, 100, … 1e9
  EXPECT_TRUE(none.exhausted);
  damping = {.value = 1};
  const auto unsolved = [](double) { return StepOutcome{StepEnd::unsolved}; };
  EXPECT_EQ(damped_descent(damping, 99, unsolved).steps, 10);  // 1e9 itself is tried
}

}  // namespace
}  // namespace keyline::numeric
