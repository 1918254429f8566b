#include <array>
#include <cmath>
#include <optional>

#include "keyline/exchange/json_space.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/surface/interrogate.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using surface::FieldKind;

constexpr int kMostValues = 1'048'576;

Result<FieldKind> kind_of(const std::string& name) {
  if (const auto kind = surface::field_named(name)) return *kind;
  return core::fail(ErrorCode::bad_input, "\"" + name + "\" is no kind of field",
                    "use gaussian, mean, principal, zebra, isophote, reflection or highlight",
                    "kind");
}

Result<std::array<int, 2>> grid_of(const json& request) {
  if (!request.contains("grid")) return std::array{65, 65};
  const auto numbers = numbers_of_count(request, "grid", 1, 2);
  if (!numbers) return std::unexpected(numbers.error());
  const double rows = numbers->front();
  const double columns = numbers->back();
  const bool whole = rows == std::floor(rows) && columns == std::floor(columns);
  if (!whole || rows < 2 || columns < 2 || rows * columns > kMostValues)
    return core::fail(ErrorCode::bad_input, "the grid is out of range",
                      "give whole numbers [along u, along v] from 2, at most 1048576 points",
                      "grid");
  return std::array{static_cast<int>(rows), static_cast<int>(columns)};
}

surface::Lighting lighting_of(const json& request) {
  surface::Lighting l;
  const auto vector = [&](const char* name) -> std::optional<core::Vector3> {
    if (!request.contains(name)) return std::nullopt;
    return point3_of(request, name) - core::Point3{};
  };
  l.view = vector("view");
  l.light = vector("light");
  l.stripes = vector("stripes");
  if (request.contains("origin")) l.origin = point3_of(request, "origin");
  l.stripe_count = number_or(request, "stripe_count", l.stripe_count);
  l.spacing = number_or(request, "spacing", l.spacing);
  return l;
}

json number_or_null(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

json values_json(const surface::Field& field) {
  json rows = json::array();
  for (int i = 0; i < field.rows; ++i) {
    json row = json::array();
    for (int j = 0; j < field.columns; ++j) {
      const std::size_t at = static_cast<std::size_t>(i) * field.columns + j;
      const json value = number_or_null(field.values[at]);
      if (field.second.empty()) {
        row.push_back(value);
      } else {
        row.push_back(json::array({value, number_or_null(field.second[at])}));
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

json vector_json(core::Vector3 v) { return json::array({v.x, v.y, v.z}); }

json points_json(const surface::JetGrid& grid) {
  json rows = json::array();
  for (int i = 0; i < grid.rows; ++i) {
    json row = json::array();
    for (int j = 0; j < grid.columns; ++j) row.push_back(exchange::to_json(grid.at(i, j).point));
    rows.push_back(std::move(row));
  }
  return rows;
}

Result<json> run(const json& request, const Context& context) {
  const auto kind = kind_of(string_or(request, "kind", ""));
  if (!kind) return std::unexpected(kind.error());
  const auto size = grid_of(request);
  if (!size) return std::unexpected(size.error());
  const surface::JetGrid grid =
      surface::sample_grid(surface_of(request, "surface"), (*size)[0], (*size)[1], context.threads);
  const surface::Lighting lighting = lighting_of(request);
  const auto field = surface::interrogate(grid, *kind, lighting);
  if (!field) return std::unexpected(field.error());
  const surface::Lighting used = surface::completed(lighting, grid);
  json result{{"kind", request.at("kind")},      {"grid", {field->rows, field->columns}},
              {"values", values_json(*field)},   {"range", {field->range.low, field->range.high}},
              {"view", vector_json(*used.view)}, {"stripes", vector_json(*used.stripes)}};
  if (boolean_or(request, "points", false)) result["points"] = points_json(grid);
  return result;
}

}  // namespace

Operation surface_interrogate_operation() {
  using Type = Field::Type;
  return {
      "surface.interrogate",
      "A field over a surface on a grid of equal steps in u (rows) and v (columns): curvature, or "
      "what light shows of it. null where the surface has no normal or a ray misses.",
      {{"surface", Type::surface, true, "a Bezier or B-spline surface"},
       {"kind", Type::string, true,
        "gaussian, mean, principal (pairs, larger first), zebra (white where the fraction is below "
        "1/2), isophote (cosine to the light), reflection (light lines, in spacings) or highlight "
        "(distance of the normal line from the light line)"},
       {"grid", Type::number_or_numbers, false, "points along u and v, [65, 65] unless given"},
       {"view", Type::point3, false, "direction to the eye; the mean normal unless given"},
       {"light", Type::point3, false,
        "direction to the light (isophote) or of the light line (highlight)"},
       {"stripes", Type::point3, false, "direction the stripes are stacked in (zebra, reflection)"},
       {"origin", Type::point3, false, "a point of the first light line (reflection, highlight)"},
       {"stripe_count", Type::number, false, "zebra: black and white pairs on a sphere, 12"},
       {"spacing", Type::number, false, "reflection: of the light lines"},
       {"points", Type::boolean, false, "also the points of the grid"}},
      run,
      {{"surface",
        {{"type", "bezier-surface"},
         {"points", {{{0, 0, 0}, {0, 1, 0.2}}, {{1, 0, 0.3}, {1, 1, 0.1}}}}}},
       {"kind", "gaussian"},
       {"grid", {3, 3}}}};
}

}  // namespace keyline::operations
