#include "keyline/fairing/wave_choice.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

/// Which waves are tried to be taken out.
namespace keyline::fairing::detail {
namespace {

/// Between extremum `first` and the next, as many as there are extrema.
Removal swing(double sideways, std::size_t first, double share = 0.1, std::size_t count = 2) {
  return {sideways, share, first, count};
}

std::vector<std::size_t> firsts(const std::vector<Removal>& waves) {
  std::vector<std::size_t> all;
  for (const Removal& r : waves) all.push_back(r.first);
  return all;
}

using Firsts = std::vector<std::size_t>;

TEST(Refusals, AreKnownAgainToAThousandth) {
  Refusals refusals;
  EXPECT_FALSE(refusals.hold(swing(1, 0)));
  refusals.add(swing(2, 3));
  refusals.add(swing(1, 5));
  for (const double s : {1.0, 2.0}) {
    EXPECT_TRUE(refusals.hold(swing(s, 7)));
    EXPECT_TRUE(refusals.hold(swing(1.0009 * s, 7)));
    EXPECT_TRUE(refusals.hold(swing(0.9991 * s, 7)));
    EXPECT_FALSE(refusals.hold(swing(1.0011 * s, 7)));
    EXPECT_FALSE(refusals.hold(swing(0.9989 * s, 7)));
  }
  refusals.clear();
  EXPECT_FALSE(refusals.hold(swing(1, 5)));
}

/// Mean square of half a sine each beside a line, one behind the other, by adding up.
double mean_square(const std::vector<Removal>& waves) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    double t = (i + 0.5) / kSteps;
    for (const Removal& r : waves) {
      if (t < r.share) {
        sum += std::pow(r.sideways * std::sin(core::kPi * t / r.share), 2);
        break;
      }
      t -= r.share;
    }
  }
  return sum / kSteps;
}

