#include "keyline/exchange/json_curve.h"
#include "keyline/lac/quasi.h"
#include "keyline/operations/analysis_json.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using lac::QuasiForm;
using nlohmann::json;

constexpr std::pair<const char*, QuasiForm> kForms[] = {
    {"taylor-angle", QuasiForm::taylor_angle},     {"taylor-arc", QuasiForm::taylor_arc},
    {"discrete-angle", QuasiForm::discrete_angle}, {"discrete-arc", QuasiForm::discrete_arc},
    {"rational-cubic", QuasiForm::rational_cubic}, {"best", QuasiForm::best}};

std::string name_of(QuasiForm form) {
  for (const auto& [name, value] : kForms)
    if (value == form) return name;
  return "";
}

Result<QuasiForm> form_of(const json& request) {
  const std::string asked = string_or(request, "form", "taylor-angle");
  for (const auto& [name, value] : kForms)
    if (asked == name) return value;
  return core::fail(ErrorCode::bad_input, "\"" + asked + "\" is no form",
                    "use taylor-angle, taylor-arc, discrete-angle, discrete-arc, rational-cubic or "
                    "best",
                    "form");
}

Result<lac::QuasiOptions> options_of(const json& request) {
  lac::QuasiOptions options;
  const auto form = form_of(request);
  if (!form) return std::unexpected(form.error());
  options.form = *form;
  const int usual = options.form == QuasiForm::rational_cubic ? 3 : 8;
  const auto degree = integer_between(request, "degree", usual, 3, 30);
  if (!degree) return std::unexpected(degree.error());
  options.degree = *degree;
  const auto about = request.find("about");
  if (about == request.end()) return options;
  if (*about == "auto") {
    options.automatic = true;
    return options;
  }
  const auto fraction = exchange::number_from_json(*about, "about");
  if (!fraction || !(*fraction >= 0 && *fraction <= 1))
    return core::fail(ErrorCode::bad_input, "\"about\" is out of range",
                      "give a number from 0 to 1, or \"auto\"", "about");
  options.about = *fraction;
  return options;
}

Result<lac::QuasiResult> solve(const json& request, const lac::QuasiOptions& options) {
  const double alpha = number_or(request, "alpha", -1);
  if (request.contains("points") == (request.contains("lambda") || request.contains("interval")))
    return core::fail(ErrorCode::bad_input, "either handles or the standard form are wanted",
                      "give points, or lambda and interval", "points");
  if (request.contains("points")) {
    const auto handles = three_handles(request);
    if (!handles) return std::unexpected(handles.error());
    const auto& [p0, p1, p2] = *handles;
    return lac::quasi_log_aesthetic(p0, p1, p2, alpha, options);
  }
  for (const char* name : {"lambda", "interval"})
    if (!request.contains(name))
      return core::fail(ErrorCode::bad_input, std::string("\"") + name + "\" is missing",
                        "the standard form takes lambda and interval", name);
  const auto interval = numbers_of_count(request, "interval", 2, 2);
  if (!interval) return std::unexpected(interval.error());
  return lac::quasi_log_aesthetic(alpha, number_or(request, "lambda", 0),
                                  {(*interval)[0], (*interval)[1]}, options);
}

const char* answer_of(const curve::MonotoneVerdict& verdict) {
  using Answer = curve::MonotoneVerdict::Answer;
  return verdict.answer == Answer::yes ? "yes" : verdict.answer == Answer::no ? "no" : "undecided";
}

Result<json> run(const json& request, const Context&) {
  const auto options = options_of(request);
  if (!options) return std::unexpected(options.error());
  const auto solved = solve(request, *options);
  if (!solved) return std::unexpected(solved.error());
  json result{{"curve", exchange::to_json(document::PlanarCurve{solved->curve})},
              {"target", exchange::to_json(document::PlanarCurve{lac::chain_of(solved->target)})},
              {"form", name_of(solved->form)},
              {"about", solved->about},
              {"lambda", solved->lambda},
              {"deviation", solved->deviation},
              {"monotone", answer_of(solved->monotone)},
              {"lcg", nullptr}};
  if (solved->lcg_defined)
    result["lcg"] = {{"slope", solved->lcg_slope}, {"variance", solved->lcg_variance}};
  return result;
}

}  // namespace

Operation lac_quasi_operation() {
  using Type = Field::Type;
  return {"lac.quasi",
          "A quasi-log-aesthetic curve: a Bézier close to a log-aesthetic segment, from three "
          "handles (whose ends and tangents it meets itself) or from the standard form.",
          {{"points", Type::points, false, "P0, P1, P2: ends P0 and P2, tangents along P0P1, P1P2"},
           {"alpha", Type::number, true, "slope of the logarithmic curvature graph"},
           {"lambda", Type::number, false, "of the standard form, with interval"},
           {"interval", Type::numbers, false, "[from, to] in tangent angle, radians"},
           {"degree", Type::integer, false, "3 to 30; at least 5 for best; 8 if left out"},
           {"form", Type::string, false,
            "taylor-angle (if left out), taylor-arc, discrete-angle, discrete-arc, rational-cubic "
            "or best"},
           {"about", Type::any, false,
            "Taylor forms: fraction of the interval to expand at, or \"auto\" for the best"}},
          run,
          {{"points", {{0, 0}, {2, 0}, {3, 1.5}}},
           {"alpha", -1},
           {"degree", 8},
           {"form", "taylor-angle"}}};
}

}  // namespace keyline::operations
