#include "trees/view.h"

#include "views/frame_log.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

using geometry::Vec3;

constexpr double tree_click_px = 4.0;
constexpr double reach_px = 3.0;  // a click this far beside a vessel still takes it

}  // namespace

TreeView::TreeView(std::shared_ptr<const geometry::SegmentBlocks> blocks,
                   std::shared_ptr<const analysis::TreeRays> rays, QWidget* parent)
    : QOpenGLWidget(parent),
      blocks_(std::move(blocks)),
      rays_(std::move(rays)),
      low_(blocks_->low()),
      high_(blocks_->high()) {
  QSurfaceFormat wanted = QSurfaceFormat::defaultFormat();
  wanted.setVersion(3, 3);
  wanted.setProfile(QSurfaceFormat::CoreProfile);
  wanted.setDepthBufferSize(24);
  setFormat(wanted);
  setObjectName("tree_view");
  setAccessibleName(tr("Vessel tree"));
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(200, 150);
  fit();
}

void TreeView::fit() {
  eye_ = glview::fitted(eye_, low_, high_);
  update();
}

void TreeView::resizeGL(int, int) {
  eye_.width_px = std::max(1, width());
  eye_.height_px = std::max(1, height());
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
  update();
}

std::optional<analysis::TreeRayHit> TreeView::under(const QPointF& place) const {
  const glview::CameraRay ray = eye_.ray({place.x(), place.y()});
  return rays_->first({ray.origin, ray.direction, reach_px * ray.pixel}, shown_);
}

std::optional<QPointF> TreeView::place_of(const Vec3& point) const {
  const auto place = eye_.place_of(point);
  return place ? std::optional(QPointF(place->x(), place->y())) : std::nullopt;
}

void TreeView::nearer(double factor, const std::optional<QPointF>& at) {
  const double size = std::max(1e-6, (high_ - low_).norm());
  const double wanted = std::clamp(eye_.distance_mm * factor, 1e-5 * size, 100.0 * size);
  eye_ = glview::nearer(eye_, wanted / eye_.distance_mm,
                        at ? std::optional(geometry::Vec2(at->x(), at->y())) : std::nullopt);
  update();
}

void TreeView::mousePressEvent(QMouseEvent* event) {
  FrameLog::instance().event("press");
  pressed_ = last_ = event->localPos();
  moved_ = false;
}

void TreeView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF by = event->localPos() - last_;
  if (!moved_ && (event->localPos() - pressed_).manhattanLength() < tree_click_px) return;
  moved_ = true;
  FrameLog::instance().event("drag");
  last_ = event->localPos();
  if (event->buttons() & Qt::RightButton)
    nearer(std::exp(0.01 * by.y()), {});
  else if (event->buttons() & Qt::MiddleButton || event->modifiers() & Qt::ShiftModifier)
    eye_ = glview::moved(eye_, {by.x(), by.y()});
  else if (event->buttons() & Qt::LeftButton)
    eye_ = glview::turned(eye_, {by.x(), by.y()});
  update();
}

void TreeView::mouseReleaseEvent(QMouseEvent* event) {
  if (!moved_ && event->button() == Qt::LeftButton) emit clicked(event->localPos());
}

void TreeView::wheelEvent(QWheelEvent* event) {
  FrameLog::instance().event("wheel");
  nearer(std::exp(-0.0015 * event->angleDelta().y()), event->position());
  event->accept();
}

}  // namespace ostia::workstation
