#pragma once
/// \file Where the person looks, kept with the case.

#include "ostia/session/workbench.h"

#include <QObject>
#include <QTimer>
#include <map>
#include <string>
#include <vector>

namespace ostia::workstation {

/// Vessel, cursor, angle, kind of CPR, slab and grey go into the case when the person has rested for a
/// moment, so that after a crash the program opens where it was.
class ViewMemory final : public QObject {
 public:
  explicit ViewMemory(session::Workbench& bench, QObject* parent = nullptr);
  /// Now, where something has changed. Throws as CaseFile::set_settings does; nothing without a case.
  void keep();
  /// What the open case says; what it does not say, or not well, stays as it is.
  void restore();
  /// The case says which grey it was looked at with.
  bool knows_grey() const;

 private:
  session::Workbench& bench_;
  QTimer resting_;
  std::map<std::string, std::string> kept_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
