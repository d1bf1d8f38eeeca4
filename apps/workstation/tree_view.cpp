#include "tree_view.h"

#include <QMouseEvent>
#include <QOpenGLShaderProgram>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

using geometry::Vec3;

constexpr double half_height = 0.2679491924311227;  // tan(15 degrees): the view is 30 degrees high
constexpr double click_px = 4.0;
constexpr double reach_px = 3.0;  // a click this far beside a vessel still takes it

}  // namespace

TreeView::TreeView(std::shared_ptr<const geometry::VesselGraph> graph,
                   std::shared_ptr<const analysis::TreeRays> rays, QWidget* parent)
    : QOpenGLWidget(parent), graph_(std::move(graph)), rays_(std::move(rays)) {
  QSurfaceFormat wanted = QSurfaceFormat::defaultFormat();
  wanted.setVersion(3, 3);
  wanted.setProfile(QSurfaceFormat::CoreProfile);
  wanted.setDepthBufferSize(24);
  setFormat(wanted);
  setObjectName("tree_view");
  setAccessibleName(tr("Vessel tree"));
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(200, 150);
  bool any = false;
  for (const Vec3& p : graph_->points) {
    if (!p.allFinite()) continue;
    low_ = any ? Vec3(low_.cwiseMin(p)) : p;
    high_ = any ? Vec3(high_.cwiseMax(p)) : p;
    any = true;
  }
  if (!any) low_ = high_ = Vec3::Zero();
  fit();
}

void TreeView::fit() {
  target_ = 0.5 * (low_ + high_);
  distance_ = std::max(1e-6, 0.55 * (high_ - low_).norm()) / half_height;
  update();
}

void TreeView::set_grid(bool shown) {
  grid_ = shown;
  update();
}

void TreeView::set_highlight(std::int32_t edge) {
  highlight_ = edge;
  update();
}

void TreeView::set_marks(std::vector<TreeMark> marks) {
  marks_ = std::move(marks);
  update();
}

void TreeView::set_shown(std::vector<std::uint8_t> shown) {
  shown_ = std::move(shown);
  stale_ = true;
  update();
}

double TreeView::pixel_mm() const {
  return 2.0 * half_height * distance_ / std::max(1, height());
}

std::optional<analysis::TreeRayHit> TreeView::under(const QPointF& place) const {
  const double unit = 2.0 * half_height / std::max(1, height());
  const double x = (place.x() - 0.5 * width()) * unit, y = (0.5 * height() - place.y()) * unit;
  return rays_->first({eye(), x * right_ + y * up_ - back_, reach_px * unit}, shown_);
}

std::optional<QPointF> TreeView::place_of(const Vec3& point) const {
  const Vec3 seen = point - eye();
  const double depth = -seen.dot(back_);
  if (!(depth > 1e-9 * distance_)) return std::nullopt;
  const double unit = 2.0 * half_height / std::max(1, height()) * depth;
  return QPointF(0.5 * width() + seen.dot(right_) / unit, 0.5 * height() - seen.dot(up_) / unit);
}

void TreeView::turn(const QPointF& by) {
  const double step = 0.008;
  const auto about = [this](const Vec3& axis, double angle) {
    const Eigen::AngleAxisd rotation(angle, axis);
    right_ = (rotation * right_).normalized();
    back_ = rotation * back_;
    back_ = (back_ - back_.dot(right_) * right_).normalized();
    up_ = back_.cross(right_);
  };
  about(Vec3(up_), -step * by.x());
  about(Vec3(right_), -step * by.y());
  update();
}

void TreeView::move(const QPointF& by) {
  target_ += pixel_mm() * (-by.x() * right_ + by.y() * up_);
  update();
}

void TreeView::nearer(double factor) {
  const double size = std::max(1e-6, (high_ - low_).norm());
  distance_ = std::clamp(distance_ * factor, 1e-5 * size, 100.0 * size);
  update();
}

void TreeView::mousePressEvent(QMouseEvent* event) {
  pressed_ = last_ = event->localPos();
  moved_ = false;
}

void TreeView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF by = event->localPos() - last_;
  if (!moved_ && (event->localPos() - pressed_).manhattanLength() < click_px) return;
  moved_ = true;
  last_ = event->localPos();
  if (event->buttons() & Qt::RightButton)
    nearer(std::exp(0.01 * by.y()));
  else if (event->buttons() & Qt::MiddleButton || event->modifiers() & Qt::ShiftModifier)
    move(by);
  else if (event->buttons() & Qt::LeftButton)
    turn(by);
}

void TreeView::mouseReleaseEvent(QMouseEvent* event) {
  if (!moved_ && event->button() == Qt::LeftButton) emit clicked(event->localPos());
}

void TreeView::wheelEvent(QWheelEvent* event) {
  nearer(std::exp(-0.0015 * event->angleDelta().y()));
  event->accept();
}

}  // namespace ostia::workstation
