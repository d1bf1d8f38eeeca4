#pragma once
/// \file Two surfaces of one vessel: its lumen within the outside of its wall.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// Leaves out each part about another one that reaches along most of it: of two such shells the inner is the
/// lumen, the outer the outside of the wall. Returns a line for each, with its size and place.
std::vector<std::string> drop_outer_walls(std::vector<geometry::TriMesh>& parts);

/// What is within a thick wall.
struct LumenInWall {
  geometry::TriMesh lumen;                  ///< outward, open at its ends
  std::vector<meshing::GivenEnd> ends;      ///< with the names of the rings
  double width = 0.0, outside_width = 0.0;  ///< in the mean

  std::string text(double unit_mm) const;  ///< one line; `unit_mm` is that of the lengths above
};

/// The lumen of a wall that is one closed shell, as CAD programs write it: inner and outer surface joined by
/// flat rings at the ends (meshing::without_flat_rings). Nothing where the surface is no such shell. Lengths
/// are in the surface's unit.
std::optional<LumenInWall> lumen_in_wall(const geometry::FacedSurface& surface);

}  // namespace ostia::pipeline
