#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/noise.h"

namespace keyline::acquire {
namespace {

constexpr int kPoints = 4000;
constexpr double kRoughness = 0.05;

core::Point2 on_ellipse(double turn, double outward) {
  const core::Point2 p{100 * std::cos(turn), 60 * std::sin(turn)};
  const core::Vector2 n{60 * std::cos(turn), 100 * std::sin(turn)};
  return p + (outward / core::norm(n)) * n;
}

/// An ellipse whose errors are means of so many independent ones: neighbours err alike. Their
/// standard deviation is kRoughness whatever the width.
std::vector<core::Point2> rough_ellipse(int width) {
  std::mt19937_64 dice(7);
  std::normal_distribution<double> error(0, kRoughness * std::sqrt(width));
  std::vector<double> single(kPoints);
  for (double& e : single) e = error(dice);
  std::vector<core::Point2> points;
  for (int i = 0; i < kPoints; ++i) {
    double mean = 0;
    for (int k = 0; k < width; ++k) mean += single[(i + k) % kPoints] / width;
    points.push_back(on_ellipse(2 * M_PI * i / kPoints, mean));
  }
  return points;
}

TEST(Texture, ErrorsOfNeighboursAlikeAreSeenFartherApart) {
  for (const int width : {4, 8, 12}) {
    const auto points = rough_ellipse(width);
    EXPECT_LT(estimate_noise(points, true), 0.6 * kRoughness) << width;
    const Texture found = estimate_texture(points, true);
    EXPECT_NEAR(found.noise, kRoughness, 0.2 * kRoughness) << width;
    EXPECT_GT(found.stride, 1U) << width;
  }
}

TEST(NoiseStays, UnlessNeighboursErrAlike) {
  EXPECT_TRUE(noise_stays(rough_ellipse(1), true, kRoughness));
  for (const int width : {4, 8}) {
    const auto points = rough_ellipse(width);
    EXPECT_FALSE(noise_stays(points, true, estimate_noise(points, true))) << width;
    EXPECT_TRUE(noise_stays(points, true, kRoughness)) << width;
  }
}

TEST(Texture, ChanceIsChanceAndShapeIsShape) {
  const Texture chance = estimate_texture(rough_ellipse(1), true);
  EXPECT_EQ(chance.stride, 1U);
  EXPECT_NEAR(chance.noise, kRoughness, 0.05 * kRoughness);
  std::vector<core::Point2> smooth;
  for (int i = 0; i < kPoints; ++i) smooth.push_back(on_ellipse(2 * M_PI * i / kPoints, 0));
  EXPECT_LT(estimate_texture(smooth, true).noise, 1e-9);
}

RawCurve raw(const std::vector<core::Point2>& points) {
  RawCurve curve;
  for (const core::Point2 p : points) curve.points.push_back({p.x, p.y, 0});
  return curve;
}

std::string last_note(const std::vector<core::Point2>& points, const AcquireOptions& options) {
  return acquire_key_line(raw(points), options).value().report.notes.back();
}

TEST(Texture, IsToldAndTheLengthCanBeSet) {
  const auto points = rough_ellipse(8);
  const KeyLine line = acquire_key_line(raw(points)).value();
  EXPECT_NEAR(line.noise, kRoughness, 0.25 * kRoughness);
  bool told = false;
  for (const std::string& note : line.report.notes)
    told = told || note.find("texture") != std::string::npos;
  EXPECT_TRUE(told);
  // Waves of less than three points: what neighbours show.
  AcquireOptions options;
  options.detail = 0.3;
  EXPECT_LT(acquire_key_line(raw(points), options).value().noise, 0.5 * kRoughness);
  EXPECT_NE(last_note(points, options).find(", no more than neighbouring points show"),
            std::string::npos);
  // The same waves are noise now: neighbours show less of it, and nothing says that all such go.
  options.detail = 3;
  const std::string note = last_note(points, options);
  EXPECT_NE(note.find("noise measured on waves shorter than "), std::string::npos) << note;
  EXPECT_NE(note.find("; higher waves stay"), std::string::npos) << note;
  EXPECT_EQ(note.find("taken for"), std::string::npos) << note;
  options.noise = kRoughness;  // known: nothing is measured
  EXPECT_EQ(last_note(points, options).find("noise measured"), std::string::npos);
  options.noise.reset();
  options.detail = -1;
  EXPECT_FALSE(acquire_key_line(raw(points), options).has_value());
}

}  // namespace
}  // namespace keyline::acquire
