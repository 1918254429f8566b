#include "keyline/acquire/noise.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "keyline/acquire/common_step.h"
#include "keyline/acquire/local_fit.h"
#include "keyline/core/leading_number.h"
#include "keyline/core/quantile.h"

namespace keyline::acquire {
namespace {

struct Window {
  int points;
  int degree;
};

// Short windows of low degree cope with sparse points, the longer ones of high degree with bends;
// the long ones with freedom to spare tell most about dense points.
constexpr std::array<Window, 7> kWindows{
    {{5, 2}, {5, 3}, {6, 3}, {7, 4}, {8, 5}, {10, 4}, {13, 5}}};
constexpr std::size_t kMostWindows = 4000;  // enough to tell the noise to 2 %
constexpr double kAlike = 1.35;             // variances up to this times the least agree with it
// A window spans about ten strides; what is longer is shape. Ten windows make a curve.
constexpr std::size_t kScales = 100;
constexpr double kStays = 1.15;  // a doubling lets a rough line grow by 1.4, a bend by 4 and more
constexpr double kLastDigits = 16;  // epsilons that shifts and factors leave wrong at most
constexpr double kAskew = 2;        // mean over median beyond which there is more than chance
// Residuals of bends grow so when points lie twice as far apart: windows are of degree 2 and more,
// and leave the cube of their spacing. Less than half of that is a mixture with little of them.
constexpr double kBendGrowth = 8;
constexpr double kBendsShow = kBendGrowth / 2;

/// Of chi-squared variables over their degrees of freedom: the median, the mean of the least two
/// thirds, and what a third of them stays below.
struct Usual {
  double median;
  double kept_mean;
  double third;
};
Usual usual(int freedom) {
  switch (freedom) {
    case 1:
      return {0.45494, 0.27487, 0.18553};
    case 2:
      return {0.69315, 0.45069, 0.40547};
    case 5:
      return {0.87029, 0.64268, 0.64328};
    default:
      return {0.90655, 0.69751, 0.70644};  // 7
  }
}

/// Mean of the least two thirds: the rest of the windows may hold corners.
double kept_mean(std::vector<double>& values) {
  const std::size_t count = std::max<std::size_t>(1, (2 * values.size() + 1) / 3);
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
  if (end != values.end()) std::nth_element(values.begin(), end, values.end());
  std::sort(values.begin(), end);  // so that the sum does not depend on the windows' order
  return std::accumulate(values.begin(), end, 0.0) / static_cast<double>(count);
}

/// Calls visit(span of m points, `stride` apart) for windows spread evenly over the curve.
template <class Visit>
void for_windows(std::span<const core::Point2> points, bool closed, std::size_t m,
                 std::size_t stride, Visit visit) {
  const std::size_t n = points.size();
  const std::size_t reach = (m - 1) * stride;
  if (n <= reach) return;
  const std::size_t count = closed ? n : n - reach;
  const std::size_t skip = std::max<std::size_t>(1, count / kMostWindows);
  std::array<core::Point2, detail::LocalFit::kMostPoints> window;
  for (std::size_t first = 0; first < count; first += skip) {
    for (std::size_t k = 0; k < m; ++k) window[k] = points[(first + k * stride) % n];
    visit(std::span<const core::Point2>(window.data(), m));
  }
}

/// Share of the windows whose points advance steadily.
double advancing_share(std::span<const core::Point2> points, bool closed, std::size_t stride) {
  std::size_t windows = 0, advancing = 0;
  for_windows(points, closed, 6, stride, [&](std::span<const core::Point2> window) {
    const core::Vector2 chord = window.back() - window.front();
    bool forward = true;
    for (std::size_t k = 1; k < window.size(); ++k) {
      forward = forward && core::dot(chord, window[k] - window[k - 1]) > 0;
    }
    ++windows;
    advancing += forward ? 1 : 0;
  });
  return windows == 0 ? 1 : static_cast<double>(advancing) / static_cast<double>(windows);
}

/// Which windows tell: the most, without those that turn too far for the graph of a function, or
/// the quietest third of all, where nothing is but noise and the bends of the whole.
enum class Telling { most, quietest };

/// Variance in windows of one kind; infinite where there is none.
double variance_in(std::span<const core::Point2> points, bool closed, Window w, std::size_t stride,
                   Telling telling) {
  std::vector<double> variances;
  const int freedom = w.points - w.degree - 1;
  for_windows(points, closed, static_cast<std::size_t>(w.points), stride,
              [&](std::span<const core::Point2> window) {
                const auto fit = detail::LocalFit::make(window, w.degree);
                if (fit) {
                  variances.push_back(fit->squared_residuals() / freedom);
                } else if (telling == Telling::quietest) {
                  variances.push_back(std::numeric_limits<double>::infinity());
                }
              });
  if (variances.empty()) return std::numeric_limits<double>::infinity();
  const Usual chance = usual(freedom);
  if (telling == Telling::quietest)
    return core::quantile(std::move(variances), 1, 3) / chance.third;
  const double mean = kept_mean(variances) / chance.kept_mean;
  const double median = core::quantile(std::move(variances)) / chance.median;
  // The mean is the surer of the two where chance is all there is; bends spoil it first.
  return mean <= kAskew * median ? mean : median;
}

/// Variance told by points that many apart; empty where there is no window of them.
std::optional<double> estimate_variance(std::span<const core::Point2> points, bool closed,
                                        std::size_t stride, Telling telling) {
  std::array<double, kWindows.size()> variance;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kWindows.size(); ++k) {
    const Window& w = kWindows[k];
    const std::size_t enough = static_cast<std::size_t>(w.degree == 5 ? w.points + 4 : w.points);
    variance[k] = points.size() < enough ? std::numeric_limits<double>::infinity()
                                         : variance_in(points, closed, w, stride, telling);
    least = std::min(least, variance[k]);
  }
  if (!std::isfinite(least)) return std::nullopt;
  // Curvature only enlarges an estimate, chance also lowers it: those near the least are averaged.
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < kWindows.size(); ++k) {
    if (!(variance[k] <= kAlike * least)) continue;
    const double freedom = 1 - static_cast<double>(kWindows[k].degree + 1) / kWindows[k].points;
    sum += freedom * variance[k];
    weight += freedom;
  }
  return sum / weight;
}

