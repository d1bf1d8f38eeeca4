#pragma once
/// \file What a person says of the report: impression, modifiers, words on features of plaque, a signature.

#include "ostia/session/case_report.h"
#include "ostia/session/report_notes.h"

#include <QDialog>
#include <map>
#include <memory>
#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QTreeWidget;

namespace ostia::workstation {

struct Desk;

/// Shows what the case keeps; the draft and the features come when they are found. What is changed becomes
/// steps of the case when the dialog is accepted or the report signed.
class ReportNotesDialog final : public QDialog {
  Q_OBJECT
 public:
  explicit ReportNotesDialog(Desk& desk);
  void show_findings(std::shared_ptr<const session::CaseReport> report);
  void show_failure(const QString& why);

 private:
  QWidget* modifiers_box();
  QWidget* signature_box();
  void show_notes(const session::ReportNotes& notes);
  void show_features();
  session::ReportModifiers modifiers() const;
  std::vector<session::FeatureWord> features() const;
  bool keep();  ///< false: refused, and told
  void sign();
  void accept() override;

  Desk& desk_;
  session::ReportNotes notes_;
  std::shared_ptr<const session::CaseReport> report_;
  QLabel* found_;
  QPlainTextEdit* impression_;
  QPushButton* draft_;
  QComboBox *ischaemia_, *burden_, *dominance_;
  QCheckBox *stent_, *graft_, *seen_;
  QLineEdit *exception_, *agatston_, *signer_, *changes_;
  std::vector<QComboBox*> amounts_;  // LAD, LCX, RCA
  QTreeWidget* features_;
  struct Word {
    session::FeatureWord of;
    QComboBox* said;
  };
  std::vector<Word> words_;
};

}  // namespace ostia::workstation
