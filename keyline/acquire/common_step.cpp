#include "keyline/acquire/common_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace keyline::acquire::detail {
namespace {

constexpr std::size_t kFewest = 12;
// A difference is a multiple by chance where its rest is below the error: one in eight of those
// from steps so many times the error, of eleven one in 1e10.
constexpr double kClear = 16;

struct Step {
  double size;
  double error;
};

/// The greatest common divisor by Euclid's algorithm, which ends where the rest is no more than its
/// error; size 0 where it ends in errors.
Step common_divisor(Step a, Step b) {
  if (a.size > b.size) std::swap(a, b);
  while (true) {
    const double times = std::round(b.size / a.size);
    const Step rest{std::abs(b.size - times * a.size), b.error + times * a.error};
    if (rest.size <= rest.error) {
      const Step part{b.size / times, b.error / times};
      return part.error < a.error ? part : a;
    }
    if (rest.size < kClear * rest.error / 4) return {0, 0};
    b = a;
    a = rest;
  }
}

/// The values, in rising order, as multiples of a step: the step that fits them best, or 0 where
/// one is farther from its multiple than by twice the error.
double fitted(const std::vector<double>& values, double step, double error) {
  const auto n = static_cast<double>(values.size());
  std::vector<double> count(values.size(), 0);
  for (std::size_t i = 1; i < values.size(); ++i)
    count[i] = count[i - 1] + std::round((values[i] - values[i - 1]) / step);
  double mean_count = 0, mean = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean_count += count[i] / n;
    mean += (values[i] - values[0]) / n;
  }
  double product = 0, square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    product += (count[i] - mean_count) * (values[i] - values[0]);
    square += (count[i] - mean_count) * count[i];
  }
  const double best = product / square;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i] - values[0] - mean - (count[i] - mean_count) * best) > 2 * error)
      return 0;
  return best;
}

}  // namespace

std::optional<double> common_step(std::span<const double> given, double error) {
  std::vector<double> values(given.begin(), given.end());
  std::sort(values.begin(), values.end());
  const auto same = [&](double a, double b) { return b - a <= 2 * error; };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
  if (values.size() < kFewest) return std::nullopt;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < values.size(); ++i) gaps.push_back(values[i] - values[i - 1]);
  std::sort(gaps.begin(), gaps.end());
  Step step{gaps.front(), 2 * error};
  for (const double gap : gaps) {
    step = common_divisor(step, {gap, 2 * error});
    if (step.size < kClear * error) return 0.0;
  }
  return fitted(values, step.size, error);
}

}  // namespace keyline::acquire::detail
