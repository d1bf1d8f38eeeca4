#pragma once
/// \file Centerlines of a surface that a command is given.

#include "commands.h"

#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/reached.h"

#include <vector>

namespace ostia::app {

struct SurfaceAxes {
  pipeline::LumenAxes axes;
  std::vector<pipeline::UnreachedPlace> unreached;  ///< targets, told in the log already
};

/// Reads the surface and takes its centerlines between the ends; warnings go to the log. Throws InvalidInput
/// for what is no surface, and what pipeline::load and pipeline::lumen_axes throw.
SurfaceAxes axes_of_surface(const InputOptions& input, const EndOptions& ends, const core::TaskContext& task);

}  // namespace ostia::app
