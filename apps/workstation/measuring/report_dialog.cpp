#include "measuring/report_dialog.h"

#include "shell/identity.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace ostia::workstation {

ReportDialog::ReportDialog(const imaging::ShownIdentity& whose, QWidget* parent)
    : FittedDialog(parent), named_(new QCheckBox(tr("&Name the patient in this report"), this)) {
  setObjectName("report");
  setWindowTitle(tr("Report"));
  auto* rows = new QVBoxLayout(this);
  auto* what = new QLabel(tr("The report of the case as it is now, in a folder beside it."), this);
  what->setWordWrap(true);
  rows->addWidget(what);
  named_->setObjectName("named");
  rows->addWidget(named_);
  auto* who = new QLabel(identity_parts(whose).join('\n'), this);
  who->setTextFormat(Qt::PlainText);
  who->setWordWrap(true);
  who->setIndent(named_->sizeHint().height());
  rows->addWidget(who);
  auto* note = new QLabel(tr("The name is then in report.pdf and report.html. The tables, the pictures and "
                             "the case stay without it."),
                          this);
  note->setWordWrap(true);
  rows->addWidget(note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  QPushButton* make = buttons->addButton(tr("&Make the report"), QDialogButtonBox::AcceptRole);
  make->setDefault(true);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  rows->addWidget(buttons);
}

bool ReportDialog::names_patient() const {
  return named_->isChecked();
}

}  // namespace ostia::workstation
