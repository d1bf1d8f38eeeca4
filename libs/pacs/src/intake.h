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

  /// `expected`: SOP instance UIDs that the server lists. `patient_id`: of the study; empty: not known, then
  /// all must be of the same.
  /// `classes`: SOP classes that they are said to have; empty: not known.
  Intake(std::filesystem::path folder, SeriesWanted wanted, std::set<std::string> expected,
         std::string patient_id, std::set<std::string> classes, core::TaskContext task);

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
  std::vector<std::string> missing() const;  ///< of the expected
  std::size_t received() const;
  std::size_t duplicates() const;
  std::size_t unlisted() const;  ///< of the series, but not expected: kept
  std::vector<std::filesystem::path> files() const;

 private:
  std::string fault_of(const std::string& sop, const std::string& study, const std::string& series,
                       const std::string& patient);
  void show_progress() const;

  const std::filesystem::path folder_;
  const SeriesWanted wanted_;
  const std::set<std::string> expected_, classes_;
  const core::TaskContext task_;
  mutable std::mutex mutex_;
  std::string patient_id_, fault_, disk_fault_;
  bool patient_known_;
  std::map<std::string, std::filesystem::path> files_;
  std::size_t parts_ = 0, duplicates_ = 0, unlisted_ = 0;
};

}  // namespace ostia::pacs
