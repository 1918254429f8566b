#include "keyline/operations/class_a.h"
#include "keyline/operations/curve_analyze.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

/// A curve in space: its value, curvature judged on the curve itself, and what Farin's conditions
/// say beside it.
Result<EvaluationShown> space_value(const ClassASubject& subject,
                                    const classa::CavOptions& options) {
  const auto value = classa::cav(*subject.space, options);
  if (!value) return std::unexpected(value.error());
  EvaluationShown result;
  result.value = shown(*value);
  if (subject.farin) {
    const classa::FarinConditions farin = classa::farin_conditions(*subject.farin);
    result.farin = FarinShown{farin.segment, farin.expands, farin.singular_values, farin.sigma};
  }
  return result;
}

Result<EvaluationShown> run(const ClassARequest& request, const Context&) {
  const classa::CavOptions options = cav_options(request.options);
  const auto subject = class_a_subject(request);
  if (!subject) return std::unexpected(subject.error());
  if (subject->space) return space_value(*subject, options);
  auto evaluation = classa::evaluate_curve(*subject->planar, options);
  if (!evaluation) return std::unexpected(evaluation.error());
  classa::CurveValue& value = evaluation->value;
  if (value.minimum && !value.reversed) value.minimum->beta *= subject->beta;
  EvaluationShown result = shown(*evaluation);
  if (result.approximation && subject->given)
    result.approximation->given_monotone = verdict_of(certified_monotone(*subject->given).value);
  return result;
}

}  // namespace

Operation curve_cav_operation() {
  return declare<run>(
      {.name = "curve.cav",
       .summary = "Curve aesthetic value after Oya, Hanafusa and Aoyama: type 1 to 5, place in the "
                  "alpha-s plane, minimum-energy point, monotone curvature, and for a curve of "
                  "several matrices the nearest curve of one.",
       .examples = {R"({"alpha":0.7853981633974483,"s":1.05,"degree":3,"tangent":[1,2],
                        "end_tolerance":0.01})",
                    R"({"curve":{"type":"bezier","points":[[0,0],[1,2],[0,4],[-2,5]]}})"}});
}

}  // namespace keyline::operations
