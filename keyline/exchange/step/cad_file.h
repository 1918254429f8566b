#pragma once

#include <filesystem>

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/file/child_process.h"
#include "keyline/exchange/file/written.h"

/// STEP and IGES, read and written by OCCT in a program of its own, keyline-cad, so that nothing
/// that goes wrong in there reaches this process (docs/design/cad-process.md).
namespace keyline::exchange {

enum class CadFormat { step, iges };

/// Where keyline-cad is: the environment's KEYLINE_CAD, else beside the running program or in
/// ../libexec/keyline from there, else where it was installed. Empty where it is nowhere.
std::filesystem::path cad_program();

/// Time and memory for a file of that size: a minute and 4 s per MB; 1 GB and 30 times the size.
ChildLimits cad_limits(std::uintmax_t bytes);

/// Reads STEP (AP203, AP214, AP242) or IGES: edges that bound no face as curves, faces as their
/// whole underlying surface with the number of trimming edges; assemblies' transforms applied,
/// names, layers and colours, in the file's own unit. Lines stay lines and circular arcs arcs;
/// everything else is a B-spline. Curves in z = 0 are planar.
/// Fails: bad_input where the file is no such file or breaks the reader or passes a limit;
///        unsupported where keyline-cad is not installed; io; cancelled.
core::Result<document::Document> read_cad(const std::filesystem::path& file, CadFormat format,
                                          const core::CancellationToken& cancellation = {});
core::Result<document::Document> read_cad(const std::filesystem::path& file, CadFormat format,
                                          const ChildLimits& limits,
                                          const core::CancellationToken& cancellation = {});

/// Curves and surfaces with names and unit. Lines, arcs and splines are exact; the rest is within
/// `tolerance` (cad_parts). Notes a unit CAD files do not have (px, pt): its numbers stand as mm.
/// Fails: as read_cad; as cad_parts.
core::Result<Written> write_cad(const document::Document& document, CadFormat format,
                                double tolerance, const core::CancellationToken& cancellation = {});

}  // namespace keyline::exchange
