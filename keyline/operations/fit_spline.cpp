#include "keyline/fit/fit_spline.h"

#include <cmath>

#include "keyline/exchange/json_curve.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/spline_search.h"

namespace keyline::operations {
namespace {

using core::Result;
using nlohmann::json;

Result<fit::SplineFitOptions> options_of(const json& request, const Context& context) {
  fit::SplineFitOptions options;
  if (auto done = read_spline_search(request, {2, 8}, options); !done)
    return std::unexpected(done.error());
  options.seed = static_cast<std::uint64_t>(integer_or(request, "seed", 1));
  options.closed = boolean_or(request, "closed", false);
  for (const double index : numbers_of(request, "must_pass")) {
    if (index < 0 || index != std::floor(index))
      return core::fail(core::ErrorCode::bad_input, "an index is not a whole number",
                        "give indices of points, from 0", "must_pass");
    options.must_pass.push_back(static_cast<std::size_t>(index));
  }
  options.threads = context.threads;
  options.progress = context.progress;
  return options;
}

json report_json(const fit::SplineFitReport& report) {
  return {{"status", report.status == fit::SplineFitStatus::complete ? "complete" : "cancelled"},
          {"generations", report.generations},
          {"evaluations", report.evaluations},
          {"data_used", report.data_used},
          {"rounding", report.rounding},
          {"seed", report.seed}};
}

/// Of a fit to points or to a function.
template <class Fit>
json fit_json(const Fit& fit, const curve::BSpline2& curve) {
  return {{"curve", exchange::to_json(document::PlanarCurve{curve})},
          {"knots", fit.interior_knots},
          {"sse", fit.sse},
          {"bic", fit.bic},
          {"deviation", fit.deviation},
          {"rms", fit.rms},
          {"report", report_json(fit.report)}};
}

Result<json> fit_plane(const json& request, const fit::SplineFitOptions& options) {
  const auto fit =
      fit::fit_spline(points_of(request, "points"), numbers_of(request, "weights"), options);
  if (!fit) return std::unexpected(fit.error());
  return fit_json(*fit, fit->curve);
}

/// A function's graph as a planar spline: abscissae of the control points are Greville's.
curve::BSpline2 graph_of(const fit::LeastSquaresSpline& spline) {
  curve::BSpline2 graph;
  graph.degree = spline.order - 1;
  graph.knots = spline.knots;
  for (std::size_t i = 0; i < spline.coefficients[0].size(); ++i) {
    double x = 0;
    for (int k = 1; k <= graph.degree; ++k) x += spline.knots[i + k];
    graph.control.push_back({x / graph.degree, spline.coefficients[0][i]});
  }
  return graph;
}

Result<json> fit_graph(const json& request, const fit::SplineFitOptions& options) {
  const std::vector<double> x = numbers_of(request, "x");
  const std::vector<double> y = numbers_of(request, "y");
  const auto fit = fit::fit_function(x, y, numbers_of(request, "weights"), options);
  if (!fit) return std::unexpected(fit.error());
  return fit_json(*fit, graph_of(fit->spline));
}

Result<json> run(const json& request, const Context& context) {
  const bool plane = request.contains("points");
  const bool graph = request.contains("x") || request.contains("y");
  if (plane == graph || (graph && !(request.contains("x") && request.contains("y"))))
    return core::fail(core::ErrorCode::bad_input, "either \"points\" or \"x\" and \"y\" are wanted",
                      "give points of a curve, or x and y of a function", "points");
  const auto options = options_of(request, context);
  if (!options) return std::unexpected(options.error());
  return plane ? fit_plane(request, *options) : fit_graph(request, *options);
}

}  // namespace

Operation fit_spline_operation() {
  using Type = Field::Type;
  return {"fit.spline",
          "Least-squares B-spline through points of a curve or of a function, its knots found by a "
          "genetic algorithm on the Bayes information criterion.",
          {{"points", Type::points, false, "points of a plane curve, in order"},
           {"x", Type::numbers, false, "abscissae of a function; with y, instead of points"},
           {"y", Type::numbers, false, "its values"},
           {"weights", Type::numbers, false, "one positive weight per point"},
           {"must_pass", Type::numbers, false, "indices of points the curve must pass"},
           {"order", Type::integer, false, "degree + 1, 4 to 6 recommended; 4 unless given"},
           {"population", Type::integer, false, "individuals, 50 to 150 recommended"},
           {"generations", Type::integer, false, "100 to 300 recommended"},
           {"trials", Type::integer, false, "independent searches, 20 to 40 recommended"},
           {"knots", Type::string, false, "\"polished\" (default) or \"ga\""},
           {"parameter", Type::string, false,
            "\"chord\" (default), \"centripetal\" or \"smooth-chord\""},
           {"closed", Type::boolean, false, "the points are a closed loop"},
           {"seed", Type::integer, false, "of the search; 1 unless given"}},
          run,
          {{"x", {0, 1, 2, 3, 4, 5, 6, 7}},
           {"y", {0, 0.8, 0.9, 0.1, -0.7, -0.9, -0.3, 0.6}},
           {"trials", 2},
           {"generations", 20}}};
}

}  // namespace keyline::operations
