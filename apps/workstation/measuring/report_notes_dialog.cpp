#include "measuring/report_notes_dialog.h"

#include "shell/desk.h"
#include "shell/hanging.h"

#include "ostia/core/quantity_text.h"
#include "ostia/session/report_digest.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QDoubleValidator>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {
namespace {

using analysis::Dominance;
using analysis::Ischaemia;
using analysis::PlaqueAmount;
using analysis::PlaqueBurden;
using analysis::PlaqueFeature;
using session::LesionState;

template <class Value>
QComboBox* choice_box(const char* name, const QString& title,
                      const std::vector<std::pair<QString, Value>>& items, QWidget* parent) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QString::fromLatin1(name));
  box->setAccessibleName(title);
  for (const auto& [text, value] : items) box->addItem(text, static_cast<int>(value));
  return box;
}

void choose_in(QComboBox& box, int value) {
  box.setCurrentIndex(std::max(0, box.findData(value)));
}

template <class Value>
Value chosen_in(const QComboBox& box) {
  return static_cast<Value>(box.currentData().toInt());
}

QLineEdit* note_line(const char* name, const QString& title, QWidget* parent) {
  auto* edit = new QLineEdit(parent);
  edit->setObjectName(QString::fromLatin1(name));
  edit->setAccessibleName(title);
  return edit;
}

constexpr int no_burden = -1;  // the report chooses

}  // namespace

ReportNotesDialog::ReportNotesDialog(Desk& desk) : QDialog(&desk.window), desk_(desk) {
  setObjectName("report_notes");
  setWindowTitle(tr("What the report says"));
  resize_within(*this, QSize(760, 700));
  auto* rows = new QVBoxLayout(this);
  found_ = new QLabel(tr("The findings are being measured\u2026"), this);
  found_->setObjectName("report_found");
  found_->setWordWrap(true);
  rows->addWidget(found_);
  impression_ = new QPlainTextEdit(this);
  impression_->setObjectName("impression");
  impression_->setAccessibleName(tr("Impression"));
  impression_->setPlaceholderText(tr("Impression; left empty, the report has a draft of the findings"));
  impression_->setTabChangesFocus(true);
  impression_->setMinimumHeight(60);
  rows->addWidget(impression_, 2);
  draft_ = new QPushButton(tr("Add the &draft"), this);
  draft_->setObjectName("draft");
  draft_->setToolTip(tr("Puts the draft of the findings, as they are now, behind what is written."));
  draft_->setAutoDefault(false);
  draft_->setEnabled(false);
  connect(draft_, &QPushButton::clicked, this, [this] {
    const QString text = QString::fromStdString(session::drafted_impression(*report_));
    const QString written = impression_->toPlainText();
    impression_->setPlainText(written.trimmed().isEmpty() ? text : written + '\n' + text);
  });
  auto* below = new QHBoxLayout;
  below->addStretch(1);
  below->addWidget(draft_);
  rows->addLayout(below);
  rows->addWidget(modifiers_box());
  features_ = new QTreeWidget(this);
  features_->setObjectName("features");
  features_->setAccessibleName(tr("Features of high-risk plaque"));
  features_->setHeaderLabels({tr("Lesion"), tr("Feature"), tr("Measured"), tr("Confidence"), tr("Is there")});
  features_->setRootIsDecorated(false);
  features_->setMinimumHeight(60);
  features_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  rows->addWidget(features_, 2);
  rows->addWidget(signature_box());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, &ReportNotesDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  rows->addWidget(buttons);
  show_notes(desk_.bench.session().file().annotations()->report);
}

