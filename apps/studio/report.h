#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/operations/operation.h"
#include "keyline/presentation/pages.h"

#include "folder.h"

/// The page that tells what was done, in place of one that shows what is there.
namespace keyline::studio {

/// Of [{"op": "fair" or "curve.analyze", "name": …, "request": {…}}, …], all of one operation,
/// which is carried out again: the same request gives the same answer.
/// Fails: bad_input for another form; with what an operation fails with.
core::Result<presentation::Pages> report_pages(const nlohmann::json& asked, const Folder& folder,
                                               const presentation::ReportOptions& options,
                                               const operations::Context& context);

}  // namespace keyline::studio
