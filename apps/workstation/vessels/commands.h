#pragma once
/// \file Commands that find vessels, edit them, and show their walls.

class QActionGroup;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Evaluability;
class OuterWalls;
class VesselFinder;

void add_vessel_commands(CommandTable& table, Desk& desk, VesselFinder& finder, OuterWalls& walls,
                         Evaluability& evaluability, QActionGroup& tools);

}  // namespace ostia::workstation
