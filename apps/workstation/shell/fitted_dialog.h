#pragma once
/// \file A dialog that is as high as its texts need.

#include <QDialog>

namespace ostia::workstation {

/// Grows with texts that wrap or appear; as wide as a person makes it, within its parent at first.
class FittedDialog : public QDialog {
  Q_OBJECT
 public:
  explicit FittedDialog(QWidget* parent);

 protected:
  void fit();  ///< after a text has changed
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
};

}  // namespace ostia::workstation
