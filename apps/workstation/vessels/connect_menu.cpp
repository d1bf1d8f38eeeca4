#include "vessels/connect_menu.h"

#include "ostia/lumen/edit.h"

#include <QCoreApplication>
#include <QMenu>

namespace ostia::workstation {

QMenu* connect_menu(session::Workbench& bench, const Guard& guard, QWidget* parent) {
  auto* menu = new QMenu(parent);
  menu->setObjectName("connect");
  if (!qobject_cast<QMenu*>(parent)) {
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addSection(QCoreApplication::translate("ConnectMenu", "Which vessel shall begin here?"));
  }
  const geometry::VesselTree& tree = bench.model()->tree;
  bool any = false;
  for (const geometry::Vessel& other : tree.vessels) {
    if (lumen::leads_through(tree, bench.vessel.get(), other.id)) continue;
    any = true;
    menu->addAction(QString::fromStdString(other.name), menu, [&bench, guard, id = other.id] {
      guard([&] {
        const auto axis = bench.axis();
        if (!axis) return;  // gone while the menu was open
        bench.edit(lumen::BranchConnect{id, bench.vessel.get(), axis->point(bench.cursor_mm.get())});
      });
    });
  }
  menu->setEnabled(any);
  return menu;
}

}  // namespace ostia::workstation
