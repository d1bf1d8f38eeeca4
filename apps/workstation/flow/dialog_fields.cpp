// The rows of the flow case's dialog.
#include "flow/dialog.h"
#include "shell/new_folder.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <string>

namespace ostia::workstation {
namespace {

constexpr int rows_shown = 4;
constexpr int typing_ms = 400;
constexpr double field_most = 99999.0;  // what can be typed; what is allowed is checked
constexpr double usual_flow_ml_s = 1.0;

QString outlets_text(solver::OutletModel model) {
  switch (model) {
    case solver::OutletModel::zero_pressure:
      return FlowDialog::tr("pressure 0 at each");
    case solver::OutletModel::split:
      return FlowDialog::tr("a share of the flow each, by diameter");
    case solver::OutletModel::resistance:
      return FlowDialog::tr("resistances, by diameter");
  }
  return {};
}

QDoubleSpinBox* number(const QString& name, const QString& accessible, int decimals, double value,
                       const QString& suffix) {
  auto* box = number_field(name, accessible, field_most, decimals, decimals == 0 ? 10.0 : 0.1, value);
  box->setSuffix(suffix);
  return box;
}

QComboBox* list(const QString& name, const QString& accessible) {
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setAccessibleName(accessible);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(10);
  return box;
}

}  // namespace

FlowDialog::FlowDialog(const FlowChoice& last, QWidget* parent) : FittedDialog(parent) {
  setObjectName("flow_dialog");
  setWindowTitle(tr("Flow case"));
  typing_.setSingleShot(true);
  typing_.setInterval(typing_ms);
  connect(&typing_, &QTimer::timeout, this, [this] { emit mesh_wanted(mesh_file_->text()); });
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  add_mesh(form, last);
  add_ends(form);
  add_solver(form, last);
  add_flow(form, last);
  add_outlets(form, last);
  add_blood(form, last);
  add_folder(form, last);
  note_ = new QLabel;
  note_->setObjectName("flow_note");
  note_->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  go_ = buttons->addButton(tr("Write the case"), QDialogButtonBox::AcceptRole);
  go_->setObjectName("go");
  connect(buttons, &QDialogButtonBox::accepted, this, &FlowDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(run_);
  layout->addWidget(note_);
  layout->addStretch(1);
  layout->addWidget(buttons);
  go_->setDefault(true);
  want_mesh();
  if (!mesh_file_->text().isEmpty()) typing_.start(0);  // it was not typed
}

void FlowDialog::add_mesh(QFormLayout* form, const FlowChoice& last) {
  mesh_file_ = new QLineEdit(QString::fromStdString(last.mesh.string()));
  mesh_file_->setObjectName("flow_mesh");
  mesh_file_->setAccessibleName(tr("Mesh"));
  auto* choose = new QPushButton(tr("C&hoose\u2026"));
  choose->setObjectName("choose_mesh");
  choose->setAutoDefault(false);
  mesh_field_ = add_form_field(form, tr("&Mesh"), in_a_row({mesh_file_, choose}), mesh_file_, "mesh");
  connect(mesh_file_, &QLineEdit::textChanged, this, &FlowDialog::want_mesh);
  connect(choose, &QPushButton::clicked, this, &FlowDialog::choose_mesh);
}

void FlowDialog::add_ends(QFormLayout* form) {
  ends_ = new QTreeWidget;
  ends_->setObjectName("flow_ends");
  ends_->setAccessibleName(tr("Inlets and outlets"));
  ends_->setRootIsDecorated(false);
  ends_->setHeaderLabels({tr("Open end"), tr("Diameter"), tr("Mean flow")});
  ends_->header()->setStretchLastSection(true);
  ends_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  const int row = fontMetrics().height() + 4;
  ends_->setFixedHeight((rows_shown + 1) * row + 2 * ends_->frameWidth() + 4);
  form->addRow(form_field_label(tr("&Ends"), ends_), ends_);
}

void FlowDialog::add_solver(QFormLayout* form, const FlowChoice& last) {
  solver_ = list("flow_solver", tr("Solver"));
  for (const pipeline::SolverKind kind : pipeline::solver_kinds) {
    const QString suite = QString::fromStdString(std::string(traits_of(kind).suite));
    solver_->addItem(suite.isEmpty() ? title_of(kind) : title_of(kind) + " (" + suite + ")",
                     static_cast<int>(kind));
  }
  solver_->setCurrentIndex(solver_->findData(static_cast<int>(last.solver)));
  form->addRow(form_field_label(tr("&Solver"), solver_), solver_);
  connect(solver_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &FlowDialog::check);
}

void FlowDialog::add_flow(QFormLayout* form, const FlowChoice& last) {
  flow_ = list("flow_kind", tr("Flow through each inlet"));
  flow_->addItem(tr("by its diameter"));
  flow_->addItem(tr("the same through each inlet"));
  flow_->setCurrentIndex(last.flow_ml_s ? 1 : 0);
  flow_->setToolTip(
      tr("By its diameter: 1.43 d^2.55 (SI), measured in human coronary arteries "
         "(van der Giessen 2011)"));
  flow_ml_s_ = number("flow_ml_s", tr("Mean flow"), 3, last.flow_ml_s.value_or(usual_flow_ml_s), tr(" ml/s"));
  flow_field_ = add_form_field(form, tr("&Flow in"), in_a_row({flow_, flow_ml_s_}), flow_ml_s_, "flow");
  waveform_ = list("flow_waveform", tr("Course over time"));
  waveform_->addItem(tr("steady"), QString());
  waveform_->addItem(tr("pulse of a left coronary artery (model)"), QStringLiteral("coronary-left"));
  waveform_->addItem(tr("pulse of a right coronary artery (model)"), QStringLiteral("coronary-right"));
  waveform_->setCurrentIndex(std::max(0, waveform_->findData(QString::fromStdString(last.waveform))));
  form->addRow(form_field_label(tr("&Time"), waveform_), waveform_);
  connect(flow_ml_s_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &FlowDialog::check);
  for (QComboBox* box : {flow_, waveform_})
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &FlowDialog::check);
}

void FlowDialog::add_outlets(QFormLayout* form, const FlowChoice& last) {
  outlets_ = list("flow_outlets", tr("Outlets"));
  for (const solver::OutletTraits& one : solver::outlet_models())
    outlets_->addItem(outlets_text(one.model), static_cast<int>(one.model));
  outlets_->setCurrentIndex(std::max(0, outlets_->findData(static_cast<int>(last.outlets))));
  outlets_->setToolTip(
      tr("Shares and resistances go as the diameter to 2.27 (van der Giessen 2011); together the "
         "resistances take 90 mmHg."));
  outlets_field_ = add_form_field(form, tr("&Outlets"), outlets_, outlets_, "outlets");
  connect(outlets_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &FlowDialog::check);
}

void FlowDialog::add_blood(QFormLayout* form, const FlowChoice& last) {
  rheology_ = list("flow_rheology", tr("Viscosity of blood"));
  rheology_->addItem(tr("Newtonian"));
  rheology_->addItem(tr("shear-thinning"));
  rheology_->setToolTip(tr("Shear-thinning: the law of Carreau (Cho and Kensey 1991)"));
  rheology_->setCurrentIndex(last.blood.rheology == solver::Rheology::carreau ? 1 : 0);
  viscosity_ = number("flow_viscosity", tr("Viscosity"), 2, last.blood.viscosity_mpa_s, tr(" mPa s"));
  density_ = number("flow_density", tr("Density"), 0, last.blood.density_kg_m3, tr(" kg/m\u00b3"));
  blood_field_ =
      add_form_field(form, tr("&Blood"), in_a_row({rheology_, viscosity_, density_}), viscosity_, "blood");
  connect(rheology_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &FlowDialog::check);
  for (QDoubleSpinBox* box : {viscosity_, density_})
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &FlowDialog::check);
}

void FlowDialog::add_folder(QFormLayout* form, const FlowChoice& last) {
  folder_ = new NewFolderField(form, {}, this);
  connect(folder_, &NewFolderField::changed, this, &FlowDialog::check);
  run_ = new QCheckBox(tr("&Run the solver when the case is written"));
  run_->setObjectName("flow_run");
  run_->setChecked(last.run);
}

}  // namespace ostia::workstation
