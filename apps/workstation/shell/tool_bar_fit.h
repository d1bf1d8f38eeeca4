#pragma once
/// \file Tool bars that never hide a tool.

#include <QObject>

class QWidget;
class QToolBar;

namespace ostia::workstation {

/// Shows the bar's commands as pictures with words below where there is room for all of them beside the
/// other bar, else as pictures alone.
class ToolBarFit final : public QObject {
  Q_OBJECT
 public:
  ToolBarFit(QWidget* window, QToolBar* tools, QToolBar* others);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void fit();
  int width_with_words() const;
  QWidget* window_;
  QToolBar *tools_, *others_;
};

}  // namespace ostia::workstation
