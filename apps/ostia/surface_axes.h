#pragma once
/// \file Centerlines of a surface that a command is given.

#include "commands.h"

#include "ostia/centerline/extract_centerlines.h"

namespace ostia::app {

/// Reads the surface and takes its centerlines between the ends; warnings go to the log. Throws InvalidInput
/// for what is no surface, and what pipeline::load and centerline::extract_centerlines throw.
centerline::CenterlineResult axes_of_surface(const InputOptions& input, const EndOptions& ends,
                                             const core::TaskContext& task);

}  // namespace ostia::app
