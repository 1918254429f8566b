#include "result_table.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/operations/json_form.h"

namespace keyline::app {
namespace {

using Kind = core::Type::Kind;
using Rows = std::vector<std::vector<std::string>>;

/// What of a member fits into a cell: empty for what is not given, nothing for lists and records.
bool cell_of(const core::Field& field, const void* member, std::string& cell) {
  const core::Type* its = &field.type();
  if (its->kind == Kind::optional) {
    its = &its->item();
    member = member ? field.type().held(member) : nullptr;
  }
  if (its->kind > Kind::choice) return false;
  if (!member) return true;
  const auto shown = operations::write_json(*its, member);
  if (!shown) return true;
  cell = shown->is_number_float() ? core::number_text(shown->get<double>(), 5)
         : shown->is_string()     ? core::on_one_line(shown->get<std::string>())
                                  : shown->dump();
  return true;
}

void add_record(const core::Type& type, const void* record, std::vector<std::string>& row,
                std::vector<std::string>* names) {
  core::visit_fields(type, record, [&](const core::Field& field, const void* member) {
    std::string cell;
    if (!cell_of(field, member, cell)) return;
    row.push_back(cell);
    if (names) names->push_back(std::string(field.name));
  });
}

}  // namespace

std::string table_of(const core::Type& type, const void* list) {
  if (type.kind != Kind::list || type.item().kind != Kind::record) return {};
  const std::size_t count = type.size(list);
  if (count == 0) return {};
  Rows rows(count + 1);
  for (std::size_t i = 0; i < count; ++i)
    add_record(type.item(), type.at(const_cast<void*>(list), i), rows[i + 1],
               i == 0 ? &rows[0] : nullptr);
  if (rows[0].empty()) return {};
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) line += fmt::format("{:<{}}  ", row[k], widths[k]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace keyline::app
