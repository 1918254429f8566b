#pragma once

#include <nlohmann/json.hpp>

#include "keyline/classa/cav.h"
#include "keyline/classa/edit.h"
#include "keyline/classa/free_form.h"
#include "keyline/curve/monotone.h"

/// Results of room classa in the public form. All numbers finite; what does not exist is null.
namespace keyline::operations {

/// {"type", "cav", "alpha", "s", "degree", "reversed", "turn", "energy", "minimum", "monotone"}.
nlohmann::json curve_value_json(const classa::CurveValue& value);

/// The same with "nearest" (types 4 and 5) and, for an approximated curve, "approximation".
nlohmann::json evaluation_json(const classa::Evaluation& evaluation);

/// {"curve", "before", "after", "target", "path"}; before and after are curve.cav results.
core::Result<nlohmann::json> class_a_edit_json(const classa::EditResult& edited,
                                               const classa::Approximation& given,
                                               const classa::EditOptions& options);

/// "yes", "no", "undecided".
const char* answer_name(curve::MonotoneVerdict::Answer answer);

}  // namespace keyline::operations
