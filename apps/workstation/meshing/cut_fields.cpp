#include "meshing/cut_fields.h"

#include "meshing/cut_handle.h"
#include "meshing/dock.h"
#include "views/scene_drag.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr int slider_steps = 1000;
constexpr double vessel_frame_radii = 5.0;  // the frame's side about a vessel

}  // namespace

CutFields::CutFields(QFormLayout* form, session::Workbench& bench, SceneWidget& scene, QObject* parent)
    : QObject(parent), bench_(bench), scene_(scene) {
  cut_ = new QComboBox;
  cut_->setObjectName("mesh_cut");
  cut_->setAccessibleName(MeshDock::tr("How the mesh is cut open"));
  cut_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  cut_->view()->setAccessibleName(cut_->accessibleName());
  for (const auto& [text, by] : {std::pair(MeshDock::tr("not at all"), CutBy::none),
                                 {MeshDock::tr("across the selected vessel"), CutBy::vessel},
                                 {MeshDock::tr("left and right"), CutBy::left_right},
                                 {MeshDock::tr("front and back"), CutBy::front_back},
                                 {MeshDock::tr("head and feet"), CutBy::head_feet},
                                 {MeshDock::tr("towards the viewer"), CutBy::view}})
    cut_->addItem(text, static_cast<int>(by));
  cut_->setToolTip(tr("The plane can be dragged in 3D by its frame and its arrow."));
  place_ = new QSlider(Qt::Horizontal);
  place_->setObjectName("mesh_cut_place");
  place_->setAccessibleName(MeshDock::tr("Place of the cut"));
  place_->setRange(0, slider_steps);
  place_->setPageStep(slider_steps / 20);
  place_->setSingleStep(slider_steps / 200);
  place_->setValue(slider_steps / 2);
  turned_ = new QCheckBox(MeshDock::tr("The &other side"));
  turned_->setObjectName("mesh_cut_turned");
  auto* label = new QLabel(MeshDock::tr("C&ut"));
  label->setBuddy(cut_);
  form->addRow(label, cut_);
  form->addRow(place_);
  form->addRow(turned_);
  soon_.setSingleShot(true);
  soon_.setInterval(0);
  const auto again = QOverload<>::of(&QTimer::start);
  connect(&soon_, &QTimer::timeout, this, &CutFields::show);
  connect(cut_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &CutFields::choose_direction);
  connect(cut_, QOverload<int>::of(&QComboBox::activated), this, &CutFields::choose_direction);
  connect(place_, &QSlider::valueChanged, &soon_, again);
  connect(turned_, &QCheckBox::toggled, &soon_, again);
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) { soon_.start(); }));
  scene_.set_grip(this);
}

CutFields::CutBy CutFields::by() const {
  return static_cast<CutBy>(cut_->currentData().toInt());
}

void CutFields::set_guest(std::shared_ptr<view::MeshScene> guest, const geometry::Box3& box) {
  guest_ = std::move(guest);
  box_ = box;
  taken_.reset();
  show();
}

void CutFields::leave_whole() {
  const QSignalBlocker quiet(cut_);
  cut_->setCurrentIndex(0);
}

/// Also where the same is chosen again, after the tree was turned.
void CutFields::choose_direction() {
  towards_ = scene_.scene().pose().towards;
  soon_.start();
}

std::optional<view::MeshCut> CutFields::cut() const {
  if (by() == CutBy::none || !guest_) return {};
  const double share = static_cast<double>(place_->value()) / slider_steps;
  view::MeshCut cut;
  if (by() == CutBy::vessel) {
    const auto axis = bench_.axis();
    if (!axis) return {};
    cut.point = axis->point(share * axis->length());
    cut.normal = axis->frame(share * axis->length()).tangent;
  } else {
    cut.normal = by() == CutBy::left_right   ? Vec3(Vec3::UnitX())
                 : by() == CutBy::front_back ? Vec3(-Vec3::UnitY())
                 : by() == CutBy::head_feet  ? Vec3(Vec3::UnitZ())
                                             : towards_;
    cut.point = box_.center() + (share - 0.5) * way_mm() * cut.normal;
  }
  if (turned_->isChecked()) cut.normal = -cut.normal;
  return cut;
}

double CutFields::way_mm() const {
  if (by() == CutBy::vessel) return bench_.axis() ? bench_.axis()->length() : 0.0;
  const Vec3 along = by() == CutBy::left_right   ? Vec3(Vec3::UnitX())
                     : by() == CutBy::front_back ? Vec3(Vec3::UnitY())
                     : by() == CutBy::head_feet  ? Vec3(Vec3::UnitZ())
                                                 : towards_;
  return along.cwiseAbs().dot(box_.sizes());
}

Vec3 CutFields::frame_sizes() const {
  const auto axis = bench_.axis();
  if (by() != CutBy::vessel || !axis) return box_.sizes();
  const double s = axis->length() * place_->value() / slider_steps;
  return Vec3::Constant(vessel_frame_radii * axis->radius(s));
}

void CutFields::show() {
  place_->setEnabled(by() != CutBy::none);
  turned_->setEnabled(by() != CutBy::none);
  handle_.clear();
  if (!guest_) return;
  const std::optional<view::MeshCut> now = cut();
  if (now) handle_ = cut_handle(*now, frame_sizes());
  guest_->set_cut(now);
  guest_->set_handle(handle_);
  scene_.request_render();
}

bool CutFields::under(const Vec2& display) const {
  return !handle_.empty() && near_lines(scene_.scene(), handle_, display);
}

void CutFields::take(const Vec2& display) {
  if (const auto now = cut()) taken_ = Taken{display, *now, place_->value()};
}

void CutFields::drag(const Vec2& display) {
  const double way = way_mm();
  if (!taken_ || way <= 0.0) return;
  const double mm = dragged_mm(scene_.scene(), taken_->cut.point, taken_->cut.normal, taken_->at, display);
  const double turned = turned_->isChecked() ? -1.0 : 1.0;  // the slider goes by the normal before that
  place_->setValue(taken_->place + static_cast<int>(std::lround(turned * mm / way * slider_steps)));
}

void CutFields::put_back() {
  if (const auto was = std::exchange(taken_, std::nullopt)) place_->setValue(was->place);
}

}  // namespace ostia::workstation
