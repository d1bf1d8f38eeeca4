#pragma once
/// \file A card over views that have nothing to show.

#include <QFrame>

class QLabel;
class QVBoxLayout;

namespace ostia::workstation {

/// Stands over the views in `over`, a part of the window, while it is wanted and they are there. As wide as
/// its texts need, in a narrow window over the views beside.
class Card : public QFrame {
  Q_OBJECT
 public:
  Card(QWidget& window, QWidget& over);

 protected:
  static constexpr int widest = 380;  ///< units of the interface
  QVBoxLayout& rows() { return *rows_; }
  QLabel* add_line(const QString& text);   ///< wraps
  QLabel* add_title(const QString& text);  ///< large
  void want(bool wanted);                  ///< after its texts have changed, too
  bool eventFilter(QObject* object, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void show_or_hide();
  void place();
  QWidget& window_;
  QWidget* over_;
  bool wanted_ = false;
  QVBoxLayout* rows_;
};

}  // namespace ostia::workstation
