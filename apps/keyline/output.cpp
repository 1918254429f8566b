#include "output.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "keyline/exchange/atomic_file.h"
#include "keyline/exchange/document_file.h"
#include "keyline/operations/document_picture.h"
#include "keyline/report/html_report.h"

#include "terminal.h"

namespace keyline::app {

using core::Result;

std::vector<std::string> curve_extensions(const std::vector<std::string>& further) {
  std::vector<std::string> known = exchange::written_extensions();
  known.insert(known.end(), further.begin(), further.end());
  return known;
}

namespace {

/// Whether both names lead to one file, there already or not.
bool are_one(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::equivalent(a, b, none)) return fs::is_regular_file(a, none);
  return fs::absolute(a, none).lexically_normal() == fs::absolute(b, none).lexically_normal();
}

Result<void> check_extension(const std::string& file, const std::vector<std::string>& known) {
  const std::string extension = exchange::extension_of(file);
  if (std::find(known.begin(), known.end(), extension) != known.end()) return {};
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : " ") + name;
  return core::fail(core::ErrorCode::bad_input, "this command does not write \"" + extension + "\"",
                    "use one of " + list, file);
}

}  // namespace

Result<void> check_outputs(const CommonOptions& common, const std::vector<std::string>& known,
                           const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < common.outputs.size(); ++i) {
    const std::string& file = common.outputs[i];
    if (auto done = check_extension(file, known); !done) return done;
    if (auto can = exchange::check_writable(file); !can) return can;
    for (const std::string& input : inputs)
      if (are_one(file, input))
        return core::fail(core::ErrorCode::bad_input, "this is the input, which is not overwritten",
                          "give -o another name", file);
    for (std::size_t k = 0; k < i; ++k)
      if (are_one(file, common.outputs[k]))
        return core::fail(core::ErrorCode::bad_input, "this output is named twice",
                          "give every -o a name of its own", file);
  }
  return {};
}

Result<void> add_output(exchange::OutputFiles& files, const std::string& file,
                        const Writer& writer) {
  const auto content = writer();
  if (!content) return std::unexpected(exchange::in_file(content.error(), file));
  return files.add(file, *content);
}

Result<void> write_outputs(const CommonOptions& common, const Writers& writers) {
  exchange::OutputFiles files;
  for (const std::string& file : common.outputs)
    if (auto done = add_output(files, file, writers.at(exchange::extension_of(file))); !done)
      return done;
  return files.commit();
}

Writers curve_writers(const document::Document& document, double tolerance,
                      const CommonOptions& common) {
  const auto shared = std::make_shared<const document::Document>(document);
  exchange::WriteOptions options;
  options.tolerance = tolerance;
  Writers writers;
  for (const std::string& extension : exchange::written_extensions())
    writers[extension] = [=, quiet = common.quiet]() -> Result<std::string> {
      auto written = exchange::format_document(*shared, extension, options);
      if (!written) return std::unexpected(written.error());
      for (const std::string& note : written->notes)
        say(quiet, fmt::format("{}: {}", extension, note));
      return std::move(written->content);
    };
  return writers;
}

void add_picture_writers(Writers& writers, const document::Document& document,
                         const std::string& title, const std::string& input,
                         const CommonOptions& common) {
  const auto shared = std::make_shared<const document::Document>(document);
  operations::ReportOptions options;
  options.title = title;
  options.subtitle = input;
  options.command = common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  const auto picture = [=](const auto& encode) -> Result<std::string> {
    const auto drawing = operations::document_picture(*shared, options);
    return drawing ? encode(*drawing) : std::unexpected(drawing.error());
  };
  writers[".pdf"] = [=] { return picture(figure::write_pdf); };
  writers[".png"] = [=] {
    return picture([](const figure::Drawing& d) { return figure::write_png(d, 2); });
  };
  writers[".html"] = [=]() -> Result<std::string> {
    const auto report = operations::document_report(*shared, options);
    if (!report) return std::unexpected(report.error());
    return report::html_report(*report);
  };
}

document::Document document_of(const std::string& name, const document::Path& path,
                               const std::string& unit) {
  document::Document document;
  document.unit = unit;
  document.paths.push_back({{name, {}, {}}, path, 0});
  return document;
}

}  // namespace keyline::app
