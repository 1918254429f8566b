#pragma once

#include <string>

#include "keyline/core/error.h"
#include "keyline/operations/perform.h"

namespace keyline::presentation {

/// Of sketch.trace: ink, the strokes that were drawn or found, numbered from 0 and in the colour of
/// the line that stands for them (grey: none), and the lines over them, one PNG of 1,600 pixels and
/// more. Ink of a picture shows where the outcome has its stages.
/// Precondition: the outcome is of sketch.trace.
core::Result<std::string> overlay_picture(const operations::Outcome& outcome);

}  // namespace keyline::presentation
