// Fills a closed surface (STL, PLY, OBJ, VTP; mm) with tetrahedra, and with layers of prisms on its wall
// where its file names the wall, inlet and outlets: layered_mesh lumen.vtp mesh.vtu
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
    ostia::geometry::MixedMesh mesh;
    if (surface.faces.size() > 1) {
      mesh = ostia::meshing::fill_with_layers(surface).mesh;
    } else {  // without an inlet and outlets the layers would have no ends
      surface.faces = {{}};
      surface.face_ids.assign(surface.mesh.triangles.size(), surface.faces.front().id);
      mesh = ostia::geometry::mixed(ostia::meshing::tetrahedralize(surface).mesh);
    }
    ostia::io::export_mesh(mesh, ostia::io::MeshFormat::vtu, argv[2]);
    std::printf("Ostia %s: %zu prisms, %zu tetrahedra\n", ostia::core::version().c_str(), mesh.prisms.size(),
                mesh.tetrahedra.size());
  } catch (const ostia::Error& error) {
    std::fprintf(stderr, "layered_mesh: %s\n", error.what());
    return static_cast<int>(error.exit_code());
  }
}
