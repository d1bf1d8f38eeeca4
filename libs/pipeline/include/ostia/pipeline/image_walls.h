#pragma once
/// \file The walls of a tree's vessels as an image shows them.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/start_surface.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// One wall a vessel, found on rays (segmentation::lumen_boundary) where the vessel runs by itself. At a
/// take-off the rays of a branch would meet its parent's wall: there it is a tube of the axis' radii, and the
/// passage is smooth. Warnings go to the log with the vessel's name, and to `said`, a list for each vessel in
/// the tree's order, where it is given.
std::vector<lumen::RadialWall> walls_from_image(const geometry::VesselTree& tree,
                                                const imaging::ImageVolume& image,
                                                const core::TaskContext& task,
                                                std::vector<std::vector<std::string>>* said = nullptr);

}  // namespace ostia::pipeline
