#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/library/entry.h"

/// The design library: curves and surfaces of many designs in one SQLite file, found again by what
/// they look like. Several programs may read and write it at once; what was added is there whole or
/// not at all, whenever a program or the machine stops.
namespace keyline::library {

namespace detail {
class Database;
}

enum class Mode { read, write };  ///< write makes the library where there is none

/// Whether this build can store anything (it was built with SQLite).
bool is_available();

/// The file of the library unless one is named: what KEYLINE_LIBRARY in the environment says, else
/// library.kl in keyline's folder of the user's data (XDG_DATA_HOME, ~/.local/share). Empty where
/// there is no such folder.
std::filesystem::path default_file();

/// An open library. Not for two threads at once; open it once in each.
class Library {
 public:
  /// Fails: io where the file cannot be opened; bad_input where it is something else; unsupported
  ///        where a newer keyline wrote it, and in a build without SQLite. An older library is
  ///        brought up to date when it is opened to write.
  static core::Result<Library> open(const std::filesystem::path& file, Mode mode);
  Library(Library&&) noexcept;
  Library& operator=(Library&&) noexcept;
  ~Library();

  detail::Database& database() { return *database_; }

 private:
  explicit Library(std::unique_ptr<detail::Database> database);
  std::unique_ptr<detail::Database> database_;
};

/// What became of an entry: its number in the library, and whether it is new there.
struct Added {
  std::int64_t id = 0;
  bool is_new = false;
};

/// Stores entries, all or none. An entry whose thing (geometry, label, unit) and source are there
/// already keeps its number: to add the same twice changes nothing.
/// Fails: io; then nothing was added.
core::Result<std::vector<Added>> add(Library& library, const std::vector<Entry>& entries);

/// The entry of that number, all of it. Fails: bad_input where there is none.
core::Result<Entry> get(Library& library, std::int64_t id);

/// The things of those numbers as one document, labels and all.
/// Fails: as get(); bad_input where their units differ.
core::Result<document::Document> export_document(Library& library,
                                                 const std::vector<std::int64_t>& ids);

/// How many things it holds.
core::Result<std::int64_t> size(Library& library);

}  // namespace keyline::library
