#include "meshing/dock.h"

#include "meshing/histogram.h"
#include "shell/quantities.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

using geometry::Vec3;
using meshing::ElementMeasure;

constexpr std::size_t worst_listed = 20;
constexpr int panel_rows_shown = 3;
constexpr double elements_seen = 6.0;  // in half of the picture's height, where one is flown to

QString number(double value) {
  return QString::fromStdString(view::three_digits(value));
}

}  // namespace

MeshDock::MeshDock(session::Workbench& bench, SceneWidget& scene, QWidget* parent)
    : QDockWidget(tr("Mesh"), parent), scene_(scene) {
  setObjectName("mesh");
  auto* area = new QScrollArea;  // a low window
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setFocusPolicy(Qt::NoFocus);  // what is in it takes the keyboard
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setWidget(rows(bench));
  area->setMinimumWidth(area->widget()->minimumSizeHint().width() +
                        area->style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  setWidget(area);
  // It also tells of tabs, and of a window that is minimised: what is shown in 3D stays then.
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool) {
    if (std::exchange(was_hidden_, isHidden()) != isHidden()) show_in_scene(!isHidden());
  });
  connect(&scene_, &SceneWidget::guest_changed, this, [this](const view::SceneGuest* shown) {
    if (!guest_ || shown == guest_.get()) return;
    guest_.reset();  // another has taken its place
    cut_->set_guest(nullptr, box_);
  });
  own_.push_back(bench.case_changed.observe([this] { clear(); }));
}

MeshDock::~MeshDock() = default;

QWidget* MeshDock::rows(session::Workbench& bench) {
  auto* all = new QWidget;
  auto* column = new QVBoxLayout(all);
  column->setContentsMargins(6, 6, 6, 6);
  name_ = new QLabel(tr("No mesh has been made yet."));
  name_->setObjectName("mesh_name");
  name_->setWordWrap(true);
  column->addWidget(name_);
  gate_ = new QLabel;
  gate_->setObjectName("mesh_gate");
  gate_->setWordWrap(true);
  gate_->hide();
  column->addWidget(gate_);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->setRowWrapPolicy(QFormLayout::WrapLongRows);
  column->addLayout(form);
  add_colors(form);
  histogram_ = new HistogramWidget;
  histogram_->setObjectName("mesh_histogram");
  histogram_->setAccessibleName(tr("How many elements have which value"));
  form->addRow(histogram_);
  figures_ = new QLabel;
  figures_->setObjectName("mesh_figures");
  figures_->setWordWrap(true);
  form->addRow(figures_);
  cut_ = new CutFields(form, bench, scene_, this);
  auto* title = new QLabel(tr("&Worst elements"));
  list_ = new QListWidget;
  list_->setObjectName("mesh_worst");
  list_->setAccessibleName(tr("Worst elements"));
  list_->setToolTip(tr("A click shows the element in 3D."));
  list_->setMinimumHeight(panel_rows_shown * list_->fontMetrics().height() + 8);
  title->setBuddy(list_);
  column->addWidget(title);
  column->addWidget(list_, 1);
  connect(list_, &QListWidget::currentRowChanged, this, &MeshDock::fly_to);
  const auto again = [this](const QListWidgetItem* item) { fly_to(list_->row(item)); };
  connect(list_, &QListWidget::itemActivated, this, again);
  connect(list_, &QListWidget::itemClicked, this, again);
  return all;
}

void MeshDock::add_colors(QFormLayout* form) {
  measure_ = new QComboBox;
  measure_->setObjectName("mesh_measure");
  measure_->setAccessibleName(tr("What the colours show"));
  measure_->setSizeAdjustPolicy(QComboBox::AdjustToContents);  // the dock is as wide as its texts
  measure_->view()->setAccessibleName(measure_->accessibleName());
  for (std::size_t m = 0; m < meshing::element_measure_count; ++m)
    measure_->addItem(title_of(static_cast<ElementMeasure>(m)));
  auto* label = new QLabel(tr("&Colours"));
  label->setBuddy(measure_);
  form->addRow(label, measure_);
  connect(measure_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &MeshDock::show_measure);
  add_edges(form);
}

