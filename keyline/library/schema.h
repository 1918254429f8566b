#pragma once

#include <span>

#include "keyline/core/error.h"
#include "keyline/library/database.h"

namespace keyline::library::detail {

/// What takes a library from each version of its schema to the next, from an empty file on; the
/// version of this program is their number. A step that was published never changes.
std::span<const char* const> schema_steps();

/// Brings a library to the version of the last step, in one transaction: other programs see the old
/// one or the new one. With write-ahead log from then on.
/// Fails: unsupported for a library of a newer version; bad_input for a database that is none of
///        ours; io as Database.
core::Result<void> migrate(Database& database, std::span<const char* const> steps);

/// Whether a library that is only read has this version; an older one wants a writer first.
core::Result<void> check_version(Database& database, std::size_t version);

}  // namespace keyline::library::detail
