#include "keyline/fit/knot_rates.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;
using fit::SplineFitOptions;

struct SplineFitRequest {
  std::optional<std::vector<core::Point2>> points;
  std::optional<std::vector<double>> x;
  std::optional<std::vector<double>> y;
  std::vector<double> weights;
  SplineFitOptions options;
  fit::SplineSettings settings;
  static constexpr auto describe() {
    using Request = SplineFitRequest;
    return core::fields(
        core::field<&Request::points>("points of a plane curve, in order; or x and y").count(1),
        core::field<&Request::x>("abscissae of a function; with y, instead of points"),
        core::field<&Request::y>("its values"),
        core::field<&Request::weights>("one positive weight per point"),
        core::field<&Request::options, &SplineFitOptions::must_pass>(
            "indices of points the curve must pass, from 0"),
        core::field<&Request::options, &SplineFitOptions::closed>("the points are a closed loop"),
        core::flattened<&Request::options>(),
        core::field<&Request::settings, &fit::SplineSettings::rates>(
            "how often the genetic search crosses and mutates"),
        core::field<&Request::settings, &fit::SplineSettings::interval>(
            "of a function: [a, b] the spline is wanted on, which holds all x"),
        core::field<&Request::options, &SplineFitOptions::seed>(
            "of the search; the same seed, the same result"));
  }
};

enum class Status { complete, cancelled };
constexpr auto choices(const Status*) {
  return core::words<Status>({{Status::complete, "complete"}, {Status::cancelled, "cancelled"}});
}

struct SearchReport {
  Status status = Status::complete;
  fit::SplineFitReport search;
  static constexpr auto describe() {
    using Report = fit::SplineFitReport;
    return core::fields(
        core::field<&SearchReport::status>("whether the whole search was done"),
        core::field<&SearchReport::search, &Report::generations>("done, over all trials"),
        core::field<&SearchReport::search, &Report::evaluations>("least-squares fits"),
        core::field<&SearchReport::search, &Report::data_used>("data in the search"),
        core::field<&SearchReport::search, &Report::rounding>("of the data; 0: none found"),
        core::field<&SearchReport::search, &Report::seed>("as given"));
  }
};

struct SplineFitAnswer {
  MadeCurve curve;
  std::vector<double> knots;
  double sse = 0;
  double bic = 0;
  double deviation = 0;
  double rms = 0;
  SearchReport report;
  static constexpr auto describe() {
    using Answer = SplineFitAnswer;
    return core::fields(core::flattened<&Answer::curve>(),
                        core::field<&Answer::knots>("interior ones, increasing"),
                        core::field<&Answer::sse>("weighted sum of squares"),
                        core::field<&Answer::bic>("Bayes information criterion; lower is better"),
                        core::field<&Answer::deviation>("largest distance of a point").in("length"),
                        core::field<&Answer::rms>("root of the weighted mean square").in("length"),
                        core::field<&Answer::report>("how the search went"));
  }
};

/// Of a fit to points or to a function.
template <class Fit>
SplineFitAnswer answer_of(Fit&& fit, curve::BSpline2 curve) {
  const bool complete = fit.report.status == fit::SplineFitStatus::complete;
  return {made({std::move(curve)}),
          std::move(fit.interior_knots),
          fit.sse,
          fit.bic,
          fit.deviation,
          fit.rms,
          {complete ? Status::complete : Status::cancelled, fit.report}};
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

Result<SplineFitAnswer> run(const SplineFitRequest& request, const Context& context) {
  const bool graph = request.x || request.y;
  if (request.points.has_value() == graph || (graph && !(request.x && request.y)))
    return core::fail(core::ErrorCode::bad_input, "either \"points\" or \"x\" and \"y\" are wanted",
                      "give points of a curve, or x and y of a function", "points");
  SplineFitOptions options = request.options;
  // [Fairing]'s plain search: random first knots, no polish.
  if (options.knots == fit::KnotPlacement::ga) options.smart_start = false;
  options.threads = context.threads;
  options.progress = context.progress;
  if (graph) {
    if (request.x->size() != request.y->size())
      return core::fail(core::ErrorCode::bad_input, "as many y as x are needed",
                        "give one y for each x", "y");
    auto fit =
        fit::fit_function(*request.x, *request.y, request.weights, options, request.settings);
    if (!fit) return std::unexpected(fit.error());
    return answer_of(*fit, graph_of(fit->spline));
  }
  if (request.settings.interval)
    return core::fail(core::ErrorCode::bad_input, "only a function has an interval",
                      "give x and y, or no interval", "interval");
  auto fit = fit::fit_spline(*request.points, request.weights, options, request.settings.rates);
  if (!fit) return std::unexpected(fit.error());
  return answer_of(*fit, fit->curve);
}

}  // namespace

Operation fit_spline_operation() {
  return declare<run>(
      {.name = "fit.spline",
       .summary = "Least-squares B-spline through points of a curve or of a function, its knots "
                  "found by a genetic algorithm on the Bayes information criterion. [Fairing] "
                  "recommends order 4 to 6, population 50 to 150, generations 100 to 300 and "
                  "trials 20 to 40.",
       .examples = {R"({"x":[0,1,2,3,4,5,6,7],"y":[0,0.8,0.9,0.1,-0.7,-0.9,-0.3,0.6],
                        "trials":2,"generations":20})"},
       .long_running = true});
}

}  // namespace keyline::operations
