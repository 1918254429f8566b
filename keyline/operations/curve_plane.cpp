#include <algorithm>

#include "keyline/operations/class_a.h"
#include "keyline/operations/class_a_plane.h"
#include "keyline/operations/paper_operations.h"

namespace keyline::operations {
namespace {

using core::Result;

struct PlaneRequest {
  ClassARequest curve;
  std::optional<core::Interval> shown;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&PlaneRequest::curve>(),
        core::field<&PlaneRequest::shown>(
            "range of s; else such that the curve, its minimum and the region are in sight")
            .named("show"));
  }
};

struct PlaneAnswer {
  ClassAPlane plane;
  EvaluationShown value;
  static constexpr auto describe() {
    return core::fields(core::flattened<&PlaneAnswer::plane>(),
                        core::field<&PlaneAnswer::value>("of the curve, as curve.cav has it"));
  }
};

/// Range of s that shows the borders of the region and all there is to be seen.
core::Interval scales(const EvaluationShown& e) {
  core::Interval s{0.4, 2.4};
  const auto add = [&s](double value) {
    s.low = std::clamp(0.9 * value, 0.05, s.low);
    s.high = std::clamp(1.1 * value, s.high, 20.0);
  };
  if (e.value.s) add(*e.value.s);
  if (e.value.minimum) add(e.value.minimum->s);
  if (e.nearest && *e.nearest) add((*e.nearest)->s);
  return s;
}

Result<classa::CurveReading> reading_of(const ClassASubject& subject, const EvaluationShown& value,
                                        const classa::CavOptions& options) {
  if (subject.space) return classa::read_curve(*subject.space, options);
  return classa::read_curve(value.evaluation->approximation.curve, options);
}

Result<PlaneAnswer> run(const PlaneRequest& request, const Context&) {
  const classa::CavOptions options = cav_options(request.curve.options);
  const auto subject = class_a_subject(request.curve);
  if (!subject) return std::unexpected(subject.error());
  auto value = value_of(*subject, options);
  if (!value) return std::unexpected(value.error());
  const auto found = reading_of(*subject, *value, options);
  if (!found) return std::unexpected(found.error());
  const classa::CurveReading& reading = *found;
  if (value->value.degree < 2 || !(norm(reading.conditions.chord) > 0))
    return core::fail(core::ErrorCode::undrawable, "the curve has no energy to compare with",
                      "give a curve of degree 2 or more whose ends are apart", "curve");
  PlaneAnswer answer;
  answer.value = std::move(*value);
  const core::Interval s = request.shown.value_or(scales(answer.value));
  if (!(s.low > 0))
    return core::fail(core::ErrorCode::bad_input, "s is a scale: it is above 0",
                      "give a range as [0.4, 2.4]", "show");
  answer.plane = class_a_plane(reading, options.alpha_max, s);
  return answer;
}

}  // namespace

Operation curve_plane_operation() {
  return declare<run>(
      {.name = "curve.plane",
       .summary =
           "The alpha-s plane about a curve: where Class A begins, strain energy of curves "
           "of its degree, places that keep its ends and start tangent, and its own value. Of a "
           "curve in space: in its plane, else in that of its start tangent and chord.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[1,2],[0,4],[-2,5]]}})"}});
}

}  // namespace keyline::operations
