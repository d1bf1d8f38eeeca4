#include "meshing_dialog.h"

#include "file_dialogs.h"

#include "ostia/core/error.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/vessel_choice.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QResizeEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

using pipeline::SurfaceEnds;
using Size = ExportChoice::Size;
using Vessels = ExportChoice::Vessels;

constexpr double fewest_edges = 6.0, most_edges = 60.0;
constexpr double shortest_mm = 0.05, longest_mm = 3.0;
constexpr double field_most = 999.0;  // what can be typed; what is allowed is checked
constexpr int dialog_width = 560;
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
    : QDialog(parent), subject_(std::move(subject)) {
  const bool mesh = subject_.kind == ExportKind::mesh;
  setObjectName(mesh ? "mesh_dialog" : "surface_dialog");
  setWindowTitle(mesh ? tr("Mesh and export") : tr("Export the surface"));
  setMinimumWidth(std::min(dialog_width, parent ? parent->width() - 40 : dialog_width));
  resize(minimumWidth(), 0);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  add_vessels(form, last);
  if (!mesh) add_ends(form, last);
  add_size(form, last);
  if (mesh) {
    volume_ = new VolumeFields(form, last.volume, this);
    connect(volume_, &VolumeFields::changed, this, &MeshingDialog::check);
  }
  add_formats(form, last);
  add_folder(form);
  estimate_ = quiet_label("estimate");
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  go_ = buttons->addButton(mesh ? tr("Mesh and export") : tr("Export"), QDialogButtonBox::AcceptRole);
  go_->setObjectName("go");
  connect(buttons, &QDialogButtonBox::accepted, this, &MeshingDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(estimate_);
  layout->addStretch(1);
  layout->addWidget(buttons);
  go_->setDefault(true);  // once it is in the dialog: else it is the dialog that chooses, and it takes Cancel
  check();
}

void MeshingDialog::add_vessels(QFormLayout* form, const ExportChoice& last) {
  const auto& tree = subject_.model->tree;
  vessels_ = new QComboBox;
  vessels_->setObjectName("vessels_chosen");
  vessels_->setAccessibleName(tr("Vessels"));
  add(vessels_, tr("all, %1").arg(tree.vessels.size()), Vessels::all);
  if (!subject_.visible.empty() && subject_.visible.size() < tree.vessels.size())
    add(vessels_, tr("those shown in 3D: %1").arg(names_of(subject_.visible)), Vessels::visible);
  if (tree.vessels.size() > 1)
    add(vessels_, tr("the selected one: %1").arg(names_of({subject_.selected})), Vessels::selected);
  vessels_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  choose(vessels_, last.vessels);
  parents_ = quiet_label("parents");
  auto* column = new QVBoxLayout;
  column->setSpacing(2);
  column->addWidget(vessels_);
  column->addWidget(parents_);
  form->addRow(export_field_label(tr("&Vessels"), vessels_), column);
  connect(vessels_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshingDialog::check);
}

void MeshingDialog::add_ends(QFormLayout* form, const ExportChoice& last) {
  ends_ = new QComboBox;
  ends_->setObjectName("ends");
  ends_->setAccessibleName(tr("Ends"));
  add(ends_, tr("cut flat, closed, faces named"), SurfaceEnds::capped);
  add(ends_, tr("cut flat, open"), SurfaceEnds::open);
  add(ends_, tr("rounded, as in the model"), SurfaceEnds::rounded);
  choose(ends_, last.ends);
  form->addRow(export_field_label(tr("&Ends"), ends_), ends_);
  connect(ends_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshingDialog::check);
}

void MeshingDialog::add_size(QFormLayout* form, const ExportChoice& last) {
  size_ = new QComboBox;
  size_->setObjectName("size");
  size_->setAccessibleName(tr("Size of the triangles"));
  if (subject_.kind == ExportKind::surface) add(size_, tr("as fine as the model"), Size::as_modelled);
  add(size_, tr("by the calibre"), Size::by_calibre);
  add(size_, tr("the same everywhere"), Size::even);
  size_->setToolTip(
      tr("By the calibre: as many edges around a thin vessel as around a thick one. The same everywhere: "
         "shorter only where fewer than eight edges would be around the lumen."));
  choose(size_, last.size);
  const auto number = [&](const QString& name, const QString& accessible, int decimals, double value,
                          const QString& suffix) {
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(accessible);
    box->setRange(0.0, field_most);
    box->setDecimals(decimals);
    box->setSingleStep(decimals == 0 ? 1.0 : 0.05);
    box->setValue(value);
    box->setSuffix(suffix);
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &MeshingDialog::check);
    return box;
  };
  edges_ = number("edges_around", tr("Edges around a vessel"), 0, last.edges_around, tr(" edges around"));
  edge_mm_ = number("edge_mm", tr("Edge length"), 2, last.edge_mm, tr(" mm"));
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  line->addWidget(size_, 1);
  line->addWidget(edges_);
  line->addWidget(edge_mm_);
  size_field_ = add_export_field(form, tr("&Triangles"), row, size_, "size");
  connect(size_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshingDialog::check);
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
  formats_field_ = add_export_field(form, tr("Surface as"), row, row, "formats");
}

