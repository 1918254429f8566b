#include "keyline/library/schema.h"

#include <array>
#include <chrono>
#include <string>
#include <thread>

namespace keyline::library::detail {

using core::ErrorCode;
using core::Result;

namespace {

constexpr std::int64_t kApplication = 0x6b65796c;  // "keyl": marks the file as a design library

constexpr std::array kSteps = {
    R"sql(
CREATE TABLE curve(
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  digest INTEGER NOT NULL,
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  layer TEXT NOT NULL,
  unit TEXT NOT NULL,
  source TEXT NOT NULL,
  size REAL NOT NULL,
  length REAL,
  volume REAL,
  curvature_min REAL,
  curvature_max REAL,
  rhythm TEXT NOT NULL,
  cav_type INTEGER,
  cav REAL,
  nearest_cav REAL,
  nearest_distance REAL,
  sav REAL,
  notes TEXT NOT NULL);
CREATE INDEX curve_digest ON curve(digest);
CREATE INDEX curve_cav ON curve(cav);
CREATE INDEX curve_name ON curve(name);
CREATE TABLE shape(
  curve INTEGER PRIMARY KEY REFERENCES curve ON DELETE CASCADE,
  geometry TEXT NOT NULL,
  thumbnail TEXT NOT NULL);
CREATE TABLE piece(
  curve INTEGER NOT NULL REFERENCES curve ON DELETE CASCADE,
  ordinal INTEGER NOT NULL,
  share REAL NOT NULL,
  rhythm TEXT NOT NULL,
  slope REAL,
  second_slope REAL,
  lcg_slope REAL,
  lcg_variance REAL,
  volume REAL NOT NULL,
  self_affinity REAL,
  PRIMARY KEY(curve, ordinal)) WITHOUT ROWID;
CREATE INDEX piece_rhythm ON piece(rhythm, slope, second_slope, self_affinity);
CREATE INDEX piece_slope ON piece(slope, second_slope, self_affinity);
CREATE TABLE profile(
  curve INTEGER PRIMARY KEY REFERENCES curve ON DELETE CASCADE,
  turning BLOB NOT NULL);
)sql",
};

Result<void> refuse_newer(std::int64_t version, std::size_t ours) {
  if (version <= static_cast<std::int64_t>(ours)) return {};
  return core::fail(ErrorCode::unsupported,
                    "the library has schema version " + std::to_string(version) +
                        ", this program knows up to " + std::to_string(ours),
                    "use the keyline that wrote it, or a newer one");
}

/// All that is read while it lives is of one state of the file, in a transaction or not.
class OneState {
 public:
  explicit OneState(Database& database) : database_(database) {
    begun_ = database.execute("SAVEPOINT one_state");
  }
  ~OneState() {
    if (begun_) static_cast<void>(database_.execute("RELEASE one_state"));
  }
  OneState(const OneState&) = delete;
  OneState& operator=(const OneState&) = delete;

  const Result<void>& begun() const { return begun_; }

 private:
  Database& database_;
  Result<void> begun_;
};

/// Version 0 is a file with nothing in it, or somebody else's. Read in one state: between two reads
/// another program may make the file a library.
Result<std::int64_t> version_of(Database& database) {
  const OneState state(database);
  if (!state.begun()) return std::unexpected(state.begun().error());
  const auto application = database.integer("PRAGMA application_id");
  if (!application) return std::unexpected(application.error());
  const auto things = database.integer("SELECT count(*) FROM sqlite_schema");
  if (!things) return std::unexpected(things.error());
  if (*application != kApplication && (*application != 0 || *things > 0))
    return core::fail(ErrorCode::bad_input, "this database is no design library",
                      "give another file", database.file().string());
  return database.integer("PRAGMA user_version");
}

/// Only one connection can change the mode, and SQLite does not wait for it by itself.
Result<void> use_write_ahead_log(Database& database) {
  constexpr int kTries = 100;
  Result<void> done;
  for (int i = 0; i < kTries; ++i) {
    done = database.execute("PRAGMA journal_mode = WAL");
    if (done) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return done;
}

}  // namespace

std::span<const char* const> schema_steps() { return kSteps; }

Result<void> check_version(Database& database, std::size_t version) {
  const auto found = version_of(database);
  if (!found) return std::unexpected(found.error());
  if (auto known = refuse_newer(*found, version); !known) return known;
  if (*found == static_cast<std::int64_t>(version)) return {};
  return core::fail(
      ErrorCode::unsupported, "the library has the older schema version " + std::to_string(*found),
      "add something to it once, which brings it up to date", database.file().string());
}

Result<void> migrate(Database& database, std::span<const char* const> steps) {
  const auto before = version_of(database);
  if (!before) return std::unexpected(before.error());
  if (auto known = refuse_newer(*before, steps.size()); !known) return known;
  if (*before == static_cast<std::int64_t>(steps.size())) return {};
  if (auto log = use_write_ahead_log(database); !log) return log;
  auto transaction = Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  // Another program may have been here first.
  const auto version = version_of(database);
  if (!version) return std::unexpected(version.error());
  if (auto known = refuse_newer(*version, steps.size()); !known) return known;
  for (auto at = static_cast<std::size_t>(*version); at < steps.size(); ++at)
    if (auto done = database.execute(steps[at]); !done) return done;
  if (auto done = database.execute("PRAGMA application_id = " + std::to_string(kApplication) +
                                   "; PRAGMA user_version = " + std::to_string(steps.size()));
      !done)
    return done;
  return transaction->commit();
}

}  // namespace keyline::library::detail
