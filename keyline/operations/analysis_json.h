#pragma once

#include <nlohmann/json.hpp>

#include "keyline/analysis/analyze.h"
#include "keyline/analysis/continuity.h"

/// Results of room analysis in the public form. All numbers finite.
namespace keyline::operations {

/// "yes", "no", "undecided".
const char* answer_name(analysis::MonotoneAnswer::Value value);
nlohmann::json interval_json(core::Interval interval);
nlohmann::json interpretation_json(const analysis::Interpretation& reading);
nlohmann::json lcg_json(const analysis::Lcg& lcg);
nlohmann::json lddc_json(const analysis::Lddc& lddc);
nlohmann::json joint_json(const analysis::JointContinuity& joint);
nlohmann::json curve_analysis_json(const analysis::CurveAnalysis& analysis);

}  // namespace keyline::operations
