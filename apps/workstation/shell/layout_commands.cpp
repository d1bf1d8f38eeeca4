#include "commands/table.h"
#include "shell/desk.h"
#include "shell/floating_views.h"
#include "shell/layouts.h"
#include "views/planes_dock.h"

#include <QInputDialog>
#include <QMenu>
#include <memory>
#include <vector>

namespace ostia::workstation {
namespace {

void ask_and_save(const Desk& desk, Layouts& layouts) {
  bool given = false;
  const QString name = QInputDialog::getText(&desk.window, Layouts::tr("Save this layout"),
                                             Layouts::tr("Its name:"), QLineEdit::Normal, {}, &given);
  if (given) desk.messages.guarded([&] { layouts.save(name); }, true);
}

void ask_and_forget(const Desk& desk, Layouts& layouts) {
  if (layouts.names().isEmpty()) return desk.messages.say(Layouts::tr("There is no layout of your own yet."));
  bool given = false;
  const QString name = QInputDialog::getItem(&desk.window, Layouts::tr("Forget a layout"),
                                             Layouts::tr("Which:"), layouts.names(), 0, false, &given);
  if (given) layouts.forget(name);
}

QString floating_id(QString name) {
  return QStringLiteral("view.float_") + name.remove(QStringLiteral("_panel"));
}

void begin_with_shown(const Desk& desk, Layouts& layouts) {
  const QString which = layouts.first() == layouts.shown() ? QString() : layouts.shown();
  layouts.set_first(which);
  desk.messages.say(which.isEmpty() ? Layouts::tr("The window begins as it was left.")
                                    : Layouts::tr("The window begins with this layout."));
}

}  // namespace

void add_layout_commands(CommandTable& table, Desk& desk, Layouts& layouts, PlanesDock& planes) {
  table.add({.id = "view.layout_reading",
             .text = Command::tr("All views"),
             .tip = Command::tr("The reading layout: lists, CPRs, sections, tree and profile."),
             .run = [&layouts] { layouts.show_reading(); }});
  table.add({.id = "view.layout_planes",
             .text = Command::tr("Three planes alone"),
             .tip = Command::tr("Axial, coronal and sagittal, or oblique, with one crosshair and a slab."),
             .run = [&layouts] { layouts.show_planes(); }});
  table.add({.id = "view.layout_flat",
             .text = Command::tr("2D views alone"),
             .tip = Command::tr("The tree gives its room to the other views."),
             .run = [&layouts] { layouts.show_flat(); }});
  table.add(
      {.id = "view.layout_save",
       .text = Command::tr("Save this layout\u2026"),
       .tip = Command::tr("Keeps the window as it is under a name, with what floats on another monitor."),
       .run = [&desk, &layouts] { ask_and_save(desk, layouts); }});
  table.add({.id = "view.layout_forget",
             .text = Command::tr("Forget a layout\u2026"),
             .tip = Command::tr("Takes one of your own layouts away."),
             .run = [&desk, &layouts] { ask_and_forget(desk, layouts); }});
  table.add({.id = "view.layout_first",
             .text = Command::tr("Begin with the layout shown last"),
             .tip = Command::tr("The window begins with it; again: as it was left."),
             .run = [&desk, &layouts] { begin_with_shown(desk, layouts); }});
  table.add({.id = "view.planes",
             .text = Command::tr("Three &planes"),
             .tip = Command::tr("Three linked planes beside the other views, or on another monitor."),
             .action = planes.toggleViewAction()});
}

void add_floating_commands(CommandTable& table, FloatingViews& views) {
  for (const FloatingView& one : views.all()) {
    const QString name = one.view->objectName();
    table.add({.id = floating_id(name),
               .text = Command::tr("%1 in a window of its own").arg(one.title),
               .tip = Command::tr("On another monitor, say; again, or closing it, puts it back."),
               .bind = [&views, name](QAction& action) {
                 action.setCheckable(true);
                 QObject::connect(&action, &QAction::toggled, &views,
                                  [&views, name](bool on) { views.set_floating(name, on); });
                 QObject::connect(&views, &FloatingViews::changed, &action,
                                  [&views, &action, name] { action.setChecked(views.floats(name)); });
               }});
  }
}

void list_own_layouts(QMenu& menu, Layouts& layouts) {
  auto added = std::make_shared<std::vector<QAction*>>();
  QObject::connect(&menu, &QMenu::aboutToShow, &layouts, [&menu, &layouts, added] {
    for (QAction* one : *added) delete one;
    added->clear();
    const QStringList names = layouts.names();
    if (!names.isEmpty()) added->push_back(menu.addSeparator());
    for (const QString& name : names)
      added->push_back(menu.addAction(QString(name).replace('&', QStringLiteral("&&")), &layouts,
                                      [&layouts, name] { layouts.show_own(name); }));
  });
}

}  // namespace ostia::workstation
