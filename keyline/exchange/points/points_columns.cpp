#include "keyline/exchange/points/points_columns.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"

namespace keyline::exchange::detail {
namespace {

using core::ErrorCode;
using core::Result;
using Names = std::vector<std::string>;

constexpr int kNone = PointsColumns::kNone;

/// Names of the three coordinates. Surveys have eastings and northings; their heights are no third
/// coordinate of a line in plan.
constexpr std::initializer_list<const char*> kAxes[] = {{"x", "easting"}, {"y", "northing"}, {"z"}};

int find_name(const Names& names, std::initializer_list<const char*> wanted) {
  for (const char* name : wanted) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) return static_cast<int>(at - names.begin());
  }
  return kNone;
}

/// Whether the name is that letter among words for coordinates: "x-koordinate", "position x",
/// "x/c". "normal_x" is something else.
bool names_axis(std::string_view name, char axis) {
  int letters = 0;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of(" _-/.:"), name.size());
    const std::string_view word = name.substr(0, end);
    const bool letter = word.size() == 1 && word[0] == axis;
    letters += letter;
    if (!letter && !word.empty() && !is_coordinate_word(word)) return false;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return letters == 1;
}

/// The column whose name says that axis, where it is the only one.
int find_word(const Names& names, char axis) {
  const auto says = [axis](const std::string& name) { return names_axis(name, axis); };
  const auto at = std::ranges::find_if(names, says);
  const bool alone = at != names.end() && std::find_if(at + 1, names.end(), says) == names.end();
  return alone ? static_cast<int>(at - names.begin()) : kNone;
}

/// The column of an axis, by its name or by a word of it.
int find_axis(const Names& names, const std::initializer_list<const char*>& axis) {
  const int named = find_name(names, axis);
  return named != kNone ? named : find_word(names, **axis.begin());
}

Result<int> column_named(const Names& names, const std::string& wanted, const std::string& place) {
  const int named = find_name(names, {plain_name(wanted).c_str()});
  if (named != kNone) return named;
  const bool digits =
      !wanted.empty() && wanted.size() < 5 &&
      std::all_of(wanted.begin(), wanted.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits && std::stoi(wanted) >= 1) return std::stoi(wanted) - 1;
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  return core::fail(ErrorCode::bad_input, "there is no column '" + shortened(wanted) + "'",
                    known.empty() ? "the file has no header: give the number of the column"
                                  : "the columns are " + shortened(known),
                    place);
}

Result<void> take_asked(PointsColumns& columns, const Names& names, const PointsOptions& options,
                        const std::string& place) {
  if (options.columns.size() < 2 || options.columns.size() > 3)
    return core::fail(ErrorCode::bad_input, "two or three columns are needed",
                      "name the columns of x, y and maybe z", "columns");
  int* const wanted[] = {&columns.x, &columns.y, &columns.z};
  for (std::size_t k = 0; k < options.columns.size(); ++k) {
    const auto column = column_named(names, options.columns[k], place);
    if (!column) return std::unexpected(column.error());
    *wanted[k] = *column;
  }
  return {};
}

void take_named(PointsColumns& columns, const Names& names) {
  std::vector<int> found;
  for (const auto& axis : kAxes) {
    const int column = find_axis(names, axis);
    if (column != kNone) found.push_back(column);
  }
  while (found.size() < 2) found.push_back(static_cast<int>(found.size()));
  columns.x = found[0];
  columns.y = found[1];
  if (found.size() > 2) columns.z = found[2];
}

constexpr std::initializer_list<const char*> kOfCurves = {"id", "curve", "name", "curve_id"};

}  // namespace

bool is_coordinate_word(std::string_view word) {
  static constexpr auto kWords = std::to_array<std::string_view>(
      {"coordinate", "coord", "coords", "koordinate", "position", "pos", "axis", "achse", "value",
       "wert", "point", "punkt", "pt", "p", "c", "coordinates"});
  return std::ranges::find(kWords, word) != kWords.end();
}

bool names_curves(const Names& names, const PointsOptions& options) {
  return !options.id_column.empty() || find_name(names, kOfCurves) != kNone;
}

bool is_points_header(const Names& names, const PointsOptions& options) {
  if (names.size() < 2) return false;
  const auto named = [&](const auto& axis) { return find_axis(names, axis) != kNone; };
  const auto wanted = [&](const std::string& name) {
    return !name.empty() && find_name(names, {plain_name(name).c_str()}) != kNone;
  };
  return std::ranges::count_if(kAxes, named) >= 2 ||
         std::any_of(options.columns.begin(), options.columns.end(), wanted) ||
         wanted(options.id_column) || wanted(options.weight_column);
}

Result<PointsColumns> choose_columns(const Names& names, const PointsOptions& options,
                                     std::size_t fields, bool text_id, const std::string& place) {
  PointsColumns columns;
  if (!options.columns.empty()) {
    if (auto taken = take_asked(columns, names, options, place); !taken)
      return std::unexpected(taken.error());
  } else if (!names.empty()) {
    take_named(columns, names);
  } else {
    const int first = text_id ? 1 : 0;
    const bool three = static_cast<int>(fields) - first >= 3;
    columns = {first, first + 1, three ? first + 2 : kNone, kNone, text_id ? 0 : kNone};
  }
  if (columns.weight == kNone) columns.weight = find_name(names, {"weight", "weights", "w"});
  if (columns.id == kNone) columns.id = find_name(names, kOfCurves);
  for (const auto& [name, target] : {std::pair{&options.weight_column, &columns.weight},
                                     std::pair{&options.id_column, &columns.id}}) {
    if (name->empty()) continue;
    const auto column = column_named(names, *name, place);
    if (!column) return std::unexpected(column.error());
    *target = *column;
  }
  return columns;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 40;
  const std::string out = core::on_one_line(core::whole_characters(text, kMost));
  return text.size() > kMost ? out + "..." : out;
}

bool all_numbers(const std::vector<std::string_view>& fields, const TableStyle& style,
                 std::size_t from) {
  return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(from), fields.end(),
                     [&](auto f) { return parse_number(f, style).has_value(); });
}

bool is_remark(const std::vector<std::string_view>& fields, TableStyle style, std::size_t column,
               std::size_t width) {
  const auto is_number = [&](std::string_view f) {
    return !f.empty() && parse_number(f, style).has_value();
  };
  std::size_t words = 0;
  bool digits = false;  // in one of them: what might be a number with a mistake in it
  for (const std::string_view f : fields) {
    if (f.empty() || is_number(f)) continue;
    ++words;
    digits = digits || f.find_first_of("0123456789") != f.npos;
  }
  if (words == 0) return false;
  const bool starts = column < fields.size() && is_number(fields[column]);
  // A row may have a word behind its numbers; a sentence that starts with a number has several.
  if (starts) return words > 1 && (fields.size() > width + 1 || !digits);
  if (style.separator == ' ') return true;
  const bool sentence = std::any_of(fields.begin(), fields.end(), [](std::string_view f) {
    return f.find_first_of(" :=") != f.npos;
  });
  return fields.size() < width || (words == fields.size() && sentence);
}

bool is_like_row(const std::vector<std::string_view>& fields, TableStyle style, std::size_t width) {
  const auto is_fraction = [&](std::string_view f) {
    return f.find_first_of(".,") != f.npos && parse_number(f, style).has_value();
  };
  const auto fractions = static_cast<std::size_t>(std::ranges::count_if(fields, is_fraction));
  return fields.size() == width && width >= 2 && fractions + 1 == width;
}

}  // namespace keyline::exchange::detail
