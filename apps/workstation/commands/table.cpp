#include "commands/table.h"

#include "commands/icons.h"
#include "commands/texts.h"
#include "shell/crash_watch.h"
#include "shell/desk.h"

#include <QMenu>
#include <QToolButton>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace ostia::workstation {

CommandTable::CommandTable(Desk& desk) : QObject(&desk.window), desk_(desk) {
  const auto ask = [this](const auto&...) { refresh(); };
  own_.push_back(desk.bench.case_changed.observe(ask));
  own_.push_back(desk.bench.image_changed.observe(ask));
  own_.push_back(desk.bench.steps_changed.observe(ask));
  own_.push_back(desk.bench.vessel.observe(ask));
  own_.push_back(desk.failure.observe(ask));
}

void CommandTable::add(Command command) {
  if (find(command.id)) throw std::logic_error("two commands are " + command.id.toStdString());
  if (!command.action) command.action = new QAction(&desk_.window);
  QAction* action = command.action;
  action->setText(command.text);
  action->setObjectName(command.id);
  desk_.window.addAction(action);  // its keys work while its menu is shut
  connect(action, &QAction::triggered, this, [id = command.id.toStdString()] { note_command(id); });
  if (command.run)
    connect(action, &QAction::triggered, this, [this, run = command.run] { desk_.messages.guarded(run); });
  if (command.bind) {
    action->setCheckable(true);
    command.bind(*action);
  }
  all_.push_back(std::move(command));
}

void CommandTable::take_away(const QString& id) {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Command& one) { return one.id == id; });
  if (found == all_.end()) return;
  delete found->action;
  all_.erase(found);
}

const Command* CommandTable::find(const QString& id) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Command& one) { return one.id == id; });
  return found == all_.end() ? nullptr : &*found;
}

QAction& CommandTable::action(const QString& id) const {
  const Command* found = find(id);
  if (!found) throw std::logic_error("there is no command " + id.toStdString());
  return *found->action;
}

void CommandTable::arrange(const QStringList& ids) {
  const auto place = [&](const Command& one) {
    const int at = ids.indexOf(one.id);
    return at < 0 ? ids.size() : at;
  };
  std::stable_sort(all_.begin(), all_.end(),
                   [&](const Command& a, const Command& b) { return place(a) < place(b); });
}

QString CommandTable::why_not(const Command& command) {
  return command.action->isEnabled() || !command.why_not ? QString() : command.why_not();
}

void CommandTable::refresh() {
  for (const Command& one : all_) {
    if (!one.enabled) continue;
    one.action->setEnabled(one.enabled());
    refresh_tips(one);
  }
}

void CommandTable::refresh_tips(const Command& command) const {
  const QString why = why_not(command);
  const QString tip = why.isEmpty() ? command.tip : why;
  const QString keys = command.action->shortcut().toString(QKeySequence::NativeText);
  QString shown = plain_text(command.text);
  if (!keys.isEmpty()) shown += QStringLiteral("  [%1]").arg(keys);
  if (!tip.isEmpty()) shown += '\n' + tip;
  command.action->setToolTip(shown);
  command.action->setStatusTip(tip);
}

void CommandTable::dress() {
  auto defaults = std::make_shared<std::vector<Shortcut>>();
  for (const Command& one : all_)
    defaults->push_back(
        {one.id, one.keys.pacs, one.keys.research.isEmpty() ? one.keys.pacs : one.keys.research});
  refresh();
  dress_as(ShortcutKeys::from(desk_.machine.settings(), defaults));
}

void CommandTable::dress_as(const ShortcutKeys& keys) {
  keys_ = keys;
  for (const Command& one : all_) {
    one.action->setShortcuts(keys_.keys(one.id));
    refresh_tips(one);
    if (!one.action->icon().isNull()) continue;
    one.action->setIcon(command_icon(one.id));
    one.action->setIconVisibleInMenu(false);
  }
}

void CommandTable::set_keys(const ShortcutKeys& keys) {
  const auto settings = keys.settings(keys_);
  dress_as(keys);
  desk_.messages.guarded([&] { desk_.machine.set_settings(settings); });
}

QToolButton* command_button(const CommandTable& commands, const QString& id) {
  auto* button = new QToolButton;
  button->setObjectName("button." + id);
  button->setDefaultAction(&commands.action(id));
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

QStringList menus_of(const QAction& action) {
  for (const QWidget* widget : action.associatedWidgets())
    if (const auto* menu = qobject_cast<const QMenu*>(widget); menu && !menu->title().isEmpty())
      return menus_of(*menu->menuAction()) << plain_text(menu->title());
  return {};
}

}  // namespace ostia::workstation
