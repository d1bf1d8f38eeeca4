#include "case_file/database.h"

#include "ostia/core/error.h"

#include <utility>

namespace ostia::session {

Database::Database(const std::string& path, int flags, std::string shown) : shown_(std::move(shown)) {
  const int code = sqlite3_open_v2(path.c_str(), &handle_, flags | SQLITE_OPEN_EXRESCODE, nullptr);
  if (code == SQLITE_OK) return;
  try {
    raise(code, "open");
  } catch (...) {
    close();
    throw;
  }
}

Database::~Database() {
  close();
}

Database::Database(Database&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), shown_(std::move(other.shown_)) {}

Database& Database::operator=(Database&& other) noexcept {
  if (this != &other) {
    close();
    handle_ = std::exchange(other.handle_, nullptr);
    shown_ = std::move(other.shown_);
  }
  return *this;
}

void Database::close() noexcept {
  if (handle_) sqlite3_close_v2(handle_);
  handle_ = nullptr;
}

void Database::raise(int code, const std::string& doing) const {
  const int primary = code & 0xff;
  const std::string what = "cannot " + doing + " the case " + shown_ + ": ";
  const std::string detail = handle_ ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
  if (primary == SQLITE_FULL)
    throw ResourceError(what + "the disk is full; the case is what it was before. Make room and try again");
  // A quota, a limit of a file's size: SQLite tells them from a full disk neither here nor by errno.
  if (code == SQLITE_IOERR_WRITE)
    throw ResourceError(what +
                        "writing failed (a quota, a limit of a file's size, or the drive); the case is "
                        "what it was before. Make room and try again");
  switch (primary) {
    case SQLITE_NOMEM:
      throw ResourceError(what + "out of memory");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw IoError(what +
                    "it is open in another window or program; close it there, or wait until it is done");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      throw IoError(what +
                    "the file or its folder is read-only; open it for reading only, or copy it to a "
                    "folder where you may write");
    case SQLITE_CANTOPEN:
      throw IoError(what + "it cannot be opened (" + detail + "); check the folder and its permissions");
    case SQLITE_IOERR:
      throw IoError(what + "reading or writing failed (" + detail + ")");
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
    case SQLITE_FORMAT:
      throw InvalidInput(what + "the file is damaged (" + detail + "); take a copy of it from a backup");
    default:
      throw Error(what + detail);
  }
}

void Database::execute(const std::string& sql) {
  check(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr), "use");
}

std::string Database::text_of(const std::string& sql) {
  Statement statement(*this, sql.c_str());
  return statement.step() ? statement.text(0) : std::string();
}

std::string Database::content() const {
  sqlite3_int64 size = 0;
  unsigned char* bytes = sqlite3_serialize(handle_, "main", &size, 0);
  if (!bytes) throw ResourceError("cannot copy the case " + shown_ + ": out of memory");
  std::string content(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  sqlite3_free(bytes);
  return content;
}

Statement::Statement(const Database& database, const char* sql) : database_(&database) {
  database.check(sqlite3_prepare_v3(database.get(), sql, -1, SQLITE_PREPARE_PERSISTENT, &handle_, nullptr),
                 "use");
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) {
    sqlite3_reset(handle_);
    return false;
  }
  try {
    database_->raise(code, "use");
  } catch (...) {
    sqlite3_reset(handle_);
    throw;
  }
}

std::string_view Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(handle_, column);
  const int size = sqlite3_column_bytes(handle_, column);
  return data ? std::string_view(static_cast<const char*>(data), static_cast<std::size_t>(size))
              : std::string_view();
}

void Statement::bind(int index, std::string_view text) {
  bound(sqlite3_bind_text64(handle_, index, text.data() ? text.data() : "", text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
}

void Statement::bind(int index, Blob blob) {
  bound(sqlite3_bind_blob64(handle_, index, blob.bytes.data() ? blob.bytes.data() : "", blob.bytes.size(),
                            SQLITE_STATIC));
}

Transaction::Transaction(Database& database) : database_(&database) {
  database.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  // SQLite itself has gone back after some errors.
  if (open_ && sqlite3_get_autocommit(database_->get()) == 0)
    sqlite3_exec(database_->get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_->check(sqlite3_exec(database_->get(), "COMMIT", nullptr, nullptr, nullptr), "write");
  open_ = false;
}

}  // namespace ostia::session
