#pragma once
/// \file Meshes made of arrays.

#include "array.h"

#include "ostia/geometry/tri_mesh.h"

#include <memory>

namespace ostia::python {

/// Of (n, 3) places and (m, 3) indices, kept as they are where they can be. Throws InvalidInput for arrays of
/// another kind, places that are not finite and indices of no place.
std::shared_ptr<geometry::TriMesh> mesh_of(const py::object& points, const py::object& triangles,
                                           const py::object& copy);
/// Throws InvalidInput for an index that is none of `count` places.
void require_indices(const py::array& indices, std::size_t count, const std::string& name);
/// The same for a surface, whose arrays may have been written to since it was made of them.
void require_indices(const geometry::TriMesh& surface);

}  // namespace ostia::python
