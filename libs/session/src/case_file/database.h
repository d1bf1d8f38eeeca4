#pragma once
/// \file SQLite with errors as exceptions, and statements that are kept prepared.

// Debian builds the library with both; the header shows them on demand.
#ifndef SQLITE_ENABLE_SESSION
#define SQLITE_ENABLE_SESSION 1
#endif
#ifndef SQLITE_ENABLE_PREUPDATE_HOOK
#define SQLITE_ENABLE_PREUPDATE_HOOK 1
#endif
#include <sqlite3.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace ostia::session {

/// One connection. The name is shown in messages.
class Database {
 public:
  Database() = default;
  Database(const std::string& path, int flags, std::string shown);
  ~Database();
  Database(Database&& other) noexcept;
  Database& operator=(Database&& other) noexcept;

  sqlite3* get() const { return handle_; }
  const std::string& shown() const { return shown_; }
  void rename(std::string shown) { shown_ = std::move(shown); }
  void execute(const std::string& sql);
  std::string text_of(const std::string& sql);  ///< first column of the first row; empty without one
  std::string content() const;  ///< the bytes of the file it would be, commits in a WAL included
  /// Throws what an error code means: ResourceError (full disk, memory), IoError (locked, read-only,
  /// unreadable), InvalidInput (damaged, not a database).
  [[noreturn]] void raise(int code, const std::string& doing) const;
  void check(int code, const std::string& doing) const {
    if (code != SQLITE_OK) raise(code, doing);
  }
  void close() noexcept;

 private:
  sqlite3* handle_ = nullptr;
  std::string shown_;
};

/// Bytes to be bound as a blob; they must live until the statement has run.
struct Blob {
  std::string_view bytes;
};

/// A prepared statement; `with` binds all parameters anew, `run` and `step` execute.
class Statement {
 public:
  Statement(const Database& database, const char* sql);
  ~Statement() { sqlite3_finalize(handle_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  template <class... Values>
  Statement& with(const Values&... values) {
    sqlite3_reset(handle_);
    [[maybe_unused]] int index = 0;
    (bind(++index, values), ...);
    return *this;
  }
  bool step();  ///< true: a row is there; false: done, and the statement is reset
  void run() {
    while (step()) {
    }
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_, column); }
  double real(int column) const { return sqlite3_column_double(handle_, column); }
  std::string text(int column) const { return std::string(bytes(column)); }
  std::string_view bytes(int column) const;
  void reset() { sqlite3_reset(handle_); }

 private:
  void bind(int index, std::int64_t value) { bound(sqlite3_bind_int64(handle_, index, value)); }
  void bind(int index, std::int32_t value) { bind(index, std::int64_t{value}); }
  void bind(int index, double value) { bound(sqlite3_bind_double(handle_, index, value)); }
  void bind(int index, std::string_view text);
  void bind(int index, const std::string& text) { bind(index, std::string_view(text)); }
  void bind(int index, const char* text) { bind(index, std::string_view(text)); }
  void bind(int index, Blob blob);
  void bound(int code) const { database_->check(code, "use"); }
  const Database* database_;
  sqlite3_stmt* handle_ = nullptr;
};

/// Undone unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
  bool open_ = true;
};

}  // namespace ostia::session
