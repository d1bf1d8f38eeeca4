#pragma once
/// \file Volume meshes read from files. World LPS, mm. They are written by mesh_export.h.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// Whether `path` is named as a volume mesh is that read_volume_mesh knows.
bool is_volume_mesh(const std::filesystem::path& path);
/// The formats that can be read, for messages.
std::string readable_volume_meshes();

/// Reads what export_mesh writes as VTU, Gmsh 2.2 and 4.1, OpenFOAM (the case's folder; its faces get ids
/// from 1 in the patches' order), Exodus II, Abaqus, Fluent, CGNS and XDMF, and any such file (Gmsh's,
/// Fluent's and OpenFOAM's in ASCII) of tetrahedra with 4 or 10 nodes, prisms with 6 or 18, triangles and
/// quadrilaterals; in VTU, OpenFOAM and Fluent also hexahedra with 8, each as two prisms
/// (geometry::add_as_prisms). Without ids of faces the boundary is all wall; without boundary cells it is the
/// elements' free sides. Throws InvalidInput: no sound file, cells of other types (by name), linear and
/// quadratic elements together, no elements.
geometry::MixedMesh read_volume_mesh(const std::filesystem::path& path);

struct LayeredMesh {
  geometry::MixedMesh mesh;
  std::vector<bool> in_layers;  ///< each tetrahedron: whether it was a layer's prism; empty: not told
  std::size_t hexahedra = 0;    ///< of the file, each now two prisms
};
/// The same with what the file says of layers: VTU's and XDMF's cell array `layer`; a volume group of Gmsh, a
/// block of Exodus II, an element set of Abaqus, a section of CGNS or a cell zone of OpenFOAM whose name ends
/// with `_layers`.
LayeredMesh read_layered_mesh(const std::filesystem::path& path);

}  // namespace ostia::io
