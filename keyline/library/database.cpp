#include "keyline/library/database.h"

#include <cstring>
#include <utility>

#include <sqlite3.h>

namespace keyline::library::detail {

using core::ErrorCode;
using core::Result;

namespace {

/// A writer holds the file for one commit; this long only where a disk or its owner is stuck.
constexpr int kPatienceMilliseconds = 30'000;

std::unexpected<core::Failure> failure(sqlite3* database, int code) {
  const std::string file = database && sqlite3_db_filename(database, nullptr)
                               ? sqlite3_db_filename(database, nullptr)
                               : "";
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return core::fail(ErrorCode::io, "the library is being written by another program",
                        "try again when it is done", file);
    case SQLITE_FULL:
      return core::fail(ErrorCode::io, "there is no room left for the library",
                        "free some space; nothing that was stored is lost", file);
    case SQLITE_READONLY:
      return core::fail(ErrorCode::io, "the library may only be read",
                        "check the permissions of the file and of its folder", file);
    case SQLITE_NOTADB:
      return core::fail(ErrorCode::bad_input, "this is no design library", {}, file);
    case SQLITE_CORRUPT:
      return core::fail(ErrorCode::io, "the library is damaged",
                        "recover it with sqlite3 FILE .recover, or take a copy", file);
    default:
      return core::fail(ErrorCode::io,
                        std::string("the library cannot be used: ") +
                            (database ? sqlite3_errmsg(database) : sqlite3_errstr(code)),
                        {}, file);
  }
}

/// For SQLite's file names with parameters.
std::string uri_of(const std::filesystem::path& file, const char* parameters) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (c == '?' || c == '#' || c == '%') {
      constexpr const char* kHex = "0123456789ABCDEF";
      const auto byte = static_cast<unsigned char>(c);
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      uri += c;
    }
  }
  return uri + parameters;
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Statement::Statement(sqlite3* database, sqlite3_stmt* statement)
    : database_(database), statement_(statement) {}

Statement& Statement::bind(int at, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), at, value);
  return *this;
}
Statement& Statement::bind(int at, double value) {
  sqlite3_bind_double(statement_.get(), at, value);
  return *this;
}
Statement& Statement::bind(int at, std::optional<double> value) {
  if (value) return bind(at, *value);
  sqlite3_bind_null(statement_.get(), at);
  return *this;
}
Statement& Statement::bind(int at, std::string_view text) {
  sqlite3_bind_text64(statement_.get(), at, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
  return *this;
}
Statement& Statement::bind(int at, std::span<const float> values) {
  sqlite3_bind_blob64(statement_.get(), at, values.data(), values.size_bytes(), SQLITE_STATIC);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  auto failed = failure(database_, code);
  sqlite3_reset(statement_.get());
  return failed;
}

Result<void> Statement::run() {
  for (;;) {
    const auto row = step();
    if (!row) return std::unexpected(row.error());
    if (!*row) break;
  }
  sqlite3_reset(statement_.get());
  return {};
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}
double Statement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}
std::optional<double> Statement::number_if_any(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  return number(column);
}
std::string Statement::text(int column) const {
  const auto* text = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return text ? std::string(reinterpret_cast<const char*>(text), size) : std::string();
}
bool Statement::floats(int column, std::span<float> values) const {
  const void* blob = sqlite3_column_blob(statement_.get(), column);
  const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  if (!blob || bytes != values.size_bytes()) return false;
  std::memcpy(values.data(), blob, bytes);
  return true;
}

Result<Database> Database::open(const std::filesystem::path& file, Access access) {
  const int mode = access == Access::read    ? SQLITE_OPEN_READONLY
                   : access == Access::write ? SQLITE_OPEN_READWRITE
                                             : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const auto connect = [&](const char* parameters) -> Result<Database> {
    sqlite3* raw = nullptr;
    const int code = sqlite3_open_v2(uri_of(file, parameters).c_str(), &raw,
                                     mode | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
    Database database(file, raw);
    if (code != SQLITE_OK) return failure(raw, code);
    sqlite3_extended_result_codes(raw, 1);
    sqlite3_busy_timeout(raw, kPatienceMilliseconds);
    return database;
  };
  std::error_code ignored;
  if (access != Access::create && !std::filesystem::exists(file, ignored))
    return core::fail(ErrorCode::io, "there is no such library", "make it with library add",
                      file.string());
  auto database = connect("");
  if (!database || access != Access::read) return database;
  // A folder that may not be written has no place for the shared memory of the write-ahead log;
  // where nothing waits in the log either, the file alone is the library.
  if (database->integer("SELECT count(*) FROM sqlite_schema")) return database;
  const auto log = std::filesystem::file_size(file.string() + "-wal", ignored);
  if (!ignored && log > 0) return database;
  return connect("?immutable=1");
}

Result<void> Database::execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failure(database_.get(), code);
  return {};
}

Result<Statement> Database::prepare(std::string_view sql) {
  sqlite3_stmt* raw = nullptr;
  const int code =
      sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &raw, nullptr);
  if (code != SQLITE_OK) return failure(database_.get(), code);
  return Statement(database_.get(), raw);
}

Result<std::int64_t> Database::integer(std::string_view sql) {
  auto statement = prepare(sql);
  if (!statement) return std::unexpected(statement.error());
  const auto row = statement->step();
  if (!row) return std::unexpected(row.error());
  return *row ? statement->integer(0) : 0;
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(database_.get()); }

Result<Transaction> Transaction::begin(Database& database) {
  if (auto begun = database.execute("BEGIN IMMEDIATE"); !begun)
    return std::unexpected(begun.error());
  return Transaction(database);
}

Transaction::~Transaction() {
  if (database_) static_cast<void>(database_->execute("ROLLBACK"));
}

Result<void> Transaction::commit() {
  auto done = database_->execute("COMMIT");
  if (done) database_ = nullptr;
  return done;
}

}  // namespace keyline::library::detail
