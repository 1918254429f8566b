#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/operations/document_read.h"

#include "commands.h"

/// The files of a command through document.read.
namespace keyline::app {

/// What they hold; `planar`: curves in space that lie in a plane as planar ones. Failures name the
/// file.
core::Result<operations::ReadAnswer> read_files(const InputOptions& input,
                                                const core::Progress& progress, bool planar = true);

/// A curve or line of it as the subject of a request.
nlohmann::json subject_of(const operations::NamedCurve& curve, const InputOptions& input);

}  // namespace keyline::app
