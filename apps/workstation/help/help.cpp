#include "help/help.h"

#include "commands/icons.h"
#include "commands/keyboard.h"
#include "commands/shortcuts_page.h"
#include "commands/texts.h"
#include "help/about_dialog.h"
#include "help/manual_dialog.h"
#include "help/tour.h"
#include "shell/preferences_dialog.h"

#include <QMenu>
#include <QMenuBar>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr const char* tour_setting = "tour";

/// A dialog of which there is one at a time; it comes to the front where it is open.
template <class Dialog, class... Args>
void show_one(MainWindow& window, Args&&... args) {
  auto* dialog = window.findChild<Dialog*>();
  if (!dialog) {
    dialog = new Dialog(std::forward<Args>(args)..., &window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
  }
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace

Help::Help(MainWindow& window, const Menus& menus)
    : QObject(&window),
      window_(window),
      keyboard_(new Keyboard(&window)),
      keys_(ShortcutKeys::from(window.machine().settings())) {
  menus.edit->addSeparator();
  add(menus.edit, "edit.preferences", tr("&Preferences\u2026"), [this] { show_preferences(); });
  add_mouse(menus.tools);
  add_views(menus.views);
  add_panels(menus.views);
  window.menuBar()->setObjectName("menus");
  QMenu* help = window.menuBar()->addMenu(tr("&Help"));
  add(help, "help.manual", tr("&Manual"), [this] { show_manual(); });
  add(help, "help.shortcuts", tr("&Keys and mouse"), [this] { show_shortcuts(); });
  add(help, "help.tour", tr("&Tour"), [this] { show_tour(); });
  help->addSeparator();
  add(help, "help.about", tr("&About Ostia"), [this] { show_about(); });
  dress_commands();
}

QAction* Help::add(QMenu* menu, const QString& id, const QString& text, const std::function<void()>& run) {
  auto* made = new QAction(text, &window_);
  made->setObjectName(id);
  connect(made, &QAction::triggered, this, [this, run] { window_.guarded(run); });
  window_.addAction(made);
  menu->addAction(made);
  return made;
}

void Help::add_mouse(QMenu* tools) {
  tools->addSeparator();
  add(tools, "tool.smaller", tr("Smaller ball, shorter reach"), [this] { change_size(-1.0); });
  add(tools, "tool.larger", tr("Larger ball, longer reach"), [this] { change_size(1.0); });
  QMenu* mouse = tools->addMenu(tr("Mouse by keys"));
  add(mouse, "mouse.left", tr("Pointer to the left"), [this] { keyboard_->move_mouse(-1, 0); });
  add(mouse, "mouse.right", tr("Pointer to the right"), [this] { keyboard_->move_mouse(1, 0); });
  add(mouse, "mouse.up", tr("Pointer up"), [this] { keyboard_->move_mouse(0, -1); });
  add(mouse, "mouse.down", tr("Pointer down"), [this] { keyboard_->move_mouse(0, 1); });
  add(mouse, "mouse.press", tr("Press or let go"), [this] { keyboard_->press_or_release(); });
}

void Help::add_views(QMenu* views) {
  session::Workbench& bench = window_.bench();
  QMenu* go = views->addMenu(tr("Go to"));
  add(go, "view.root", tr("Beginning of the vessel"), [&bench] { bench.cursor_mm.set(0.0); });
  add(go, "view.end", tr("End of the vessel"), [&bench] {
    if (const auto axis = bench.axis()) bench.cursor_mm.set(axis->length());
  });
  add(go, "view.next_lesion", tr("Next stenosis"), [this] { to_lesion(1); });
  add(go, "view.previous_lesion", tr("Previous stenosis"), [this] { to_lesion(-1); });
  add(views, "view.thinner", tr("Thinner slab"),
      [&bench] { bench.slab_mm.set(bench.slab_mm.get() - bench.slab_mm.range()->step); });
  add(views, "view.thicker", tr("Thicker slab"),
      [&bench] { bench.slab_mm.set(bench.slab_mm.get() + bench.slab_mm.range()->step); });
}

void Help::add_panels(QMenu* views) {
  QMenu* panels = views->addMenu(tr("Panels"));
  add(panels, "panel.next", tr("Next panel"), [this] { keyboard_->go_by(1); });
  add(panels, "panel.previous", tr("Previous panel"), [this] { keyboard_->go_by(-1); });
  add(panels, "panel.alone", tr("This panel alone"), [this] { keyboard_->maximise_focused(); });
  panels->addSeparator();
  for (const auto& [name, text] : {std::pair("vessels", tr("Vessels")),
                                   {"cpr1", tr("CPR")},
                                   {"cpr2", tr("CPR + 90\u00b0")},
                                   {"section", tr("Cross-section")},
                                   {"slice", tr("Slice")},
                                   {"tree", tr("Coronary tree")},
                                   {"profile", tr("Lumen profile")},
                                   {"measurements", tr("Measurements")},
                                   {"steps", tr("Steps")}})
    add(panels, QStringLiteral("panel.%1").arg(name), text,
        [this, station = QString(name)] { keyboard_->go_to(station); });
}

std::vector<QAction*> Help::commands() const {
  std::vector<QAction*> found;
  for (QAction* action : window_.findChildren<QAction*>())
    if (action->objectName().contains('.')) found.push_back(action);
  return found;
}

void Help::dress_commands() {
  for (QAction* action : commands()) {
    const QString id = action->objectName();
    action->setShortcuts(keys_.keys(id));
    window_.addAction(action);  // its keys work while its menu is shut
    if (!action->property("tip").isValid()) action->setProperty("tip", command_tip(id));
    const QString tip = action->property("tip").toString();
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    QString shown = plain_text(action->text());
    if (!keys.isEmpty()) shown += QStringLiteral("  [%1]").arg(keys);
    if (!tip.isEmpty()) shown += '\n' + tip;
    action->setToolTip(shown);
    action->setStatusTip(tip);
    if (action->icon().isNull()) {
      action->setIcon(command_icon(id));
      action->setIconVisibleInMenu(false);
    }
  }
}

void Help::set_keys(const ShortcutKeys& keys) {
  const auto settings = keys.settings(keys_);
  keys_ = keys;
  dress_commands();
  window_.guarded([&] { window_.machine().set_settings(settings); });
}

void Help::change_size(double steps) {
  session::Workbench& bench = window_.bench();
  auto& property = bench.tool.get() == session::Tool::brush ? bench.brush_mm : bench.reach_mm;
  property.set(property.get() + steps * property.range()->step);
}

void Help::to_lesion(int direction) {
  session::Workbench& bench = window_.bench();
  constexpr double same_mm = 0.05;
  const double here = bench.own_mm(bench.cursor_mm.get());
  std::optional<double> best;
  for (const analysis::Stenosis& one : bench.stenoses(bench.vessel.get())) {
    const double ahead = direction * (one.throat_mm - here);
    if (ahead > same_mm && (!best || ahead < direction * (*best - here))) best = one.throat_mm;
  }
  if (best)
    bench.cursor_mm.set(bench.here_mm(*best));
  else
    window_.say(tr("No other stenosis in this direction."));
}

bool Help::wants_tour(const session::MachineState& machine) {
  const std::map<std::string, std::string> settings = machine.settings();
  const auto wish = settings.find(tour_setting);
  return wish != settings.end() ? wish->second == "again"
                                : settings.empty() && machine.recent_cases().empty();
}

void Help::greet() {
  if (wants_tour(window_.machine()) && qEnvironmentVariableIsEmpty("OSTIA_NO_TOUR")) show_tour();
}

void Help::show_tour() {
  delete tour_;  // keys may be others by now
  tour_ = new Tour(window_, keys_);
  connect(tour_, &Tour::ended, this, [this](bool again) {
    window_.guarded([&] { window_.machine().set_setting(tour_setting, again ? "again" : "seen"); });
  });
  tour_->begin();
}
void Help::show_shortcuts() {
  show_one<ShortcutsPage>(window_, *this);
}
void Help::show_manual() {
  show_one<ManualDialog>(window_);
}
void Help::show_about() {
  show_one<AboutDialog>(window_);
}
void Help::show_preferences() {
  show_one<PreferencesDialog>(window_, window_, *this);
}

}  // namespace ostia::workstation
