#pragma once
/// \file Meshes cut open, so that their inside is seen.

#include "ostia/figure/scene.h"
#include "ostia/geometry/mixed_mesh.h"

namespace ostia::figure {

/// Keeps what lies behind a plane: points p with (p - point) . normal <= 0.
struct CutPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< any length but 0; points towards what is taken away
};

/// A part of what is seen, outward; half_of_quad as in MeshActor.
struct CutPart {
  geometry::TriMesh mesh;
  std::vector<bool> half_of_quad;
};
/// What is seen of a mesh when the elements whose centroid lies beyond the plane are taken away: whole
/// elements, so that their shape can be judged. Of quadratic elements the corners count.
struct CutMesh {
  CutPart boundary;  ///< sides on the mesh's boundary
  CutPart interior;  ///< sides of tetrahedra laid open by the cut
  CutPart layers;    ///< sides of prisms laid open by the cut
};
/// Throws InvalidInput for no elements, bad indices or a normal of zero. Everything cut away gives empty
/// parts.
CutMesh cut_open(const geometry::MixedMesh& mesh, const CutPlane& plane);
/// The parts as actors with their edges drawn; empty ones are left out.
std::vector<MeshActor> cut_actors(const geometry::MixedMesh& mesh, const CutPlane& plane,
                                  const Color& boundary = colors::lumen, const Color& interior = colors::cut,
                                  const Color& layers = colors::contour);

/// The part of a surface behind the plane; triangles across it are cut in two, exactly.
geometry::TriMesh clipped(const geometry::TriMesh& surface, const CutPlane& plane);

}  // namespace ostia::figure
