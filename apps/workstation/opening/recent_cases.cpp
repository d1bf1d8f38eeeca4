#include "opening/recent_cases.h"

#include "opening/opening.h"
#include "shell/desk.h"

#include <QMenu>
#include <utility>

namespace ostia::workstation {

QString recent_case_text(const Desk& desk, const session::RecentCase& one, const QString& name) {
  const bool named = desk.identity.kept.get();
  const QString whose = named ? identity_line(desk.identity.of_image(one.image_sha256)) : QString();
  return whose.isEmpty() ? name : whose + QStringLiteral("  \u2013  ") + name;
}

void list_recent_cases(QMenu& menu, const Desk& desk, std::function<void(const QString&)> open) {
  QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu, &desk, open = std::move(open)] {
    menu.clear();
    for (const session::RecentCase& one : desk.machine.recent_cases()) {
      const QString path = QString::fromStdString(one.path.string());
      menu.addAction(recent_case_text(desk, one, path).replace('&', QStringLiteral("&&")), &menu,
                     [open, path] { open(path); });
    }
    if (menu.isEmpty()) menu.addAction(Opening::tr("none yet"))->setEnabled(false);
  });
}

}  // namespace ostia::workstation
