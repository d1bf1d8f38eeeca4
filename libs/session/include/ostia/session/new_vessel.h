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

/// A case's first vessel: the way (path_between) as its axis, its wall found in the image on rays. Throws as
/// lumen::model_of_walls and segmentation::lumen_boundary do.
lumen::LumenModel model_of_way(const segmentation::MinimalPath& way, const std::string& name,
                               const imaging::ImageVolume& image,
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
