#pragma once
/// \file From a pixel type known at run time to one known to the compiler. Private to the room.

#include "ostia/imaging/image_file.h"

#include <cstdint>
#include <type_traits>
#include <utility>

namespace ostia::imaging {

/// Calls `f` with a zero of the C++ type.
template <class F>
void with_pixel_type(PixelType type, const F& f) {
  switch (type) {
    case PixelType::int8:
      return f(std::int8_t{});
    case PixelType::uint8:
      return f(std::uint8_t{});
    case PixelType::int16:
      return f(std::int16_t{});
    case PixelType::uint16:
      return f(std::uint16_t{});
    case PixelType::int32:
      return f(std::int32_t{});
    case PixelType::uint32:
      return f(std::uint32_t{});
    case PixelType::int64:
      return f(std::int64_t{});
    case PixelType::uint64:
      return f(std::uint64_t{});
    case PixelType::float32:
      return f(float{});
    case PixelType::float64:
      return f(double{});
  }
}

}  // namespace ostia::imaging
