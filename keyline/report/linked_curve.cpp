#include "keyline/report/linked_curve.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "keyline/core/error.h"
#include "keyline/core/markup.h"
#include "keyline/figure/text.h"

namespace keyline::report::detail {
namespace {

constexpr int kDigits = 7;

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0,
                                 std::chars_format::general, kDigits);
  text.append(digits.data(), end.ptr);
}

/// "name":[…] of the values as `number_of` tells them.
template <class List, class NumberOf>
void append_list(std::string& text, std::string_view name, const List& list, NumberOf number_of) {
  ((text += '"') += name) += "\":[";
  bool first = true;
  for (const auto& item : list) {
    if (!first) text += ',';
    first = false;
    append_number(text, number_of(item));
  }
  text += ']';
}

void append_curvature(std::string& text, const figure::SampledCurve& curve) {
  const auto same = [](double value) { return value; };
  append_list(text, "s", curve.arc_length, same);
  text += ',';
  append_list(text, "k", curve.curvature, same);
}

void check(const figure::SampledCurve& curve) {
  const std::size_t n = curve.points.size();
  if (curve.arc_length.size() != n || curve.tangent_angle.size() != n ||
      curve.curvature.size() != n)
    throw core::InvalidInput("linked_curve: the curve's lists differ in length");
}

std::string numbers_of(const LinkedCurve& linked) {
  const figure::SampledCurve& curve = linked.curve;
  const core::Point2 origin = curve.points.empty() ? core::Point2{} : curve.points.front();
  std::string text = "{";
  append_curvature(text, curve);
  text += ',';
  append_list(text, "x", curve.points, [origin](core::Point2 p) { return p.x - origin.x; });
  text += ',';
  append_list(text, "y", curve.points, [origin](core::Point2 p) { return p.y - origin.y; });
  text += ',';
  append_list(text, "a", curve.tangent_angle, [](double angle) { return angle; });
  text += ',';
  append_list(text, "joints", curve.joints, [](std::size_t i) { return static_cast<double>(i); });
  text += ",\"before\":{";
  append_curvature(text, linked.before);
  return text + "}}";
}

}  // namespace

std::string linked_curve(const LinkedCurve& linked, const std::string& figures) {
  check(linked.curve);
  check(linked.before);
  const auto safe = [](std::string_view text) {
    return core::escape_markup(figure::clean_text(text));
  };
  std::string html = "<div class=\"explorer\" data-unit=\"" + safe(linked.unit) +
                     "\" data-figures=\"" + figures + "\">\n";
  if (!linked.pieces.empty()) {
    html += "<ul hidden=\"hidden\">";
    for (const std::string& piece : linked.pieces) html += "<li>" + safe(piece) + "</li>";
    html += "</ul>\n";
  }
  return html + "<script type=\"application/json\">" + numbers_of(linked) + "</script>\n</div>\n";
}

}  // namespace keyline::report::detail
