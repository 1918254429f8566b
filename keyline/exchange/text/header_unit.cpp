#include "keyline/exchange/text/header_unit.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "keyline/document/document.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

std::string unit_in_words(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 21> kWords = {
      {{"\"", "in"},          {"''", "in"},         {"'", "ft"},           {"millimeter", "mm"},
       {"millimeters", "mm"}, {"millimetre", "mm"}, {"millimetres", "mm"}, {"centimeter", "cm"},
       {"centimeters", "cm"}, {"centimetre", "cm"}, {"centimetres", "cm"}, {"meter", "m"},
       {"meters", "m"},       {"metre", "m"},       {"metres", "m"},       {"inch", "in"},
       {"inches", "in"},      {"in.", "in"},        {"foot", "ft"},        {"feet", "ft"},
       {"ft.", "ft"}}};
  std::string name = lower_case(trimmed(text));
  if (document::millimetres(name) > 0) return name;
  for (const auto& [word, unit] : kWords)
    if (name == word) return unit;
  return {};
}

std::string unit_said(std::string_view line) {
  static constexpr std::array kSubjects = {"unit",       "units",      "dimension",
                                           "dimensions", "coordinate", "coordinates",
                                           "lengths",    "einheit",    "einheiten"};
  std::vector<std::string> words;
  bool open = false;
  for (const char c : lower_case(line)) {
    const bool parts = std::string_view(" \t:=,;()[]\"'").find(c) != std::string_view::npos;
    if (!parts && !std::exchange(open, true)) words.emplace_back();
    if (parts)
      open = false;
    else
      words.back() += c;
  }
  if (words.size() < 2) return {};
  const bool about = std::ranges::any_of(words, [](const std::string& word) {
    return std::ranges::find(kSubjects, word) != kSubjects.end();
  });
  const std::string& last = words.back();
  const bool in_it = words[words.size() - 2] == "in" && last.size() > 1;
  return about || in_it ? unit_in_words(last) : std::string();
}

std::size_t start_of_unit(std::string_view cell) {
  if (const std::size_t open = cell.find_first_of("[("); open != cell.npos) return open;
  const std::size_t mark = cell.find_last_of("/_");
  const bool named = mark != cell.npos && mark > 0 && !unit_in_words(cell.substr(mark + 1)).empty();
  return named ? mark : cell.npos;
}

namespace {

std::string unquoted_cell(std::string_view cell) {
  std::string name(trimmed(cell));
  std::erase(name, '"');
  std::erase(name, '\'');
  return name;
}

/// A cell with nothing but marks in its brackets, those of inches or feet, doubled where a table
/// has the cell in quotes: the mark.
std::string mark_of(std::string_view cell) {
  std::string_view mark = trimmed(cell);
  const bool quoted = mark.starts_with('"');
  mark = mark.substr(std::min(mark.find_first_of("[(") + 1, mark.size()));
  mark = trimmed(mark.substr(0, mark.find_first_of("])")));
  return std::string(quoted && mark == "\"\"" ? "\"" : mark);
}

}  // namespace

HeaderUnit unit_alone(std::string_view cell) {
  const std::string unit = unit_in_words(unquoted_cell(cell));
  return unit.empty() ? unit_of(cell) : HeaderUnit{unit, {}, false};
}

HeaderUnit unit_of(std::string_view cell) {
  const std::string name = unquoted_cell(cell);
  const std::size_t at = start_of_unit(name);
  if (at == std::string::npos) return {};
  const std::string_view behind = std::string_view(name).substr(at + 1);
  const std::string_view text = trimmed(behind.substr(0, behind.find_first_of("])")));
  const std::string unit = unit_in_words(text.empty() ? mark_of(cell) : text);
  const bool said = unit.empty() && !text.empty() && text != "-" && text != "1";
  return {unit, said ? std::string(text) : std::string(), name[at] == '('};
}

}  // namespace keyline::exchange::detail
