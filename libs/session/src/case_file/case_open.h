#pragma once
/// \file Opening a case file: every check before its tables are used.

#include "case_file/database.h"

#include "ostia/session/case_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace ostia::session {

enum class JournalKind {
  wal,       ///< beside the file, one sync a command
  rollback,  ///< on network file systems, where a WAL's shared memory cannot be trusted
};
/// By the f_type of statfs(2).
bool is_network_file_system(std::uint64_t magic);
JournalKind journal_kind_for(const std::filesystem::path& file);

/// Holds the place of a file that this process has open: POSIX locks do not hold between two users in one
/// process, and closing one descriptor would drop the other's.
class OpenFileMark;

struct OpenedCase {
  std::shared_ptr<OpenFileMark> mark;
  Database database;
};

/// For writing: the file itself, locked. For reading: its content in memory, recovered where a crash has left
/// a journal; the file is not changed. Throws as CaseFile::open does.
OpenedCase open_case(const std::filesystem::path& path, OpenMode mode);
/// Sets up a new or opened connection: locking, journal, durability.
void configure(Database& database, JournalKind kind);
/// An empty new database at a path where nothing is.
Database new_database(const std::filesystem::path& path, JournalKind kind);

}  // namespace ostia::session
