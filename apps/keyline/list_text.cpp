#include "list_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"

namespace keyline::app {
namespace {

using nlohmann::json;

/// A corner of a box, with so many digits that about six are left of the box's size.
std::string corner_text(const json& corner, int digits) {
  std::string text;
  for (const json& x : corner)
    text += (text.empty() ? "" : ",") + core::number_text(x.get<double>(), digits);
  return text;
}

std::string box_text(const json& box) {
  double size = 0, farthest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = box["low"][i].get<double>(), high = box["high"][i].get<double>();
    size = std::max(size, high - low);
    farthest = std::max({farthest, std::abs(low), std::abs(high)});
  }
  const double lost = size > 0 ? std::floor(std::log10(farthest / size)) : 0;
  const int digits = 6 + static_cast<int>(std::clamp(lost, 0.0, 9.0));
  return corner_text(box["low"], digits) + " to " + corner_text(box["high"], digits);
}

}  // namespace

std::string list_text(const json& listed) {
  const auto text = [](const json& j) { return j.is_string() ? j.get<std::string>() : ""; };
  std::string all = fmt::format(
      "{:>4} {:<12} {:<24} {:<26} {:>12}  {}\n", "", "kind", "name", "type", "length",
      "bounding box" + (text(listed["unit"]).empty() ? "" : " in " + text(listed["unit"])));
  int number = 0;
  for (const json& thing : listed["things"]) {
    all += fmt::format(
        "{:>4} {:<12} {:<24} {:<26} {:>12}  {}\n", ++number, text(thing["kind"]),
        text(thing["name"]) +
            (text(thing["layer"]).empty() ? "" : " [" + text(thing["layer"]) + "]"),
        text(thing["type"]),
        thing.contains("length") ? core::number_text(thing["length"].get<double>(), 6) : "",
        box_text(thing["box"]));
  }
  for (const json& note : listed["notes"]) all += "note: " + text(note) + "\n";
  for (const json& skipped : listed["skipped"]) all += "skipped: " + text(skipped) + "\n";
  return all;
}

}  // namespace keyline::app
