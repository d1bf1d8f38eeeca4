#pragma once
/// \file Pictures as PNG files.

#include <cstddef>
#include <string>

namespace ostia::figure {

/// Opaque pixels, each a 32-bit word 0x..RRGGBB, its lowest byte first, `stride` bytes a row, as a PNG file
/// of 8-bit RGB. The same pixels give the same bytes. Throws ResourceError where it cannot be packed.
std::string png_bytes(const unsigned char* pixels, int width, int height, std::ptrdiff_t stride);

}  // namespace ostia::figure
