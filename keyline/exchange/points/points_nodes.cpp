#include "keyline/exchange/points/points_nodes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

/// What stands behind a keyword, any letter case, and a blank or "="; none where the line starts
/// with another word.
std::optional<std::string_view> behind(std::string_view line, std::string_view keyword) {
  line = trimmed(line);
  if (lower_case(line.substr(0, keyword.size())) != keyword) return std::nullopt;
  line.remove_prefix(keyword.size());
  if (line.empty() || (kBlanks.find(line[0]) == kBlanks.npos && line[0] != '='))
    return std::nullopt;
  return trimmed(line);
}

/// Whether one of the pairs KEY=value outside quotes is it; of a value all that is behind it, too.
template <class Is>
bool any_value(std::string_view line, Is is) {
  bool quoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    quoted = quoted != (line[at] == '"');
    if (quoted || line[at] != '=') continue;
    const std::string_view before = trimmed(line.substr(0, at));
    const std::string_view key = before.substr(before.find_last_of(", \t") + 1);
    if (is(key, trimmed(line.substr(at + 1)))) return true;
  }
  return false;
}

}  // namespace

bool NodeCounts::is_next(const std::vector<std::string_view>& row, const TableStyle& style,
                         std::size_t before) const {
  return parse_number(row[0], style) == first + static_cast<double>(before);
}

core::Failure NodeCounts::out_of_turn(const std::vector<std::string_view>& row,
                                      const std::string& place) const {
  return {core::ErrorCode::bad_input, "node " + shortened(row[0]) + " is out of turn",
          "number the nodes one after the other from " + std::to_string(first == 0 ? 0 : 1), place};
}

core::Failure NodeCounts::too_few(std::size_t read, const std::string& place) const {
  return {core::ErrorCode::bad_input,
          "only " + std::to_string(read) + " of " + core::counted(nodes, "node"),
          "check that the file is complete", place};
}

std::vector<double> numbers_of(const std::vector<std::string_view>& fields,
                               const TableStyle& style) {
  std::vector<double> numbers;
  for (const auto field : fields) numbers.push_back(parse_number(field, style).value_or(-1));
  return numbers;
}

std::optional<NodeCounts> node_counts(const std::vector<double>& first,
                                      const std::vector<std::string_view>& second,
                                      const TableStyle& style) {
  constexpr double kMost = 1e9;
  const auto is_count = [](double v) { return v >= 0 && v < kMost && v == std::floor(v); };
  if (first.size() != 4 || !std::ranges::all_of(first, is_count)) return std::nullopt;
  const double dimension = first[1];
  const double others = first[2] + first[3];
  if (second.empty()) return std::nullopt;
  const double number = parse_number(second[0], style).value_or(-1);
  const bool nodes = first[0] > 1 && (dimension == 2 || dimension == 3) && first[3] <= 1 &&
                     static_cast<double>(second.size()) == 1 + dimension + others &&
                     (number == 0 || number == 1);
  if (!nodes) return std::nullopt;
  return NodeCounts{.nodes = static_cast<std::size_t>(first[0]),
                    .others = static_cast<std::size_t>(others),
                    .first = number,
                    .in_space = dimension == 3};
}

std::optional<std::string_view> tecplot_variables(std::string_view line) {
  const auto rest = behind(line, "variables");
  if (!rest || !rest->starts_with('=')) return std::nullopt;
  return trimmed(rest->substr(1));
}

bool is_tecplot_zone(std::string_view line) {
  const auto rest = behind(line, "zone");
  return rest && rest->find('=') != rest->npos;
}

bool goes_on_with_zone(std::string_view line) {
  line = trimmed(line);
  const bool word = !line.empty() && std::isalpha(static_cast<unsigned char>(line[0]));
  return word && line.find('=') != line.npos && !is_tecplot_zone(line);
}

bool is_zone_of_blocks(std::string_view line) {
  const std::string text = lower_case(line);
  return any_value(text, [](std::string_view key, std::string_view value) {
    const bool layout = key == "f" || key == "datapacking" || key == "zonetype";
    return key == "et" || (layout && (value.starts_with("block") || value.starts_with("fe")));
  });
}

void ZoneCount::take(std::string_view line) {
  any_value(line, [this](std::string_view key, std::string_view value) {
    const std::string name = lower_case(key);
    const auto count = core::take_whole<std::size_t>(value);
    if (count && (name == "i" || name == "j" || name == "k"))
      points = points.value_or(1) * static_cast<double>(*count);
    return false;
  });
}

core::Result<void> ZoneCount::check(std::size_t rows) const {
  const std::size_t read = rows - before;
  if (!points || *points == static_cast<double>(read)) return {};
  return core::fail(core::ErrorCode::bad_input,
                    "a zone of " + core::number_text(*points, 12) + " points (I, J, K), and " +
                        core::counted(read, "row") + " behind it",
                    "check that the file is complete, or mend the zone", place);
}

std::string tecplot_title(std::string_view line) {
  std::string title;
  const bool zone = is_tecplot_zone(line);
  if (!zone && !behind(line, "title")) return title;
  any_value(line, [&](std::string_view key, std::string_view value) {
    const std::string_view name = value.substr(0, value.find('"', 1) + 1);
    const bool meant = lower_case(key) == (zone ? "t" : "title") && value.starts_with('"');
    if (meant) title = unquoted(name);
    return meant;
  });
  return title;
}

}  // namespace keyline::exchange::detail
