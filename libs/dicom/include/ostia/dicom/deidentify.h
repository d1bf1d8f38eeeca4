#pragma once
/// \file Copies of DICOM images that do not say whose they are (PS3.15 annex E).

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom_dataset.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::dicom {

struct DeidentifyOptions {
  std::string patient = "ANONYMOUS";  ///< name and number that the copies have; printable ASCII, 1 to 64
  /// What UIDs are replaced by; the same key, the same UIDs. Empty: one that is drawn at random and
  /// forgotten, so that nobody can tell which UID became which.
  std::string key;
};

/// What was done with an attribute, over all files.
struct DeidentifiedTag {
  std::uint64_t removed = 0, emptied = 0, replaced = 0;
};
struct DeidentifyReport {
  std::size_t files = 0;
  std::vector<std::string>
      left_out;  ///< files that were not copied, each with the reason; names without folder
  std::map<imaging::DicomTag, DeidentifiedTag> tags;  ///< without values
  std::uint64_t private_removed = 0;
  std::vector<std::string> warnings;
};

/// One object: what is not on the room's list of attributes that tell of image and machine alone is removed,
/// private attributes with it; what an image must have is emptied or replaced, UIDs by others. That is at
/// least what the Basic Application Level Confidentiality Profile asks for, without any of its options.
/// Throws InvalidInput for an object that is no image of CT or MR, or whose pixels are said to show texts
/// (BurnedInAnnotation YES).
imaging::DicomDataset deidentified(const imaging::DicomDataset& object, const std::string& key,
                                   const std::string& patient, DeidentifyReport& report);

/// All DICOM images below `input` (a file or folder), each copied to `output`, which appears whole or not at
/// all and must not exist or be empty: IM000001.dcm, ... in an order that follows from the new UIDs, and
/// deidentified.json (schema `deidentified`), which is also returned. Pixel data are copied as they are: a
/// face can be made of a head's images. Throws InvalidInput where there is no image at all, IoError,
/// ResourceError, Cancelled.
DeidentifyReport deidentify(const std::filesystem::path& input, const std::filesystem::path& output,
                            const DeidentifyOptions& options = {},
                            const core::TaskContext& task = core::no_task());
std::string deidentify_json(const DeidentifyReport& report);

}  // namespace ostia::dicom
