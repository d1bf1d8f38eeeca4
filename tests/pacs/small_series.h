#pragma once
/// \file A CT series of a few small slices.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::testing {

struct SmallSeries {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  std::string study_uid, series_uid;
  std::vector<std::string> sop_uids;  ///< of `files`
  std::vector<std::string> bytes;     ///< of `files`
};
/// `seed` decides on the UIDs.
SmallSeries small_series(const std::string& seed, int slices = 5, const std::string& patient_id = "PID-1",
                         const std::string& patient_name = "DOE^JANE");

/// The file's bytes with one text put for another of the same length.
std::string replaced(std::string bytes, const std::string& from, const std::string& to);

}  // namespace ostia::testing
