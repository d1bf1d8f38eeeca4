#include "case_file/case_open.h"

#include "case_file/case_schema.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"
#include "ostia/core/version.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <system_error>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t largest_case = 4ULL << 30;
constexpr std::string_view magic = "SQLite format 3";  // and a zero
// SQLite's lock bytes (its file format, "The Locking Byte Page"): one who reads holds a shared lock here.
constexpr off_t shared_first = 0x40000000 + 2, shared_size = 510;

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InvalidInput("cannot open the case " + path.string() + ": " + what);
}

class Descriptor {
 public:
  explicit Descriptor(const fs::path& path) : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (fd_ < 0)
      throw IoError("cannot open the case " + path.string() + ": " + std::generic_category().message(errno) +
                    (errno == ENOENT ? "; check the name" : ""));
  }
  ~Descriptor() { ::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

fs::path beside(const fs::path& path, const char* suffix) {
  return fs::path(path.string() + suffix);
}

bool has_content(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return !error && size > 0;
}

bool has_journal(const fs::path& path) {
  return has_content(beside(path, "-wal")) || has_content(beside(path, "-journal"));
}

/// What the first bytes say, before SQLite sees the file.
struct Header {
  std::uint32_t page_size = 0, pages = 0;
  std::int32_t version = 0;
};

Header header_of(const fs::path& path, const Descriptor& file, std::uint64_t size) {
  std::array<char, 100> bytes{};
  const ssize_t got = ::pread(file.get(), bytes.data(), bytes.size(), 0);
  if (got < 0)
    throw IoError("cannot read the case " + path.string() + ": " + std::generic_category().message(errno));
  const std::string_view head(bytes.data(), static_cast<std::size_t>(got));
  if (head.empty()) refuse(path, "the file is empty; take a copy of it from a backup");
  if (head.substr(0, magic.size()) != magic.substr(0, std::min(magic.size(), head.size())))
    refuse(path, "it is not a case of Ostia; cases are made by `ostia lumen --case`");
  if (head.size() < bytes.size()) refuse(path, "the file is truncated to " + std::to_string(size) + " bytes");
  if (big_endian(head, 68) != application_id)
    refuse(path, "it is a database of another program, not a case of Ostia");
  Header header;
  header.page_size = big_endian(head, 14) & 0xffff;
  if (header.page_size == 1) header.page_size = 65536;
  header.pages = big_endian(head, 28);
  header.version = static_cast<std::int32_t>(big_endian(head, 60));
  return header;
}

/// The program version that a case of a newer format asks for, if its table `meta` can still be read.
std::string needed_version(const fs::path& path) {
  try {
    Database database("file:" + path.string() + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI,
                      path.string());
    return database.text_of("SELECT value FROM meta WHERE key = 'needs'");
  } catch (const Error&) {
    return "";
  }
}

void check_header(const fs::path& path, const Descriptor& file) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) refuse(path, "it is not a file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const Header header = header_of(path, file, size);
  if (header.version > schema_version) {
    const std::string needed = needed_version(path);
    refuse(path, "its format " + std::to_string(header.version) + " is newer than this program's (" +
                     std::to_string(schema_version) + ", Ostia " + core::version() +
                     "); open it with Ostia " +
                     (needed.empty() ? "of a newer version" : needed + " or newer"));
  }
  const std::uint64_t expected = std::uint64_t{header.page_size} * header.pages;
  if (!has_journal(path) && size < expected)
    refuse(path, "the file is truncated: it has " + std::to_string(size) + " of " + std::to_string(expected) +
                     " bytes; take a copy of it from a backup");
}

/// A shared lock while the content is copied; refused while another process writes.
void lock_shared(const fs::path& path, const Descriptor& file) {
  struct flock lock {};
  lock.l_type = F_RDLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = shared_first;
  lock.l_len = shared_size;
  if (::fcntl(file.get(), F_SETLK, &lock) == 0) return;
  if (errno == EACCES || errno == EAGAIN)
    throw IoError("cannot open the case " + path.string() +
                  ": it is open in another window or program; close it there, or wait until it is done");
}

