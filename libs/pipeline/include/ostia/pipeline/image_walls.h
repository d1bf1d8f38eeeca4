#pragma once
/// \file The walls of a tree's vessels as an image shows them.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// Where a branch has left the lumen that it comes from, judged by the axes' radii; 0 for a vessel that comes
/// from none. `axes` in the order of the tree's vessels, of which `vessel` is an index.
double free_from_mm(const geometry::VesselTree& tree,
                    const std::vector<std::shared_ptr<const geometry::AxisCurve>>& axes, std::size_t vessel);

/// The wall of a boundary that was found from where the vessel runs by itself (free_from_mm) to its end, with
/// take-off and end as walls_from_image has them.
lumen::RadialWall wall_of_boundary(const segmentation::LumenBoundary& found, double free_mm, double end_mm);

/// The wall of one vessel, as below; `axes` as above. What is to be told is added to `warnings`.
lumen::RadialWall wall_from_image(const geometry::VesselTree& tree,
                                  const std::vector<std::shared_ptr<const geometry::AxisCurve>>& axes,
                                  std::size_t vessel, const imaging::ImageVolume& image,
                                  std::vector<std::string>& warnings,
                                  const core::TaskContext& task = core::no_task());

/// One wall a vessel, found on rays (segmentation::lumen_boundary) where the vessel runs by itself. At a
/// take-off the rays of a branch would meet its parent's wall: there it is a tube as wide as the branch is
/// behind it, and the passage is smooth. Over the last radius and blur before its end it keeps its calibre: a
/// blunt end seems narrow from the side. A vessel whose wall cannot be found is a tube with its axis' radii,
/// and is warned about: it does not lose the others. Warnings go to the log with the vessel's name, and to
/// `said`, a list for each vessel in the tree's order, where it is given.
std::vector<lumen::RadialWall> walls_from_image(const geometry::VesselTree& tree,
                                                const imaging::ImageVolume& image,
                                                const core::TaskContext& task,
                                                std::vector<std::vector<std::string>>* said = nullptr);

}  // namespace ostia::pipeline
