#pragma once
/// \file Vertices' single precision as vectors to compute with.

#include "ostia/geometry/tri_mesh.h"

#include <array>

namespace ostia::glview {

inline geometry::Vec3 in_double(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

}  // namespace ostia::glview
