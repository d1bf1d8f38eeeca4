#pragma once
/// \file Commands of the heart in 3D.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class HeartDock;
class HeartVolume;
class Scissors;

void add_heart_commands(CommandTable& table, Desk& desk, HeartVolume& heart, Scissors& scissors,
                        HeartDock& dock);

}  // namespace ostia::workstation
