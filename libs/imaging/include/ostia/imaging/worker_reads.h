#pragma once
/// \file What the worker has to read for a task, known before a foreign library sees any of it.

#include <filesystem>
#include <vector>

namespace ostia::imaging {

/// The files of decode_dicom_files's list. Throws IoError, InvalidInput.
std::vector<std::filesystem::path> reads_of_decoding(const std::filesystem::path& list_file);
/// An image that read_foreign_image_in_worker is given, with the other half of one in two files (Analyze).
std::vector<std::filesystem::path> reads_of_foreign_image(const std::filesystem::path& in);

}  // namespace ostia::imaging
