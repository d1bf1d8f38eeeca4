#pragma once
/// \file The fat about the main arteries in the window: measured in the background, drawn on the CPRs, told
/// in a page.

#include "ostia/session/fat_board.h"
#include "ostia/view/fat_layer.h"

#include <QDockWidget>
#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

class QLabel;
class QTreeWidget;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class PictureWidget;

/// While it is shown, measured (job "fat") whenever it is not known: after an edit, for another case. Never
/// waited for. Goes before the views that it draws on.
class Fat final : public QObject {
  Q_OBJECT
 public:
  Fat(Desk& desk, const std::vector<PictureWidget*>& pictures);
  session::FatBoard& board() { return board_; }
  /// Nothing will be measured before the next edit; what is measured now is a job.
  bool idle() const { return !soon_.isActive(); }
  const QString& problem() const { return problem_; }  ///< why nothing was measured

 signals:
  void problem_changed();

 private:
  void look_soon();
  void look();
  Desk& desk_;
  session::FatBoard board_;
  std::vector<std::unique_ptr<view::FatLayer>> layers_;
  QTimer soon_;
  QString problem_;
  std::vector<session::Subscription> own_;
};

/// Index, stretch and volume of each artery. Open, the map is on the CPRs; put away, nothing is measured.
class FatPage final : public QDockWidget {
  Q_OBJECT
 public:
  FatPage(Desk& desk, Fat& fat);

 private:
  QWidget* legend();
  void fill();
  Desk& desk_;
  Fat& fat_;
  QTreeWidget* vessels_ = nullptr;
  QLabel* state_ = nullptr;
  std::vector<session::Subscription> own_;
};

void add_fat_commands(CommandTable& table, FatPage& page);

}  // namespace ostia::workstation
