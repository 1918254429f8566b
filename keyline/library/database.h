#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "keyline/core/error.h"

struct sqlite3;
struct sqlite3_stmt;

/// SQLite as this house wants it: values, results instead of codes, nothing left open. For .cpp
/// files of this room only.
namespace keyline::library::detail {

/// A statement that was understood. Parameters count from 1, columns from 0. Empty optionals are
/// NULL. Text and bytes that are bound must live until the statement is stepped or reset.
class Statement {
 public:
  Statement(sqlite3* database, sqlite3_stmt* statement);

  Statement& bind(int at, std::int64_t value);
  Statement& bind(int at, double value);
  Statement& bind(int at, std::optional<double> value);
  Statement& bind(int at, std::string_view text);
  Statement& bind(int at, std::span<const float> values);

  /// True: a row stands ready; false: there are no more.
  core::Result<bool> step();
  /// Runs to the end and makes ready to be bound again.
  core::Result<void> run();

  std::int64_t integer(int column) const;
  double number(int column) const;
  std::optional<double> number_if_any(int column) const;
  std::string text(int column) const;
  /// False where the column holds another number of them.
  bool floats(int column, std::span<float> values) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

enum class Access { read, write, create };

/// One connection to one file.
class Database {
 public:
  /// Fails: io where the file is missing (unless it may be created), cannot be opened, or has no
  /// room; bad_input where it is no database.
  static core::Result<Database> open(const std::filesystem::path& file, Access access);

  core::Result<void> execute(const std::string& sql);
  core::Result<Statement> prepare(std::string_view sql);
  core::Result<std::int64_t> integer(std::string_view sql);
  std::int64_t last_row() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  Database(std::filesystem::path file, sqlite3* database)
      : file_(std::move(file)), database_(database) {}

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// Writes that happen together or not at all: undone unless committed.
class Transaction {
 public:
  /// Waits for other writers. Fails: io where they take too long.
  static core::Result<Transaction> begin(Database& database);
  Transaction(Transaction&& other) noexcept : database_(other.database_) {
    other.database_ = nullptr;
  }
  ~Transaction();
  core::Result<void> commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;
};

}  // namespace keyline::library::detail
