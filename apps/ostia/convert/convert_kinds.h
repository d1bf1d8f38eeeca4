#pragma once
/// \file What `ostia convert` does with cases and volume meshes.

#include "commands.h"

namespace ostia::app {

bool converts_own_kind(const ConvertCommand& options);
/// A case's lumen as a surface (.stl, .ply), its axes as lines (.vtp, .csv) or as a tree (.swc). A volume
/// mesh as another one (.vtu, .msh, .inp, .exo, .cgns, or a folder for OpenFOAM; --format says which else),
/// or its boundary as a surface (.stl, .ply; .vtp with the faces' names).
ExitCode convert_own_kind(const ConvertCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
