#pragma once
/// \file A volume mesh for tests of the window.

#include "solver_test_support.h"
#include "tube_case.h"

#include "ostia/io/mesh_export.h"

namespace ostia::workstation::testing {

/// A tube of 6 mm along z with an inlet and an outlet, as wide as the case's.
inline geometry::MixedMesh tube_mesh(int layers = 0) {
  return solver::vessel(geometry::straight_tube(6.0, tube_radius_mm), 0.5, layers);
}

}  // namespace ostia::workstation::testing
