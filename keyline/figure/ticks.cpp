#include "keyline/figure/ticks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "keyline/core/error.h"

namespace keyline::figure {

namespace {

constexpr const char* kMinus = "\u2212";

std::string with_true_minus(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, kMinus);
  return text;
}

std::string fixed(double value, int decimals) {
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

int decade(double value) { return static_cast<int>(std::floor(std::log10(value))); }

/// Smallest of 1, 2, 5 times a power of ten that is >= value.
double round_number_above(double value) {
  const double below = round_number_below(value);
  if (below >= value * (1 - 1e-12)) return below;
  const double lead = below / std::pow(10.0, decade(below * 1.0001));
  return below * (lead > 1.5 && lead < 3 ? 2.5 : 2);
}

}  // namespace

double round_number_below(double value) {
  const double power = std::pow(10.0, decade(value));
  const double lead = value / power * (1 + 1e-12);
  return power * (lead >= 10 ? 10 : lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

std::string superscript(int value) {
  static constexpr std::array<const char*, 10> kDigits = {"\u2070", "\u00B9", "\u00B2", "\u00B3",
                                                          "\u2074", "\u2075", "\u2076", "\u2077",
                                                          "\u2078", "\u2079"};
  std::string text = value < 0 ? "\u207B" : "";
  for (const char digit : std::to_string(std::abs(value)))
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string short_number(double value, int significant) {
  if (!std::isfinite(value)) return "\u2013";
  if (value == 0) return "0";
  const int digits = std::clamp(significant, 1, 15);
  std::array<char, 40> text{};
  auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                           std::chars_format::scientific, digits - 1);
  const std::string scientific(text.data(), end.ptr);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  const bool plain = exponent >= -4 && exponent < 6;
  std::string number =
      plain ? fixed(value, std::max(0, digits - 1 - exponent)) : scientific.substr(0, e);
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  if (!plain) number += "\u00D710" + superscript(exponent);
  return with_true_minus(number);
}

Ticks linear_ticks(const core::Interval& range, int most) {
  const double extent = length(range);
  if (!(extent > 0) || !std::isfinite(extent) || most < 2)
    throw core::InvalidInput("linear_ticks: needs a finite range and at least two ticks");
  double step = round_number_above(extent / most);
  if (std::floor(range.high / step) - std::ceil(range.low / step) + 1 > most)
    step = round_number_above(step * 1.5);
  Ticks result;
  const int largest = decade(std::max(std::abs(range.low), std::abs(range.high)));
  if (largest >= 5 || largest <= -4)
    result.exponent = 3 * static_cast<int>(std::floor(largest / 3.0));
  const double unit = std::pow(10.0, result.exponent);
  const int decimals = std::clamp(-decade(step / unit * (1 + 1e-9)), 0, 12);
  const double first = std::ceil(range.low / step - 1e-9);
  const int count = static_cast<int>(std::floor(range.high / step + 1e-9) - first) + 1;
  for (int i = 0; i < std::min(count, most + 1); ++i) {
    const double value = (first + i) * step;
    result.ticks.push_back({value, with_true_minus(fixed(value / unit, decimals))});
  }
  return result;
}

double signed_root(double value) { return std::copysign(std::sqrt(std::abs(value)), value); }

Ticks signed_root_ticks(const core::Interval& range, int most) {
  if (!(length(range) > 0) || !std::isfinite(length(range)) || most < 2)
    throw core::InvalidInput("signed_root_ticks: needs a finite range and at least two ticks");
  const double low = signed_root(range.low);
  const double high = signed_root(range.high);
  const double apart = (high - low) / most;
  Ticks result;
  const auto add_side = [&](double sign) {
    const double end = sign > 0 ? range.high : -range.low;
    double last = INFINITY;
    for (double v = end > 0 ? round_number_below(end) : 0; v > 0; v = round_number_below(v * 0.7)) {
      const double place = std::sqrt(v);
      if (place < apart || sign * v < range.low || sign * v > range.high) break;
      if (last - place < apart) continue;
      last = place;
      result.ticks.push_back({sign * v, short_number(sign * v, 3)});
    }
  };
  add_side(1);
  add_side(-1);
  if (range.low <= 0 && range.high >= 0) result.ticks.push_back({0, "0"});
  std::sort(result.ticks.begin(), result.ticks.end(),
            [](const Tick& a, const Tick& b) { return a.value < b.value; });
  return result;
}

Ticks log_ticks(const core::Interval& range, int most) {
  if (!(range.low > 0) || !(range.high > range.low) || !std::isfinite(range.high))
    throw core::InvalidInput("log_ticks: needs a positive range");
  const int first = static_cast<int>(std::floor(std::log10(range.low) + 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(range.high) + 1e-9));
  const double decades = std::log10(range.high) - std::log10(range.low);
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / std::max(most, 2))));
  Ticks result;
  for (int e = first; e <= last; ++e) {
    const double power = std::pow(10.0, e);
    for (int m = 1; m < 10; ++m) {
      const double value = m * power;
      if (value < range.low * (1 - 1e-9) || value > range.high * (1 + 1e-9)) continue;
      Tick tick{value, ""};
      if (decades < 2 && (m == 1 || m == 2 || m == 5)) tick.label = short_number(value, 3);
      if (decades >= 2 && m == 1 && e % stride == 0) tick.label = "10" + superscript(e);
      if (m == 1 || decades < 12) result.ticks.push_back(tick);
    }
  }
  return result;
}

core::Interval axis_range(const std::vector<double>& values, Scale scale) {
  constexpr double kLargest = 1e290;
  const bool log = scale == Scale::log10;
  double low = INFINITY;
  double high = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value) || std::abs(value) > kLargest) continue;
    if (log && !(value > 1 / kLargest)) continue;
    low = std::min(low, log ? std::log10(value) : value);
    high = std::max(high, log ? std::log10(value) : value);
  }
  if (low > high) return log ? core::Interval{1, 10} : core::Interval{0, 1};
  const double size = std::max(std::abs(low), std::abs(high));
  if (scale == Scale::signed_root && low < high) {
    const double from = signed_root(low);
    const double to = signed_root(high);
    const double slack = 0.04 * (to - from);
    return {(from - slack) * std::abs(from - slack), (to + slack) * std::abs(to + slack)};
  }
  double margin = 0.04 * (high - low);
  if (log && high - low < 0.1) margin = 0.3;
  if (!log && high - low <= 1e-9 * size) margin = size > 1e-290 ? 0.1 * size : 1;
  if (log) return {std::pow(10.0, low - margin), std::pow(10.0, high + margin)};
  return {low - margin, high + margin};
}

}  // namespace keyline::figure
