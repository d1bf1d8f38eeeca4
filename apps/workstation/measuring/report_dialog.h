#pragma once
/// \file Before a report is made: whether it says whose it is.

#include "shell/fitted_dialog.h"

#include "ostia/imaging/series_preview.h"

class QCheckBox;

namespace ostia::workstation {

/// The box is empty each time: a name gets into a document because somebody wanted it in this one.
class ReportDialog final : public FittedDialog {
  Q_OBJECT
 public:
  ReportDialog(const imaging::ShownIdentity& whose, QWidget* parent);
  bool names_patient() const;

 private:
  QCheckBox* named_;
};

}  // namespace ostia::workstation
