#include "keyline/operations/analysis_json.h"
#include "keyline/operations/analyze_report.h"
#include "keyline/operations/class_a_json.h"
#include "keyline/operations/class_a_request.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

/// A curve in space: its value, curvature judged on the curve itself, and what Farin's conditions
/// say beside it.
core::Result<json> space_value(const ClassASubject& subject, const classa::CavOptions& options) {
  const auto value = classa::cav(*subject.space, options);
  if (!value) return std::unexpected(value.error());
  json result = curve_value_json(*value);
  if (subject.farin) {
    const classa::FarinConditions farin = classa::farin_conditions(*subject.farin);
    result["farin"] = {{"segment", farin.segment},
                       {"expands", farin.expands},
                       {"singular_values", farin.singular_values},
                       {"sigma", farin.sigma}};
  }
  return result;
}

core::Result<json> run(const json& request, const Context&) {
  const auto options = cav_options(request);
  if (!options) return std::unexpected(options.error());
  const auto subject = class_a_subject(request);
  if (!subject) return std::unexpected(subject.error());
  if (subject->space) return space_value(*subject, *options);
  auto evaluation = classa::evaluate_curve(*subject->planar, *options);
  if (!evaluation) return std::unexpected(evaluation.error());
  classa::CurveValue& value = evaluation->value;
  if (value.minimum && !value.reversed) value.minimum->beta *= subject->beta;
  json result = evaluation_json(*evaluation);
  if (result.contains("approximation") && subject->given)
    result["approximation"]["given_monotone"] =
        answer_name(certified_monotone(*subject->given).value);
  return result;
}

}  // namespace

Operation curve_cav_operation() {
  return {"curve.cav",
          "Curve aesthetic value after Oya, Hanafusa and Aoyama: type 1 to 5, place in the "
          "alpha-s plane, minimum-energy point, monotone curvature, and for a curve of several "
          "matrices the nearest curve of one.",
          class_a_fields(),
          run,
          {{"alpha", 0.7853981633974483},
           {"s", 1.05},
           {"degree", 3},
           {"tangent", {1, 2}},
           {"end_tolerance", 0.01}}};
}

}  // namespace keyline::operations
