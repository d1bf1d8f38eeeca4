#include "views/planes_dock.h"

#include "shell/bind.h"
#include "shell/desk.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>

namespace ostia::workstation {

using view::LinkedPlane;

PlanesDock::PlanesDock(Desk& desk, QWidget* parent)
    : QDockWidget(tr("Three planes"), parent), desk_(desk), planes_(std::make_shared<view::LinkedPlanes>()) {
  setObjectName("planes");
  auto* columns = new QSplitter(Qt::Horizontal);
  auto* right = new QSplitter(Qt::Vertical);
  columns->addWidget(picture(LinkedPlane::axial, "plane_axial", tr("Axial plane")));
  right->addWidget(picture(LinkedPlane::coronal, "plane_coronal", tr("Coronal plane")));
  right->addWidget(picture(LinkedPlane::sagittal, "plane_sagittal", tr("Sagittal plane")));
  columns->addWidget(right);
  columns->setStretchFactor(0, 3);
  columns->setStretchFactor(1, 2);
  columns->setSizes({600, 400});
  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(1);
  rows->addWidget(controls());
  rows->addWidget(columns, 1);
  setWidget(whole);
}

PictureWidget* PlanesDock::picture(LinkedPlane kind, const QString& name, const QString& title) {
  const Guard guard = [this](const std::function<void()>& act) { desk_.messages.guarded(act); };
  auto* made =
      new PictureWidget(std::make_unique<view::LinkedPlaneView>(desk_.bench, kind, planes_), name, guard);
  made->setAccessibleName(title);
  made->show_identity(desk_.identity);
  pictures_.push_back(made);
  connect(made, &PictureWidget::hovered, this, &PlanesDock::hovered);
  own_.push_back(
      made->pointer().end_chosen.observe([this](const geometry::Vec3& end) { emit end_chosen(end); }));
  return made;
}

QWidget* PlanesDock::controls() {
  auto* bar = new QWidget;
  auto* line = new QHBoxLayout(bar);
  line->setContentsMargins(6, 1, 6, 1);
  auto* kind = new QComboBox;
  kind->setObjectName("planes_slab");
  kind->setAccessibleName(tr("Slab"));
  using reformat::Slab;
  for (const auto& [text, value] : {std::pair(tr("Thin"), Slab::none),
                                    {tr("Mean"), Slab::mean},
                                    {tr("MIP"), Slab::maximum},
                                    {tr("MinIP"), Slab::minimum}})
    kind->addItem(text, static_cast<int>(value));
  bind(kind, desk_.bench.slab);
  auto* thickness = new QDoubleSpinBox;
  thickness->setObjectName("planes_slab_mm");
  thickness->setAccessibleName(tr("Thickness of the slab"));
  thickness->setToolTip(tr("Shift and wheel over a plane, or the dots on its border, change it, too"));
  thickness->setDecimals(1);
  thickness->setSuffix(tr(" mm"));
  thickness->setFocusPolicy(Qt::ClickFocus);
  bind(thickness, desk_.bench.slab_mm);
  auto* straight = new QPushButton(tr("Straight"));
  straight->setObjectName("planes_reset");
  straight->setToolTip(tr("Axial, coronal and sagittal again; the rings on the lines turn them"));
  connect(straight, &QPushButton::clicked, this, &PlanesDock::reset);
  line->addWidget(new QLabel(tr("Slab")));
  line->addWidget(kind);
  line->addWidget(thickness);
  line->addStretch(1);
  line->addWidget(straight);
  return bar;
}

void PlanesDock::fit() {
  for (PictureWidget* one : pictures_) one->view().fit();
}

void PlanesDock::reset() {
  planes_->reset();
}

}  // namespace ostia::workstation
