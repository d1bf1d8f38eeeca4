#pragma once
/// \file Meshes cut open, so that their inside is seen.

#include "ostia/figure/scene.h"
#include "ostia/geometry/tri_mesh.h"

namespace ostia::figure {

/// Keeps what lies behind a plane: points p with (p - point) . normal <= 0.
struct CutPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< any length but 0; points towards what is taken away
};

/// What is seen of a tetrahedral mesh when the tetrahedra whose centroid lies beyond the plane are taken
/// away: whole elements, so that their shape can be judged. Outward triangles.
struct CutMesh {
  geometry::TriMesh boundary;  ///< faces on the mesh's boundary
  geometry::TriMesh interior;  ///< faces laid open by the cut
};
/// Throws InvalidInput for no tetrahedra, bad indices or a normal of zero. Everything cut away gives two
/// empty surfaces.
CutMesh cut_open(const geometry::VolumeMesh& mesh, const CutPlane& plane);
/// The two parts as actors with their edges drawn; empty parts are left out.
std::vector<MeshActor> cut_actors(const geometry::VolumeMesh& mesh, const CutPlane& plane,
                                  const Color& boundary = colors::lumen, const Color& interior = colors::cut);

/// The part of a surface behind the plane; triangles across it are cut in two, exactly.
geometry::TriMesh clipped(const geometry::TriMesh& surface, const CutPlane& plane);

}  // namespace ostia::figure
