#include "keyline/exchange/document_file.h"
#include "keyline/library/search.h"
#include "keyline/library/statistics.h"
#include "keyline/operations/document_write.h"
#include "keyline/operations/library_entry.h"
#include "keyline/operations/open_library.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

/// Who reads a library too makes the files of its write-ahead log beside it for as long as it is
/// open.
constexpr bool kLogBeside = true;
/// An example that stands alone: made by the example of library.add.
constexpr const char* kExample = R"({"library":"/tmp/keyline-example.kl"})";

struct FindRequest {
  std::string library;
  std::optional<std::variant<document::Path, std::string>> like;
  library::Criteria criteria;
  static constexpr auto describe() {
    return core::fields(
        core::field<&FindRequest::library>(kLibrary),
        core::field<&FindRequest::like>(
            "a curve, or a file that holds one: nearest first by normalised curvature, whatever "
            "size, pose and direction"),
        core::flattened<&FindRequest::criteria>());
  }
};

/// The first curve of a file.
Result<document::Path> path_in_file(const std::string& file, const Context& context) {
  InputRequest input;
  input.file = {file};
  input.planar = true;
  auto read = read_input(input, context.progress);
  if (!read) return std::unexpected(read.error());
  for (const NamedCurve& c : read->curves) {
    if (c.line) return document::Path{{{curve::Polyline2{c.line->points}}}, false};
    if (auto path = planar_path(*c.curve)) return std::move(*path);
  }
  return fail(ErrorCode::bad_input, "holds no planar curve", "give a file that holds one", file);
}

Result<library::Findings> run_find(const FindRequest& request, const Context& context) {
  library::Criteria criteria = request.criteria;
  if (request.like) {
    const auto* file = std::get_if<std::string>(&*request.like);
    const auto path =
        file ? path_in_file(*file, context) : Result<document::Path>(std::get<0>(*request.like));
    if (!path) return std::unexpected(path.error());
    criteria.like = library::turning_profile(
        path->curves.size() == 1 ? curve::PlanarView(path->curves[0]) : curve::PlanarView(*path));
  }
  auto library = open_library(request.library, library::Mode::read);
  if (!library) return std::unexpected(library.error());
  return library::find(*library, criteria);
}

struct ShowRequest {
  std::string library;
  std::int64_t number = 1;
  static constexpr auto describe() {
    return core::fields(core::field<&ShowRequest::library>(kLibrary),
                        core::field<&ShowRequest::number>("its number, which library.find tells")
                            .within(core::at_least(1))
                            .needed());
  }
};

Result<LibraryEntry> run_show(const ShowRequest& request, const Context&) {
  auto library = open_library(request.library, library::Mode::read);
  if (!library) return std::unexpected(library.error());
  const auto entry = library::get(*library, request.number);
  if (!entry) return std::unexpected(entry.error());
  return entry_shown(*entry);
}

struct ExportRequest {
  std::string library;
  std::vector<std::int64_t> numbers;
  std::string file;
  double tolerance = 0;
  static constexpr auto describe() {
    using R = ExportRequest;
    return core::fields(
        core::field<&R::library>(kLibrary),
        core::field<&R::numbers>("numbers of things").count(1).or_bare_item().needed(),
        core::field<&R::file>("to write, in the format of its extension").needed(),
        core::field<&R::tolerance>("largest deviation where the format cannot hold a curve as it "
                                   "is; 1e-5 of the longest unless given")
            .in("length")
            .within(core::kPositive));
  }
};

Result<WrittenFile> run_export(const ExportRequest& request, const Context&) {
  auto library = open_library(request.library, library::Mode::read);
  if (!library) return std::unexpected(library.error());
  const auto document = library::export_document(*library, request.numbers);
  if (!document) return std::unexpected(document.error());
  exchange::WriteOptions options;
  options.tolerance = request.tolerance;
  const auto written = exchange::write_document(*document, request.file, options);
  if (!written) return std::unexpected(exchange::in_file(written.error(), request.file));
  return WrittenFile{request.file, written->deviation, written->notes};
}

struct StatsRequest {
  std::string library;
  static constexpr auto describe() {
    return core::fields(core::field<&StatsRequest::library>(kLibrary));
  }
};

Result<library::Statistics> run_stats(const StatsRequest& request, const Context&) {
  auto library = open_library(request.library, library::Mode::read);
  if (!library) return std::unexpected(library.error());
  return library::statistics(*library);
}

}  // namespace

Operation library_find_operation() {
  return declare<run_find>({.name = "library.find",
                            .summary = "Finds curves and surfaces in a design library by rhythm, "
                                       "slope, CAV, SAV, size, name, or by a curve they look like.",
                            .examples = {kExample},
                            .reads_files = true,
                            .writes_files = kLogBeside});
}

Operation library_show_operation() {
  return declare<run_show>(
      {.name = "library.show",
       .summary = "Shows one curve or surface of a design library, with all that is known.",
       .examples = {R"({"library":"/tmp/keyline-example.kl","number":1})"},
       .reads_files = true,
       .writes_files = kLogBeside});
}

Operation library_export_operation() {
  return declare<run_export>(
      {.name = "library.export",
       .summary = "Writes curves and surfaces of a design library to a file.",
       .examples = {R"({"library":"/tmp/keyline-example.kl","numbers":[1],
                                               "file":"/tmp/keyline-example.json"})"},
       .reads_files = true,
       .writes_files = true});
}

Operation library_stats_operation() {
  return declare<run_stats>(
      {.name = "library.stats",
       .summary = "Surveys a design library: how many curves are of each of the five types, their "
                  "slopes, and how self-affine their pieces are.",
       .examples = {kExample},
       .reads_files = true,
       .writes_files = kLogBeside});
}

}  // namespace keyline::operations
