// What the mouse and keys do in the 3D view.

#include "views/frame_log.h"
#include "views/hand_events.h"
#include "views/scene_widget.h"

#include <QVTKOpenGLWindow.h>

#include <QCursor>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr double click_px = 3.0;

Qt::CursorShape cursor_over(const SceneGrip& grip) {
  return grip.draws() ? Qt::CrossCursor : Qt::SizeAllCursor;
}

}  // namespace

geometry::Vec2 SceneWidget::display(const QPointF& at) const {
  const double ratio = devicePixelRatioF();
  return {at.x() * ratio, (container_->height() - at.y()) * ratio};
}

view::PointerEvent SceneWidget::pointer_event(const QPointF& at, Qt::MouseButton button,
                                              Qt::KeyboardModifiers keys) const {
  view::PointerEvent event = hand_event(button, keys);
  event.px = display(at);
  return event;
}

void SceneWidget::hand(const std::function<void()>& act) {
  guard_(act);
  window_->setCursor(gripped_ && grip_ ? cursor_over(*grip_) : cursor_of(pointer_->shape()));
}

/// The button went up unseen: no more is done, and no click comes of it.
void SceneWidget::let_go() {
  buttons_ = Qt::NoButton;
  if (gripped_ && grip_->draws()) grip_->put_back();
  holding_ = gripped_ = false;
  scene_->set_interacting(false);
  hand([&] { pointer_->let_go(); });
  request_render();
}

void SceneWidget::mouse_pressed(const QMouseEvent& event) {
  if (buttons_ != Qt::NoButton && button_.lost(event)) let_go();
  if (gripped_) {  // of another button meanwhile
    buttons_ = event.buttons();
    return;
  }
  if (buttons_ == Qt::NoButton) button_.pressed(event);
  pressed_ = last_ = event.localPos();
  buttons_ = event.buttons();
  moved_ = false;
  refining_.stop();
  container_->setFocus(Qt::MouseFocusReason);
  gripped_ = event.button() == Qt::LeftButton && event.buttons() == Qt::LeftButton &&
             !(event.modifiers() & Qt::ShiftModifier) && grip_ && grip_->under(display(event.localPos()));
  if (gripped_) {
    holding_ = true;
    grip_->take(display(event.localPos()));
    hand([] {});
    return;
  }
  hand([&] {
    holding_ = pointer_->press(pointer_event(event.localPos(), event.button(), event.modifiers()));
  });
}

void SceneWidget::mouse_moved(const QMouseEvent& event) {
  if (buttons_ != Qt::NoButton && button_.lost(event)) let_go();
  const bool camera = event.buttons() != Qt::NoButton && !holding_;
  if (holding_) FrameLog::instance().event("tree");
  if (gripped_) {
    grip_->drag(display(event.localPos()));
    return;
  }
  hand([&] { pointer_->move(pointer_event(event.localPos(), Qt::NoButton, event.modifiers())); });
  if (event.buttons() == Qt::NoButton && grip_ && grip_->under(display(event.localPos())))
    window_->setCursor(cursor_over(*grip_));
  if (camera) turn_camera(event);
  if (event.buttons() == Qt::NoButton) emit pointed(display(event.localPos()));
}

void SceneWidget::turn_camera(const QMouseEvent& event) {
  if (!moved_ && (event.localPos() - pressed_).manhattanLength() < click_px) return;
  if (!moved_) scene_->set_interacting(true);
  moved_ = true;
  FrameLog::instance().event("tree");
  const double ratio = devicePixelRatioF();
  const double right = (event.localPos().x() - last_.x()) * ratio,
               up = (last_.y() - event.localPos().y()) * ratio;
  if (event.buttons() & Qt::RightButton)
    scene_->zoom_by(std::pow(1.01, up / ratio));
  else if ((event.buttons() & Qt::MiddleButton) || (event.modifiers() & Qt::ShiftModifier))
    scene_->pan_by(right, up);
  else
    scene_->rotate_by(right, up);
  last_ = event.localPos();
  request_render();
}

void SceneWidget::mouse_released(const QMouseEvent& event) {
  buttons_ = event.buttons();
  if (gripped_ && event.button() != Qt::LeftButton) return;  // of another button meanwhile
  if (gripped_) guard_([this] { grip_->let_go(); });
  holding_ = gripped_ = false;
  scene_->set_interacting(false);
  hand([&] { pointer_->release(pointer_event(event.localPos(), event.button(), event.modifiers())); });
  request_render();
}

bool SceneWidget::key_pressed(int key) {
  if (key == Qt::Key_Escape && gripped_) {
    gripped_ = false;  // what is moved until the button goes up moves nothing
    grip_->put_back();
    return true;
  }
  if (key == Qt::Key_Escape && grip_ && grip_->draws()) {
    grip_->put_back();
    return true;
  }
  if (key == Qt::Key_Escape && pointer_->busy()) {
    hand([&] { pointer_->cancel(); });
    return true;
  }
  if (key != Qt::Key_Delete && key != Qt::Key_Backspace) return false;
  hand([&] {
    pointer_->erase(pointer_event(container_->mapFromGlobal(QCursor::pos()), Qt::NoButton, Qt::NoModifier));
  });
  return true;
}

bool SceneWidget::eventFilter(QObject* object, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && (object == window_ || object == container_) && grip_ &&
      (gripped_ || grip_->draws()) && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();  // it comes as a key, and not as a command's
    return true;
  }
  if (event->type() == QEvent::KeyPress && (object == window_ || object == container_) &&
      key_pressed(static_cast<QKeyEvent*>(event)->key()))
    return true;
  if (object != window_) return QWidget::eventFilter(object, event);
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      mouse_pressed(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseMove:
      mouse_moved(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonRelease:
      mouse_released(*static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonDblClick:
      if (!session::measure_kind(bench_.tool.get())) go_to(scene_->pose_fitted());
      return true;
    case QEvent::WindowBlocked:  // by a dialog, which takes the releases from now on
      if (buttons_ != Qt::NoButton) let_go();
      return QWidget::eventFilter(object, event);
    case QEvent::Leave:
      hand([&] { pointer_->leave(); });
      emit left();
      return true;
    case QEvent::Wheel: {
      const auto* wheel = static_cast<QWheelEvent*>(event);
      scene_->zoom_by(std::pow(1.2, wheel->angleDelta().y() / 120.0), display(wheel->position()));
      request_render();
      return true;
    }
    default:
      return QWidget::eventFilter(object, event);
  }
}

}  // namespace ostia::workstation
