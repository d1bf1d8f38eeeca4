#pragma once
/// \file Help: the tour, and the pages that help.

#include "ostia/session/machine_state.h"

#include <QObject>
#include <QPointer>

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Tour;

/// Opens the pages of help. A child of the desk's window.
class Help final : public QObject {
  Q_OBJECT
 public:
  Help(Desk& desk, const CommandTable& commands);
  /// The tour, where it is wanted and the environment has no OSTIA_NO_TOUR.
  void greet();
  /// On the first start on this machine (an empty state folder), or where the person asked for it again.
  static bool wants_tour(const session::MachineState& machine);

 public slots:
  void show_palette();
  void show_tour();
  void show_shortcuts();
  void show_manual();
  void show_about();

 private:
  Desk& desk_;
  const CommandTable& commands_;
  QPointer<Tour> tour_;
};

}  // namespace ostia::workstation
