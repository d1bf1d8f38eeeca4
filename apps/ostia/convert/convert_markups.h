#pragma once
/// \file `ostia convert` to 3D Slicer's markups.

#include "commands.h"

namespace ostia::app {

bool converts_to_markups(const ConvertCommand& options);
/// Lines, a tree or a case as one curve for each vessel (.mrk.json), or, with --landmarks and always in
/// .fcsv, as lists of the places where vessels begin, divide and end; of a case also those of its
/// measurements. Markups and tables of points as they are. Throws UsageError for options that would do
/// nothing, and what reading throws.
ExitCode convert_to_markups(const ConvertCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
