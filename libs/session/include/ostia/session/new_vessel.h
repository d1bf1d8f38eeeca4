#pragma once
/// \file Vessels from ways that were found in the image.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/edit.h"
#include "ostia/segmentation/minimal_path.h"

#include <optional>
#include <string>

namespace ostia::session {

/// A name that no vessel has: "V1", "V2", ... `model` may be null.
std::string unused_name(const lumen::LumenModel* model);

/// The edit that joins a way (path_to_tree) to the tree as a new vessel. Throws InvalidInput for a way
/// without a junction.
lumen::BranchAdd branch_of(const segmentation::MinimalPath& way, const std::string& name);

/// A way (path_to_tree) that came to the distal end of a vessel within its lumen's radius there, and that
/// goes on, not back along it: the edit that lengthens that vessel. Nothing for all others: they are
/// branches.
std::optional<lumen::AxisExtend> extension_of(const segmentation::MinimalPath& way,
                                              const lumen::LumenModel& model);

/// The edit that makes a vessel of its own of a way (path_between): another ostium, a graft. Throws
/// InvalidInput for a way of fewer than three points.
lumen::VesselAdd artery_of(const segmentation::MinimalPath& way, const std::string& name);

/// The same edit (BranchAdd, VesselAdd) with the wall that the image shows about the new vessel, as the
/// search gives it, and with its name by the rules where they are sure of it and no vessel has it yet; others
/// as they are. Throws as lumen::apply and Cancelled; a wall that is not found is a tube.
lumen::Edit with_wall_and_name(const lumen::Edit& edit, const lumen::LumenModel& model,
                               const imaging::ImageVolume& image,
                               const core::TaskContext& task = core::no_task());

/// How far a way runs through something wider than a coronary artery (an aorta, a chamber): 10 mm and more
/// about its direction is as bright as its lumen. Its first `spared_mm` are not asked: an ostium lies at one.
double wide_stretch_mm(const segmentation::MinimalPath& way, const imaging::ImageVolume& image,
                       double spared_mm = 0.0);
/// Throws GeometryError where that is more than 8 mm, with what to do; the warning where it is more than 2.
std::optional<std::string> require_artery(const segmentation::MinimalPath& way,
                                          const imaging::ImageVolume& image, double spared_mm = 0.0);

/// A case's first vessel: the way (path_between) as its axis, its wall found in the image on rays. Throws as
/// lumen::model_of_walls and segmentation::lumen_boundary do.
lumen::LumenModel model_of_way(const segmentation::MinimalPath& way, const std::string& name,
                               const imaging::ImageVolume& image,
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
