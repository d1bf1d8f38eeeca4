#include "meshing/fields.h"

#include "ostia/core/error.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QSpinBox>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int most_layers = 20;
constexpr double thickest = 3.0, least_thickness = 0.01;
constexpr int meshing_field_most = 999;  // what can be typed; what is allowed is checked
constexpr int meshing_rows_shown = 4;

// Of the library's titles the one that is not a program's name alone.
[[maybe_unused]] constexpr const char* translated_title =
    QT_TRANSLATE_NOOP("ostia::workstation::VolumeFields", "STL, a file for each face");

QString shown_title(io::MeshFormat format) {
  return VolumeFields::tr(std::string(io::title_of(format)).c_str());
}

bool holds(io::MeshFormat format, bool prisms, bool quadratic) {
  try {
    io::require_holds(format, prisms, quadratic);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

VolumeFields::VolumeFields(QFormLayout* elements, QFormLayout* formats, const VolumeChoice& last,
                           QObject* parent)
    : QObject(parent) {
  add_layers(elements, last);
  add_order(elements, last);
  add_formats(formats, last);
}

void VolumeFields::add_layers(QFormLayout* form, const VolumeChoice& last) {
  layers_ = new QSpinBox;
  layers_->setObjectName("layers");
  layers_->setAccessibleName(tr("Layers of prisms on the wall"));
  layers_->setRange(0, meshing_field_most);
  layers_->setSpecialValueText(tr("none"));
  layers_->setValue(last.layers);
  layers_->setToolTip(
      tr("Flat prisms on the wall, where the shear stress is. Where there is no room they get "
         "thinner, never fewer."));
  thickness_ = number_field("layer_thickness", tr("Thickness of all layers"), meshing_field_most, 2, 0.05,
                            last.thickness);
  thickness_->setPrefix(tr("thickness "));
  thickness_->setSuffix(tr(" of an edge"));
  split_ = new QCheckBox(tr("as tetrahedra"));
  split_->setObjectName("split_prisms");
  split_->setToolTip(tr("Each prism becomes three tetrahedra, for programs that know nothing else"));
  split_->setChecked(last.split);
  QWidget* row = in_a_row({layers_, thickness_, split_}, thickness_);
  layers_field_ = add_form_field(form, tr("&Layers"), row, layers_, "layers");
  connect(layers_, QOverload<int>::of(&QSpinBox::valueChanged), this, &VolumeFields::changed);
  connect(thickness_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &VolumeFields::changed);
  connect(split_, &QCheckBox::toggled, this, &VolumeFields::changed);
}

void VolumeFields::add_order(QFormLayout* form, const VolumeChoice& last) {
  order_ = new QComboBox;
  order_->setObjectName("order");
  order_->setAccessibleName(tr("Order of the elements"));
  order_->addItem(tr("linear"), 1);
  order_->addItem(tr("quadratic, curved along the wall"), 2);
  order_->setCurrentIndex(last.order == 2 ? 1 : 0);
  form->addRow(form_field_label(tr("Ele&ments"), order_), order_);
  connect(order_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &VolumeFields::changed);
}

void VolumeFields::add_formats(QFormLayout* form, const VolumeChoice& last) {
  formats_ = new QListWidget;
  formats_->setObjectName("mesh_formats");
  formats_->setAccessibleName(tr("Formats of the mesh"));
  formats_->setToolTip(tr("VTU, which ParaView reads, is always written; it keeps the names of the faces"));
  for (const io::MeshFormat format : io::mesh_formats) {
    if (format == io::MeshFormat::vtu) continue;
    auto* item = new QListWidgetItem(shown_title(format), formats_);
    item->setData(Qt::UserRole, static_cast<int>(format));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool chosen = std::ranges::find(last.formats, format) != last.formats.end();
    item->setCheckState(chosen ? Qt::Checked : Qt::Unchecked);
  }
  formats_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  formats_->setFixedHeight(meshing_rows_shown * formats_->sizeHintForRow(0) + 2 * formats_->frameWidth());
  formats_field_ = add_form_field(form, tr("Mesh as VTU, and"), formats_, formats_, "mesh_formats");
  connect(formats_, &QListWidget::itemChanged, this, &VolumeFields::changed);
}

VolumeChoice VolumeFields::choice() const {
  VolumeChoice made;
  made.layers = layers_->value();
  made.thickness = thickness_->value();
  made.split = split_->isChecked();
  made.order = order_->currentData().toInt();
  for (int i = 0; i < formats_->count(); ++i)
    if (formats_->item(i)->checkState() == Qt::Checked)
      made.formats.push_back(static_cast<io::MeshFormat>(formats_->item(i)->data(Qt::UserRole).toInt()));
  return made;
}

pipeline::VolumeOptions VolumeFields::options() const {
  const VolumeChoice made = choice();
  pipeline::VolumeOptions options;
  if (made.layers > 0) {
    options.layers.emplace();
    options.layers->layers = made.layers;
    options.layers->thickness = made.thickness;
    options.split_prisms = made.split;
  }
  options.order = made.order;
  options.formats = made.formats;
  return options;
}

bool VolumeFields::check() {
  thickness_->setEnabled(layers_->value() > 0);
  split_->setEnabled(layers_->value() > 0);
  FormField field = layers_field_;
  mark({layers_, field.trouble}, {});
  mark({thickness_, field.trouble}, {});
  if (layers_->value() <= most_layers) field.input = thickness_;
  const bool layers_fit = mark(field, layers_trouble());
  return mark(formats_field_, formats_trouble()) && layers_fit;
}

void VolumeFields::scale_layers(double factor) {
  thickness_->setValue(std::max(least_thickness, std::floor(100.0 * thickness_->value() * factor) / 100.0));
}

void VolumeFields::drop_layers() {
  layers_->setValue(0);
}

QString VolumeFields::layers_trouble() const {
  if (layers_->value() == 0) return {};
  if (layers_->value() > most_layers)
    return tr("%1 layers are too many. Choose up to %2.").arg(layers_->value()).arg(most_layers);
  if (thickness_->value() > 0.0 && thickness_->value() <= thickest) return {};
  return tr("Layers of %1 edges together cannot be made. Choose a thickness above 0 and up to %2.")
      .arg(thickness_->value(), 0, 'f', 2)
      .arg(thickest);
}

QString VolumeFields::formats_trouble() const {
  const VolumeChoice made = choice();
  const bool prisms = made.layers > 0 && !made.split;
  for (const io::MeshFormat format : made.formats) {
    if (holds(format, prisms, made.order == 2)) continue;
    if (made.order == 2 && !holds(format, false, true))
      return tr("%1 cannot hold quadratic elements. Choose linear ones, or take the mark away.")
          .arg(shown_title(format));
    return tr("%1 cannot hold these prisms. Choose layers as tetrahedra, or take the mark away.")
        .arg(shown_title(format));
  }
  return {};
}

}  // namespace ostia::workstation
