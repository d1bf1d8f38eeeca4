#pragma once
/// \file Grey levels that a person keeps under names of their own, on this machine.

#include "shell/named_presets.h"

#include "ostia/session/workbench.h"

#include <QObject>

class QMenu;

namespace ostia::workstation {

class CommandTable;
struct Desk;

class GreyPresets final : public QObject {
  Q_OBJECT
 public:
  explicit GreyPresets(Desk& desk);
  QStringList names() const { return presets_.names(); }
  void use(const QString& name);  ///< nothing where there is none, or it makes no window
  /// The grey levels as they are now. Throws InvalidInput for a name without letters.
  void save(const QString& name);
  void forget(const QString& name) { presets_.remove(name); }
  void ask_and_save();
  void ask_and_forget();

 private:
  Desk& desk_;
  NamedPresets presets_;
};

void add_grey_preset_commands(CommandTable& table, GreyPresets& presets);
/// Adds them whenever the menu is about to be shown.
void list_grey_presets(QMenu& menu, GreyPresets& presets);

}  // namespace ostia::workstation
