#include "meshing/dialog.h"

#include "shell/new_folder.h"

#include "ostia/core/error.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/vessel_choice.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStyle>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

using pipeline::SurfaceEnds;
using Vessels = ExportChoice::Vessels;

const QStringList surface_formats{"vtp", "stl", "ply"};

template <class Enum>
void add(QComboBox* box, const QString& text, Enum value) {
  box->addItem(text, static_cast<int>(value));
}

template <class Enum>
Enum chosen(const QComboBox* box) {
  return static_cast<Enum>(box->currentData().toInt());
}

template <class Enum>
void choose(QComboBox* box, Enum value) {
  box->setCurrentIndex(std::max(0, box->findData(static_cast<int>(value))));
}

QLabel* quiet_label(const QString& name) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setEnabled(false);
  return label;
}

/// Two digits that count: "about 120000" rather than "118342".
QString about(double count) {
  if (count < 100.0) return QString::number(std::ceil(count), 'f', 0);
  const double unit = std::pow(10.0, std::floor(std::log10(count)) - 1.0);
  const double rounded = std::round(count / unit) * unit;
  return rounded < 1e6 ? QString::number(rounded, 'f', 0)
                       : MeshingDialog::tr("%1 million").arg(std::round(rounded / 1e5) / 10.0);
}

}  // namespace

