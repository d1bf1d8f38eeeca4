#pragma once
/// \file The outer walls of a model's vessels as its image shows them, and the plaque within.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/analysis/plaque.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/segmentation/outer_wall.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::session {

struct OuterWallsOptions {
  double step_mm = 0.5;  ///< between rows of rays, [0.1, 2]
  int around = 32;       ///< rays of a row, [8, 128]
  segmentation::OuterWallOptions wall;
  analysis::PlaqueOptions plaque;
  bool maps = false;  ///< what each piece of plaque is is kept, to be shown
};
void validate(const OuterWallsOptions& options);  ///< throws InvalidInput

/// One vessel's walls where it runs by itself: behind its take-off, without a radius at its free ends, where
/// the lumen closes or opens to the aorta, and within the image.
struct VesselWalls {
  std::int32_t vessel = 0;
  std::shared_ptr<const geometry::AxisCurve> axis;
  segmentation::LumenBoundary lumen;  ///< the model's, on rays about the axis; 0.05 mm where it is shut
  segmentation::OuterWall outer;
  analysis::PlaqueProfile plaque;
  std::vector<analysis::PlaqueMap> maps;  ///< of the slabs of `plaque`, where they were asked for
};

/// The model's lumen stays as it is; the image shows where the wall about it ends. Nothing for a vessel of
/// which less than 2 mm run by themselves within the image. `surface_of` is asked from the calling thread.
/// Throws InvalidInput for bad options or a vessel that is not there, and Cancelled.
std::optional<VesselWalls> vessel_walls(const lumen::LumenModel& model,
                                        const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                        const imaging::ImageVolume& image,
                                        const OuterWallsOptions& options = {},
                                        const core::TaskContext& task = core::no_task());

/// Fills in `maps` of walls that were found without them; as `OuterWallsOptions::maps` with the same options
/// for plaque. Throws InvalidInput for bad options, and Cancelled.
void add_plaque_maps(VesselWalls& walls, const lumen::LumenModel& model, const imaging::ImageVolume& image,
                     const analysis::PlaqueOptions& options = {},
                     const core::TaskContext& task = core::no_task());

/// The outer wall's line on the section at an abscissa: `points` world places from theta = 0 on, where it was
/// found; none beyond.
std::vector<geometry::Vec3> outer_wall_ring(const VesselWalls& walls, double s_mm, int points = 96);

}  // namespace ostia::session
