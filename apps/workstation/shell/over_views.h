#pragma once
/// \file A page in the place of the window's views.

#include <QFrame>

class QMainWindow;

namespace ostia::workstation {

/// Covers the views, which come back when it is hidden or goes. Made hidden.
class OverViews : public QFrame {
  Q_OBJECT
 public:
  explicit OverViews(QMainWindow& window);
  ~OverViews() override;

 protected:
  QMainWindow& window_;
  bool eventFilter(QObject* object, QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void place();
  void bring_views_back();
};

}  // namespace ostia::workstation
