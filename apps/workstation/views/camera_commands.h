#pragma once
/// \file Commands that look at the tree in 3D from a side, or as a C-arm does.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class SceneWidget;

void add_camera_commands(CommandTable& table, Desk& desk, SceneWidget& scene);

}  // namespace ostia::workstation
