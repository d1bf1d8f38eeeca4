#pragma once
/// \file Stereolithography (3D Systems 1989), the binary form.

#include "ostia/geometry/tri_mesh.h"

#include <string>

namespace ostia::geometry {

/// 84 + 50 bytes a triangle: world LPS mm in single precision, each with the normal of its own corners, zero
/// for one without an area. The first 80 bytes say so in words.
std::string binary_stl(const TriMesh& mesh);

}  // namespace ostia::geometry
