#pragma once
/// \file A folder under construction that outlives a run which does not end well.

#include "ostia/core/files.h"
#include "ostia/core/folder_lock.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace ostia::core {

class MadeParents;

/// The folder `.kept-TARGET` beside a target. A run that ends without `commit`, killed or not, leaves what it
/// has recorded there, and the next run for the same target takes it over. One run at a time has it.
///
///     .kept-out/result/...      becomes the target
///     .kept-out/record.json     what is whole in it, as its user has it
class KeptFolder {
 public:
  /// What a dead run left half-made in `result` is removed. Throws as FolderLock ("another run is at work
  /// there") and StagedFolder do; missing folders above are made.
  explicit KeptFolder(std::filesystem::path target);
  /// Leaves nothing where nothing was recorded.
  ~KeptFolder();
  KeptFolder(const KeptFolder&) = delete;
  KeptFolder& operator=(const KeptFolder&) = delete;

  const std::filesystem::path& result() const { return result_; }
  /// As it was last recorded, by this run or an earlier one; empty: nothing.
  std::string record() const;
  void set_record(const std::string& text);
  /// `result` becomes the target, as StagedFolder has it; the rest goes.
  void commit();

 private:
  std::filesystem::path target_, folder_, result_;
  std::unique_ptr<const MadeParents> parents_;  ///< gone with this object where they are empty
  std::optional<FolderLock> lock_;
  std::optional<ShownAs> shown_;
  bool committed_ = false;
};

}  // namespace ostia::core
