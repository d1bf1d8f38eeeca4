#pragma once
/// \file The left ventricle's muscle by the artery that is nearest (docs/methods/myocardial-territories.md).

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

struct TerritoryOptions {
  double density_g_ml = 1.05;  ///< of myocardium, [0.9, 1.2]
  double step_mm = 0.5;        ///< between places along the arteries, [0.1, 5]
};
void validate(const TerritoryOptions& options);  ///< throws InvalidInput

/// What is nearest to a vessel's own part: what no vessel before it in the tree has.
struct VesselTerritory {
  std::int32_t vessel = 0;
  std::string name;
  double mass_g = 0.0, share = 0.0;  ///< of all of the muscle
};

/// A place along a segment, with the muscle that is nearest to it.
struct TerritoryPlace {
  std::int32_t segment = 0;
  double along_mm = 0.0;  ///< from the segment's first point
  geometry::Vec3 place = geometry::Vec3::Zero();
  double mass_g = 0.0;
};

struct MyocardialTerritories {
  TerritoryOptions options;
  double mass_g = 0.0;
  std::vector<VesselTerritory> vessels;  ///< in the tree's order, those with nothing, too
  std::vector<TerritoryPlace> places;    ///< segment by segment, in the tree's order
  double lumen_mm3 = 0.0;                ///< of the tree, truncated cones between its points; 0 without radii
  double lumen_mm3_per_g() const { return mass_g > 0.0 ? lumen_mm3 / mass_g : 0.0; }
  /// 1 and up: a vessel's place in `vessels`; 0 outside of the muscle. On the mask's grid.
  imaging::MaskVolume labels;
};

/// Each voxel of the mask belongs to the place on the arteries that is nearest in a straight line (ties: the
/// first). The same for any number of threads. Throws InvalidInput for bad options, an empty mask, a tree
/// that is not sound or has more than 255 vessels, or arteries that are nowhere within 30 mm of the muscle
/// (another patient's, or another frame), and Cancelled.
MyocardialTerritories myocardial_territories(const geometry::VesselTree& tree,
                                             const imaging::MaskVolume& myocardium,
                                             const TerritoryOptions& options = {},
                                             const core::TaskContext& task = core::no_task());

/// The muscle that blood reaches through a place of a vessel: nearest to what lies behind it, on the vessel
/// and on all that leaves it there. Throws InvalidInput for a vessel that is not there or an abscissa that it
/// has not.
double mass_behind_g(const MyocardialTerritories& territories, const geometry::VesselTree& tree,
                     std::int32_t vessel, double s_mm);

}  // namespace ostia::analysis
