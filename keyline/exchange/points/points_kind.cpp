#include "keyline/exchange/points/points_kind.h"

#include <algorithm>
#include <array>

#include "keyline/exchange/file/standard_stream.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {
namespace {

core::Result<void> refused(const std::string& file) {
  return core::fail(core::ErrorCode::bad_input,
                    "a scan in PTX: its points are placed by a matrix before them, which is not "
                    "read",
                    "convert it to PTS, XYZ or PLY", file);
}

bool has_numbers(std::string_view line, std::size_t count) {
  const auto fields = split(line, {});
  return fields.size() == count && std::ranges::all_of(fields, [](std::string_view field) {
           return parse_number(field, {}).has_value();
         });
}

}  // namespace

core::Result<void> PointsKind::take(std::string_view line, const std::string& file) {
  constexpr std::array<std::size_t, 7> kHead = {1, 1, 3, 3, 3, 3, 4};  // no other list begins so
  if (!is_head_) return {};
  if (extension_of(file) == ".ptx") return refused(file);
  is_head_ = has_numbers(line, kHead[line_]);
  if (!is_head_) return {};
  ++line_;
  is_head_ = line_ < kHead.size();
  return is_head_ ? core::Result<void>{} : refused(file);
}

}  // namespace keyline::exchange::detail
