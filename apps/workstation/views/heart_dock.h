#pragma once
/// \file How the CT looks in 3D, and what of it is shown: look, box, scissors.

#include <QDockWidget>
#include <array>

class QAction;
class QSlider;

namespace ostia::workstation {

class CommandTable;
class HeartVolume;

class HeartDock final : public QDockWidget {
  Q_OBJECT
 public:
  explicit HeartDock(HeartVolume& heart, QWidget* parent = nullptr);
  /// Puts the commands of scissors and heart on buttons. Once all are there.
  void add_buttons(const CommandTable& commands);

 private:
  QWidget* look_part();
  QWidget* box_part();
  void crop_changed();
  void show_crop();
  HeartVolume& heart_;
  QWidget* buttons_ = nullptr;
  std::array<QSlider*, 3> from_{}, to_{};
};

}  // namespace ostia::workstation
