#pragma once
/// \file What a softcopy presentation state says of the grey window.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::dicom {

struct PresentedWindow {
  double centre = 0.0, width = 0.0;    ///< of the image's values, HU for CT
  std::string explanation;             ///< may be empty; as it stands in the file
  std::vector<std::string> instances;  ///< SOP instances that it is for; empty: all that the state refers to
};

/// Linear windows of a grey-scale, colour or pseudo-colour presentation state (PS3.3 C.11.8); tables are
/// passed over. Throws InvalidInput naming the file where it is no presentation state, has no window, or a
/// width that is not at least 1; IoError.
std::vector<PresentedWindow> read_presented_windows(const std::filesystem::path& path);

}  // namespace ostia::dicom
