#pragma once
/// \file Work that may crash or swell runs in a child process with limits.

#include "ostia/core/task_context.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::core {

struct ChildLimits {
  std::uint64_t memory_bytes = 4ULL << 30;   ///< address space; not enforced under AddressSanitizer
  std::chrono::seconds cpu_time{600};        ///< CPU seconds
  std::uint64_t output_bytes = 16ULL << 30;  ///< largest file the child may write
};

struct ChildResult {
  int exit_code = 0;           ///< meaningful when signal == 0
  int signal = 0;              ///< 0, or the signal that ended the child
  bool out_of_time = false;    ///< ended by the CPU limit
  std::string standard_error;  ///< last 64 KiB
  double peak_mb = 0.0;        ///< most memory resident, of it or of one of its own children
  /// "was killed by signal 11 (segmentation fault)", "ran out of its 600 s of CPU time", "exited with code
  /// 3".
  std::string describe() const;
  bool ok() const { return signal == 0 && exit_code == 0; }
};

/// Runs `program` with `arguments`, no shell, standard input closed, standard output discarded, environment
/// reduced to PATH, LC_ALL=C, TMPDIR and the OSTIA_ variables. The child dies with its parent. Blocks; on
/// cancel the child is killed and ostia::Cancelled thrown. What it says on standard error is also appended to
/// the file `log`, where one is given, as it comes. Throws ResourceError when no process can be made, IoError
/// when the program is not there or the log cannot be written.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const ChildLimits& limits = {}, const TaskContext& task = no_task(),
                      const std::filesystem::path& log = {});

/// As a shell would find it; nothing where it is not there or cannot be run.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

}  // namespace ostia::core
