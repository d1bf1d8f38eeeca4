// Fills a closed surface (STL, PLY, OBJ, VTP; mm) with layers of prisms on its wall and tetrahedra inside,
// for ParaView:
//   layered_mesh lumen.vtp mesh.vtu
#include "ostia/core/error.h"
#include "ostia/core/version.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/meshing/boundary_layer.h"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: layered_mesh SURFACE MESH.vtu\n");
    return 2;
  }
  try {
    ostia::geometry::FacedSurface surface = ostia::io::read_surface(argv[1]).surface;
    if (surface.faces.empty()) {  // a file without names: all of it is wall
      surface.faces.emplace_back();
      surface.face_ids.assign(surface.mesh.triangles.size(), surface.faces.front().id);
    }
    const auto filled = ostia::meshing::fill_with_layers(surface);
    ostia::io::export_mesh(filled.mesh, ostia::io::MeshFormat::vtu, argv[2]);
    std::printf("Ostia %s: %zu prisms, %zu tetrahedra\n", ostia::core::version().c_str(),
                filled.mesh.prisms.size(), filled.mesh.tetrahedra.size());
  } catch (const ostia::Error& error) {
    std::fprintf(stderr, "layered_mesh: %s\n", error.what());
    return static_cast<int>(error.exit_code());
  }
}
