#pragma once
/// \file What is asked before a plug-in runs: its parameters, and once for each script whether it may.

#include "shell/fitted_dialog.h"
#include "shell/form_fields.h"

#include "ostia/session/plugin_job.h"

#include <QString>
#include <functional>
#include <optional>
#include <vector>

class QFormLayout;
class QPushButton;
class QVBoxLayout;

namespace ostia::workstation {

/// A vessel to choose from.
struct NamedVessel {
  QString name;
  std::int32_t id = 0;
  bool selected = false;
};

/// A row for each parameter, by its type; what is wrong stands under its field, and the button waits.
class PluginDialog final : public FittedDialog {
  Q_OBJECT
 public:
  /// `is_new`: the script has not run in this state yet.
  PluginDialog(const session::Plugin& plugin, bool is_new, const std::vector<NamedVessel>& vessels,
               QWidget* parent);
  session::PluginValues values() const;  ///< once it was accepted

 private:
  struct Row {
    session::PluginParameter parameter;
    FormField field;
    std::function<std::string()> typed;
  };
  void add_question(const session::Plugin& plugin, QVBoxLayout& layout);
  void add_row(QFormLayout* form, const session::PluginParameter& parameter,
               const std::vector<NamedVessel>& vessels);
  void check();
  std::vector<Row> rows_;
  QPushButton* go_ = nullptr;
};

}  // namespace ostia::workstation
