#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/figure/drawing.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

/// What is in a document, to look at.
namespace keyline::presentation {

/// Its planar curves in one picture, in their colours and as wide as they are drawn. Of the options
/// title, subtitle and unit are used; the document's unit goes before.
/// Fails: unsupported where there is no planar curve.
core::Result<figure::Drawing> document_picture(const document::Document& document,
                                               const ReportOptions& options = {});

/// The picture with a table of the curves: name, layer, members, length, width.
core::Result<report::Report> document_report(const document::Document& document,
                                             const ReportOptions& options = {});

}  // namespace keyline::presentation
