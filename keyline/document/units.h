#pragma once

#include <string>

#include "keyline/document/document.h"

namespace keyline::document {

/// Every length multiplied by a positive factor; the unit stays as it is called.
Document scaled(Document document, double factor);

/// The same things in another unit, lengths multiplied by how many of it one of the document's is.
/// Unchanged where either is unknown (millimetres() 0).
Document in_unit(Document document, const std::string& unit);

}  // namespace keyline::document
