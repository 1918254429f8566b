#include "keyline/exchange/json_curve.h"
#include "keyline/lac/spline.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

/// [start, end], either of them null for none.
Result<void> read_ends(const json& request, const char* name,
                       std::optional<double> lac::SplineEnd::* member,
                       lac::SplineOptions& options) {
  const auto it = request.find(name);
  if (it == request.end()) return {};
  if (!it->is_array() || it->size() != 2)
    return core::fail(ErrorCode::bad_input, std::string("\"") + name + "\" is no pair",
                      "give [start, end]; null for an end without", name);
  lac::SplineEnd* const ends[2] = {&options.start, &options.end};
  for (std::size_t i = 0; i < 2; ++i) {
    if ((*it)[i].is_null()) continue;
    const auto value =
        exchange::number_from_json((*it)[i], std::string(name) + "[" + std::to_string(i) + "]");
    if (!value) return std::unexpected(value.error());
    ends[i]->*member = *value;
  }
  return {};
}

json report_of(const lac::SplineSolution& solved, std::size_t spans) {
  json overridden = json::array();
  for (const std::size_t span : solved.overridden)
    overridden.push_back({{"span", span}, {"alpha", -1}});
  return {{"spans", spans},
          {"overridden", std::move(overridden)},
          {"deviation", solved.deviation},
          {"iterations", solved.iterations}};
}

Result<json> run(const json& request, const Context&) {
  const std::vector<core::Point2> points = points_of(request, "points");
  lac::SplineOptions options;
  options.closed = boolean_or(request, "closed", false);
  const std::size_t spans = options.closed ? points.size() : points.size() - 1;
  if (request.contains("alpha")) {
    const auto alpha = numbers_of_count(request, "alpha", 1, std::max<std::size_t>(spans, 1));
    if (!alpha) return std::unexpected(alpha.error());
    options.alpha = *alpha;
  }
  if (auto read = read_ends(request, "directions", &lac::SplineEnd::direction, options); !read)
    return std::unexpected(read.error());
  if (auto read = read_ends(request, "curvatures", &lac::SplineEnd::curvature, options); !read)
    return std::unexpected(read.error());
  const auto solved = lac::solve_spline(points, options);
  if (!solved) return std::unexpected(solved.error());
  return json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
              {"report", report_of(*solved, spans)}};
}

}  // namespace

Operation lac_spline_operation() {
  using Type = Field::Type;
  return {"lac.spline",
          "The G2 spline of log-aesthetic pieces through the points, one piece per span. Spans "
          "whose curvature changes sign need a slope below 0; the report lists those overridden.",
          {{"points", Type::points, true, "what the curve passes, in order"},
           {"alpha", Type::number_or_numbers, false, "one slope, or one per span; -1 if left out"},
           {"closed", Type::boolean, false, "whether the curve returns to the first point"},
           {"directions", Type::any, false,
            "[start, end] direction of travel in radians; null for a free end"},
           {"curvatures", Type::any, false, "[start, end] signed curvature; null for a free end"}},
          run,
          {{"points", {{0, 0}, {1, 0.8}, {2.5, 1}, {4, 0.2}}}, {"alpha", -1}}};
}

}  // namespace keyline::operations
