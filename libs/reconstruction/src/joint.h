#pragma once
/// \file Where vessels meet: two poles and one arc of points between each two neighbours round the axis.

#include "field.h"

#include "ostia/reconstruction/surface.h"

#include <array>
#include <optional>
#include <vector>

namespace ostia::reconstruction {

struct Joint {
  Vec3 centre = Vec3::Zero();
  std::vector<Slot> slots;  ///< counter-clockwise about the axis
  std::optional<JointField> field;
  std::array<Vec3, 2> poles{Vec3::Zero(), Vec3::Zero()};
  /// arcs[i] runs from the first pole to the second, between slots i and i + 1: sides / 2 - 1 points.
  std::vector<std::vector<Vec3>> arcs;
  std::vector<double> clearance;  ///< how far along each slot's direction its ring reaches, mm
};

/// Slots of each point of the graph where branches end that are not open; in the order of the points.
std::vector<Joint> joints_of(const std::vector<Tube>& tubes, const geometry::VesselGraph& graph,
                             const ReconstructionOptions& options);

}  // namespace ostia::reconstruction
