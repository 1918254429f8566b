#include "keyline/fairing/asked.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

/// What is refused before anything is solved, and at which option.
namespace keyline::fairing::detail {
namespace {

acquire::KeyLine line_of(std::size_t points, double noise = 0.1) {
  acquire::KeyLine line;
  for (std::size_t i = 0; i < points; ++i) line.points.push_back({1.0 * i, 0});
  line.noise = noise;
  return line;
}

/// The option that is to blame; "" where nothing is.
std::string blamed(const FairOptions& options, const acquire::KeyLine& line = line_of(5)) {
  const auto sound = check(line, options);
  return sound ? "" : sound.error().path;
}

FairOptions with(auto set) {
  FairOptions options;
  set(options);
  return options;
}

TEST(Asked, TwoPointsAreEnough) {
  EXPECT_FALSE(check(line_of(1), {}));
  EXPECT_TRUE(check(line_of(2), {}));
}

TEST(Asked, ToleranceIsALengthOrNothing) {
  for (const double sound : {0.0, 0.1, 1e9})
    EXPECT_EQ(blamed(with([&](auto& o) { o.tolerance = sound; })), "");
  for (const double bad : {-1e-9, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_EQ(blamed(with([&](auto& o) { o.tolerance = bad; })), "tolerance");
}

TEST(Asked, SigmasWantANoiseAndNoTolerance) {
  EXPECT_EQ(blamed(with([](auto& o) { o.sigmas = 3; })), "");
  EXPECT_EQ(blamed(with([](auto& o) {
              o.sigmas = 3;
              o.tolerance = 0.1;
            })),
            "sigmas");
  EXPECT_EQ(blamed(with([](auto& o) { o.sigmas = 3; }), line_of(5, 0)), "sigmas");
}

TEST(Asked, NumbersHaveTheirRanges) {
  for (const int order : {4, 5, 6})
    EXPECT_EQ(blamed(with([&](auto& o) { o.spline.order = order; })), "");
  for (const int order : {3, 7})
    EXPECT_EQ(blamed(with([&](auto& o) { o.spline.order = order; })), "order");
  EXPECT_EQ(blamed(with([](auto& o) { o.waves = 0; })), "");
  EXPECT_EQ(blamed(with([](auto& o) { o.waves = -1; })), "waves");
  EXPECT_EQ(blamed(with([](auto& o) { o.pieces = 1; })), "");
  EXPECT_EQ(blamed(with([](auto& o) { o.pieces = -1; })), "pieces");
  EXPECT_EQ(blamed(with([](auto& o) { o.must_pass = {0, 4}; })), "");
  EXPECT_EQ(blamed(with([](auto& o) { o.must_pass = {5}; })), "must_pass");
}

TEST(Asked, RegionsArePartsOfTheWhole) {
  const auto of = [](double low, double high) {
    return blamed(with([&](auto& o) { o.region = core::Interval{low, high}; }));
  };
  EXPECT_EQ(of(0, 1), "");
  EXPECT_EQ(of(0.2, 0.3), "");
  EXPECT_EQ(of(-0.1, 1), "region");
  EXPECT_EQ(of(0, 1.1), "region");
  EXPECT_EQ(of(0.5, 0.5), "region");
  EXPECT_EQ(of(0.6, 0.5), "region");
}

// A closed line goes on behind its end.
TEST(Asked, RegionsOfClosedLinesMayRunOverTheStart) {
  acquire::KeyLine line = line_of(8);
  line.closed = true;
  const auto of = [&](double low, double high) {
    return blamed(with([&](auto& o) { o.region = core::Interval{low, high}; }), line);
  };
  EXPECT_EQ(of(-0.1, 0.2), "");
  EXPECT_EQ(of(0.9, 1.1), "");
  EXPECT_EQ(of(-0.1, 1), "region");
  EXPECT_EQ(of(-1.1, -1), "region");
}

TEST(Asked, ALimitOfTheRateDoesNotGoWithTheShortestChain) {
  EXPECT_EQ(blamed(with([](auto& o) { o.max_rate = 1; })), "");
  EXPECT_EQ(blamed(with([](auto& o) {
              o.max_rate = 1;
              o.pieces = 3;
            })),
            "max_rate");
  EXPECT_EQ(blamed(with([](auto& o) {
              o.max_rate = 1;
              o.criterion = Criterion::fewest_pieces;
            })),
            "max_rate");
}

TEST(Asked, SlopesAndWavesDoNotGoWithTheShortestChain) {
  const auto shortest = [](auto set) {
    return blamed(with([&](auto& o) {
      o.pieces = 3;
      set(o);
    }));
  };
  EXPECT_EQ(shortest([](auto& o) { o.slopes = {-3, 3}; }), "");  // as they are unless given
  EXPECT_EQ(shortest([](auto& o) { o.slopes = {0.5, 3}; }), "slopes");
  EXPECT_EQ(shortest([](auto& o) { o.slopes = {-3, 2}; }), "slopes");
  EXPECT_EQ(shortest([](auto& o) { o.waves = 1; }), "waves");
}

TEST(Asked, JointsOfOneRateSayWhatTheyDoNotGoWith) {
  const auto why = [](auto set) {
    FairOptions options;
    options.joints = JointOrder::g3;
    set(options);
    const auto sound = check(line_of(5), options);
    EXPECT_TRUE(sound || sound.error().path == "joints");
    return sound ? std::string() : sound.error().message;
  };
  EXPECT_EQ(why([](auto&) {}), "");
  EXPECT_NE(why([](auto& o) { o.pieces = 2; }).find("shortest chain"), std::string::npos);
  EXPECT_NE(why([](auto& o) { o.criterion = Criterion::fewest_pieces; }).find("shortest chain"),
            std::string::npos);
  EXPECT_NE(why([](auto& o) { o.max_rate = 1; }).find("rate"), std::string::npos);
  EXPECT_NE(why([](auto& o) { o.symmetric.mode = SymmetricMode::found; }).find("symmetric"),
            std::string::npos);
  EXPECT_NE(why([](auto& o) { o.interpretations.emplace_back(); }).find("readings"),
            std::string::npos);
}

}  // namespace
}  // namespace keyline::fairing::detail
