#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

struct ShowCurveRequest {
  AnyCurve curve;
  static constexpr auto describe() {
    return core::fields(core::field<&ShowCurveRequest::curve>("any curve").needed());
  }
};

struct ShownCurve {
  MadeCurve curve;
  static constexpr auto describe() { return core::fields(core::flattened<&ShownCurve::curve>()); }
};

Result<ShownCurve> run(const ShowCurveRequest& request, const Context&) {
  return ShownCurve{{request.curve, {}, {}, {}, {}}};
}

}  // namespace

Operation curve_show_operation() {
  return declare<run>(
      {.name = "curve.show",
       .summary =
           "Gives a curve in further forms: points along it, Beziers, a B-spline, or the data "
           "for drawing its comb and graphs.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[2,0],[3,1]]}})"}});
}

}  // namespace keyline::operations
