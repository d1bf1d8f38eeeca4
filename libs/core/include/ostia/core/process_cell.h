#pragma once
/// \file Shuts a process in that reads a stranger's bytes: what takes it over reaches no network, no other
/// file, no other program.

#include <filesystem>
#include <vector>

namespace ostia::core {

/// What a process in the cell may still touch, beside what it has open already and the system's own libraries
/// and tables (/usr, /lib, what tells of processors and memory), which it may read.
struct CellRules {
  std::vector<std::filesystem::path>
      reads;  ///< files, or folders with all below them; missing ones are nothing
  std::vector<std::filesystem::path> writes;  ///< folders: files in them are made, written and read
};

/// Which walls of the cell stand; a kernel may be without one of them.
struct CellWalls {
  /// System calls are those of computing, of open files and of its own threads (seccomp); of another
  /// architecture there are none.
  bool calls = false;
  bool files = false;  ///< files are those of the rules (Landlock)
  bool whole() const { return calls && files; }
};

/// What this kernel has; changes nothing.
CellWalls possible_cell();

/// From here on this thread, and all that it starts, are in the cell; for good. A process calls it before it
/// has other threads. Other programs, new processes, sockets, io_uring, tracing, signals to others: each such
/// call fails (EPERM); one by another architecture's table of calls ends the process (SIGSYS). What the
/// kernel does not have is left out, and said in the result.
CellWalls enter_cell(const CellRules& rules);

}  // namespace ostia::core
