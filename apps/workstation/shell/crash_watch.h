#pragma once
/// \file A program that crashes leaves a report on this computer, for its user alone.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::workstation {

/// From its making on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) writes a text file into `folder`,
/// which is then made (0700, the file 0600), and ends the program as it would have ended. The file holds the
/// program's version, the signal, the time, the last commands by their ids and the call stack as modules and
/// offsets: no path, and nothing of a patient or a case. One at a time; a second one throws std::logic_error.
class CrashWatch {
 public:
  explicit CrashWatch(const std::filesystem::path& folder);
  ~CrashWatch();
  CrashWatch(const CrashWatch&) = delete;
  CrashWatch& operator=(const CrashWatch&) = delete;
};

/// Beside what else this machine's state is.
std::filesystem::path crash_folder(const std::filesystem::path& state_folder);
/// A command was given. Kept in memory, of each the first 47 bytes, the last 24 of them.
void note_command(const std::string& id);
/// Libraries that were loaded since, such as the graphics driver's, are known by name from now on.
void know_modules();
/// The reports in a folder, the newest last.
std::vector<std::filesystem::path> crash_reports(const std::filesystem::path& folder);

}  // namespace ostia::workstation
