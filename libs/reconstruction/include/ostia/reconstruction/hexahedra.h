#pragma once
/// \file Structured meshes of hexahedra inside of a reconstructed surface ([Luboz] 2.2 keeps quadrilaterals
/// for them). See docs/methods/hexahedra.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/hex_mesh.h"
#include "ostia/reconstruction/surface.h"

#include <cstddef>

namespace ostia::reconstruction {

struct HexahedraOptions {
  double shell = 0.35;  ///< thickness of the layers along the wall, in distances from wall to axis; in (0, 1)
  int layers = 0;       ///< in the shell, in [1, 32]; 0: 2^(level - 1)
  double growth = 1.0;  ///< from layer to layer, away from the wall; in [1, 2]
  /// Nodes within are moved where a scaled Jacobian is below this; in [0, 1).
  double wanted_jacobian = 0.3;
  int relaxations = 30;  ///< rounds of that, at most; in [0, 1000]
};
void validate(const HexahedraOptions& options);  ///< throws InvalidInput

struct SweptHexahedra {
  geometry::HexMesh mesh;  ///< faces as the surface's: wall, inlet_<n>, outlet_<n>
  double volume_mm3 = 0.0;
  double least_jacobian = 0.0, mean_jacobian = 0.0;  ///< scaled
  std::size_t folded = 0;                            ///< hexahedra whose scaled Jacobian is not positive
};

/// Each branch is swept from its first to its last ring: layers of quadrilaterals along the wall, and within
/// them one quadrilateral, divided, between the axis and each side of the section. At a fork the sections of
/// two branches share the sector between their arc and the joint's centre, so that neighbours meet face to
/// face. The wall's points are the surface's own. Throws InvalidInput for options and a surface of level 0,
/// whose sections have no middle between two corners; Cancelled.
SweptHexahedra sweep_hexahedra(const ReconstructedSurface& surface, const HexahedraOptions& options = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::reconstruction
