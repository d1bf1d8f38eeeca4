#pragma once
/// \file Texts of a DICOM file's header, by the bounded parser.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace ostia::imaging {

/// Texts of the data set itself by their tags (group << 16 | element), as bytes without padding; for what is
/// checked or shown and never kept.
using DicomTexts = std::map<std::uint32_t, std::string>;
/// Fills the texts whose tags `wanted` holds; those that the file lacks, or has beyond a damage, stay as they
/// are. False when it is not DICOM. Throws IoError.
bool read_dicom_texts(const std::filesystem::path& path, DicomTexts& wanted);

}  // namespace ostia::imaging
