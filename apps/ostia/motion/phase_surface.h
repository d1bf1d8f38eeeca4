#pragma once
/// \file The surface at one phase, from whatever holds it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/pipeline/motion_fit.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::app {

struct PhaseFile;

/// How a mask gets its surface: blurred and cut at its own level (segmentation::segment_mask), or by Poisson
/// reconstruction through that surface's vertices (meshing::poisson_surface), as [Yi] 5.1 has it.
enum class MaskSurface { isosurface, poisson };

/// Of a mask or an image, by its name.
bool is_image_name(const std::string& name);

/// A surface; a mask's, a case's. Empty where there are no triangles, voxels or vessels. `units` is "", "m",
/// "cm" or "mm". Throws InvalidInput that names the file for an image that is no mask.
geometry::TriMesh phase_surface(const std::filesystem::path& file, const std::string& units,
                                MaskSurface how = MaskSurface::isosurface,
                                const core::TaskContext& task = core::no_task());
/// Reads them all. As phase_surface.
std::vector<pipeline::PhaseSurface> read_phases(const std::vector<PhaseFile>& files, const std::string& units,
                                                MaskSurface how, const core::TaskContext& task);

/// How many mm the unit of length is: "m", "cm", "mm"; "" is mm.
double unit_mm(const std::string& units);

}  // namespace ostia::app
