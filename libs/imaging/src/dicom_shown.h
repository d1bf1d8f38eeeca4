#pragma once
/// \file What a window shows of whom and when, read for that alone.

#include "ostia/imaging/series_preview.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::imaging {

/// Bytes of a DICOM text in UTF-8: ASCII, Latin-1 (ISO_IR 100) and UTF-8 (ISO_IR 192) are known, anything
/// else becomes '?'. No control characters; at most 256 bytes are looked at.
std::string shown_text(std::string_view bytes, std::string_view character_set);
/// "Doe, Jane" of "Doe^Jane^^^=..." (PS3.5 6.2.1).
std::string shown_name(std::string_view bytes, std::string_view character_set);
/// "2024-03-01" of "20240301" (and of the old "2024.03.01"); empty for anything else.
std::string shown_date(std::string_view text);

/// From one file's header; what it lacks is empty.
ShownIdentity shown_identity(const std::filesystem::path& dicom_file);

}  // namespace ostia::imaging
