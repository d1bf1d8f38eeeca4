#pragma once
/// \file The commands of a comparison with a former scan.

namespace ostia::workstation {

class CommandTable;
class Comparing;
class ComparisonPage;
class Reporting;
class SceneWidget;
struct Desk;

void add_comparison_commands(CommandTable& table, Desk& desk, Comparing& comparing, ComparisonPage& page,
                             SceneWidget& scene, Reporting& reporting);

}  // namespace ostia::workstation
