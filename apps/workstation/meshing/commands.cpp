#include "meshing/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "meshing/dock.h"
#include "meshing/export.h"
#include "shell/desk.h"

namespace ostia::workstation {

void add_meshing_commands(CommandTable& table, const Desk& desk, MeshingExport& meshing) {
  table.add(needs_case({.id = "file.export_surface",
                        .text = Command::tr("The &wall\u2026"),
                        .tip = Command::tr("Makes a surface of the wall (VTP, STL, PLY) in the background."),
                        .keys = {"Ctrl+E"},
                        .run = [&desk, &meshing] { meshing.ask(ExportKind::surface, desk.case_path); }},
                       desk));
  table.add(
      needs_case({.id = "file.export_mesh",
                  .text = Command::tr("A &mesh\u2026"),
                  .tip = Command::tr("Fills the lumen with tetrahedra for a solver, in the background."),
                  .keys = {"Ctrl+M"},
                  .run = [&desk, &meshing] { meshing.ask(ExportKind::mesh, desk.case_path); }},
                 desk));
  table.add({.id = "file.open_mesh",
             .text = Command::tr("Open a &mesh\u2026"),
             .tip = Command::tr("Shows a mesh made earlier, here or elsewhere, and how good it is."),
             .keys = {"Ctrl+Alt+M"},
             .run = [&meshing] { meshing.ask_for_mesh(); }});
  table.add({.id = "view.mesh",
             .text = Command::tr("The &mesh"),
             .tip = Command::tr("Shows and hides the mesh that was made or opened last."),
             .action = meshing.dock().toggleViewAction()});
}

}  // namespace ostia::workstation
