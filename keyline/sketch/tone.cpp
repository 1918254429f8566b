#include "keyline/sketch/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/quantile.h"
#include "keyline/sketch/background.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

using Gray = Raster<std::uint16_t>;

constexpr int kImpulse = 9000;  ///< salt and pepper differ by this much from all neighbours

constexpr double kPaperShare = 0.8;  ///< of the picture, no lighter than its paper

constexpr double kAlone = 0.35;  ///< of a dark pixel's depth: a neighbour with more is its line

/// What a pixel that stands out of all of its neighbours becomes: their median. Dark ones only
/// where all neighbours are paper: along a hairline the grey swells and fades.
std::optional<std::uint16_t> without_impulse(const Gray& image, std::size_t at) {
  const auto w = static_cast<std::size_t>(image.width);
  const std::uint16_t* above = &image.data[at - w];
  const std::uint16_t* here = &image.data[at];
  const std::uint16_t* below = &image.data[at + w];
  const int value = here[0];
  const bool darker = here[-1] - value >= kImpulse;
  if (!darker && value - here[-1] < kImpulse) return {};
  std::array<std::uint16_t, 8> around = {above[-1], above[0],  above[1], here[-1],
                                         here[1],   below[-1], below[0], below[1]};
  if (!std::ranges::all_of(
          around, [&](int other) { return (darker ? other - value : value - other) >= kImpulse; }))
    return {};
  std::nth_element(around.begin(), around.begin() + 4, around.end());
  const int usual = around[4];
  const int darkest = *std::min_element(around.begin(), around.begin() + 4);
  if (darker && usual - darkest > kAlone * (usual - value)) return {};
  return around[4];
}

/// Single pixels much darker or much lighter than every neighbour go.
void remove_impulses(Gray& image) {
  const int w = image.width;
  const int h = image.height;
  if (w < 3 || h < 3) return;
  std::vector<std::pair<std::size_t, std::uint16_t>> mended;  // as the picture was before
  std::mutex adding;
  for_rows(1, h - 1, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const std::size_t row = image.index(0, y);
      const std::uint16_t* here = &image.data[row];
      for (int x = 1; x + 1 < w; ++x) {
        while (x + 5 < w && word_at(here + x) == word_at(here + x - 1))
          x += 4;  // most of the paper
        const std::size_t at = row + static_cast<std::size_t>(x);
        if (const auto usual = without_impulse(image, at)) {
          const std::scoped_lock lock(adding);
          mended.emplace_back(at, *usual);
        }
      }
    }
  });
  for (const auto& [at, usual] : mended) image.data[at] = usual;
}

/// Luminance to x of the formula, 1 … 256.
double intensity(double luminance) { return 1 + luminance / 65535 * 255; }

/// Value below which the given share of a sample of pixels lies.
double percentile(const Gray& image, double share) {
  std::vector<std::uint16_t> sample;
  const std::size_t step = std::max<std::size_t>(1, image.data.size() / 200000);
  for (std::size_t i = 0; i < image.data.size(); i += step) sample.push_back(image.data[i]);
  return core::value_at(sample, share);
}

/// Share of a sample of pixels below level y.
double share_below(const Gray& level, double y) {
  const std::size_t step = std::max<std::size_t>(1, level.data.size() / 200000);
  std::size_t below = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < level.data.size(); i += step, ++count)
    below += level.data[i] < y * Tone::kWhite ? 1 : 0;
  return static_cast<double>(below) / static_cast<double>(count);
}

/// Median absolute difference of pixels some steps apart, as a standard deviation of one pixel.
double noise_at_lag(const Gray& level, int lag) {
  if (level.width <= lag) return 0;
  std::vector<int> sample;
  const std::size_t step = std::max<std::size_t>(1, level.data.size() / 100000);
  for (std::size_t i = 0; i + static_cast<std::size_t>(lag) < level.data.size(); i += step)
    sample.push_back(std::abs(level.data[i] - level.data[i + static_cast<std::size_t>(lag)]));
  return core::quantile(std::move(sample)) / (0.6745 * std::sqrt(2.0)) / Tone::kWhite;
}

double noise_of(const Gray& level) {
  return std::max(noise_at_lag(level, 1), noise_at_lag(level, 4));
}

std::vector<std::uint16_t> tones(double gain) {
  return level_table<std::uint16_t>([gain](double luminance) {
    const double y = gain * std::log(intensity(luminance));
    return static_cast<std::uint16_t>(std::clamp(y * Tone::kWhite, 0.0, 65535.0));
  });
}

}  // namespace

double darkness_of(double y, double gain) {
  return std::clamp(1 - std::exp((y - 1) / gain), 0.0, 1.0);
}

Tone transform_intensity(Image image, const ToneOptions& options) {
  Tone tone;
  tone.light_on_dark = options.polarity == Polarity::light_on_dark ||
                       (options.polarity == Polarity::automatic && is_light_on_dark(image));
  tone.level = std::move(image.luminance);
  if (tone.light_on_dark)
    for (std::uint16_t& v : tone.level.data) v = static_cast<std::uint16_t>(65535 - v);
  tone.margins = clear_margins(tone.level, percentile(tone.level, kPaperShare));
  remove_impulses(tone.level);
  const double paper = std::max(intensity(percentile(tone.level, kPaperShare)), 2.0);
  tone.gain = options.gain.value_or(1 / std::log(paper));
  look_up(tone.level, tones(tone.gain), tone.level);
  tone.shaded = share_below(tone.level, 1 + tone.gain * std::log(2.0 / 3));
  tone.flattened = flatten_background(tone.level, tone.gain, options.flatten);
  tone.noise = noise_of(tone.level);
  return tone;
}

void blur_levels(Tone& tone, double sigma) {
  cv::Mat level(tone.level.height, tone.level.width, CV_16U, tone.level.data.data());
  const int size = 2 * static_cast<int>(std::ceil(2.5 * sigma)) + 1;
  cv::GaussianBlur(level, level, {size, size}, sigma);
  tone.noise = noise_of(tone.level);
}

}  // namespace keyline::sketch
