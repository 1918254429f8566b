#include "keyline/library/search.h"
#include "keyline/library/statistics.h"

/// The room in a build without SQLite: nothing opens, so that nothing else is ever reached.
namespace keyline::library {

namespace detail {
class Database {};
}  // namespace detail

namespace {

std::unexpected<core::Failure> absent() {
  return core::fail(core::ErrorCode::unsupported, "this build of keyline has no design library",
                    "build it with -DKEYLINE_LIBRARY=ON, which needs SQLite");
}

}  // namespace

bool is_available() { return false; }

Library::Library(std::unique_ptr<detail::Database> database) : database_(std::move(database)) {}
Library::Library(Library&&) noexcept = default;
Library& Library::operator=(Library&&) noexcept = default;
Library::~Library() = default;

core::Result<Library> Library::open(const std::filesystem::path&, Mode) { return absent(); }
core::Result<std::vector<Added>> add(Library&, const std::vector<Entry>&) { return absent(); }
core::Result<Entry> get(Library&, std::int64_t) { return absent(); }
core::Result<document::Document> export_document(Library&, const std::vector<std::int64_t>&) {
  return absent();
}
core::Result<std::int64_t> size(Library&) { return absent(); }
core::Result<Findings> find(Library&, const Criteria&) { return absent(); }
core::Result<Statistics> statistics(Library&) { return absent(); }

}  // namespace keyline::library
