#include "opening/recent_cases.h"

#include "opening/opening.h"
#include "shell/desk.h"

#include <QMenu>
#include <utility>

namespace ostia::workstation {

void list_recent_cases(QMenu& menu, const Desk& desk, std::function<void(const QString&)> open) {
  QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu, &desk, open = std::move(open)] {
    menu.clear();
    for (const session::RecentCase& one : desk.machine.recent_cases()) {
      const QString path = QString::fromStdString(one.path.string());
      menu.addAction(path, &menu, [open, path] { open(path); });
    }
    if (menu.isEmpty()) menu.addAction(Opening::tr("none yet"))->setEnabled(false);
  });
}

}  // namespace ostia::workstation