// Taken out together they may leave offsets of as large a mean square as there is to spare.
TEST(SmallWaves, FillTheMeanSquareThatIsSpare) {
  const std::vector<Removal> all{swing(1e-3, 4, 0.2), swing(2e-3, 0, 0.15), swing(3e-3, 6, 0.1),
                                 swing(5e-3, 2, 0.3)};
  for (std::size_t n = 0; n <= all.size(); ++n) {
    const std::vector<Removal> few(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
    const double spare = mean_square(few);
    EXPECT_EQ(small_waves(all, 8, 1, spare + 1e-9, {}).size(), n);
    if (n > 0) {
      EXPECT_EQ(small_waves(all, 8, 1, spare - 1e-9, {}).size(), n - 1);
    }
  }
  EXPECT_EQ(firsts(small_waves(all, 8, 1, 1, {})), (Firsts{4, 0, 6, 2}));
  EXPECT_TRUE(small_waves(all, 8, 1, -1e-6, {}).empty());
}

TEST(SmallWaves, EndWithTheFirstThatIsWiderThanTheTolerance) {
  const std::vector<Removal> all{swing(1e-3, 4), swing(2e-3, 0), swing(3e-3, 6)};
  EXPECT_EQ(firsts(small_waves(all, 8, 1.9e-3, 1, {})), (Firsts{4}));
  EXPECT_EQ(firsts(small_waves(all, 8, 2e-3, 1, {})), (Firsts{4, 0}));
  const std::vector<Removal> half{swing(2, 0, 0.5), swing(3, 2, 0.5)};  // a mean square of 1
  EXPECT_EQ(firsts(small_waves(half, 4, 9, 1, {})), (Firsts{0}));
}

// Of an open curve's five extrema, and the same of a closed one, whose last swing ends at the
// first.
TEST(SmallWaves, ShareNoExtremum) {
  const std::vector<Removal> open{swing(1, 1),         swing(2, 0), swing(3, 2),
                                  swing(4, 0, 0.1, 1), swing(5, 3), swing(6, 4, 0.1, 1)};
  EXPECT_EQ(firsts(small_waves(open, 5, 10, 1e3, {})), (Firsts{1, 0, 3}));
  const std::vector<Removal> closed{swing(1, 4), swing(2, 0), swing(3, 3), swing(4, 1)};
  EXPECT_EQ(firsts(small_waves(closed, 5, 10, 1e3, {})), (Firsts{4, 1}));
}

TEST(SmallWaves, LeaveOutWhatWasRefused) {
  const std::vector<Removal> all{swing(1, 0), swing(2, 2), swing(3, 4)};
  Refusals refusals;
  refusals.add(swing(2, 0));
  EXPECT_EQ(firsts(small_waves(all, 6, 10, 1e3, refusals)), (Firsts{0, 4}));
}

/// How many at once are attempted where no more than so many can go.
std::vector<std::size_t> attempts(AtOnce& at_once, std::size_t count, std::size_t possible) {
  std::vector<std::size_t> tried;
  const bool went = at_once.try_together(count, [&](std::size_t n) {
    tried.push_back(n);
    return n <= possible;
  });
  EXPECT_EQ(went, !tried.empty() && tried.back() <= possible);
  return tried;
}

TEST(AtOnce, HalfAsManyWhereItFailsTwiceAsManyTheNextTime) {
  AtOnce at_once;
  EXPECT_EQ(attempts(at_once, 1'000'000, 1'000'000), (Firsts{1'000'000}));
  EXPECT_EQ(attempts(at_once, 3'000'000, 1'000'000), (Firsts{2'000'000, 1'000'000}));
  EXPECT_EQ(attempts(at_once, 40, 3), (Firsts{40, 20, 10, 5, 2}));
  EXPECT_EQ(attempts(at_once, 40, 3), (Firsts{4, 2}));
  EXPECT_EQ(attempts(at_once, 40, 9), (Firsts{4}));
  EXPECT_EQ(attempts(at_once, 3, 9), (Firsts{3}));
  EXPECT_EQ(attempts(at_once, 40, 9), (Firsts{6}));
}

// Where not even two can, one is tried at a time, and two again once one went.
TEST(AtOnce, OneIsNotTogether) {
  AtOnce at_once;
  EXPECT_TRUE(attempts(at_once, 0, 9).empty());
  EXPECT_TRUE(attempts(at_once, 1, 9).empty());
  EXPECT_EQ(attempts(at_once, 5, 0), (Firsts{5, 2}));
  EXPECT_TRUE(attempts(at_once, 40, 9).empty());
  at_once.one_went();
  EXPECT_EQ(attempts(at_once, 40, 9), (Firsts{2}));
  at_once.one_went();
  EXPECT_EQ(attempts(at_once, 40, 9), (Firsts{4}));
}

/// Of sizes 1, 1.01, 1.02 …
std::vector<Removal> many(std::size_t n) {
  std::vector<Removal> all;
  for (std::size_t i = 0; i < n; ++i) all.push_back(swing(1 + 0.01 * double(i), i));
  return all;
}

struct Tried {
  Firsts waves;
  bool too_many = false;
};

/// All that are tried, so many at a time, where none can go.
Tried tried(const std::vector<Removal>& all, double tolerance, int before, std::size_t most,
            Refusals refusals = {}) {
  SingleWaves waves(all, tolerance, before, refusals);
  Tried result;
  for (auto few = waves.next(most); !few.empty(); few = waves.next(most)) {
    EXPECT_LE(few.size(), most);
    for (const Removal& r : few) refusals.add(r), result.waves.push_back(r.first);
  }
  result.too_many = waves.too_many();
  return result;
}

// 24 in a row and 100 of a curve, whatever the number at a time.
TEST(SingleWaves, AreTriedUpToTheirNumber) {
  for (const std::size_t most : {1U, 2U, 5U, 7U, 100U}) {
    SCOPED_TRACE(most);
    for (const std::size_t n : {0U, 1U, 23U, 24U, 25U, 60U}) {
      const Tried all = tried(many(n), 10, 0, most);
      EXPECT_EQ(all.waves.size(), std::min<std::size_t>(n, 24));
      EXPECT_EQ(all.too_many, n > 24);
      for (std::size_t i = 0; i < all.waves.size(); ++i) EXPECT_EQ(all.waves[i], i);
    }
    for (const std::size_t n : {2U, 3U, 4U}) {
      const Tried late = tried(many(n), 10, 97, most);
      EXPECT_EQ(late.waves.size(), std::min<std::size_t>(n, 3));
      EXPECT_EQ(late.too_many, n > 3);
    }
    EXPECT_EQ(tried(many(60), 10, 76, most).waves.size(), 24U);
    EXPECT_EQ(tried(many(60), 10, 77, most).waves.size(), 23U);
  }
}

// Wider than eight tolerances no wave goes, so that none is missed.
TEST(SingleWaves, EndWhereNoneCanGo) {
  for (const std::size_t most : {1U, 4U}) {
    const Tried some = tried(many(60), 1.105 / 8, 0, most);
    EXPECT_EQ(some.waves.size(), 11U);
    EXPECT_FALSE(some.too_many);
    EXPECT_EQ(tried({swing(8, 0)}, 1, 0, most).waves.size(), 1U);
    EXPECT_TRUE(tried(many(60), 0.99 / 8, 0, most).waves.empty());
    EXPECT_FALSE(tried(many(30), 1.235 / 8, 0, most).too_many);  // 24 of them
    EXPECT_TRUE(tried(many(30), 1.245 / 8, 0, most).too_many);   // 25
  }
}

// Three points lie on an arc, so that they hold no rate of curvature; four do. Narrower ones after
// it are tried all the same.
TEST(SingleWaves, ThatStandOnFewPointsAreTriedHoweverWide) {
  std::vector<Removal> all{swing(1, 0), swing(50, 1), swing(60, 2), swing(70, 3), swing(80, 4)};
  for (std::size_t i = 0; i < all.size(); ++i) all[i].points = i;
  all[1].points = 4;
  for (const std::size_t most : {1U, 2U, 5U})
    EXPECT_EQ(tried(all, 1, 0, most).waves, (Firsts{0, 2, 3})) << most;
}

// The same swing stands for itself: others of its size are refused with it.
TEST(SingleWaves, AreTriedOnceOfASize) {
  const std::vector<Removal> all{swing(1, 0), swing(1.0005, 1), swing(2, 2), swing(2, 3),
                                 swing(3, 4)};
  Refusals refusals;
  for (const std::size_t most : {1U, 2U, 5U})
    EXPECT_EQ(tried(all, 10, 0, most).waves, (Firsts{0, 2, 4})) << most;
  refusals.add(swing(1, 0));
  for (const std::size_t most : {1U, 2U, 5U})
    EXPECT_EQ(tried(all, 10, 0, most, refusals).waves, (Firsts{2, 4})) << most;
}

}  // namespace
}  // namespace keyline::fairing::detail
