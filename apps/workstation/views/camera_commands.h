#pragma once
/// \file Commands that look at the tree in 3D from a side, or as a C-arm does.

#include "ostia/session/workbench.h"

namespace ostia::workstation {

class CommandTable;
class SceneWidget;

void add_camera_commands(CommandTable& table, const session::Workbench& bench, SceneWidget& scene);

}  // namespace ostia::workstation
