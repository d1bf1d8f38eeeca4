// The commands of the page that shows a vessel tree.

#include "shell/main_window.h"
#include "trees/opening.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>

namespace ostia::workstation {

void MainWindow::build_tree_menu(QMenu* tools) {
  trees_ = std::make_unique<TreeOpening>(*this);
  QMenu* menu = tools->addMenu(tr("Vessel t&ree"));
  const auto add = [&](const char* id, const QString& text, const QString& tip,
                       const std::function<void(TreePage&)>& act) {
    QAction* made = action(id, text, [this, act] { trees_->with_page(act); });
    made->setProperty("tip", tip);
    menu->addAction(made);
    return made;
  };
  auto* group = new QActionGroup(this);
  const auto tool = [&](const char* id, const QString& text, const QString& tip, TreeTool chosen) {
    QAction* made = add(id, text, tip, [chosen](TreePage& page) { page.choose(chosen); });
    made->setCheckable(true);
    made->setChecked(chosen == TreeTool::select);
    group->addAction(made);
  };
  tool("tree.select", tr("Choose a segment"), tr("A click on a segment shows its facts."), TreeTool::select);
  tool("tree.straight", tr("Straight distance"), tr("Click two places on the vessels' walls."),
       TreeTool::straight);
  tool("tree.along", tr("Distance along the tree"),
       tr("Click two places; the way is along the vessels' axes."), TreeTool::along);
  tool("tree.angle", tr("Angle of two segments"), tr("Click two segments; between their distal directions."),
       TreeTool::angle);
  tool("tree.region", tr("Region"), tr("Click the centre of a ball; what lies in it is added up."),
       TreeTool::region);
  menu->addSeparator();
  const auto toggle = [&](const char* id, const QString& text, const QString& tip,
                          void (TreePage::*act)(bool)) {
    QAction* made = action(id, text, {});
    made->setProperty("tip", tip);
    made->setCheckable(true);
    menu->addAction(made);
    connect(made, &QAction::triggered, this, [this, made, act](bool on) {
      if (!trees_->page()) made->setChecked(false);
      guarded([&] { trees_->with_page([act, on](TreePage& page) { (page.*act)(on); }); });
    });
  };
  toggle("tree.grid", tr("Coordinate grid"), tr("Lines at round coordinates."), &TreePage::show_grid);
  toggle("tree.subtree", tr("Subtree only"), tr("Shows the chosen segment and all behind it alone."),
         &TreePage::show_subtree);
  menu->addSeparator();
  add("tree.fit", tr("All of the tree"), tr("Shows all of the vessel tree."),
      [](TreePage& page) { page.fit(); });
  add("tree.copy", tr("Copy the values"), tr("Puts what was measured on the clipboard, as a table."),
      [](TreePage& page) { page.copy(); });
  add("tree.export", tr("Save the values\u2026"), tr("Writes what was measured as a table (CSV)."),
      [](TreePage& page) { page.export_csv(); });
  add("tree.clear", tr("Forget the values"), tr("Takes all that was measured in the tree away."),
      [](TreePage& page) { page.clear(); });
  QAction* close_it = action("tree.close", tr("Close the tree"), [this] { trees_->close(); });
  close_it->setProperty("tip", tr("Closes the vessel tree; the case's views come back."));
  menu->addAction(close_it);
}

}  // namespace ostia::workstation
