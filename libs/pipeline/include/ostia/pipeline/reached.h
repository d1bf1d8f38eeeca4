#pragma once
/// \file Whether a lumen or its axes come to the places that were asked for.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// A place that was asked for and was not reached.
struct UnreachedPlace {
  geometry::Vec3 place;
  geometry::Vec3 reached;   ///< the nearest place that was reached
  double missing_mm = 0.0;  ///< between the two
};

/// Targets that lie more than `near_mm` outside of that part of the surface which is nearest to the source.
/// The surface is closed and not empty.
std::vector<UnreachedPlace> unreached(const geometry::TriMesh& lumen, const geometry::Vec3& source,
                                      const std::vector<geometry::Vec3>& targets, double near_mm);
/// Targets that lie farther from every vessel's end than twice its radius there and 2 mm. The tree is not
/// empty.
std::vector<UnreachedPlace> unreached(const geometry::VesselTree& axes,
                                      const std::vector<geometry::Vec3>& targets);

/// "the lumen ends at (1.0, 2.0, 3.0) mm, 160 mm before the target (1.0, 2.0, 163.0)", and what may help.
std::string text_of(const UnreachedPlace& place);
std::vector<std::string> texts_of(const std::vector<UnreachedPlace>& places);

}  // namespace ostia::pipeline
