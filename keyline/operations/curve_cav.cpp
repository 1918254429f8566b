#include "keyline/operations/class_a.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

Result<EvaluationShown> run(const ClassARequest& request, const Context&) {
  const auto subject = class_a_subject(request);
  if (!subject) return std::unexpected(subject.error());
  return value_of(*subject, cav_options(request.options));
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