QWidget* ReportNotesDialog::modifiers_box() {
  auto* box = new QWidget(this);
  auto* columns = new QHBoxLayout(box);
  columns->setContentsMargins(0, 0, 0, 0);
  auto* left = new QFormLayout;
  auto* right = new QFormLayout;
  columns->addLayout(left, 1);
  columns->addLayout(right, 1);
  ischaemia_ = choice_box<Ischaemia>("ischaemia", tr("Ischaemia (I)"),
                                     {{tr("not tested"), Ischaemia::not_tested},
                                      {tr("negative"), Ischaemia::negative},
                                      {tr("borderline"), Ischaemia::borderline},
                                      {tr("positive"), Ischaemia::positive}},
                                     box);
  left->addRow(tr("Ischaemia (I)"), ischaemia_);
  stent_ = new QCheckBox(tr("Stent (S)"), box);
  stent_->setObjectName("stent");
  graft_ = new QCheckBox(tr("Graft (G)"), box);
  graft_->setObjectName("graft");
  auto* both = new QHBoxLayout;
  both->addWidget(stent_);
  both->addWidget(graft_);
  both->addStretch(1);
  left->addRow(QString(), both);
  exception_ = note_line("exception", tr("Exceptions (E)"), box);
  exception_->setToolTip(tr("What is no atherosclerosis: dissection, anomalous origin, aneurysm"));
  left->addRow(tr("Exceptions (E)"), exception_);
  dominance_ = choice_box<Dominance>("dominance", tr("Dominance"),
                                     {{tr("as the tree has it"), Dominance::unknown},
                                      {tr("right"), Dominance::right},
                                      {tr("left"), Dominance::left},
                                      {tr("co-dominant"), Dominance::codominant}},
                                     box);
  left->addRow(tr("Dominance"), dominance_);
  agatston_ = note_line("agatston", tr("Calcium score (Agatston)"), box);
  auto* number = new QDoubleValidator(0.0, 20000.0, 1, agatston_);
  number->setNotation(QDoubleValidator::StandardNotation);
  number->setLocale(QLocale::c());
  agatston_->setValidator(number);
  right->addRow(tr("Calcium score (Agatston)"), agatston_);
  seen_ = new QCheckBox(tr("Plaque by sight"), box);
  seen_->setObjectName("seen");
  auto* amounts = new QHBoxLayout;
  for (const char* artery : {"LAD", "LCX", "RCA"}) {
    auto* one = choice_box<PlaqueAmount>(artery, QString::fromLatin1(artery),
                                         {{tr("none"), PlaqueAmount::none},
                                          {tr("mild"), PlaqueAmount::mild},
                                          {tr("moderate"), PlaqueAmount::moderate},
                                          {tr("severe"), PlaqueAmount::severe}},
                                         box);
    one->setToolTip(QString::fromLatin1(artery));
    connect(seen_, &QCheckBox::toggled, one, &QWidget::setEnabled);
    amounts_.push_back(one);
    amounts->addWidget(one);
  }
  right->addRow(seen_, amounts);
  burden_ = new QComboBox(box);
  burden_->setObjectName("burden");
  burden_->setAccessibleName(tr("Plaque burden stated"));
  burden_->addItem(tr("as the report chooses"), no_burden);
  burden_->addItem(tr("no plaque"), static_cast<int>(PlaqueBurden::none));
  for (const PlaqueBurden one : {PlaqueBurden::p1, PlaqueBurden::p2, PlaqueBurden::p3, PlaqueBurden::p4})
    burden_->addItem(QString::fromStdString(analysis::to_string(one)), static_cast<int>(one));
  right->addRow(tr("Plaque burden stated"), burden_);
  return box;
}

QWidget* ReportNotesDialog::signature_box() {
  auto* box = new QWidget(this);
  auto* line = new QHBoxLayout(box);
  line->setContentsMargins(0, 0, 0, 0);
  signer_ = note_line("signer", tr("Signed by"), box);
  signer_->setPlaceholderText(tr("Signed by"));
  signer_->setText(QString::fromStdString(desk_.machine.setting(author_setting).value_or("")));
  changes_ = note_line("changes", tr("What changed"), box);
  changes_->setPlaceholderText(tr("What changed"));
  auto* sign_now = new QPushButton(tr("&Sign this version"), box);
  sign_now->setObjectName("sign");
  sign_now->setAutoDefault(false);
  connect(sign_now, &QPushButton::clicked, this, &ReportNotesDialog::sign);
  line->addWidget(signer_, 1);
  line->addWidget(changes_, 2);
  line->addWidget(sign_now);
  return box;
}

void ReportNotesDialog::show_notes(const session::ReportNotes& notes) {
  notes_ = notes;
  const session::ReportModifiers& said = notes.modifiers;
  impression_->setPlainText(QString::fromStdString(notes.impression));
  choose_in(*ischaemia_, static_cast<int>(said.ischaemia));
  stent_->setChecked(said.stent);
  graft_->setChecked(said.graft);
  exception_->setText(QString::fromStdString(said.exception));
  choose_in(*dominance_, static_cast<int>(said.dominance));
  agatston_->setText(said.agatston ? QString::number(*said.agatston, 'g', 8) : QString());
  seen_->setChecked(said.seen.has_value());
  const session::SeenPlaque seen = said.seen.value_or(session::SeenPlaque{});
  const PlaqueAmount amounts[] = {seen.lad, seen.lcx, seen.rca};
  for (std::size_t i = 0; i < amounts_.size(); ++i) {
    choose_in(*amounts_[i], static_cast<int>(amounts[i]));
    amounts_[i]->setEnabled(said.seen.has_value());
  }
  choose_in(*burden_, said.burden ? static_cast<int>(*said.burden) : no_burden);
}

void ReportNotesDialog::show_findings(std::shared_ptr<const session::CaseReport> report) {
  report_ = std::move(report);
  found_->setText(tr("As the case is now: CAD-RADS %1")
                      .arg(QString::fromStdString(analysis::to_string(report_->statement))));
  draft_->setEnabled(true);
  show_features();
}

void ReportNotesDialog::show_failure(const QString& why) {
  found_->setText(tr("The findings could not be measured: %1").arg(why));
}

