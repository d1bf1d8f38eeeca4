#include "views/grey_presets.h"

#include "commands/table.h"
#include "shell/desk.h"
#include "shell/quantities.h"

#include "ostia/core/error.h"

#include <QInputDialog>
#include <QMenu>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::workstation {
namespace {

std::optional<double> number_of(const NamedPresets::Values& values, const char* key) {
  const auto found = values.find(key);
  if (found == values.end()) return std::nullopt;
  bool good = false;
  const double value = QString::fromStdString(found->second).toDouble(&good);
  return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string whole(double hu) {
  return QString::number(std::round(hu)).toStdString();
}

}  // namespace

GreyPresets::GreyPresets(Desk& desk)
    : QObject(&desk.window), desk_(desk), presets_(desk.machine, "window.own") {}

void GreyPresets::use(const QString& name) {
  const NamedPresets::Values values = presets_.values(name);
  const auto level = number_of(values, "level"), width = number_of(values, "width");
  if (level && width && *width >= 1.0) desk_.bench.grey.set({*level, *width});
}

void GreyPresets::save(const QString& name) {
  const QString clean = name.simplified();
  if (clean.isEmpty()) throw InvalidInput("grey levels need a name");
  const session::GreyWindow now = desk_.bench.grey.get();
  presets_.set(clean, {{"level", whole(now.level_hu)}, {"width", whole(now.width_hu)}});
}

void GreyPresets::ask_and_save() {
  bool given = false;
  const session::GreyWindow now = desk_.bench.grey.get();
  const QString name = QInputDialog::getText(
      &desk_.window, tr("Save these grey levels"),
      tr("Name of window %1, level %2:").arg(quantity::hu(now.width_hu), quantity::hu(now.level_hu)),
      QLineEdit::Normal, {}, &given);
  if (given) desk_.messages.guarded([&] { save(name); }, true);
}

void GreyPresets::ask_and_forget() {
  if (names().isEmpty()) return desk_.messages.say(tr("There are no grey levels of your own yet."));
  bool given = false;
  const QString name =
      QInputDialog::getItem(&desk_.window, tr("Forget grey levels"), tr("Which:"), names(), 0, false, &given);
  if (given) forget(name);
}

void add_grey_preset_commands(CommandTable& table, GreyPresets& presets) {
  table.add({.id = "window.save",
             .text = Command::tr("Save these grey levels\u2026"),
             .tip = Command::tr("Keeps window and level under a name, on this computer."),
             .run = [&presets] { presets.ask_and_save(); }});
  table.add({.id = "window.forget",
             .text = Command::tr("Forget grey levels\u2026"),
             .tip = Command::tr("Takes grey levels of your own away."),
             .run = [&presets] { presets.ask_and_forget(); }});
}

void list_grey_presets(QMenu& menu, GreyPresets& presets) {
  auto added = std::make_shared<std::vector<QAction*>>();
  QObject::connect(&menu, &QMenu::aboutToShow, &presets, [&menu, &presets, added] {
    for (QAction* one : *added) delete one;
    added->clear();
    if (!presets.names().isEmpty()) added->push_back(menu.addSeparator());
    for (const QString& name : presets.names())
      added->push_back(menu.addAction(QString(name).replace('&', QStringLiteral("&&")), &presets,
                                      [&presets, name] { presets.use(name); }));
  });
}

}  // namespace ostia::workstation
