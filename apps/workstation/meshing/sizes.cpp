#include "meshing/sizes.h"

#include "ostia/pipeline/vessel_export.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::workstation {
namespace {

using Size = SizeChoice::Size;

constexpr double fewest_edges = 6.0, most_edges = 60.0;
constexpr double shortest_mm = 0.05, longest_mm = 3.0;
constexpr double size_field_most = 999.0;  // what can be typed; what is allowed is checked

}  // namespace

SizeFields::SizeFields(QFormLayout* form, const SizeChoice& last, bool mesh, QObject* parent)
    : QObject(parent) {
  add_triangles(form, last, mesh);
  if (!mesh) return;
  add_places(form, last);
  add_extensions(form, last);
}

QDoubleSpinBox* SizeFields::number(const QString& name, const QString& accessible, int decimals,
                                   double value) {
  auto* box = number_field(name, accessible, size_field_most, decimals, decimals == 0 ? 1.0 : 0.05, value);
  connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &SizeFields::changed);
  return box;
}

void SizeFields::add_triangles(QFormLayout* form, const SizeChoice& last, bool mesh) {
  size_ = new QComboBox;
  size_->setObjectName("size");
  size_->setAccessibleName(tr("Size of the triangles"));
  const auto add = [&](const QString& text, Size size) { size_->addItem(text, static_cast<int>(size)); };
  if (!mesh) add(tr("as fine as the model"), Size::as_modelled);
  add(tr("by the calibre"), Size::by_calibre);
  add(tr("the same everywhere"), Size::even);
  size_->setToolTip(
      tr("By the calibre: as many edges around a thin vessel as around a thick one. The same everywhere: "
         "shorter only where fewer than eight edges would be around the lumen."));
  size_->setCurrentIndex(std::max(0, size_->findData(static_cast<int>(last.size))));
  edges_ = number("edges_around", tr("Edges around a vessel"), 0, last.edges_around);
  edges_->setSuffix(tr(" edges around"));
  edge_mm_ = number("edge_mm", tr("Edge length"), 2, last.edge_mm);
  edge_mm_->setSuffix(tr(" mm"));
  size_field_ = add_form_field(form, tr("&Triangles"), in_a_row({size_, edges_, edge_mm_}), size_, "size");
  connect(size_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &SizeFields::changed);
}

void SizeFields::add_places(QFormLayout* form, const SizeChoice& last) {
  stenoses_ =
      number("stenosis_edges", tr("Edges at stenoses over those of the vessel"), 2, last.stenosis_share);
  stenoses_->setPrefix(tr("edges times "));
  stenoses_->setToolTip(
      tr("Shorter edges where the vessel is narrowed by 30 % or more; 0.5 halves them, 1 leaves them."));
  add_bounded(form, tr("At &stenoses"),
              {{}, stenoses_, 0.05, 1.0, false, tr("Choose %1 to %2 of the edges\u2019 length.")});
  curvature_ =
      number("curvature_ratio", tr("Edge over the wall's radius of curvature"), 2, last.curvature_ratio);
  curvature_->setSpecialValueText(tr("not looked at"));
  curvature_->setSuffix(tr(" of the bend's radius"));
  curvature_->setToolTip(
      tr("Shorter edges where the wall bends more than around itself, as in the crotch of a fork; 0.4 is a "
         "good start."));
  add_bounded(form, tr("At &bends"), {{}, curvature_, 0.02, 2.0, true, tr("Choose %1 to %2, or 0.")});
  radii_ = number("size_radii", tr("Bound on the size of wide places, in radii"), 2, last.size_radii);
  radii_->setSpecialValueText(tr("as wide as they are"));
  radii_->setPrefix(tr("as if "));
  radii_->setSuffix(tr(" radii wide"));
  radii_->setToolTip(
      tr("An aneurysm gets the edges of its vessel: the wall counts as at most so many radii away from the "
         "axis. 1 or more; 0: no bound."));
  add_bounded(form, tr("&Aneurysms"), {{}, radii_, 1.0, 100.0, true, tr("Choose %1 to %2, or 0.")});
}