/// The content as SQLite would see it after recovery; in a copy, so that the file stays as it is.
std::string recovered(const fs::path& path) {
  const core::PrivateFolder folder;
  const fs::path copy = folder.path() / "copy";
  for (const char* suffix : {"", "-wal", "-journal"})
    if (fs::exists(beside(path, suffix))) fs::copy_file(beside(path, suffix), beside(copy, suffix));
  {
    Database database(copy.string(), SQLITE_OPEN_READWRITE, path.string());
    database.execute("PRAGMA locking_mode=EXCLUSIVE");
    if (!database.text_of("PRAGMA wal_checkpoint(TRUNCATE)").empty())
      database.text_of("PRAGMA journal_mode=DELETE");
    database.text_of("SELECT count(*) FROM sqlite_schema");
  }
  return core::read_file(copy, largest_case);
}

Database in_memory(std::string content, const fs::path& path) {
  if (content.size() < 100) refuse(path, "the file is truncated");
  content[18] = content[19] = 1;  // a database in memory has no WAL
  Database database(":memory:", SQLITE_OPEN_READWRITE, path.string());
  auto* bytes = static_cast<unsigned char*>(sqlite3_malloc64(content.size()));
  if (!bytes) throw ResourceError("cannot read the case " + path.string() + ": out of memory");
  std::memcpy(bytes, content.data(), content.size());
  const auto size = static_cast<sqlite3_int64>(content.size());
  database.check(sqlite3_deserialize(database.get(), "main", bytes, size, size,
                                     SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE),
                 "read");
  return database;
}

std::string schema_of(Database& database) {
  Statement rows(database, "SELECT type, name, sql FROM sqlite_schema WHERE sql IS NOT NULL ORDER BY name");
  std::string all;
  while (rows.step()) all += rows.text(0) + " " + rows.text(1) + " " + rows.text(2) + "\n";
  return all;
}

void harden(Database& database) {
  for (const int off :
       {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_TRUSTED_SCHEMA})
    sqlite3_db_config(database.get(), off, 0, nullptr);
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  database.execute("PRAGMA cell_size_check=ON");
}

void check_pages(Database& database, const fs::path& path) {
  const std::string found = database.text_of("PRAGMA quick_check(1)");
  if (found != "ok") refuse(path, "the file is damaged (" + found + "); take a copy of it from a backup");
}

void check_tables(Database& database, const fs::path& path) {
  Database fresh(":memory:", SQLITE_OPEN_READWRITE, "");
  create_schema(fresh);
  if (schema_of(database) != schema_of(fresh))
    refuse(path, "its tables are not those of a case; the file is damaged or was made by another program");
}

struct Writable {
  bool file = false, folder = false;  // SQLite's journal lies beside the case
};
Writable writable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto may = [](const fs::path& what, int how) {
    return ::faccessat(AT_FDCWD, what.c_str(), how, AT_EACCESS) == 0;
  };
  return {may(path, W_OK), may(folder, W_OK | X_OK)};
}

void require_writable(const fs::path& path) {
  const Writable may = writable(path);
  if (may.file && may.folder) return;
  throw IoError("cannot open the case " + path.string() + " for editing: the " +
                (may.file ? "folder" : "file") +
                " is read-only; open it for reading only, or copy it to a folder where you may write");
}

}  // namespace

bool can_be_edited(const fs::path& path) {
  const Writable may = writable(path);
  return may.file && may.folder;
}

