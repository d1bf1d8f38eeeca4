#pragma once
/// \file Bounds of the Jacobian of elements that may be straight, cheaply.

#include "ostia/meshing/quadratic.h"

namespace ostia::meshing {

/// The Jacobian of an element beside that of its straight version.
struct ElementJacobian {
  double lower = 0.0;           ///< bound of the Jacobian, mm3
  double straight_lower = 0.0;  ///< bound of the straight version's
  double volume_mm3 = 0.0, straight_volume_mm3 = 0.0;
  /// lower / straight_lower; of an element that is inverted when straight too 1 where it is no worse, else 0.
  double ratio() const;
};
ElementJacobian element_jacobian(const TetrahedronNodes& nodes);
ElementJacobian element_jacobian(const PrismNodes& nodes);
/// Whether the ratio is at least `share`: faster.
bool keeps_jacobian(const TetrahedronNodes& nodes, double share);
bool keeps_jacobian(const PrismNodes& nodes, double share);

}  // namespace ostia::meshing
