#include "keyline/presentation/report_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "keyline/figure/ticks.h"

namespace keyline::presentation::detail {
namespace {

using figure::short_number;

constexpr double kWorthTelling = 0.01;  // plausibility
constexpr std::size_t kMostReadings = 4;

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + "\u00A0" + unit;
}

std::string radius_text(double curvature, const std::string& unit) {
  if (curvature == 0) return "\u221E";
  if (!std::isfinite(curvature)) return "0";
  return with_unit(short_number(1 / std::abs(curvature)), unit);
}

/// Jumps that are rounding are shown as such: with two digits.
std::string jump_text(double value, const std::string& unit) {
  return value == 0 ? "0" : with_unit(short_number(value, 2), unit);
}

}  // namespace

report::Report headed(const ReportOptions& options, std::string title) {
  return {.title = options.title.empty() ? std::move(title) : options.title,
          .subtitle = options.subtitle,
          .options = options.options,
          .command = options.command,
          .generator = options.generator};
}

std::string length_text(double value, const std::string& unit, int significant) {
  return with_unit(short_number(value, significant), unit);
}

std::string radii_text(double curvature_start, double curvature_end, const std::string& unit) {
  if (curvature_start == 0 && curvature_end == 0) return "straight";
  if (curvature_start == curvature_end) return radius_text(curvature_start, unit);
  return radius_text(curvature_start, "") + " \u2026 " + radius_text(curvature_end, unit);
}

std::string area_text(double value, const std::string& unit) {
  return with_unit(short_number(value), unit.empty() ? "" : unit + "\u00B2");
}

std::string slopes_text(const std::vector<double>& slopes) {
  std::string text;
  for (const double slope : slopes) {
    const double rounded = std::round(slope * 100) / 100 + 0.0;
    text += (text.empty() ? "" : ", ") + short_number(rounded, 4);
  }
  return text;
}

std::string readings_text(const std::vector<analysis::Interpretation>& interpretations) {
  std::string text;
  std::size_t told = 0;
  for (const auto& reading : interpretations) {
    if (told == kMostReadings || (told > 0 && reading.plausibility < kWorthTelling)) break;
    std::string slopes = slopes_text(reading.slopes);
    if (!slopes.empty()) slopes.insert(0, 1, ' ');
    const double percent = 100 * reading.plausibility;
    const std::string share = percent > 99.5 && percent < 100 && interpretations.size() > 1
                                  ? ">\u200999"
                                  : fmt::format("{:.0f}", percent);
    text += fmt::format("{}{}{} ({}\u00A0%)", told > 0 ? "; " : "",
                        analysis::rhythm_name(reading.rhythm), slopes, share);
    ++told;
  }
  return text;
}

report::JointRow joint_row(const std::string& between, const analysis::JointContinuity& joint,
                           const std::string& unit) {
  const std::string per = unit.empty() ? "" : "1/" + unit;
  const auto told = [](const std::optional<double>& jump, const std::string& its_unit) {
    return jump ? jump_text(*jump, its_unit) : "\u221E";
  };
  report::JointRow row;
  row.between = between;
  row.gap = jump_text(joint.gap, unit);
  row.angle = short_number(joint.angle * 180 / std::numbers::pi, 2) + "\u00B0";
  row.curvature_jump = told(joint.curvature_jump, per);
  row.rate_jump = told(joint.curvature_rate_jump, unit.empty() ? "" : per + "\u00B2");
  row.order = joint.order < 0 ? "gap" : fmt::format("G{}", joint.order);
  return row;
}

void let_units_wrap(std::vector<report::KeyNumber>& numbers) {
  constexpr std::string_view kNoBreak = "\u00A0";
  const auto loosen = [kNoBreak](std::string& text) {
    for (auto at = text.find(kNoBreak); at != std::string::npos; at = text.find(kNoBreak, at))
      text.replace(at, kNoBreak.size(), " ");
  };
  for (report::KeyNumber& number : numbers) {
    loosen(number.value);
    loosen(number.note);
  }
}

}  // namespace keyline::presentation::detail
