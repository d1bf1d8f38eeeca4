#include "ostia/geometry/mixed_mesh.h"

namespace ostia::geometry {

MixedMesh mixed(const VolumeMesh& mesh) {
  MixedMesh out;
  out.points = mesh.points;
  out.tetrahedra = mesh.tetrahedra;
  out.triangles = mesh.boundary;
  out.triangle_face_ids = mesh.boundary_face_ids;
  out.faces = mesh.faces;
  return out;
}

}  // namespace ostia::geometry
