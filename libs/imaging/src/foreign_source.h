#pragma once
/// \file Images that ITK reads in the worker, as the other formats' parsers have them. Private to the room.

#include "image_source.h"

namespace ostia::imaging {

/// As foreign_image_format, of the file's first bytes, unpacked.
std::string foreign_format_of(const std::filesystem::path& path, const std::string& head);

/// Lets the worker read it. Throws InvalidInput with its words, ResourceError where it ran out of memory or
/// time.
ImageSource read_foreign_source(const std::filesystem::path& path, const std::string& format);

}  // namespace ostia::imaging
