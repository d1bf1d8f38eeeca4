#pragma once
/// \file What the program is, and what it is not.

#include <QDialog>

namespace ostia::workstation {

class AboutDialog final : public QDialog {
  Q_OBJECT
 public:
  explicit AboutDialog(QWidget* parent);
};

}  // namespace ostia::workstation