MeshingDialog::MeshingDialog(ExportSubject subject, const ExportChoice& last, QWidget* parent)
    : FittedDialog(parent), subject_(std::move(subject)) {
  const bool mesh = subject_.kind == ExportKind::mesh;
  setObjectName(mesh ? "mesh_dialog" : "surface_dialog");
  setWindowTitle(mesh ? tr("Mesh and export") : tr("Export the surface"));
  auto* layout = new QVBoxLayout(this);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  layout->addLayout(form);
  add_vessels(form);
  fill_vessels(last.vessels);
  QFormLayout *sizes = form, *formats = form, *below = form;
  if (mesh) {
    pages_ = new QTabWidget;
    pages_->setObjectName("pages");
    layout->addWidget(pages_, 1);
    sizes = page(tr("Si&zes"));
    QFormLayout* elements = page(tr("La&yers and elements"));
    formats = page(tr("&Formats"));
    size_ = new SizeFields(sizes, last.size, true, this);
    volume_ = new VolumeFields(elements, formats, last.volume, this);
    connect(volume_, &VolumeFields::changed, this, &MeshingDialog::check);
    add_check();
    below = new QFormLayout;
    below->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    layout->addLayout(below);
  } else {
    add_ends(form, last);
    size_ = new SizeFields(form, last.size, false, this);
  }
  connect(size_, &SizeFields::changed, this, &MeshingDialog::check);
  add_formats(formats, last);
  folder_ = new NewFolderField(below, subject_.folder, this);
  connect(folder_, &NewFolderField::changed, this, &MeshingDialog::check);
  estimate_ = quiet_label("estimate");
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  go_ = buttons->addButton(mesh ? tr("Mesh and export") : tr("Export"), QDialogButtonBox::AcceptRole);
  go_->setObjectName("go");
  connect(buttons, &QDialogButtonBox::accepted, this, &MeshingDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(estimate_);
  layout->addStretch(mesh ? 0 : 1);
  layout->addWidget(buttons);
  go_->setDefault(true);  // once it is in the dialog: else it is the dialog that chooses, and it takes Cancel
  check();
}

QFormLayout* MeshingDialog::page(const QString& title) {
  auto* one = new QWidget;
  auto* form = new QFormLayout(one);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  pages_->addTab(one, title);
  return form;
}

void MeshingDialog::add_check() {
  check_ = new MeshingCheck;
  pages_->addTab(check_, tr("&Will it mesh?"));
  connect(check_, &MeshingCheck::repair_wanted, this, &MeshingDialog::repair);
  connect(check_, &MeshingCheck::chosen, this, &MeshingDialog::fit);
}

void MeshingDialog::repair(const meshing::ForecastPlace& place) {
  using meshing::OfferedRepair;
  if (place.repair == OfferedRepair::smaller_edges)
    size_->scale_edges(place.factor);
  else if (place.repair == OfferedRepair::thinner_layers)
    volume_->scale_layers(place.factor);
  else if (place.repair == OfferedRepair::drop_layers)
    volume_->drop_layers();
}

void MeshingDialog::add_vessels(QFormLayout* form) {
  vessels_ = new QComboBox;
  vessels_->setObjectName("vessels_chosen");
  vessels_->setAccessibleName(tr("Vessels"));
  vessels_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  parents_ = quiet_label("parents");
  auto* column = new QVBoxLayout;
  column->setSpacing(2);
  column->addWidget(vessels_);
  column->addWidget(parents_);
  form->addRow(form_field_label(tr("&Vessels"), vessels_), column);
  connect(vessels_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshingDialog::check);
}

void MeshingDialog::fill_vessels(Vessels chosen_before) {
  const QSignalBlocker quiet(vessels_);
  const auto& tree = subject_.model->tree;
  vessels_->clear();
  add(vessels_, tr("all, %1").arg(tree.vessels.size()), Vessels::all);
  if (!subject_.visible.empty() && subject_.visible.size() < tree.vessels.size())
    add(vessels_, tr("those shown in 3D: %1").arg(names_of(subject_.visible)), Vessels::visible);
  if (tree.vessels.size() > 1)
    add(vessels_, tr("the selected one: %1").arg(names_of({subject_.selected})), Vessels::selected);
  choose(vessels_, chosen_before);
}

void MeshingDialog::set_model(std::shared_ptr<const lumen::LumenModel> model,
                              std::vector<std::int32_t> visible, std::int32_t selected) {
  subject_.model = std::move(model);
  subject_.visible = std::move(visible);
  subject_.selected = selected;
  fill_vessels(chosen<Vessels>(vessels_));
  check();
}

void MeshingDialog::add_ends(QFormLayout* form, const ExportChoice& last) {
  ends_ = new QComboBox;
  ends_->setObjectName("ends");
  ends_->setAccessibleName(tr("Ends"));
  add(ends_, tr("cut flat, closed, faces named"), SurfaceEnds::capped);
  add(ends_, tr("cut flat, open"), SurfaceEnds::open);
  add(ends_, tr("rounded, as in the model"), SurfaceEnds::rounded);
  choose(ends_, last.ends);
  form->addRow(form_field_label(tr("&Ends"), ends_), ends_);
  connect(ends_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshingDialog::check);
}

void MeshingDialog::add_formats(QFormLayout* form, const ExportChoice& last) {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  const QMap<QString, QString> tips{{"vtp", tr("ParaView, VTK; keeps the names of the faces")},
                                    {"stl", tr("Any program, 3D printers; without names of faces")},
                                    {"ply", tr("MeshLab, Blender; without names of faces")}};
  for (const QString& format : surface_formats) {
    auto* box = new QCheckBox(format.toUpper());
    box->setObjectName("format." + format);
    box->setToolTip(tips[format]);
    box->setChecked(std::count(last.formats.begin(), last.formats.end(), format.toStdString()) > 0);
    connect(box, &QCheckBox::toggled, this, &MeshingDialog::check);
    line->addWidget(box);
    formats_.push_back(box);
  }
  line->addStretch(1);
  formats_field_ = add_form_field(form, tr("Surface as"), row, row, "formats");
}

void MeshingDialog::check() {
  if (!go_) return;  // while it is put together
  const bool sound_size = size_->sound();
  const bool volume_fits = !volume_ || volume_->check();
  const bool size_fits = size_->check(sound_size ? count_trouble() : QString());
  const bool formats_fit = mark(formats_field_, formats_trouble());
  const bool folder_fits = folder_->check();
  go_->setEnabled(size_fits && formats_fit && folder_fits && volume_fits);
  if (check_) {
    check_->set_stale();
    check_->set_possible(size_fits && volume_fits);
    mark_pages();
  }
  const auto chosen_ids = vessel_ids();
  const auto needed = pipeline::with_parents(subject_.model->tree, chosen_ids);
  std::vector<std::int32_t> more;
  for (const std::int32_t id : needed)
    if (std::find(chosen_ids.begin(), chosen_ids.end(), id) == chosen_ids.end()) more.push_back(id);
  parents_->setVisible(!more.empty());
  parents_->setText(tr("together with the vessels that they come from: %1").arg(names_of(more)));
  if (sound_size)
    show_estimate();
  else
    estimate_->clear();
  fit();
}

/// What is wrong on a page that is not shown is seen on its tab.
void MeshingDialog::mark_pages() {
  for (int i = 0; i < pages_->count(); ++i) {
    QString wrong;
    for (const QLabel* label : pages_->widget(i)->findChildren<QLabel*>())
      if (label->objectName().endsWith("_trouble") && !label->text().isEmpty()) wrong = label->text();
    pages_->setTabToolTip(i, wrong);
    pages_->setTabIcon(i, wrong.isEmpty() ? QIcon() : style()->standardIcon(QStyle::SP_MessageBoxWarning));
  }
}

QString MeshingDialog::count_trouble() const {
  if (subject_.kind == ExportKind::surface) return {};
  const double cells =
      pipeline::estimate_mesh(*subject_.model, vessel_ids(), *size_->sizing(), volume_->options()).tetrahedra;
  if (cells <= pipeline::most_tetrahedra) return {};
  return tr("About %1 cells; more than %2 do not fit. Choose longer edges, or fewer vessels.")
      .arg(about(cells), about(pipeline::most_tetrahedra));
}

QString MeshingDialog::formats_trouble() const {
  const bool any = std::any_of(formats_.begin(), formats_.end(), [](auto* box) { return box->isChecked(); });
  return any || subject_.kind == ExportKind::mesh ? QString() : tr("Choose at least one format.");
}

void MeshingDialog::show_estimate() {
  QStringList lines;
  if (const auto size = size_->sizing()) {
    const auto estimate = pipeline::estimate_mesh(*subject_.model, vessel_ids(), *size,
                                                  volume_ ? volume_->options() : pipeline::VolumeOptions());
    lines << (subject_.kind == ExportKind::mesh
                  ? tr("About %1 cells, %2 triangles on their surface.")
                        .arg(about(estimate.tetrahedra + estimate.prisms), about(estimate.triangles))
                  : tr("About %1 triangles.").arg(about(estimate.triangles)));
  }
  if (subject_.one_is_running) lines << tr("The export that is under way will be given up for this one.");
  estimate_->setText(lines.join(' '));
}

std::vector<std::int32_t> MeshingDialog::vessel_ids() const {
  switch (chosen<Vessels>(vessels_)) {
    case Vessels::visible:
      return subject_.visible;
    case Vessels::selected:
      return {subject_.selected};
    case Vessels::all:
      break;
  }
  std::vector<std::int32_t> all;
  for (const geometry::Vessel& vessel : subject_.model->tree.vessels) all.push_back(vessel.id);
  return all;
}

QString MeshingDialog::names_of(const std::vector<std::int32_t>& ids) const {
  QStringList names;
  for (const geometry::Vessel& vessel : subject_.model->tree.vessels)
    if (std::find(ids.begin(), ids.end(), vessel.id) != ids.end())
      names << QString::fromStdString(vessel.name);
  return names.join(", ");
}

ExportChoice MeshingDialog::choice() const {
  ExportChoice made;
  made.vessels = chosen<Vessels>(vessels_);
  if (ends_) made.ends = chosen<SurfaceEnds>(ends_);
  made.size = size_->choice();
  made.formats.clear();
  for (const QCheckBox* box : formats_)
    if (box->isChecked()) made.formats.push_back(box->text().toLower().toStdString());
  if (volume_) made.volume = volume_->choice();
  made.folder = folder_->path();
  return made;
}

pipeline::SurfaceExportOptions MeshingDialog::surface_options() const {
  const ExportChoice made = choice();
  return {vessel_ids(), made.ends, size_->sizing(), made.formats};
}

pipeline::MeshExportOptions MeshingDialog::mesh_options() const {
  pipeline::MeshExportOptions options;
  options.vessels = vessel_ids();
  options.sizing = *size_->sizing();
  options.extensions = size_->extensions();
  options.volume = volume_->options();
  options.surface_formats = choice().formats;
  return options;
}

void MeshingDialog::accept() {
  check();
  if (!go_->isEnabled()) return;
  // A folder is made and taken away again: rights alone do not tell whether that is possible.
  QString trouble;
  try {
    pipeline::require_free_folder(folder_->path());
  } catch (const IoError&) {
    trouble = tr("Nothing can be written in %1. Choose another place.")
                  .arg(QFileInfo(folder_->text()).absolutePath());
  } catch (const std::exception&) {
    trouble = tr("The folder holds files that are not from an earlier export. Name another one.");
  }
  if (!folder_->check(trouble)) {
    folder_->set_focus();
    return;
  }
  QDialog::accept();
}

}  // namespace ostia::workstation
