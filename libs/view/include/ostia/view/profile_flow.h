#pragma once
/// \file A solver's result on the wall, along the vessels (docs/methods/flow-along-vessel.md).

#include "ostia/analysis/ostial_way.h"
#include "ostia/analysis/wall_flow.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/view/surface_field_scene.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace ostia::view {

/// One number for each point or triangle of a surface, NaN where not known; none: not computed.
struct WallValues {
  std::span<const double> values;
  FieldAt at = FieldAt::points;
};

/// Of each vessel's own stretch, from where it begins to its end.
using FlowStations = std::map<std::int32_t, std::vector<analysis::FlowStation>>;

/// Each place of the surface belongs to the vessel whose wall it is (WallOwner), at the foot on its axis. A
/// place farther from there than half of the radius and 1 mm is of no vessel: a flow extension, or another
/// heart. Throws InvalidInput for another number of values than the surface has, and as WallOwner does.
/// Cancelled.
FlowStations flow_along_vessels(const lumen::LumenModel& model, const geometry::TriMesh& wall,
                                const WallValues& shear_pa, const WallValues& pressure_pa,
                                const core::TaskContext& task = core::no_task());

/// What the profile shows beside the lumen's size. Immutable.
struct ProfileFlow {
  FlowStations stations;
  std::string shear_title, pressure_title;  ///< with their units, as the legend has them; empty: not shown
};

/// The stations of a vessel's way, where `way` has its stretches; one that knows nothing lies between two
/// vessels that do not meet.
std::vector<analysis::FlowStation> stations_along(const FlowStations& stations,
                                                  const std::vector<analysis::WayStretch>& way);

}  // namespace ostia::view
