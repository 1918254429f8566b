#include <iterator>

#include "keyline/operations/document_read.h"
#include "keyline/operations/library_entry.h"
#include "keyline/operations/open_library.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

constexpr const char* kFiles =
    "files of curves, surfaces or points; each is read as document.read does";

struct MeasureRequest {
  std::vector<std::string> file;
  std::string select;
  std::string glyphs;
  std::vector<NamedCurve> curves;
  std::string unit;
  std::string source;
  std::size_t first = 0;
  std::optional<std::size_t> most;
  static constexpr auto describe() {
    using R = MeasureRequest;
    return core::fields(
        core::field<&R::file>(kFiles).or_bare_item(),
        core::field<&R::select>("of each file: take only what has this name, layer or number"),
        core::field<&R::glyphs>("of fonts: characters, /name or U+0053"),
        core::field<&R::curves>("instead of files: curves with their names"),
        core::field<&R::unit>("of the coordinates; else the file's own"),
        core::field<&R::source>("where it comes from; else the file's name"),
        core::field<&R::first>("of each file: leave out so many things before")
            .within(core::at_least(0)),
        core::field<&R::most>("of each file: so many things at most; else all")
            .within(core::at_least(1)));
  }
};

struct MeasureAnswer {
  std::vector<LibraryEntry> entries;
  std::vector<std::string> skipped;
  static constexpr auto describe() {
    return core::fields(
        core::field<&MeasureAnswer::entries>("everything that was found, measured"),
        core::field<&MeasureAnswer::skipped>("what the files hold beside, in words"));
  }
};

/// Points as lines, all else as it is.
document::Document document_of(ReadAnswer read) {
  document::Document document = std::move(read.document);
  document.unit = read.unit;
  for (const NamedCurve& c : read.curves) {
    if (!c.line) continue;
    curve::Polyline2 line{c.line->points};
    if (c.line->closed) line.points.push_back(line.points.front());
    const document::Label label{c.name, c.layer, c.color};
    document.paths.push_back({label, {{{std::move(line)}}, c.line->closed}, 0});
  }
  return document;
}

document::Document document_of(const MeasureRequest& request) {
  document::Document document;
  document.unit = request.unit;
  for (const NamedCurve& c : request.curves) {
    const document::Label label{c.name, c.layer, c.color};
    if (!c.curve) continue;
    if (const auto path = planar_path(*c.curve))
      document.paths.push_back({label, *path, c.stroke_width});
    else if (const auto* space = std::get_if<document::SpaceCurve>(&*c.curve))
      document.space_curves.push_back({label, *space});
  }
  return document;
}

struct Measured {
  std::vector<library::Entry> entries;
  std::vector<std::string> skipped;
};

Result<void> measure_document(const document::Document& document, const std::string& source,
                              const MeasureRequest& request, const Context& context,
                              Measured& all) {
  auto entries = library::describe(document, source, {request.first, request.most, context.threads},
                                   context.progress);
  if (!entries) return std::unexpected(entries.error());
  std::ranges::move(*entries, std::back_inserter(all.entries));
  all.skipped.insert(all.skipped.end(), document.skipped.begin(), document.skipped.end());
  return {};
}

Result<Measured> measure(const MeasureRequest& request, const Context& context) {
  Measured all;
  if (!request.curves.empty())
    if (auto done = measure_document(document_of(request), request.source, request, context, all);
        !done)
      return std::unexpected(done.error());
  for (const std::string& file : request.file) {
    InputRequest input;
    input.file = {file};
    input.select = request.select;
    input.glyphs = request.glyphs;
    input.unit = request.unit;
    auto read = read_input(input, context.progress);
    if (!read) return std::unexpected(read.error());
    const std::string& source = request.source.empty() ? file : request.source;
    if (auto done = measure_document(document_of(std::move(*read)), source, request, context, all);
        !done)
      return std::unexpected(done.error());
  }
  return all;
}

Result<MeasureAnswer> run_measure(const MeasureRequest& request, const Context& context) {
  auto measured = measure(request, context);
  if (!measured) return std::unexpected(measured.error());
  MeasureAnswer answer;
  for (const library::Entry& entry : measured->entries)
    answer.entries.push_back(entry_shown(entry));
  answer.skipped = std::move(measured->skipped);
  return answer;
}

struct AddRequest {
  std::string library;
  MeasureRequest measured;
  std::vector<LibraryEntry> entries;
  static constexpr auto describe() {
    using R = AddRequest;
    return core::fields(
        core::field<&R::library>(kLibrary), core::flattened<&R::measured>(),
        core::field<&R::entries>("instead of files: entries as library.measure gives them"));
  }
};

struct AddedThing {
  std::int64_t id = 0;
  std::string name;
  bool is_new = false;
  static constexpr auto describe() {
    return core::fields(core::field<&AddedThing::id>("its number in the library"),
                        core::field<&AddedThing::name>("may be empty"),
                        core::field<&AddedThing::is_new>("false: it was there already"));
  }
};

struct AddAnswer {
  std::vector<AddedThing> added;
  std::int64_t size = 0;
  std::vector<std::string> skipped;
  static constexpr auto describe() {
    return core::fields(core::field<&AddAnswer::added>("in the order of the files"),
                        core::field<&AddAnswer::size>("things in the library now"),
                        core::field<&AddAnswer::skipped>("what the files hold beside, in words"));
  }
};

Result<AddAnswer> run_add(const AddRequest& request, const Context& context) {
  // Before the work: a library that cannot be written is told at once.
  auto library = open_library(request.library, library::Mode::write);
  if (!library) return std::unexpected(library.error());
  auto measured = measure(request.measured, context);
  if (!measured) return std::unexpected(measured.error());
  for (const LibraryEntry& shown : request.entries) {
    auto entry = entry_of(shown);
    if (!entry) return std::unexpected(entry.error());
    if (!request.measured.source.empty()) entry->source = request.measured.source;
    measured->entries.push_back(std::move(*entry));
  }
  const auto added = library::add(*library, measured->entries);
  if (!added) return std::unexpected(added.error());
  AddAnswer answer;
  for (std::size_t i = 0; i < added->size(); ++i)
    answer.added.push_back(
        {(*added)[i].id, library::label(measured->entries[i]).name, (*added)[i].is_new});
  const auto size = library::size(*library);
  if (!size) return std::unexpected(size.error());
  answer.size = *size;
  answer.skipped = std::move(measured->skipped);
  return answer;
}

}  // namespace

Operation library_measure_operation() {
  return declare<run_measure>(
      {.name = "library.measure",
       .summary = "Measures curves and surfaces as a design library does: rhythm, slopes, volumes, "
                  "CAV, SAV, size, profile, thumbnail.",
       .examples = {R"({"curves":[{"name":"a","curve":{"type":"bezier",
           "points":[[0,0],[1,0],[2,0.3],[2.6,1.2]]}}]})"},
       .long_running = true,
       .reads_files = true});
}

Operation library_add_operation() {
  return declare<run_add>(
      {.name = "library.add",
       .summary = "Measures curves and surfaces and keeps them in a design library; what is there "
                  "already stays as it is.",
       .examples = {R"({"library":"/tmp/keyline-example.kl","source":"example","curves":[
           {"name":"a","curve":{"type":"bezier","points":[[0,0],[1,0],[2,0.3],[2.6,1.2]]}}]})"},
       .long_running = true,
       .reads_files = true,
       .writes_files = true});
}

}  // namespace keyline::operations
