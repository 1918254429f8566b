#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/classa/cav.h"
#include "keyline/classa/edit.h"
#include "keyline/classa/farin.h"
#include "keyline/classa/free_form.h"
#include "keyline/document/planar_curve.h"
#include "keyline/operations/operation.h"

/// What curve.cav and curve.edit have in common.
namespace keyline::operations {

/// "curve", "alpha", "s", … "s_range": the fields of both.
std::vector<Field> class_a_fields();

/// The options of the value; bad_input for words and ranges that are none.
core::Result<classa::CavOptions> cav_options(const nlohmann::json& request);

/// A curve to be placed in the plane: planar, in space, or by a matrix of Farin's.
struct ClassASubject {
  std::optional<classa::Approximation> planar;
  double beta = 1;  ///< of a curve given by (alpha, s): unit of the minimum's beta
  std::optional<document::Path> given;  ///< what was approximated
  std::optional<curve::Bezier3> space;
  std::optional<classa::SpaceMatrixCurve> farin;  ///< `space` is then its curve
};

/// From "curve", or from "alpha", "s", "degree", "tangent", or from "matrix", "tangent", "degree".
core::Result<ClassASubject> class_a_subject(const nlohmann::json& request);

/// The curve as one polynomial Bezier curve: itself, or its approximation within the tolerance.
core::Result<classa::Approximation> class_a_bezier(const document::Path& path,
                                                   std::optional<double> tolerance);

/// Amount, target and what it holds, beside the options of the value.
core::Result<classa::EditOptions> edit_options(const nlohmann::json& request);

}  // namespace keyline::operations
