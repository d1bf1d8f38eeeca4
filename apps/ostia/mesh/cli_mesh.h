#pragma once
/// \file The options that say how a surface is meshed.

#include "commands.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

/// What --export takes.
std::vector<std::string> mesh_format_names();
/// Those of `mesh` and `model`: sizes, flow extensions, layers, order, formats.
void add_mesh(CLI::App& app, MeshOptions& o);
/// Those of `mesh` alone.
void add_mesh_command(CLI::App& app, MeshCommand& o);

}  // namespace ostia::app