/// Exponent of the last decimal place value is written with (-2 for 0.25, 1 for 130), and its
/// number of significant digits, in the shortest decimal form that reads back to value.
struct DecimalForm {
  int last_place;
  int digits;
};

DecimalForm decimal_form(double value) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                 std::chars_format::scientific);
  const std::string_view s(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
  const std::size_t e = s.find('e');
  const int exponent = core::parse_whole<int>(s.substr(e + (s[e + 1] == '+' ? 2 : 1))).value_or(0);
  const int digits = e == 1 ? 1 : static_cast<int>(e) - 1;
  return {exponent - digits + 1, digits};
}

/// Rounding step of one coordinate, 0 where it is not rounded.
double step_of(std::vector<int> places, int usual_digits) {
  if (usual_digits >= 13) return 0;
  // The place that is fine enough for four fifths of the values.
  return std::pow(10.0, std::min(core::quantile(std::move(places), 1, 5), 0));
}

/// Some thousands of the curve's values.
std::vector<double> values_of(const RawCurve& raw, double core::Point3::* coordinate) {
  std::vector<double> values;
  const std::size_t skip = std::max<std::size_t>(1, raw.points.size() / 5000);
  for (std::size_t i = 0; i < raw.points.size(); i += skip)
    if (std::isfinite(raw.points[i].*coordinate)) values.push_back(raw.points[i].*coordinate);
  return values;
}

/// Empty where the coordinate is 0 throughout and tells nothing.
std::optional<double> step_of_values(std::span<const double> values) {
  std::vector<int> places;
  std::vector<int> digits;
  for (const double value : values) {
    if (value == 0) continue;
    const DecimalForm form = decimal_form(value);
    places.push_back(form.last_place);
    digits.push_back(form.digits);
  }
  if (places.empty()) return std::nullopt;
  return step_of(std::move(places), core::quantile(std::move(digits)));
}

/// Empty where too few values differ to tell.
std::optional<double> common_step_of(std::span<const double> values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  const double last_digits = kLastDigits * std::numeric_limits<double>::epsilon() * size;
  const auto exact = detail::common_step(values, last_digits);
  const double decimals = step_of_values(values).value_or(0);
  if (!exact || decimals == 0) return exact;
  // Before their last decimal was rounded they may have been multiples of something larger.
  return std::max(*exact, detail::common_step(values, decimals / 2).value_or(0));
}

/// The finest of the steps that x, y and z tell; 0 where none does.
template <class StepOf>
double finest_step(const RawCurve& raw, StepOf step_of_one) {
  std::optional<double> finest;
  for (const auto coordinate : {&core::Point3::x, &core::Point3::y, &core::Point3::z}) {
    if (coordinate == &core::Point3::z && !raw.has_z) continue;
    if (const auto step = step_of_one(values_of(raw, coordinate)))
      finest = std::min(finest.value_or(*step), *step);
  }
  return finest.value_or(0);
}

}  // namespace

std::size_t noise_stride(std::span<const core::Point2> points, bool closed) {
  std::size_t stride = 1;
  while (advancing_share(points, closed, stride) < 0.75 && 24 * stride < points.size()) {
    stride *= 2;
  }
  return stride;
}

double estimate_noise(std::span<const core::Point2> points, bool closed) {
  return estimate_noise(points, closed, noise_stride(points, closed));
}

Texture estimate_texture(std::span<const core::Point2> points, bool closed) {
  const std::size_t nearest = noise_stride(points, closed);
  const double least = estimate_noise(points, closed, nearest);
  double before = least;
  for (std::size_t stride = 2 * nearest; kScales * stride <= points.size(); stride *= 2) {
    const double now = estimate_noise(points, closed, stride);
    if (now <= kStays * before)
      return stride == 2 * nearest ? Texture{least, nearest, nearest}
                                   : Texture{now, stride, nearest};
    before = now;
  }
  return {least, nearest, nearest};
}

bool noise_stays(std::span<const core::Point2> points, bool closed, double noise) {
  return estimate_noise(points, closed, 2 * noise_stride(points, closed)) <= kStays * noise;
}

double estimate_noise(std::span<const core::Point2> points, bool closed, std::size_t stride) {
  return std::sqrt(estimate_variance(points, closed, stride, Telling::most).value_or(0));
}

double noise_beyond_bends(std::span<const core::Point2> points, bool closed, std::size_t stride,
                          double noise) {
  const auto near = estimate_variance(points, closed, stride, Telling::quietest);
  const auto apart = estimate_variance(points, closed, 2 * stride, Telling::quietest);
  if (!near || !apart) return 0;
  if (*apart <= kBendsShow * kBendsShow * *near) return noise;
  constexpr double kMost = kBendGrowth * kBendGrowth;
  return noise * std::sqrt(std::max(0.0, (kMost - *apart / *near) / (kMost - 1)));
}

double estimate_rounding(const RawCurve& raw) { return finest_step(raw, step_of_values); }

double estimate_common_step(const RawCurve& raw) { return finest_step(raw, common_step_of); }

}  // namespace keyline::acquire