void MeshingDialog::add_folder(QFormLayout* form) {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  folder_ = new QLineEdit(QString::fromStdString(subject_.folder.string()));
  folder_->setObjectName("folder");
  folder_->setAccessibleName(tr("Folder that is made"));
  auto* choose_button = new QPushButton(tr("&Choose\u2026"));
  choose_button->setAutoDefault(false);
  line->addWidget(folder_, 1);
  line->addWidget(choose_button);
  folder_field_ = add_export_field(form, tr("&New folder"), row, folder_, "folder");
  connect(folder_, &QLineEdit::textChanged, this, &MeshingDialog::check);
  connect(choose_button, &QPushButton::clicked, this, &MeshingDialog::choose_folder);
}

void MeshingDialog::choose_folder() {
  const QFileInfo now(folder_->text());
  const QString inside = ask_folder(this, tr("Where the folder is to be"), now.absolutePath());
  if (!inside.isEmpty()) folder_->setText(inside + "/" + now.fileName());
}

void MeshingDialog::check() {
  if (!go_) return;  // while it is put together
  const Size size = chosen<Size>(size_);
  edges_->setVisible(size == Size::by_calibre);
  edge_mm_->setVisible(size == Size::even);
  mark({edges_, size_field_.trouble}, {});
  mark({edge_mm_, size_field_.trouble}, {});
  ExportField field = size_field_;
  field.input = size == Size::even ? edge_mm_ : size == Size::by_calibre ? edges_ : size_field_.input;
  const bool size_fits = mark(field, size_trouble());
  const bool formats_fit = mark(formats_field_, formats_trouble());
  const bool folder_fits = mark(folder_field_, folder_trouble());
  const bool volume_fits = !volume_ || volume_->check();
  go_->setEnabled(size_fits && formats_fit && folder_fits && volume_fits);
  const auto chosen_ids = vessel_ids();
  const auto needed = pipeline::with_parents(subject_.model->tree, chosen_ids);
  std::vector<std::int32_t> more;
  for (const std::int32_t id : needed)
    if (std::find(chosen_ids.begin(), chosen_ids.end(), id) == chosen_ids.end()) more.push_back(id);
  parents_->setVisible(!more.empty());
  parents_->setText(tr("together with the vessels that they come from: %1").arg(names_of(more)));
  if (size_fits)
    show_estimate();
  else
    estimate_->clear();
  fit();
}

void MeshingDialog::fit() {
  // Texts that wrap say what height they need for a width; a window does not ask by itself.
  layout()->activate();
  const int needed = layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width())
                                                   : layout()->totalMinimumSize().height();
  setMinimumHeight(needed);
  if (height() < needed) resize(width(), needed);
}

void MeshingDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  if (event->size().width() != event->oldSize().width()) fit();
}

void MeshingDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  fit();
}

