#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/presentation/pages.h"

/// Results into files, the format by their extension.
namespace keyline::presentation {

/// What document.write writes and pages show.
std::vector<std::string> known_extensions();

/// Whether -o names standard output: "-" (JSON), "svg:-".
bool is_standard_output(const std::string& file);

/// bad_input, before anything is computed, for an extension of none of `known`, a file named twice
/// or a file that is one of the inputs, which nothing may overwrite; io for one that cannot be
/// written.
core::Result<void> check_outputs(const std::vector<std::string>& files,
                                 const std::vector<std::string>& known,
                                 const std::vector<std::string>& inputs);

/// Curves and surfaces on their way into files.
struct Output {
  document::Document document;
  operations::FormatOptions format;
  bool on_page = false;
};

/// Of a request of document.write; "file" may be left out.
core::Result<Output> output_of(nlohmann::json request);

/// Of what document.read answered, whole.
Output output_of(const operations::ReadAnswer& read);

/// "2 planar curves, 1 surface in mm".
std::string contents_of(const operations::ReadAnswer& read);

/// Writes every file, all of them or none: with its page where there is one for the extension, else
/// as document.write does. Returns what was written, as document.write tells it.
/// Fails: as document.write; cancelled, before any file is in place.
core::Result<operations::WriteAnswer> write_files(const std::vector<std::string>& files,
                                                  const Pages& pages, const Output& output,
                                                  const core::Progress& progress = {});

/// Pictures into a folder, which is made where it does not exist.
core::Result<void> write_folder(const std::string& folder,
                                const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace keyline::presentation
