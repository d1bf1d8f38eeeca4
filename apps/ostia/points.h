#pragma once
/// \file Points and branches as they are typed.

#include "commands.h"

#include "ostia/imaging/volume.h"
#include "ostia/pipeline/model.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::app {

/// "x,y,z" in the frame that `coords` names: lps and ras in mm, ijk in voxels of `grid` (needed for ijk
/// alone). Throws InvalidInput that shows the text.
geometry::Vec3 parse_point(std::string_view text, const std::string& coords, const imaging::Geometry* grid);

/// "P:P" or "P:P:P".
segmentation::BranchSeeds parse_branch(std::string_view text, const std::string& coords,
                                       const imaging::Geometry* grid);

pipeline::SourceOptions source_options(const InputOptions& input);
/// Everything of a model's options that the command line can say; `grid` is the image's, or null.
void apply(const LumenOptions& from, const std::string& coords, const imaging::Geometry* grid,
           pipeline::ModelOptions& to);
void apply(const EndOptions& from, const std::string& coords, const imaging::Geometry* grid,
           pipeline::ModelOptions& to);
void apply(const MeshOptions& from, pipeline::ModelOptions& to);

}  // namespace ostia::app
