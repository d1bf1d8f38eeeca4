#pragma once
/// \file What a person keeps on this machine under names of their own: layouts, grey levels.

#include "ostia/session/machine_state.h"

#include <QString>
#include <QStringList>
#include <map>
#include <string>

namespace ostia::workstation {

/// Under one key of MachineState. What cannot be read is as if there were none.
class NamedPresets {
 public:
  using Values = std::map<std::string, std::string>;
  NamedPresets(session::MachineState& machine, std::string key) : machine_(machine), key_(std::move(key)) {}
  QStringList names() const;                            ///< by the alphabet
  Values values(const QString& name) const;             ///< empty where there is none of the name
  void set(const QString& name, const Values& values);  ///< in the place of one of the same name
  void remove(const QString& name);

 private:
  session::MachineState& machine_;
  std::string key_;
};

}  // namespace ostia::workstation
