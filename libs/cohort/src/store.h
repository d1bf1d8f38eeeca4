#pragma once
/// \file The cohort's SQLite files: errors as exceptions, statements that stay prepared.

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::cohort {

class Store {
 public:
  enum class Mode { create, write, read };
  /// `create` is for files that are published when they are whole: it keeps no journal.
  Store(const std::filesystem::path& file, Mode mode);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  sqlite3* get() const { return handle_; }
  void execute(const char* sql) const;
  /// False where another program has it, or nobody may write it.
  bool try_execute(const char* sql) const;
  void check(int code) const {
    if (code != SQLITE_OK) raise(code);
  }
  [[noreturn]] void raise(int code) const;

 private:
  sqlite3* handle_ = nullptr;
  std::string shown_;
};

class Query {
 public:
  Query(const Store& store, const char* sql);
  ~Query() { sqlite3_finalize(handle_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  template <class... Values>
  Query& with(const Values&... values) {
    sqlite3_reset(handle_);
    [[maybe_unused]] int at = 0;
    (bind(++at, values), ...);
    return *this;
  }
  bool step();  ///< true: a row is there; false: done, and the query is reset
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_, column); }
  double real(int column) const { return sqlite3_column_double(handle_, column); }
  /// NaN where there is none; `with` writes NaN as none.
  double real_or_nan(int column) const;
  std::string text(int column) const;
  int columns() const { return sqlite3_column_count(handle_); }
  int type(int column) const { return sqlite3_column_type(handle_, column); }  ///< SQLITE_INTEGER, ...

 private:
  void bind(int at, std::int64_t value) { store_->check(sqlite3_bind_int64(handle_, at, value)); }
  void bind(int at, int value) { bind(at, std::int64_t{value}); }
  void bind(int at, std::size_t value) { bind(at, static_cast<std::int64_t>(value)); }
  void bind(int at, double value) { store_->check(sqlite3_bind_double(handle_, at, value)); }
  void bind(int at, std::string_view text);
  void bind(int at, const std::string& text) { bind(at, std::string_view(text)); }
  void bind(int at, const char* text) { bind(at, std::string_view(text)); }

  const Store* store_;
  sqlite3_stmt* handle_ = nullptr;
};

}  // namespace ostia::cohort
