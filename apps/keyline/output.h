#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/document.h"
#include "keyline/exchange/atomic_file.h"

#include "commands.h"

/// Results to files, format by extension.
namespace keyline::app {

/// How to make the content of a file; called only for formats that are asked for.
using Writer = std::function<core::Result<std::string>()>;
/// By extension with its dot, for example ".svg".
using Writers = std::map<std::string, Writer>;

/// Extensions every command that returns curves can write, and `further` ones.
std::vector<std::string> curve_extensions(const std::vector<std::string>& further = {});

/// bad_input, before anything is computed, for an extension without writer, a file named twice or
/// a file that is one of the inputs, which nothing may overwrite; io
/// for one that cannot be written.
core::Result<void> check_outputs(const CommonOptions& common, const std::vector<std::string>& known,
                                 const std::vector<std::string>& inputs);

/// Makes ready one file of several.
core::Result<void> add_output(exchange::OutputFiles& files, const std::string& file,
                              const Writer& writer);

/// Writes every output file, all of them or none.
core::Result<void> write_outputs(const CommonOptions& common, const Writers& writers);

/// The writers every command has: what room exchange writes, within `tolerance` where a format
/// cannot hold a curve as it is. What a format could not hold is said on standard error.
Writers curve_writers(const document::Document& document, double tolerance,
                      const CommonOptions& common);

/// Adds .pdf, .png and .html: the document's planar curves to look at. `title` heads them.
void add_picture_writers(Writers& writers, const document::Document& document,
                         const std::string& title, const std::string& input,
                         const CommonOptions& common);

/// A document of one path, without layer.
document::Document document_of(const std::string& name, const document::Path& path,
                               const std::string& unit = {});

}  // namespace keyline::app
