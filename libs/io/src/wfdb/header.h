#pragma once
/// \file The header of a WFDB record.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::io {

struct WfdbSignal {
  std::string file;
  int format = 16;
  int samples_per_frame = 1;
  int skew = 0;            ///< frames by which this signal lags behind
  std::size_t offset = 0;  ///< bytes before its file's first sample
  double gain = 200.0;     ///< steps a unit
  double baseline = 0.0;   ///< the sample that is 0 units
  std::string unit = "mV", name;
  std::optional<int> checksum;
};

struct WfdbHeader {
  double frames_per_second = 250.0;
  std::size_t frames = 0;  ///< 0: as many as the files have
  std::vector<WfdbSignal> signals;
};

/// Throws InvalidInput that names file and line.
WfdbHeader read_wfdb_header(const std::filesystem::path& path);

}  // namespace ostia::io
