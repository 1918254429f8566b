#include "keyline/exchange/points/points_sides.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/header_unit.h"

namespace keyline::exchange::detail {
namespace {

constexpr int kAbsent = PointsColumns::kNone;

/// What the words of a cell say: the letter of an axis, and one word beside what all coordinates
/// are called.
struct Cell {
  char axis = 0;
  std::string side;
  bool plain = true;  ///< nothing else
};

constexpr auto kPairs =
    std::to_array<std::pair<std::string_view, std::string_view>>({{"u", "l"},
                                                                  {"upper", "lower"},
                                                                  {"up", "lo"},
                                                                  {"up", "low"},
                                                                  {"top", "bottom"},
                                                                  {"top", "bot"},
                                                                  {"o", "u"},
                                                                  {"oben", "unten"},
                                                                  {"oberseite", "unterseite"},
                                                                  {"extrados", "intrados"},
                                                                  {"suction", "pressure"}});

bool is_axis(char c) { return c >= 'x' && c <= 'z'; }

bool is_of_pair(std::string_view word) {
  return std::ranges::any_of(
      kPairs, [&](const auto& pair) { return word == pair.first || word == pair.second; });
}

void take_word(Cell& cell, std::string_view word) {
  const bool alone = word.size() == 1 && is_axis(word[0]);
  const bool glued = word.size() > 1 && is_axis(word[0]) && is_of_pair(word.substr(1));
  if (alone || glued) {
    cell.plain = cell.plain && cell.axis == 0;
    cell.axis = word[0];
    word.remove_prefix(1);
  }
  static constexpr auto kOfSides = std::to_array<std::string_view>({"surface", "side", "ordinate"});
  if (word.empty() || is_coordinate_word(word) || !unit_in_words(word).empty() ||
      std::ranges::find(kOfSides, word) != kOfSides.end())
    return;
  cell.plain = cell.plain && cell.side.empty();
  cell.side = word;
}

Cell cell_of(std::string_view text) {
  Cell cell;
  const std::string name = lower_case(text);
  std::string_view rest = name;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(" _-/.:()[]\"'%"), rest.size());
    take_word(cell, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  // a letter by itself names a side only at an axis: u, v and l are many things
  if (cell.side.size() == 1 && cell.axis == 0) cell.plain = false;
  return cell;
}

/// The only cell that says so; kAbsent where there is none or more than one.
template <class Says>
int only(const std::vector<Cell>& cells, Says says) {
  if (std::ranges::count_if(cells, says) != 1) return kAbsent;
  return static_cast<int>(std::ranges::find_if(cells, says) - cells.begin());
}

int column_of(const std::vector<Cell>& cells, std::string_view side, bool across) {
  return only(
      cells, [&](const Cell& c) { return c.plain && c.side == side && (c.axis == 'x') != across; });
}

int common_x(const std::vector<Cell>& cells) {
  const int x =
      only(cells, [](const Cell& c) { return c.plain && c.axis == 'x' && c.side.empty(); });
  if (x != kAbsent) return x;
  static constexpr auto kAlong =
      std::to_array<std::string_view>({"station", "sta", "chord", "abscissa", "stationen"});
  return only(cells, [](const Cell& c) {
    return c.plain && c.axis == 0 && std::ranges::find(kAlong, c.side) != kAlong.end();
  });
}

std::string name_of(std::string_view text) {
  if (!unit_of(text).known.empty()) text = text.substr(0, start_of_unit(text));
  std::string name(trimmed(text));
  std::erase(name, '"');
  return name;
}

}  // namespace

std::optional<Sides> find_sides(const std::vector<std::string_view>& texts, bool whole) {
  std::vector<Cell> cells;
  for (const std::string_view text : texts) cells.push_back(cell_of(text));
  const bool other = std::ranges::any_of(
      cells, [](const Cell& c) { return c.axis > 'x' && (c.side.empty() || !c.plain); });
  if (other) return std::nullopt;
  for (const auto& [upper, lower] : kPairs) {
    int above = column_of(cells, upper, true);
    int below = column_of(cells, lower, true);
    if (above == kAbsent || below == kAbsent) continue;
    int x_above = column_of(cells, upper, false);
    int x_below = column_of(cells, lower, false);
    const bool own = x_above != kAbsent && x_below != kAbsent;
    if (!own) x_above = x_below = common_x(cells);
    if (x_above == kAbsent || (whole && cells.size() != (own ? 4U : 3U))) continue;
    if (above > below) {
      std::swap(above, below);
      std::swap(x_above, x_below);
    }
    const auto side = [&](int x, int y) {
      return Sides::Side{x, y, name_of(texts[static_cast<std::size_t>(y)])};
    };
    return Sides{side(x_above, above), side(x_below, below)};
  }
  return std::nullopt;
}

}  // namespace keyline::exchange::detail
