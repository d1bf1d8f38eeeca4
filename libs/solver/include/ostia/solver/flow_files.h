#pragma once
/// \file The files of a finished run: fields, wall, tables, pictures. See docs/reference/flow-results.md.

#include "ostia/core/task_context.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/volume_fields.h"
#include "ostia/solver/flow_report.h"

#include <filesystem>

namespace ostia::solver {

/// `velocity_m_s` and `pressure_Pa` at elements and points; of a pulsatile flow those of the last time, and
/// `mean_velocity_m_s`, `mean_pressure_Pa` over its last cycle.
io::VolumeFields volume_fields(const FlowResult& result);

/// At the points of the wall: `wall_shear_stress_Pa`, `wall_shear_stress_vector_Pa` (the blood's pull on the
/// wall), `pressure_Pa`; of a pulsatile flow those of the last time, and over its last cycle
/// `time_averaged_wall_shear_stress_Pa`, `oscillatory_shear_index`, `relative_residence_time_1_Pa`.
io::PointFields wall_fields(const FlowResult& result);

/// Writes result.vtu, wall.vtp, faces.csv, result.json, wall_shear_stress.png and speed.png into a folder
/// that is there. Throws IoError, ResourceError, Cancelled.
void write_flow_files(const FlowResult& result, const FlowReport& report, const std::filesystem::path& folder,
                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
