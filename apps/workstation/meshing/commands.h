#pragma once
/// \file Commands about surfaces and meshes.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class MeshingExport;

void add_meshing_commands(CommandTable& table, const Desk& desk, MeshingExport& meshing);

}  // namespace ostia::workstation
