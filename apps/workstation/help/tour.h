#pragma once
/// \file A way through the window for those who see it for the first time.

#include "commands/shortcuts.h"

#include <QFrame>
#include <QPointer>
#include <vector>

class QCheckBox;
class QLabel;
class QWidget;
class QPushButton;

namespace ostia::workstation {

struct TourStep {
  QString title, text;
  QStringList
      targets;  ///< names of widgets; the first that is visible is pointed at; none: the window's middle
};
std::vector<TourStep> tour_steps(const ShortcutKeys& keys);

/// A frame around what is spoken of. Takes no mouse.
class TourRing final : public QWidget {
  Q_OBJECT
 public:
  explicit TourRing(QWidget* window);
  void point_at(const QRect& target);  ///< in the window's coordinates

 protected:
  void paintEvent(QPaintEvent* event) override;
};

/// A small panel beside each part of the window in turn. The window is not blocked meanwhile.
class Tour final : public QFrame {
  Q_OBJECT
 public:
  Tour(QWidget& window, const ShortcutKeys& keys);
  void begin();
  void go(int step);
  int step() const { return step_; }
  int count() const { return static_cast<int>(steps_.size()); }
  void end();

 signals:
  void ended(bool again);  ///< whether it is to be shown on the next start

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void build();
  void place();
  bool take_key(int key);
  QRect target() const;
  QWidget& window_;
  std::vector<TourStep> steps_;
  int step_ = 0;
  TourRing* ring_;
  QLabel *title_ = nullptr, *text_ = nullptr, *number_ = nullptr;
  QCheckBox* not_again_ = nullptr;
  QPushButton *back_ = nullptr, *next_ = nullptr;
};

}  // namespace ostia::workstation