QString MeshingDialog::size_trouble() const {
  const Size size = chosen<Size>(size_);
  if (size == Size::by_calibre && !(edges_->value() >= fewest_edges && edges_->value() <= most_edges)) {
    const bool few = edges_->value() < fewest_edges;
    return (few ? tr("%1 edges around a vessel are too few. Choose %2 to %3.")
                : tr("%1 edges around a vessel are too many. Choose %2 to %3."))
        .arg(edges_->value(), 0, 'f', 0)
        .arg(fewest_edges)
        .arg(most_edges);
  }
  if (size == Size::even && !(edge_mm_->value() >= shortest_mm && edge_mm_->value() <= longest_mm)) {
    const bool short_one = edge_mm_->value() < shortest_mm;
    return (short_one ? tr("Edges of %1 mm are too short. Choose %2 to %3 mm.")
                      : tr("Edges of %1 mm are too long. Choose %2 to %3 mm."))
        .arg(edge_mm_->value(), 0, 'f', 2)
        .arg(shortest_mm)
        .arg(longest_mm);
  }
  if (subject_.kind == ExportKind::surface) return {};
  const double cells =
      pipeline::estimate_mesh(*subject_.model, vessel_ids(), *sizing(), volume_->options()).tetrahedra;
  if (cells <= pipeline::most_tetrahedra) return {};
  return tr("About %1 cells; more than %2 do not fit. Choose longer edges, or fewer vessels.")
      .arg(about(cells), about(pipeline::most_tetrahedra));
}

QString MeshingDialog::formats_trouble() const {
  const bool any = std::any_of(formats_.begin(), formats_.end(), [](auto* box) { return box->isChecked(); });
  return any || subject_.kind == ExportKind::mesh ? QString() : tr("Choose at least one format.");
}

QString MeshingDialog::folder_trouble() const {
  const QString path = folder_->text();
  const QFileInfo folder(path), parent(folder.absolutePath());
  if (path.isEmpty() || folder.fileName().isEmpty() || folder.fileName() == "." || folder.fileName() == "..")
    return tr("Name a new folder.");
  if (folder.exists() && !folder.isDir()) return tr("There is a file of this name. Name another folder.");
  if (!parent.exists()) return tr("There is no folder %1.").arg(parent.filePath());
  if (!parent.isDir() || !parent.isWritable())
    return tr("Nothing can be written in %1. Choose another place.").arg(parent.filePath());
  return {};
}

void MeshingDialog::show_estimate() {
  QStringList lines;
  if (const auto size = sizing()) {
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

std::optional<meshing::SizingOptions> MeshingDialog::sizing() const {
  switch (chosen<Size>(size_)) {
    case Size::by_calibre:
      return pipeline::edges_around(edges_->value());
    case Size::even:
      return pipeline::even_edges(edge_mm_->value());
    case Size::as_modelled:
      break;
  }
  return std::nullopt;
}

ExportChoice MeshingDialog::choice() const {
  ExportChoice made;
  made.vessels = chosen<Vessels>(vessels_);
  if (ends_) made.ends = chosen<SurfaceEnds>(ends_);
  made.size = chosen<Size>(size_);
  made.edges_around = edges_->value();
  made.edge_mm = edge_mm_->value();
  made.formats.clear();
  for (const QCheckBox* box : formats_)
    if (box->isChecked()) made.formats.push_back(box->text().toLower().toStdString());
  if (volume_) made.volume = volume_->choice();
  made.folder = folder_->text().toStdString();
  return made;
}

pipeline::SurfaceExportOptions MeshingDialog::surface_options() const {
  const ExportChoice made = choice();
  return {vessel_ids(), made.ends, sizing(), made.formats};
}

pipeline::MeshExportOptions MeshingDialog::mesh_options() const {
  pipeline::MeshExportOptions options;
  options.vessels = vessel_ids();
  options.sizing = *sizing();
  options.volume = volume_->options();
  options.surface_formats = choice().formats;
  return options;
}

void MeshingDialog::accept() {
  check();
  if (!go_->isEnabled()) return;
  // A folder is made and taken away again: rights alone do not tell whether that is possible.
  try {
    pipeline::require_free_folder(folder_->text().toStdString());
  } catch (const IoError&) {
    mark(folder_field_, tr("Nothing can be written in %1. Choose another place.")
                            .arg(QFileInfo(folder_->text()).absolutePath()));
  } catch (const std::exception&) {
    mark(folder_field_, tr("The folder holds files that are not from an earlier export. Name another one."));
  }
  if (folder_field_.trouble->isVisibleTo(this)) {
    folder_->setFocus();
    return;
  }
  QDialog::accept();
}

}  // namespace ostia::workstation
