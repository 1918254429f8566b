#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"

/// How much `fair` and `curve.analyze` take at a time: what would take hours to look at span by
/// span is refused, whichever door it comes through.
namespace keyline::operations {

struct ReadAnswer;

/// unsupported for a path of more than 10,000 bent spans.
core::Result<void> check_amount(const document::Path& path);

/// unsupported where the planar curves of a file have more together, which a small file with many
/// references can hold.
core::Result<void> check_amount(const ReadAnswer& read);

}  // namespace keyline::operations
