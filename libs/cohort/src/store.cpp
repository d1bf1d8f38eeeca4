#include "store.h"

#include "ostia/core/error.h"

#include <limits>

namespace ostia::cohort {
namespace {

int flags_of(Store::Mode mode) {
  switch (mode) {
    case Store::Mode::create:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case Store::Mode::write:
      return SQLITE_OPEN_READWRITE;
    case Store::Mode::read:
      break;
  }
  return SQLITE_OPEN_READONLY;
}

}  // namespace

Store::Store(const std::filesystem::path& file, Mode mode) : shown_(file.string()) {
  const int code = sqlite3_open_v2(file.c_str(), &handle_, flags_of(mode), nullptr);
  try {
    check(code);
    check(sqlite3_busy_timeout(handle_, 2000));
    if (mode == Mode::create) execute("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF");
  } catch (...) {
    sqlite3_close_v2(handle_);
    throw;
  }
}

Store::~Store() {
  sqlite3_close_v2(handle_);
}

void Store::execute(const char* sql) const {
  check(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr));
}

bool Store::try_execute(const char* sql) const {
  const int code = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
  switch (code & 0xff) {
    case SQLITE_OK:
      return true;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      return false;
    default:
      raise(code);
  }
}

void Store::raise(int code) const {
  const std::string detail = handle_ ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
  const std::string what = "cannot use " + shown_ + ": ";
  switch (code & 0xff) {
    case SQLITE_FULL:
      throw ResourceError(what + "the disk is full; make room and try again");
    case SQLITE_NOMEM:
      throw ResourceError(what + "out of memory");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw ResourceError(what + "another program is at work in it; try again when it is done");
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:
      throw InvalidInput(what + "it is damaged or no cohort's (" + detail + ")");
    default:
      throw IoError(what + detail);
  }
}

Query::Query(const Store& store, const char* sql) : store_(&store) {
  store.check(sqlite3_prepare_v3(store.get(), sql, -1, SQLITE_PREPARE_PERSISTENT, &handle_, nullptr));
}

bool Query::step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(handle_);
  if (code != SQLITE_DONE) store_->raise(code);
  return false;
}

double Query::real_or_nan(int column) const {
  const bool none = sqlite3_column_type(handle_, column) == SQLITE_NULL;
  return none ? std::numeric_limits<double>::quiet_NaN() : real(column);
}

std::string Query::text(int column) const {
  const void* bytes = sqlite3_column_blob(handle_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_, column));
  return bytes ? std::string(static_cast<const char*>(bytes), size) : std::string();
}

void Query::bind(int at, std::string_view text) {
  store_->check(sqlite3_bind_text64(handle_, at, text.data() ? text.data() : "", text.size(),
                                    SQLITE_TRANSIENT, SQLITE_UTF8));
}

}  // namespace ostia::cohort
