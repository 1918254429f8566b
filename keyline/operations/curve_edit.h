#pragma once

#include "keyline/operations/class_a.h"
#include "keyline/operations/made_curve.h"

/// Class A editing of a curve: the operation curve.edit.
namespace keyline::operations {

/// A place of the alpha-s plane.
struct PlaneTarget {
  double alpha = 0;
  double s = 1;
  static constexpr std::string_view kTextForm = "alpha,s";
  static core::Result<PlaneTarget> from_text(std::string_view text);
  static constexpr auto describe() {
    return core::fields(core::field<&PlaneTarget::alpha>("rotation").in("radian").needed(),
                        core::field<&PlaneTarget::s>("scale").needed());
  }
};

struct CurveEditRequest {
  ClassARequest curve;
  std::optional<PlaneTarget> target;
  classa::Hold hold = classa::Hold::ends_and_tangent;
  double amount = 1;
  static constexpr auto describe() {
    using Request = CurveEditRequest;
    return core::fields(core::flattened<&Request::curve>(),
                        core::field<&Request::target>(
                            "place of the plane to move to; the minimum-energy point unless given"),
                        core::field<&Request::hold>(
                            "for a target: what stays; an end only within end_tolerance, if given"),
                        core::field<&Request::amount>("0 the given curve to 1 the target")
                            .within(core::from_to(0, 1)));
  }
};

struct CurveEditAnswer {
  MadeCurve curve;
  EvaluationShown before;
  EvaluationShown after;
  PlaneTarget target;
  double departure = 0;
  double end_moved = 0;
  std::optional<std::vector<std::array<double, 2>>> path;

  std::optional<classa::Approximation> given;  ///< not part of the public form, like `edited`
  std::optional<classa::EditResult> edited;

  static constexpr auto describe() {
    using Answer = CurveEditAnswer;
    return core::fields(
        core::flattened<&Answer::curve>(), core::field<&Answer::before>("value of the given curve"),
        core::field<&Answer::after>("measured against the same minimum"),
        core::field<&Answer::target>("the place the slide ends at"),
        core::field<&Answer::departure>(
            "bound of the largest distance from the given curve, either way")
            .in("length"),
        core::field<&Answer::end_moved>("distance of the end that is let go from where it was; the "
                                        "start of a curve read backwards")
            .in("length"),
        core::field<&Answer::path>("[alpha, s] from the given place to the target"));
  }
};

classa::EditOptions edit_options(const CurveEditRequest& request);

}  // namespace keyline::operations
