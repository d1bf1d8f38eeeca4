#pragma once
/// \file What was computed along the axes, on the wall of the lumen.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ostia::session {

struct PressureReport;

/// Of a point of the wall: what its section has on the axis. Where `occluded` is 1 nothing flows, and the
/// ratios and pressures mean nothing.
struct WallPressures {
  std::vector<double> ffr, resting_ratio, pressure_mmhg, wall_shear_pa, s_mm;
  std::vector<std::int32_t> vessel, branch, occluded;
};
struct PressureWall {
  geometry::TriMesh wall;
  WallPressures at_points;
};

/// A point belongs to the vessel whose own part of the axis is nearest, measured by its radius there. Of the
/// wall shear it has the mean about its section's rim (from friction: below 0 the wall is rubbed backwards).
WallPressures pressures_on(const PressureReport& report, std::span<const geometry::Vec3> points,
                           const core::TaskContext& task = core::no_task());

/// Of a case's whole wall, with cells of 0.15 mm or more. Throws as lumen::surface_of does.
PressureWall pressure_wall(const PressureReport& report, const lumen::LumenModel& model,
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
