#include "shell/docks.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QVariant>

namespace ostia::workstation {
namespace {

// Another one where an old arrangement would be no good any more.
constexpr int docks_version = 1;
constexpr const char* opened = "opened";  // of a dock: it has been open once

}  // namespace

std::map<std::string, std::string> dock_settings(const QMainWindow& window) {
  QStringList names;
  for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
    if (dock->property(opened).toBool()) names << dock->objectName();
  return {{"docks", window.saveState(docks_version).toBase64().toStdString()},
          {"docks.opened", names.join(' ').toStdString()}};
}

void restore_docks(QMainWindow& window, const std::optional<std::string>& docks,
                   const std::optional<std::string>& opened_ones) {
  if (!docks ||
      !window.restoreState(QByteArray::fromBase64(QByteArray::fromStdString(*docks)), docks_version))
    return;
  const QStringList names = QString::fromStdString(opened_ones.value_or("")).split(' ', Qt::SkipEmptyParts);
  for (const QString& name : names)
    if (auto* dock = window.findChild<QDockWidget*>(name)) dock->setProperty(opened, true);
}

void size_at_first(QMainWindow& window, QDockWidget& dock, int size, Qt::Orientation orientation) {
  if (dock.property(opened).toBool()) return;
  dock.setProperty(opened, true);
  window.resizeDocks({&dock}, {size}, orientation);
}

}  // namespace ostia::workstation
