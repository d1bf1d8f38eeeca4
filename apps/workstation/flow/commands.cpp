#include "flow/commands.h"

#include "commands/table.h"
#include "flow/cases.h"
#include "flow/results.h"
#include "shell/desk.h"

namespace ostia::workstation {

void add_flow_commands(CommandTable& table, const Desk& desk, FlowCases& cases, FlowResults& results) {
  table.add({.id = "file.flow_case",
             .text = Command::tr("A &flow case\u2026"),
             .tip = Command::tr("Writes a case of blood flow in a mesh for a solver, and runs it."),
             .keys = {"Ctrl+Shift+M"},
             .run = [&desk, &cases] { cases.ask(desk.case_path); }});
  table.add({.id = "file.flow_results",
             .text = Command::tr("Open flow res&ults\u2026"),
             .tip = Command::tr("Colours the wall in 3D by a solver's result, such as its shear stress."),
             .keys = {"Ctrl+Shift+R"},
             .run = [&results] { results.ask(); }});
}

}  // namespace ostia::workstation
