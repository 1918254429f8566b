#include "keyline/exchange/json/json_hull.h"

#include <cmath>
#include <limits>

#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"
#include "keyline/exchange/json/json_parts.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using detail::in;
using nlohmann::json;

constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();

const json* hull_of(const json& j) {
  const json* at = &j;
  for (const char* key : {"structure", "hull"})
    if (at->is_object() && at->contains(key)) at = &(*at)[key];
  return at->is_object() && at->contains("halfBreadths") ? at : nullptr;
}

Result<double> attribute(const json& hull, const char* name) {
  const auto attributes = detail::member(hull, "attributes", "");
  if (!attributes) return std::unexpected(attributes.error());
  const auto value = detail::number_member(**attributes, name, "attributes");
  if (value && !(*value > 0))
    return fail(ErrorCode::bad_input, "a size of the hull is not positive", "correct it",
                in("attributes", name));
  return value;
}

Result<std::vector<double>> axis(const json& table, const char* name, double unit) {
  const auto list = detail::member(table, name, "halfBreadths");
  if (!list) return std::unexpected(list.error());
  auto values = detail::numbers(**list, in("halfBreadths", name));
  if (!values) return values;
  for (double& v : *values) v *= unit;
  if (!values->empty() && !std::isfinite(values->front()))
    return fail(ErrorCode::bad_input, "this is too large", "correct it", in("halfBreadths", name));
  for (std::size_t i = 1; i < values->size(); ++i)
    if (!((*values)[i] > (*values)[i - 1]) || !std::isfinite((*values)[i]))
      return fail(ErrorCode::bad_input, "these do not grow", "put them in order",
                  in(in("halfBreadths", name), i));
  return values;
}

Result<void> add_row(HullTable& hull, const json& row, double unit, const std::string& where) {
  if (!row.is_array() || row.size() != hull.stations.size())
    return fail(ErrorCode::bad_input,
                "a row needs " + core::counted(hull.stations.size(), "half-breadth"),
                "give one per station, null outside the hull", where);
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (row[k].is_null()) {
      hull.half_breadth.push_back(kOutside);
      continue;
    }
    const auto value = number_from_json(row[k], in(where, k));
    if (!value) return std::unexpected(value.error());
    if (*value < 0)
      return fail(ErrorCode::bad_input, "a half-breadth is negative",
                  "correct it, or give null outside the hull", in(where, k));
    const double half_breadth = *value * unit;
    if (!(half_breadth <= core::kLargestCoordinate))
      return core::coordinate_too_large(in(where, k));
    hull.half_breadth.push_back(half_breadth);
  }
  return {};
}

}  // namespace

bool is_hull_json(const json& j) { return hull_of(j) != nullptr; }

Result<HullTable> hull_from_json(const json& j) {
  const json* hull = hull_of(j);
  if (!hull)
    return fail(ErrorCode::bad_input, "there is no table of offsets", "give \"halfBreadths\"");
  const auto length = attribute(*hull, "LOA");
  if (!length) return std::unexpected(length.error());
  const auto breadth = attribute(*hull, "BOA");
  if (!breadth) return std::unexpected(breadth.error());
  const auto depth = attribute(*hull, "Depth");
  if (!depth) return std::unexpected(depth.error());
  const json& table = (*hull)["halfBreadths"];
  auto waterlines = axis(table, "waterlines", *depth);
  if (!waterlines) return std::unexpected(waterlines.error());
  auto stations = axis(table, "stations", *length);
  if (!stations) return std::unexpected(stations.error());
  HullTable made{std::move(*waterlines), std::move(*stations), {}};
  const auto rows = detail::member(table, "table", "halfBreadths");
  if (!rows) return std::unexpected(rows.error());
  if (!(*rows)->is_array() || (*rows)->size() != made.waterlines.size())
    return fail(ErrorCode::bad_input, "the table needs a row for every waterline", "give them",
                "halfBreadths.table");
  for (std::size_t i = 0; i < (*rows)->size(); ++i)
    if (auto done = add_row(made, (**rows)[i], *breadth / 2, in("halfBreadths.table", i)); !done)
      return std::unexpected(done.error());
  return made;
}

}  // namespace keyline::exchange