void SizeFields::add_extensions(QFormLayout* form, const SizeChoice& last) {
  extensions_ = number("flow_extensions", tr("Length of the flow extensions"), 2, last.extensions);
  extensions_->setSingleStep(1.0);
  extensions_->setSpecialValueText(tr("none"));
  extensions_->setSuffix(tr(" diameters long"));
  extensions_->setToolTip(
      tr("Tubes beyond the cut ends that lead the flow in and out, from each real section to a circle."));
  add_bounded(form, tr("Flow e&xtensions"),
              {{}, extensions_, 0.25, 100.0, true, tr("Choose %1 to %2 diameters, or 0 for none.")});
}

SizeChoice SizeFields::choice() const {
  SizeChoice made;
  made.size = static_cast<Size>(size_->currentData().toInt());
  made.edges_around = edges_->value();
  made.edge_mm = edge_mm_->value();
  if (!stenoses_) return made;
  made.stenosis_share = stenoses_->value();
  made.curvature_ratio = curvature_->value();
  made.size_radii = radii_->value();
  made.extensions = extensions_->value();
  return made;
}

std::optional<meshing::SizingOptions> SizeFields::sizing() const {
  const SizeChoice made = choice();
  if (made.size == Size::as_modelled) return std::nullopt;
  meshing::SizingOptions sizing = made.size == Size::by_calibre ? pipeline::edges_around(made.edges_around)
                                                                : pipeline::even_edges(made.edge_mm);
  sizing.throat_share = made.stenosis_share;
  sizing.curvature_ratio = made.curvature_ratio;
  if (made.size_radii > 0.0) sizing.most_distance_radii = made.size_radii;
  return sizing;
}

std::optional<meshing::FlowExtensionOptions> SizeFields::extensions() const {
  const double diameters = choice().extensions;
  if (diameters == 0.0) return std::nullopt;
  meshing::FlowExtensionOptions options;
  options.inlet_diameters = options.outlet_diameters = diameters;
  return options;
}

bool SizeFields::check(const QString& of_mesh) {
  const Size size = choice().size;
  edges_->setVisible(size == Size::by_calibre);
  edge_mm_->setVisible(size == Size::even);
  mark({edges_, size_field_.trouble}, {});
  mark({edge_mm_, size_field_.trouble}, {});
  FormField field = size_field_;
  field.input = size == Size::even ? edge_mm_ : size == Size::by_calibre ? edges_ : size_field_.input;
  const QString own = size_trouble();
  bool fits = mark(field, own.isEmpty() ? of_mesh : own);
  for (const Bounded& number : bounded_)
    fits =
        mark(number.field, number.good() ? QString() : number.wrong.arg(number.low).arg(number.high)) && fits;
  return fits;
}

bool SizeFields::Bounded::good() const {
  return (may_be_none && box->value() == 0.0) || (box->value() >= low && box->value() <= high);
}

bool SizeFields::sound() const {
  return size_trouble().isEmpty() && std::ranges::all_of(bounded_, &Bounded::good);
}

void SizeFields::add_bounded(QFormLayout* form, const QString& text, const Bounded& number) {
  bounded_.push_back(number);
  bounded_.back().field = add_form_field(form, text, number.box, number.box, number.box->objectName());
}

QString SizeFields::size_trouble() const {
  const SizeChoice made = choice();
  if (made.size == Size::by_calibre &&
      !(made.edges_around >= fewest_edges && made.edges_around <= most_edges)) {
    const bool few = made.edges_around < fewest_edges;
    return (few ? tr("%1 edges around a vessel are too few. Choose %2 to %3.")
                : tr("%1 edges around a vessel are too many. Choose %2 to %3."))
        .arg(made.edges_around, 0, 'f', 0)
        .arg(fewest_edges)
        .arg(most_edges);
  }
  if (made.size == Size::even && !(made.edge_mm >= shortest_mm && made.edge_mm <= longest_mm)) {
    const bool short_one = made.edge_mm < shortest_mm;
    return (short_one ? tr("Edges of %1 mm are too short. Choose %2 to %3 mm.")
                      : tr("Edges of %1 mm are too long. Choose %2 to %3 mm."))
        .arg(made.edge_mm, 0, 'f', 2)
        .arg(shortest_mm)
        .arg(longest_mm);
  }
  return {};
}

void SizeFields::scale_edges(double factor) {
  const SizeChoice made = choice();
  if (made.size == Size::even)
    edge_mm_->setValue(
        std::clamp(std::floor(100.0 * made.edge_mm * factor) / 100.0, shortest_mm, longest_mm));
  else
    edges_->setValue(std::clamp(std::ceil(made.edges_around / factor), fewest_edges, most_edges));
}

}  // namespace ostia::workstation
