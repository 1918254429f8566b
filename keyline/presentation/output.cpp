#include "keyline/presentation/output.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/file/atomic_file.h"
#include "keyline/operations/json_form.h"

namespace keyline::presentation {

using core::Result;

std::vector<std::string> known_extensions() {
  std::vector<std::string> known = operations::document_extensions();
  for (const char* further : {".png", ".html"}) known.emplace_back(further);
  return known;
}

bool is_standard_output(const std::string& file) { return exchange::is_standard_stream(file); }

namespace {

/// Whether both names lead to one file, there already or not.
bool are_one(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (is_standard_output(a) || is_standard_output(b))
    return is_standard_output(a) && is_standard_output(b);
  std::error_code none;
  if (fs::equivalent(a, b, none)) return fs::is_regular_file(a, none);
  return fs::absolute(a, none).lexically_normal() == fs::absolute(b, none).lexically_normal();
}

Result<void> check_extension(const std::string& file, const std::vector<std::string>& known) {
  const std::string extension = exchange::extension_of(file);
  if (std::ranges::find(known, extension) != known.end()) return {};
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : " ") + name;
  return core::fail(core::ErrorCode::bad_input, "this command does not write \"" + extension + "\"",
                    "use one of " + list, file);
}

}  // namespace

Result<void> check_outputs(const std::vector<std::string>& files,
                           const std::vector<std::string>& known,
                           const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string& file = files[i];
    if (auto done = check_extension(file, known); !done) return done;
    if (auto can = exchange::check_writable(file); !can) return can;
    for (const std::string& input : inputs)  // a stream in and one out are two
      if (!is_standard_output(file) && are_one(file, input))
        return core::fail(core::ErrorCode::bad_input, "this is the input, which is not overwritten",
                          "give -o another name", file);
    for (std::size_t k = 0; k < i; ++k)
      if (are_one(file, files[k]))
        return core::fail(core::ErrorCode::bad_input, "this output is named twice",
                          "give every -o a name of its own", file);
  }
  return {};
}

Result<Output> output_of(nlohmann::json request) {
  request.emplace("file", "a.json");  // its names stand beside it
  operations::WriteRequest given;
  const operations::Part part{&core::type_of<operations::WriteRequest>(), &given};
  if (auto read = operations::read_json(request, {&part, 1}, {}, "document.write"); !read)
    return std::unexpected(read.error());
  return Output{operations::document_of(given), given.format, given.on_page};
}

Output output_of(const operations::ReadAnswer& read) {
  return {operations::document_of(read), {}, read.page && read.document.paths.empty()};
}

std::string contents_of(const operations::ReadAnswer& read) {
  const auto planar = static_cast<std::size_t>(std::ranges::count_if(
      read.curves, [](const auto& c) { return c.line || operations::planar_path(*c.curve); }));
  std::string text;
  for (const auto& [count, thing] :
       {std::pair{planar, "planar curve"}, std::pair{read.curves.size() - planar, "space curve"},
        std::pair{read.surfaces.size(), "surface"}})
    if (count > 0) text += (text.empty() ? "" : ", ") + core::counted(count, thing);
  return text + (read.unit.empty() ? "" : " in " + read.unit);
}

Result<operations::WriteAnswer> write_files(const std::vector<std::string>& files,
                                            const Pages& pages, const Output& output,
                                            const core::Progress& progress) {
  exchange::OutputFiles beside;
  operations::WriteAnswer answer;
  for (const std::string& file : files) {
    progress.report(static_cast<double>(answer.written.size()) / static_cast<double>(files.size()),
                    "writing " + file);
    const std::string extension = exchange::extension_of(file);
    Result<exchange::Written> written;
    if (const auto page = pages.find(extension); page != pages.end()) {
      auto content = page->second();
      if (content)
        written->content = std::move(*content);
      else
        written = std::unexpected(content.error());
    } else {
      written = operations::formatted(output.document, extension, output.format, output.on_page,
                                      progress.cancellation);
    }
    if (!written) return std::unexpected(exchange::in_file(written.error(), file));
    if (auto done = beside.add(file, written->content); !done) return std::unexpected(done.error());
    answer.written.push_back({file, written->deviation, std::move(written->notes)});
  }
  if (progress.stop_requested()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  if (auto done = beside.commit(); !done) return std::unexpected(done.error());
  answer.unused = operations::unused_of(output.format, files);
  return answer;
}

Result<void> write_folder(const std::string& folder,
                          const std::vector<std::pair<std::string, std::string>>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return core::fail(core::ErrorCode::io, "the folder cannot be made: " + error.message(),
                      "name another one", folder);
  for (const auto& [name, content] : files)
    if (auto done = exchange::write_atomically(std::filesystem::path(folder) / name, content);
        !done)
      return done;
  return {};
}

}  // namespace keyline::presentation
