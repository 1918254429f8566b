#pragma once

#include <nlohmann/json.hpp>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"
#include "keyline/fairing/fair.h"
#include "keyline/operations/operation.h"

/// The operation `fair` in typed form: shared by the operation itself and by the command line,
/// which acquires its key-line from files.
namespace keyline::operations {

/// Options from a request's fields; bad_input names the field.
core::Result<fairing::FairOptions> fair_options(const nlohmann::json& request,
                                                const Context& context);

/// The key-line of a request: its points acquired, or samples of its curve (exact, with the
/// curve's own corners).
core::Result<acquire::KeyLine> key_line_of(const nlohmann::json& request);

/// A curve as a key-line: samples evenly spaced in arc length, no noise.
core::Result<acquire::KeyLine> key_line_of(const document::Path& path);

/// The answer as one curve (log-aesthetic) or a path of several.
document::Path fair_curve(const fairing::FairResult& result);

/// The public result object.
nlohmann::json fair_json(const fairing::FairResult& result);

/// "start:G1,end:G2", "2:arc" and the like, as on the command line.
core::Result<void> parse_clamp(const std::string& text, fairing::FairOptions& options);
core::Result<fairing::InterpretationOverride> parse_interpretation(const std::string& text);
core::Result<core::Interval> parse_region(const std::string& text);

}  // namespace keyline::operations
