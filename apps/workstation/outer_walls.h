#pragma once
/// \file The outer wall in the window: found in the background, drawn on the pictures, told in words.

#include "ostia/session/outer_wall_board.h"
#include "ostia/view/outer_wall_layer.h"

#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

namespace ostia::workstation {

class MainWindow;
class PictureWidget;

/// "Plaque 45 mm³ (low attenuation 2, ...), burden 41 %; ..." of a vessel.
QString plaque_text(const session::VesselWalls& walls);

/// While it is switched on, the selected vessel's outer wall is looked for whenever it is not known: after an
/// edit, for another vessel, for another case. Never waited for. Goes before the views that it draws on.
class OuterWalls final : public QObject {
  Q_OBJECT
 public:
  OuterWalls(MainWindow& window, const std::vector<PictureWidget*>& pictures);
  session::OuterWallBoard& board() { return board_; }

 private:
  void look();
  void tell();
  MainWindow& window_;
  session::OuterWallBoard board_;
  std::vector<std::unique_ptr<view::OuterWallLayer>> layers_;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
