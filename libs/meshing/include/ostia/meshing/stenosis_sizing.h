#pragma once
/// \file The narrow places of a tree by its radii alone, where a mesh wants shorter edges ([Antiga] 7). The
/// measurement of a stenosis is ostia/analysis/stenosis.h.

#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/sizing.h"

#include <cstdint>
#include <vector>

namespace ostia::meshing {

struct ThroatOptions {
  double least_narrowing = 0.3;   ///< share of the diameter, to count, [0.05, 0.95]
  double window_diameters = 6.0;  ///< how far on either side the healthy vessel is looked for, [1, 50]
};
void validate(const ThroatOptions& options);

struct Throat {
  std::int32_t vessel = 0;                        ///< id
  geometry::Vec3 place = geometry::Vec3::Zero();  ///< on the axis, mm
  double radius_mm = 0.0;
  /// 1 - radius over the smaller of the two largest radii within the window on either side: what tapers, or
  /// begins at a thicker vessel, is no throat.
  double narrowing = 0.0;
  double length_mm = 0.0;  ///< along the axis, narrowed by half of that and more
};

/// Each once, vessel after vessel, from proximal to distal; of throats within each other's length the
/// narrowest alone. Throws InvalidInput (options; a radius that is negative or not finite).
std::vector<Throat> find_throats(const geometry::VesselTree& tree, const ThroatOptions& options = {});

/// Edges of `share` of their length at each throat, reaching over its length and `beyond_diameters` of the
/// healthy diameter. Throws InvalidInput for a share outside [0.05, 1] or diameters outside [0, 20].
std::vector<SizeFocus> size_foci(const std::vector<Throat>& throats, double share,
                                 double beyond_diameters = 1.0);

/// The sizing with foci at the throats of the axes, where throat_share asks for them. Radii are the axes'
/// distances from `wall`, whatever the tree says of them.
SizingOptions at_throats(SizingOptions sizing, const geometry::VesselTree& axes,
                         const geometry::TriMesh& wall);

}  // namespace ostia::meshing