/// Those that were found, and those that a person has spoken of.
void ReportNotesDialog::show_features() {
  const auto name = [](PlaqueFeature feature) {
    switch (feature) {
      case PlaqueFeature::low_attenuation:
        return tr("low attenuation");
      case PlaqueFeature::positive_remodelling:
        return tr("positive remodelling");
      case PlaqueFeature::spotty_calcium:
        return tr("spotty calcium");
      case PlaqueFeature::napkin_ring:
        break;
    }
    return tr("napkin ring");
  };
  const auto confidence = [](analysis::FeatureConfidence one) {
    return one == analysis::FeatureConfidence::high       ? tr("high")
           : one == analysis::FeatureConfidence::moderate ? tr("moderate")
                                                          : tr("low");
  };
  features_->clear();
  words_.clear();
  for (const session::ReportStenosis& lesion : report_->stenoses)
    for (const session::ReportFeature& one : lesion.features) {
      const analysis::PlaqueFeatureFinding& finding = one.finding;
      auto* item = new QTreeWidgetItem(
          features_, {QString("S%1, %2").arg(lesion.number).arg(QString::fromStdString(lesion.segment)),
                      name(finding.feature),
                      !finding.known         ? tr("not known")
                      : !(finding.value > 0) ? tr("none")
                                             : QString::fromStdString(session::feature_text(finding)),
                      finding.known ? confidence(finding.confidence) : QString()});
      auto* said =
          choice_box<LesionState>("feature_word", tr("Is there"),
                                  {{finding.present ? tr("found") : tr("not found"), LesionState::open},
                                   {tr("yes"), LesionState::accepted},
                                   {tr("no"), LesionState::rejected}},
                                  features_);
      choose_in(*said, static_cast<int>(one.state));
      features_->setItemWidget(item, 4, said);
      words_.push_back({{lesion.stenosis.vessel, lesion.stenosis.from_mm, lesion.stenosis.to_mm,
                         finding.feature, one.state},
                        said});
    }
}

session::ReportModifiers ReportNotesDialog::modifiers() const {
  session::ReportModifiers said;
  said.ischaemia = chosen_in<Ischaemia>(*ischaemia_);
  said.stent = stent_->isChecked();
  said.graft = graft_->isChecked();
  said.exception = exception_->text().trimmed().toStdString();
  said.dominance = chosen_in<Dominance>(*dominance_);
  if (const QString text = agatston_->text().trimmed(); !text.isEmpty()) said.agatston = text.toDouble();
  if (seen_->isChecked())
    said.seen =
        session::SeenPlaque{chosen_in<PlaqueAmount>(*amounts_[0]), chosen_in<PlaqueAmount>(*amounts_[1]),
                            chosen_in<PlaqueAmount>(*amounts_[2])};
  if (burden_->currentData().toInt() != no_burden) said.burden = chosen_in<PlaqueBurden>(*burden_);
  return said;
}

std::vector<session::FeatureWord> ReportNotesDialog::features() const {
  std::vector<session::FeatureWord> all = notes_.features;
  for (const Word& one : words_) {
    session::FeatureWord word = one.of;
    word.state = chosen_in<LesionState>(*one.said);
    if (word.state != one.of.state) all = session::with_feature(std::move(all), word);
  }
  return all;
}

bool ReportNotesDialog::keep() {
  const std::string text = impression_->toPlainText().trimmed().toStdString();
  const session::ReportModifiers said = modifiers();
  const std::vector<session::FeatureWord> words = features();
  const bool kept = desk_.messages.guarded(
      [&] {
        session::Workbench& bench = desk_.bench;
        if (text != notes_.impression) bench.annotate(session::SetReportImpression{text});
        if (!(said == notes_.modifiers)) bench.annotate(session::SetReportModifiers{said});
        if (words != notes_.features) bench.annotate(session::SetPlaqueFeatures{words});
      },
      true);
  notes_ = desk_.bench.session().file().annotations()->report;
  for (Word& one : words_) one.of.state = chosen_in<LesionState>(*one.said);
  return kept;
}

void ReportNotesDialog::sign() {
  if (!keep()) return;
  const bool done = desk_.messages.guarded(
      [&] {
        const session::CaseFile& file = desk_.bench.session().file();
        const session::OpenImage& image = desk_.bench.image();
        const session::ReportVersion version{
            QDate::currentDate().toString(Qt::ISODate).toStdString(), signer_->text().trimmed().toStdString(),
            changes_->text().trimmed().toStdString(),
            session::report_content_digest(*file.model(), *file.annotations(),
                                           image.volume ? image.reference.sha256 : std::string())};
        desk_.bench.annotate(session::SignReport{version});
      },
      true);
  if (!done) return;
  notes_ = desk_.bench.session().file().annotations()->report;
  changes_->clear();
  desk_.messages.say(tr("Version %1 of the report is signed.").arg(notes_.versions.size()));
  QDialog::accept();
}

void ReportNotesDialog::accept() {
  if (keep()) QDialog::accept();
}

}  // namespace ostia::workstation
