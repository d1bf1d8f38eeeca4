#include "png_bytes.h"

#include "ostia/core/error.h"

#include <png.h>

#include <csetjmp>
#include <new>

namespace ostia::figure {
namespace {

// A figure is paper with lines, or noise: higher levels take twice as long and save a twentieth.
constexpr int packing_level = 4;

// An exception must not pass through a library in C, whose own errors jump.
bool appended(std::string& file, png_bytep bytes, std::size_t count) {
  try {
    file.append(reinterpret_cast<const char*>(bytes), count);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void append_packed(png_structp png, png_bytep bytes, std::size_t count) {
  if (!appended(*static_cast<std::string*>(png_get_io_ptr(png)), bytes, count))
    png_error(png, "not enough memory");
}

void give_up(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

struct Pixels {
  const unsigned char* first;
  png_uint_32 width, height;
  std::ptrdiff_t stride;
};

/// False where libpng gave up. Nothing here has a destructor: its errors jump.
bool pack(png_structp png, png_infop info, const Pixels& pixels, std::string* file) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, file, append_packed, nullptr);
  png_set_compression_level(png, packing_level);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE | PNG_FILTER_SUB | PNG_FILTER_UP);
  png_set_IHDR(png, info, pixels.width, pixels.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_bgr(png);
  png_set_filler(png, 0, PNG_FILLER_AFTER);
  for (png_uint_32 y = 0; y < pixels.height; ++y)
    png_write_row(png, pixels.first + static_cast<std::ptrdiff_t>(y) * pixels.stride);
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::string png_bytes(const unsigned char* pixels, int width, int height, std::ptrdiff_t stride) {
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool whole =
      info &&
      pack(png, info, {pixels, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), stride},
           &file);
  png_destroy_write_struct(&png, &info);
  if (!whole) throw ResourceError("a picture could not be packed: not enough memory");
  return file;
}

}  // namespace ostia::figure
