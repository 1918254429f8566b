#include "keyline/lac/quasi/quasi.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/verdict.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using lac::QuasiForm;

enum class Automatic { automatic };
constexpr auto choices(const Automatic*) {
  return core::words<Automatic>({{Automatic::automatic, "auto"}});
}

struct QuasiRequest {
  std::optional<Handles> points;
  double alpha = -1;
  std::optional<double> lambda;
  std::optional<std::array<double, 2>> interval;
  std::optional<int> degree;
  QuasiForm form = QuasiForm::taylor_angle;
  std::optional<std::variant<double, Automatic>> about;
  static constexpr auto describe() {
    return core::fields(
        core::field<&QuasiRequest::points>(kHandles),
        core::field<&QuasiRequest::alpha>(kSlope).needed(),
        core::field<&QuasiRequest::lambda>("of the standard form, with interval"),
        core::field<&QuasiRequest::interval>("[from, to] in tangent angle").in("radian"),
        core::field<&QuasiRequest::degree>(
            "of the Bezier; at least 5 for best; 8 unless given, a rational cubic is of degree 3")
            .within(core::from_to(3, 30)),
        core::field<&QuasiRequest::form>("how the curve is approximated"),
        core::field<&QuasiRequest::about>(
            "Taylor forms: fraction of the interval to expand at, or \"auto\" for the best")
            .within(core::from_to(0, 1)));
  }
};

struct QuasiLcg {
  double slope = 0;
  double variance = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&QuasiLcg::slope>("of the line through the graph"),
                        core::field<&QuasiLcg::variance>("of the slope along the graph"));
  }
};

struct QuasiAnswer {
  MadeCurve curve;
  document::Path target;
  QuasiForm form = QuasiForm::taylor_angle;
  double about = 0;
  double lambda = 0;
  double deviation = 0;
  Verdict monotone = Verdict::undecided;
  std::optional<QuasiLcg> lcg;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&QuasiAnswer::curve>(),
        core::field<&QuasiAnswer::target>("the log-aesthetic segment it stands for"),
        core::field<&QuasiAnswer::form>("the one taken"),
        core::field<&QuasiAnswer::about>("Taylor forms: where it was expanded"),
        core::field<&QuasiAnswer::lambda>("of the standard form"),
        core::field<&QuasiAnswer::deviation>("bound of the distance from the target").in("length"),
        core::field<&QuasiAnswer::monotone>("whether curvature is, certified"),
        core::field<&QuasiAnswer::lcg>("logarithmic curvature graph; null for arcs and lines")
            .null_if_empty());
  }
};

lac::QuasiOptions options_of(const QuasiRequest& request) {
  lac::QuasiOptions options;
  options.form = request.form;
  options.degree =
      request.degree.value_or(request.form == QuasiForm::rational_cubic ? 3 : options.degree);
  if (!request.about) return options;
  if (const auto* fraction = std::get_if<double>(&*request.about))
    options.about = *fraction;
  else
    options.automatic = true;
  return options;
}

Result<lac::QuasiResult> solve(const QuasiRequest& request) {
  const lac::QuasiOptions options = options_of(request);
  if (request.points.has_value() == (request.lambda || request.interval))
    return core::fail(ErrorCode::bad_input, "either handles or the standard form are wanted",
                      "give points, or lambda and interval", "points");
  if (request.points) {
    const auto& [p0, p1, p2] = *request.points;
    return lac::quasi_log_aesthetic(p0, p1, p2, request.alpha, options);
  }
  if (!request.lambda || !request.interval)
    return core::fail(
        ErrorCode::bad_input, request.lambda ? "\"interval\" is missing" : "\"lambda\" is missing",
        "the standard form takes lambda and interval", request.lambda ? "interval" : "lambda");
  const auto& [from, to] = *request.interval;
  return lac::quasi_log_aesthetic(request.alpha, *request.lambda, {from, to}, options);
}

Result<QuasiAnswer> run(const QuasiRequest& request, const Context&) {
  auto solved = solve(request);
  if (!solved) return std::unexpected(solved.error());
  QuasiAnswer answer;
  answer.curve = made({std::move(solved->curve)});
  answer.target = path_of({lac::chain_of(solved->target)});
  answer.form = solved->form;
  answer.about = solved->about;
  answer.lambda = solved->lambda;
  answer.deviation = solved->deviation;
  answer.monotone = verdict_of(solved->monotone.answer);
  if (solved->lcg_defined) answer.lcg = QuasiLcg{solved->lcg_slope, solved->lcg_variance};
  return answer;
}

}  // namespace

Operation lac_quasi_operation() {
  return declare<run>(
      {.name = "lac.quasi",
       .summary = "A quasi-log-aesthetic curve: a Bézier close to a log-aesthetic segment, from "
                  "three handles (whose ends and tangents it meets itself) or from the standard "
                  "form.",
       .examples = {R"({"points":[[0,0],[2,0],[3,1.5]],"alpha":-1,"degree":8,
                        "form":"taylor-angle"})",
                    R"({"alpha":-1,"lambda":0.5,"interval":[0,1],"about":"auto"})"}});
}

}  // namespace keyline::operations
