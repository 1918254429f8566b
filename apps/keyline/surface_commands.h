#pragma once

#include "keyline/document/document.h"

#include "commands.h"

/// What commands do with a file that holds surfaces.
namespace keyline::app {

/// Says on standard error that the curves of such a file are not looked at.
void say_curves_left_out(const document::Document& document, bool quiet);

/// SAV by surface, patch and curve, curvature and pictures.
int analyze_surfaces(const AnalyzeCommand& command, const document::Document& document);

/// Every surface of the file towards Class A; each has to be one polynomial Bezier patch.
int edit_surfaces(const EditCommand& command, const document::Document& document);

}  // namespace keyline::app
