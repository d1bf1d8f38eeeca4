#pragma once
/// \file One program at a time works in a folder.

#include "ostia/core/task_context.h"

#include <filesystem>
#include <string>

namespace ostia::core {

enum class WhenBusy { refuse, wait };

/// A lock of the system's on the hidden file `.ostia-lock` of a folder: it ends with its process, however
/// that ends, so that the lock of a dead run is nobody's. The file goes with the lock; one that a dead run
/// left does no harm.
class FolderLock {
 public:
  /// Throws ResourceError where another process has the folder and none shall wait: "cannot work in `shown`:
  /// another run (process 1234) is at work there" and `way_out`; IoError where the folder is not there or
  /// cannot be written; Cancelled while it waits.
  FolderLock(const std::filesystem::path& folder, const std::filesystem::path& shown,
             const std::string& way_out, WhenBusy when_busy = WhenBusy::refuse,
             const TaskContext& task = no_task());
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace ostia::core
