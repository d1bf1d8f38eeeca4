#pragma once
/// \file A border loop and the triangles beside it made even, so that something can be joined on.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::meshing {

struct EvenSeam {
  geometry::TriMesh mesh;
  std::vector<std::int32_t> loop;    ///< along the border half-edges, as the one given
  std::vector<std::int32_t> number;  ///< of each former point; -1: it is gone
};

/// Smallest angle of the triangles that have a point in `loop`, degrees.
double seam_angle_deg(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop);

/// Remeshes a band of five edges beside a border loop to even edges; points of the loop stay on its polyline,
/// all others on the surface, and beyond the band nothing changes. Nothing where the seam is even already, or
/// where the band cannot be cut out as a manifold.
std::optional<EvenSeam> even_seam(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop);

/// Opens the smallest angles of triangles in a band on both sides of a closed chain of edges by flips,
/// collapses and small moves on the surface; the band's borders, and all beyond, stay. Nothing where that
/// does not help. `loop` of the result are those of the chain's points that are left.
std::optional<EvenSeam> mended_seam(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& loop);

}  // namespace ostia::meshing
