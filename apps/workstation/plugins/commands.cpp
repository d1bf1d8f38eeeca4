#include "plugins/commands.h"

#include "commands/table.h"
#include "plugins/plugins.h"

#include <QApplication>
#include <QMenu>
#include <QWidget>
#include <memory>

namespace ostia::workstation {
namespace {

const QString plugin_prefix = QStringLiteral("plugin.");

Command plugin_command(const session::Plugin& plugin, Plugins& plugins) {
  QString text = QString::fromStdString(plugin.title);
  return {.id = plugin_prefix + QString::fromStdString(plugin.name),
          .text = text.replace('&', QStringLiteral("&&")),
          .tip = QString::fromStdString(plugin.text),
          .run = [&plugins, name = plugin.name] { plugins.start(name); },
          .enabled = [&plugins, plugin] { return plugins.why_not(plugin).isEmpty(); },
          .why_not = [&plugins, plugin] { return plugins.why_not(plugin); }};
}

}  // namespace

void add_plugin_commands(CommandTable& table, Plugins& plugins) {
  table.add({.id = "plugins.look",
             .text = Command::tr("&Look for plug-ins again"),
             .tip = Command::tr("Reads the scripts in the folders of plug-ins, and says which are none."),
             .run = [&plugins] { plugins.look(true); }});
  table.add({.id = "plugins.folder",
             .text = Command::tr("&Open the folder of plug-ins"),
             .tip = Command::tr("Python scripts in it become commands of this menu."),
             .run = [&plugins] { plugins.open_folder(); }});
}

void list_plugins_in(QMenu& menu, CommandTable& table, Plugins& plugins) {
  menu.setToolTipsVisible(true);
  QAction* first = menu.actions().value(0);
  QAction* line = menu.insertSeparator(first);
  auto* none = new QAction(Command::tr("None yet"), &menu);
  none->setEnabled(false);
  menu.insertAction(line, none);
  QObject::connect(&menu, &QMenu::aboutToShow, &plugins, [&plugins] { plugins.look(); });
  auto listed = std::make_shared<QStringList>();
  QObject::connect(&plugins, &Plugins::changed, &menu, [&menu, &table, &plugins, line, none, listed] {
    // A list of commands that is open has rows that are about to go.
    QWidget* popup = QApplication::activePopupWidget();
    if (popup && !qobject_cast<QMenu*>(popup)) popup->close();
    for (const QString& id : *listed) table.take_away(id);
    listed->clear();
    for (const session::Plugin& one : plugins.list().plugins) {
      const Command command = plugin_command(one, plugins);
      table.add(command);
      *listed << command.id;
      menu.insertAction(line, &table.action(command.id));
    }
    none->setVisible(listed->isEmpty());
    table.dress();
  });
}

}  // namespace ostia::workstation
