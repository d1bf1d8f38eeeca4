#pragma once
// What comes from a server on its way into a folder: checked object by object.

#include "ostia/core/task_context.h"
#include "ostia/pacs/archive.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace ostia::pacs {

/// Objects of one series, written to files of their own in a folder. Safe from several threads.
class Intake {
 public:
  enum class Taken { yes, duplicate, refused };

  /// `patient_id`: of the study; empty: not known, then all must be of the same. `images`: how many the
  /// server says that the series has; 0: it does not say.
  Intake(std::filesystem::path folder, SeriesWanted wanted, std::string patient_id, std::size_t images,
         core::TaskContext task);

  /// Which images the server lists, and which SOP classes it says that they have (none: not known). From then
  /// on these count and not their number. Not while something comes.
  void expect(std::set<std::string> images, std::set<std::string> classes);
  bool has_list() const { return !expected_.empty(); }
  const std::set<std::string>& classes() const { return classes_; }

  /// Where the next object may be written to; hidden until it is taken.
  std::filesystem::path next_part();
  /// A part that is whole: kept under its UID, or removed. An object that is not of what was asked for is
  /// remembered as a fault of the server (`fault`). Throws IoError, ResourceError.
  Taken take(const std::filesystem::path& part);
  /// The disk is full or gone: to be told by who owns the calling thread.
  void note_disk_fault(const std::string& fault);

  /// What the server did wrong; empty: nothing. The fetch must end.
  std::string fault() const;
  std::string disk_fault() const;
  /// Throws InvalidInput or ResourceError where one of both is there.
  void throw_if_faulty() const;
  bool complete() const;                     ///< all that the server lists, or as many as it says, are there
  std::size_t announced() const;             ///< how many it lists or says
  std::vector<std::string> missing() const;  ///< of those that it lists
  std::size_t received() const;
  std::size_t duplicates() const;
  std::size_t unlisted() const;  ///< of the series, but not listed: kept
  std::vector<std::filesystem::path> files() const;

 private:
  std::string fault_of(const std::string& sop, const std::string& study, const std::string& series,
                       const std::string& patient);
  void show_progress() const;

  const std::filesystem::path folder_;
  const SeriesWanted wanted_;
  const std::size_t images_;
  const core::TaskContext task_;
  std::set<std::string> expected_, classes_;
  mutable std::mutex mutex_;
  std::string patient_id_, fault_, disk_fault_;
  bool patient_known_;
  std::map<std::string, std::filesystem::path> files_;
  std::size_t parts_ = 0, duplicates_ = 0;
};

}  // namespace ostia::pacs
