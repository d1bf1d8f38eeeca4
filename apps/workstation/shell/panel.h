#pragma once
/// \file A view with a title that can fill the window.

#include <QFrame>
#include <QLabel>

class QToolButton;

namespace ostia::workstation {

/// A double click on the title, or its button, asks for the whole window and back.
class Panel final : public QFrame {
  Q_OBJECT
 public:
  Panel(const QString& title, QWidget* content, QWidget* parent = nullptr);
  void set_title(const QString& title);
  /// Something beside the title: a combo box, a button.
  void add_control(QWidget* control);
  QWidget* content() const { return content_; }

 signals:
  void maximise_wanted();
  void own_window_wanted();  ///< or, where it has one, its old place

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  QWidget* bar_;
  QLabel* title_;
  QWidget* content_;
};

/// A part of a splitter that keeps the place of a view which is elsewhere.
QWidget* make_gap();
/// False for a gap, and for a splitter of nothing else.
bool has_views(const QWidget& part);

/// Shows one panel alone among all below `root`, or all again where `alone` is null. Gaps stay hidden.
void show_alone(QWidget* root, Panel* alone);

/// Brings a view to the front where it is on a page behind others; alone where there is no room for it else.
void reveal(QWidget& widget);

}  // namespace ostia::workstation
