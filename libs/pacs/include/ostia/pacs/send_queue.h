#pragma once
/// \file Objects on their way to an archive, which survive the end of the program.

#include "ostia/core/folder_lock.h"
#include "ostia/core/task_context.h"
#include "ostia/pacs/archive.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ostia::pacs {

enum class QueueState {
  waiting,  ///< not tried yet, or the server was not reached
  sent,
  failed  ///< refused by the server: tried again only when it is asked for
};
std::string to_string(QueueState state);

struct QueueItem {
  std::string id;      ///< of server and object: the same object for the same server is one item
  std::string server;  ///< its name
  QueueState state = QueueState::waiting;
  std::string reason;  ///< of the last attempt that failed
  int attempts = 0;
  std::string what = {};  ///< as `add` was told: a kind of object, and nobody's name
};

/// A folder that its owner alone may read: `ID.dcm`, a copy of the object until it is sent, and `ID.json`,
/// what has become of it. Each appears whole or not at all, so that a program that is killed leaves every
/// item waiting, sent or failed. One that is killed between the server's answer and the note of it sends the
/// object again, under the same SOP instance UID, which makes no copy there.
class SendQueue {
 public:
  /// Makes the folder where it is missing. Throws IoError; ResourceError where another program has it open.
  explicit SendQueue(std::filesystem::path folder);

  /// A DICOM file for a server. An item that is there already is not added again: one that failed waits
  /// again, and so does one that was sent. Returns its id. Throws InvalidInput (no DICOM object), IoError,
  /// ResourceError (disk full).
  std::string add(const std::filesystem::path& file, const std::string& server, const std::string& what = {});
  /// By id. Throws InvalidInput naming an item's file that is damaged.
  std::vector<QueueItem> items() const;
  /// Failed items wait again.
  void retry_failed();
  /// This one alone, where it failed; nothing for another id.
  void retry(const std::string& id);
  /// Object and note go, whatever became of it. Not while `send_waiting` runs.
  void remove(const std::string& id);
  /// Notes of what was sent go.
  void forget_sent();

  /// Tries all that wait; `archive_of` is asked once a server and may throw. A server that is not reached
  /// leaves its items waiting, with the reason. Throws Cancelled, IoError, ResourceError.
  using ArchiveOf = std::function<std::unique_ptr<Archive>(const std::string& server)>;
  void send_waiting(const ArchiveOf& archive_of, const core::TaskContext& task = core::no_task());

 private:
  std::filesystem::path file_of(const std::string& id, const char* extension) const;
  void note(const QueueItem& item) const;

  std::filesystem::path folder_;
  std::unique_ptr<core::FolderLock> lock_;
};

}  // namespace ostia::pacs
