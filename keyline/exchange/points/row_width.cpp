#include "keyline/exchange/points/row_width.h"

#include <algorithm>

#include "keyline/core/text.h"

namespace keyline::exchange::detail {
namespace {

using Fields = RowWidth::Fields;

bool is_number(std::string_view field, const TableStyle& style) {
  return !field.empty() && parse_number(field, style).has_value();
}

bool has_number(const Fields& fields, std::size_t from, const TableStyle& style) {
  const auto begin = fields.begin() + static_cast<std::ptrdiff_t>(std::min(from, fields.size()));
  return std::any_of(begin, fields.end(), [&](auto f) { return is_number(f, style); });
}

std::unexpected<core::Failure> other_columns(std::size_t columns, std::size_t first,
                                             const char* hint, const std::string& place) {
  return core::fail(
      core::ErrorCode::bad_input,
      core::counted(columns, "column") + " where the first row has " + std::to_string(first), hint,
      place);
}

}  // namespace

RowWidth::RowWidth(const Fields& fields, std::string_view line, const TableStyle& style,
                   std::size_t named) {
  for (const std::string_view field : fields) numbers_.push_back(is_number(field, style));
  numbers_.resize(std::max(fields.size(), count_cells(line, style)));
  most_ = std::max(fields.size(), named);
}

core::Result<bool> RowWidth::check(const Fields& fields, std::string_view line,
                                   const TableStyle& style, const std::string& place) const {
  constexpr const char* kComma =
      "where numbers have a decimal comma, separate columns by ; or blanks";
  constexpr const char* kAll = "give every row all its columns, with nan for a missing number";
  const std::size_t width = numbers_.size();
  if (fields.size() > most_) {
    if (!has_number(fields, most_, style)) return false;
    if (style.separator != ',') return true;
    return other_columns(fields.size(), most_, kComma, place);
  }
  if (fields.size() > width && fields.size() != most_ && has_number(fields, width, style))
    return other_columns(fields.size(), width, kAll, place);
  if (fields.size() >= width) return false;
  const std::size_t cells = count_cells(line, style);
  const auto lacking = numbers_.begin() + static_cast<std::ptrdiff_t>(std::min(cells, width));
  if (std::find(lacking, numbers_.end(), true) == numbers_.end()) return false;
  return other_columns(cells, width, kAll, place);
}

}  // namespace keyline::exchange::detail
