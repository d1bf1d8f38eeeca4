#pragma once
/// \file The user's manual in a window of its own.

#include <QDialog>
#include <QString>

namespace ostia::workstation {

/// Where the manual lies: beside the installed program, in the sources that it was built from, or, its text
/// without pictures, in the program itself.
QString manual_folder();

/// Shows `docs/manual` and follows its links; needs no other program and no network.
class ManualDialog final : public QDialog {
  Q_OBJECT
 public:
  explicit ManualDialog(QWidget* parent);
};

}  // namespace ostia::workstation
