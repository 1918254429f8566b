#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"

#include "commands.h"

/// Results to files, format by extension.
namespace keyline::app {

/// One curve to be written, with what the formats may want beside it.
struct OutputCurve {
  std::string name;
  document::Path path;
};

/// How to make the content of a file; called only for formats that are asked for.
using Writer = std::function<core::Result<std::string>()>;
/// By extension with its dot, for example ".svg".
using Writers = std::map<std::string, Writer>;

/// bad_input for an extension without writer, before anything is computed.
core::Result<void> check_outputs(const CommonOptions& common,
                                 const std::vector<std::string>& known);

/// Writes every output file, each whole or not at all.
core::Result<void> write_outputs(const CommonOptions& common, const Writers& writers);

/// The writers every command has: .json (exact), .csv (samples) and .svg (cubics within
/// `tolerance`, with the exact curves as metadata).
Writers curve_writers(const std::vector<OutputCurve>& curves, double tolerance,
                      const std::string& unit);

}  // namespace keyline::app