class OpenFileMark {
 public:
  OpenFileMark(const fs::path& path, OpenMode mode) : mode_(mode) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return;  // the opening says what is wrong
    key_ = {status.st_dev, status.st_ino};
    const std::lock_guard lock(mutex());
    int& users = open()[key_];
    if (users < 0 || (users > 0 && mode == OpenMode::read_write)) {
      throw IoError("cannot open the case " + path.string() +
                    ": it is open in another window of this program; close it there");
    }
    users = mode == OpenMode::read_write ? -1 : users + 1;
    marked_ = true;
  }
  ~OpenFileMark() {
    if (!marked_) return;
    const std::lock_guard lock(mutex());
    int& users = open()[key_];
    users = mode_ == OpenMode::read_write ? 0 : users - 1;
    if (users == 0) open().erase(key_);
  }
  OpenFileMark(const OpenFileMark&) = delete;
  OpenFileMark& operator=(const OpenFileMark&) = delete;

 private:
  using Key = std::pair<dev_t, ino_t>;
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  /// Readers of a file, or -1 for its one writer.
  static std::map<Key, int>& open() {
    static std::map<Key, int> instance;
    return instance;
  }
  OpenMode mode_;
  Key key_{};
  bool marked_ = false;
};

bool is_network_file_system(std::uint64_t type) {
  // statfs(2) and the kernel's magic.h: NFS, SMB, CIFS, SMB2, FUSE (sshfs and the like), AFS, Coda, 9P, Ceph,
  // Lustre, GPFS.
  constexpr std::array<std::uint64_t, 11> network{0x6969,     0x517B,     0xFF534D42, 0xFE534D42,
                                                  0x65735546, 0x5346414F, 0x73757245, 0x01021997,
                                                  0x00C36400, 0x0BD00BD0, 0x47504653};
  return std::find(network.begin(), network.end(), type & 0xffffffffULL) != network.end();
}

JournalKind journal_kind_for(const fs::path& file) {
  struct statfs status {};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (::statfs(folder.c_str(), &status) != 0) return JournalKind::wal;
  return is_network_file_system(static_cast<std::uint64_t>(status.f_type)) ? JournalKind::rollback
                                                                           : JournalKind::wal;
}

void configure(Database& database, JournalKind kind) {
  // Exclusive from the first access on: the WAL's index then lies in this process's memory alone.
  database.text_of("PRAGMA locking_mode=EXCLUSIVE");
  database.execute("PRAGMA synchronous=FULL");
  const std::string wanted = kind == JournalKind::wal ? "wal" : "truncate";
  if (database.text_of("PRAGMA journal_mode=" + wanted) != wanted)
    throw IoError("cannot open the case " + database.shown() + ": its journal cannot be set up");
  database.execute("PRAGMA fullfsync=ON");
  database.execute("BEGIN EXCLUSIVE; COMMIT");
}

Database new_database(const fs::path& path, JournalKind kind) {
  Database database(path.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, path.string());
  configure(database, kind);
  return database;
}

OpenedCase open_case(const fs::path& path, OpenMode mode) {
  OpenedCase opened;
  opened.mark = std::make_shared<OpenFileMark>(path, mode);
  std::string content;
  std::int32_t version = 0;
  {
    const Descriptor file(path);
    if (mode == OpenMode::read_only) lock_shared(path, file);
    check_header(path, file);
    if (mode == OpenMode::read_only)
      content = has_journal(path) ? recovered(path) : core::read_file(path, largest_case);
  }
  try {
    if (mode == OpenMode::read_only) {
      opened.database = in_memory(std::move(content), path);
      harden(opened.database);
    } else {
      require_writable(path);
      opened.database = Database(path.string(), SQLITE_OPEN_READWRITE, path.string());
      harden(opened.database);
      configure(opened.database, journal_kind_for(path));
    }
    version = static_cast<std::int32_t>(std::stol("0" + opened.database.text_of("PRAGMA user_version")));
    if (version > schema_version) refuse(path, "its format is newer than this program's");
    check_pages(opened.database, path);
    migrate(opened.database, version, [&] { check_tables(opened.database, path); });
    check_tables(opened.database, path);
  } catch (const Error& e) {
    // A damaged schema shows as SQL that cannot be compiled.
    if (e.exit_code() != ExitCode::internal) throw;
    refuse(path, std::string("the file is damaged (") + e.what() + "); take a copy of it from a backup");
  }
  return opened;
}

}  // namespace ostia::session