void MeshDock::add_edges(QFormLayout* form) {
  edges_ = new QComboBox;
  edges_->setObjectName("mesh_edges");
  edges_->setAccessibleName(tr("Edges of the elements"));
  edges_->setToolTip(
      tr("Of a whole tree there are more edges than pixels: they are drawn where they are near."));
  edges_->view()->setAccessibleName(edges_->accessibleName());
  const std::pair<QString, view::ShownEdges> choices[] = {{tr("where they are near"), view::ShownEdges::near},
                                                          {tr("always"), view::ShownEdges::always},
                                                          {tr("never"), view::ShownEdges::never}};
  for (const auto& [text, choice] : choices) edges_->addItem(text, static_cast<int>(choice));
  auto* label = new QLabel(tr("E&dges"));
  label->setBuddy(edges_);
  form->addRow(label, edges_);
  connect(edges_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] {
    if (guest_) guest_->set_edges(edges());
    scene_.request_render();
  });
}

view::ShownEdges MeshDock::edges() const {
  return static_cast<view::ShownEdges>(edges_->currentData().toInt());
}

void MeshDock::show_mesh(std::shared_ptr<const MeshPreview> preview) {
  guest_.reset();
  preview_ = std::move(preview);
  const geometry::MixedMesh& mesh = *preview_->mesh->mesh;
  box_.setEmpty();
  for (const Vec3& point : mesh.points) box_.extend(point);
  name_->setText(tr("%1: %2 tetrahedra, %3 prisms")
                     .arg(QString::fromStdString(preview_->name))
                     .arg(mesh.tetrahedra.size())
                     .arg(mesh.prisms.size()));
  cut_->leave_whole();
  show_gate();
  show_measure();
  show();
  raise();
  show_in_scene(true);
}

void MeshDock::show_gate() {
  const meshing::QualityVerdict& verdict = preview_->verdict;
  gate_->setText(
      verdict.ok()
          ? tr("Passes the quality control.")
          : tr("Does not pass the quality control: %1").arg(QString::fromStdString(verdict.summary())));
  gate_->show();
}

void MeshDock::clear() {
  preview_.reset();
  show_in_scene(false);
  name_->setText(tr("No mesh has been made yet."));
  gate_->hide();
  figures_->clear();
  histogram_->set_values({}, {});
  list_->clear();
  worst_.clear();
  hide();
}

void MeshDock::show_in_scene(bool shown) {
  if (shown && preview_) {
    if (guest_) return;
    const auto made = std::make_shared<view::MeshScene>(preview_->mesh);
    made->set_edges(edges());
    scene_.show_guest(made);
    guest_ = made;  // after the signal about the former one
    show_measure();
    cut_->set_guest(guest_, box_);
  } else if (guest_) {
    guest_.reset();
    cut_->set_guest(nullptr, box_);
    scene_.show_guest(nullptr);
  }
}

ElementMeasure MeshDock::measure() const {
  return static_cast<ElementMeasure>(std::max(0, measure_->currentIndex()));
}

void MeshDock::show_measure() {
  if (!preview_) return;
  const auto values = preview_->measures[static_cast<std::size_t>(measure())];
  const view::ValueScale scale = scale_of(*preview_, measure());
  histogram_->set_values(*values, scale);
  worst_ = worst_elements(*preview_, measure(), worst_listed);
  double sum = 0.0;
  for (const double value : *values) sum += value;
  figures_->setText(
      tr("Worst %1, mean %2")
          .arg(number((*values)[worst_.front()]), number(sum / static_cast<double>(values->size()))));
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (const std::size_t element : worst_) {
      const Eigen::Vector3f& at = preview_->mesh->centres[element];
      list_->addItem(tr("%1 at (%2, %3, %4) mm")
                         .arg(number((*values)[element]), quantity::length(at.x()), quantity::length(at.y()),
                              quantity::length(at.z())));
    }
  }
  if (!guest_) return;
  guest_->set_values(values, scale);
  guest_->set_highlight({});
  scene_.request_render();
}

void MeshDock::fly_to(int row) {
  if (!guest_ || row < 0 || static_cast<std::size_t>(row) >= worst_.size()) return;
  const std::size_t element = worst_[static_cast<std::size_t>(row)];
  guest_->set_highlight(std::span(&element, 1));
  view::CameraPose pose = scene_.scene().pose();
  pose.target = preview_->mesh->centres[element].cast<double>();
  const auto& lengths = *preview_->measures[static_cast<std::size_t>(ElementMeasure::mean_edge_mm)];
  pose.half_height_mm = elements_seen * lengths[element];
  scene_.go_to(pose);
  scene_.request_render();
}

}  // namespace ostia::workstation
