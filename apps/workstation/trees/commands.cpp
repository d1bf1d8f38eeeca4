#include "trees/commands.h"

#include "commands/table.h"
#include "trees/opening.h"

#include <QActionGroup>
#include <utility>

namespace ostia::workstation {
namespace {

using OnPage = std::function<void(TreePage&)>;

Command on_page(Command command, TreeOpening& trees, OnPage act) {
  command.run = [&trees, act = std::move(act)] { trees.with_page(act); };
  return command;
}

/// Of these one is chosen.
Command tree_tool(Command command, TreeOpening& trees, TreeTool tool, QActionGroup& group) {
  command.bind = [&group, tool](QAction& action) {
    action.setChecked(tool == TreeTool::select);
    group.addAction(&action);
  };
  return on_page(std::move(command), trees, [tool](TreePage& page) { page.choose(tool); });
}

/// A mark that goes with the page.
Command tree_switch(Command command, const CommandTable& table, TreeOpening& trees,
                    void (TreePage::*show)(bool)) {
  command.bind = [](QAction&) {};
  command.run = [&table, &trees, show, id = command.id] {
    const bool on = table.action(id).isChecked();
    if (!trees.page()) table.action(id).setChecked(false);
    trees.with_page([show, on](TreePage& page) { (page.*show)(on); });
  };
  return command;
}

}  // namespace

void add_tree_commands(CommandTable& table, TreeOpening& trees) {
  auto& tools = *new QActionGroup(&table);
  table.add(tree_tool(
      {
          .id = "tree.select",
          .text = Command::tr("Choose a segment"),
          .tip = Command::tr("A click on a segment shows its facts."),
          .keys = {"Ctrl+Alt+1"},
      },
      trees, TreeTool::select, tools));
  table.add(tree_tool(
      {
          .id = "tree.straight",
          .text = Command::tr("Straight distance"),
          .tip = Command::tr("Click two places on the vessels' walls."),
          .keys = {"Ctrl+Alt+2"},
      },
      trees, TreeTool::straight, tools));
  table.add(tree_tool(
      {
          .id = "tree.along",
          .text = Command::tr("Distance along the tree"),
          .tip = Command::tr("Click two places; the way is along the vessels' axes."),
          .keys = {"Ctrl+Alt+3"},
      },
      trees, TreeTool::along, tools));
  table.add(tree_tool(
      {
          .id = "tree.angle",
          .text = Command::tr("Angle of two segments"),
          .tip = Command::tr("Click two segments; between their distal directions."),
          .keys = {"Ctrl+Alt+4"},
      },
      trees, TreeTool::angle, tools));
  table.add(tree_tool(
      {
          .id = "tree.region",
          .text = Command::tr("Region"),
          .tip = Command::tr("Click the centre of a ball; what lies in it is added up."),
          .keys = {"Ctrl+Alt+5"},
      },
      trees, TreeTool::region, tools));
  table.add(tree_switch(
      {
          .id = "tree.grid",
          .text = Command::tr("Coordinate grid"),
          .tip = Command::tr("Lines at round coordinates."),
          .keys = {"Ctrl+Alt+6"},
      },
      table, trees, &TreePage::show_grid));
  table.add(tree_switch(
      {
          .id = "tree.subtree",
          .text = Command::tr("Subtree only"),
          .tip = Command::tr("Shows the chosen segment and all behind it alone."),
          .keys = {"Ctrl+Alt+7"},
      },
      table, trees, &TreePage::show_subtree));
  table.add(on_page(
      {
          .id = "tree.fit",
          .text = Command::tr("All of the tree"),
          .tip = Command::tr("Shows all of the vessel tree."),
          .keys = {"Ctrl+Alt+0"},
      },
      trees, [](TreePage& page) { page.fit(); }));
  table.add(on_page(
      {
          .id = "tree.copy",
          .text = Command::tr("Copy the values"),
          .tip = Command::tr("Puts what was measured on the clipboard, as a table."),
          .keys = {"Ctrl+Alt+C"},
      },
      trees, [](TreePage& page) { page.copy(); }));
  table.add(on_page(
      {
          .id = "tree.export",
          .text = Command::tr("Save the values\u2026"),
          .tip = Command::tr("Writes what was measured as a table (CSV)."),
          .keys = {"Ctrl+Alt+E"},
      },
      trees, [](TreePage& page) { page.export_csv(); }));
  table.add(on_page(
      {
          .id = "tree.clear",
          .text = Command::tr("Forget the values"),
          .tip = Command::tr("Takes all that was measured in the tree away."),
          .keys = {"Ctrl+Alt+X"},
      },
      trees, [](TreePage& page) { page.clear(); }));
  table.add({.id = "tree.close",
             .text = Command::tr("Close the tree"),
             .tip = Command::tr("Closes the vessel tree; the case's views come back."),
             .keys = {"Ctrl+Alt+W"},
             .run = [&trees] { trees.close(); }});
}

}  // namespace ostia::workstation
