#include "commands/keyboard.h"

#include "shell/panel.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QCursor>
#include <QDateTime>
#include <QKeyEvent>
#include <QLineEdit>
#include <QTabWidget>
#include <QTextEdit>
#include <QWindow>
#include <algorithm>
#include <array>

namespace ostia::workstation {
namespace {

constexpr int repeat_ms = 120;  // moves closer together than that speed up
constexpr int most_speed = 16;
constexpr double turn_px = 24.0;  // of the tree, as if the mouse had moved so far
constexpr double zoom_step = 1.2;
constexpr const char* tree_window = "QVTKOpenGLWindow";  // the tree is not a widget

bool is_navigation(int key) {
  static constexpr std::array keys{Qt::Key_Up,     Qt::Key_Down,     Qt::Key_Left, Qt::Key_Right,
                                   Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Home, Qt::Key_End,
                                   Qt::Key_Space,  Qt::Key_F2,       Qt::Key_Tab,  Qt::Key_Backtab};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

Keyboard::Keyboard(QWidget* window) : QObject(window), window_(window) {
  qApp->installEventFilter(this);
}

const QStringList& Keyboard::stations() {
  static const QStringList all{"vessels", "measurements", "steps", "cpr1",    "cpr2",
                               "section", "slice",        "tree",  "profile", "lesions"};
  return all;
}

QWidget* Keyboard::station(const QString& name) const {
  auto* found = window_->findChild<QWidget*>(name);
  if (!found || found->focusPolicy() != Qt::NoFocus) return found;
  for (QWidget* child : found->findChildren<QWidget*>())  // the tree's native window has its own container
    if (child->focusPolicy() != Qt::NoFocus) return child;
  return found;
}

int Keyboard::current_station() const {
  const QWindow* native = QGuiApplication::focusWindow();
  if (native && native->inherits(tree_window)) return stations().indexOf("tree");
  const QWidget* focus = QApplication::focusWidget();
  for (int i = 0; i < stations().size(); ++i) {
    const QWidget* one = station(stations()[i]);
    if (one && focus && (one == focus || one->isAncestorOf(focus))) return i;
  }
  return -1;
}

void Keyboard::go_to(const QString& name) {
  QWidget* target = station(name);
  if (!target) return;
  // What is behind another one's tab comes to the front.
  for (QWidget* page = target; page && !target->isVisible(); page = page->parentWidget())
    if (const QWidget* stack = page->parentWidget())
      if (auto* tabs = qobject_cast<QTabWidget*>(stack->parentWidget())) tabs->setCurrentWidget(page);
  if (target->isVisible()) target->setFocus(Qt::ShortcutFocusReason);
}

void Keyboard::go_by(int steps) {
  const int count = stations().size();
  int at = current_station();
  if (at < 0) at = steps > 0 ? -1 : 0;
  for (int tried = 0; tried < count; ++tried) {
    at = (at + steps + count) % count;
    const QWidget* target = station(stations()[at]);
    if (target && target->isVisible()) {
      go_to(stations()[at]);
      return;
    }
  }
}

void Keyboard::maximise_focused() {
  const int now = current_station();
  QWidget* focus = now < 0 ? QApplication::focusWidget() : station(stations()[now]);
  for (QWidget* at = focus; at; at = at->parentWidget())
    if (auto* panel = qobject_cast<Panel*>(at)) {
      emit panel->maximise_wanted();
      if (focus->isVisible()) focus->setFocus(Qt::ShortcutFocusReason);
      return;
    }
}

bool Keyboard::send_mouse(int type, const QPoint& at) {
  QWidget* target = QApplication::widgetAt(at);
  if (!target || target->window() != window_) return false;
  const QPoint local = target->mapFromGlobal(at);
  const auto kind = static_cast<QEvent::Type>(type);
  const Qt::MouseButton button = kind == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton;
  const Qt::MouseButtons buttons =
      kind == QEvent::MouseButtonRelease || !held_ ? Qt::NoButton : Qt::LeftButton;
  // The native window of the tree takes its events itself.
  QObject* receiver = target;
  if (qobject_cast<SceneWidget*>(target->parentWidget()))
    for (QWindow* native : QGuiApplication::allWindows())
      if (native->inherits(tree_window)) receiver = native;
  QMouseEvent event(kind, local, local, at, button, buttons, Qt::NoModifier);
  QApplication::sendEvent(receiver, &event);
  return true;
}

void Keyboard::move_mouse(int right, int down) {
  const qint64 now = QDateTime::currentMSecsSinceEpoch();
  speed_ = now - last_move_ms_ < repeat_ms ? std::min(most_speed, speed_ + 1) : 1;
  last_move_ms_ = now;
  const QPoint at = QCursor::pos() + QPoint(right, down) * speed_;
  QCursor::setPos(at);
  if (held_) send_mouse(QEvent::MouseMove, at);
}

void Keyboard::press_or_release() {
  held_ = !held_;
  if (!send_mouse(held_ ? QEvent::MouseButtonPress : QEvent::MouseButtonRelease, QCursor::pos()))
    held_ = false;
}

bool Keyboard::kept_from_shortcuts(QObject* object, int key, Qt::KeyboardModifiers keys) const {
  if (keys & ~(Qt::ShiftModifier | Qt::KeypadModifier)) return false;
  if (const auto* picture = qobject_cast<PictureWidget*>(object))
    return key == Qt::Key_Escape && const_cast<PictureWidget*>(picture)->pointer().busy();
  if (object->inherits(tree_window)) {
    auto* tree = window_->findChild<SceneWidget*>();
    return key == Qt::Key_Escape && tree && tree->pointer().busy();
  }
  const bool line = qobject_cast<QLineEdit*>(object) || qobject_cast<QAbstractSpinBox*>(object) ||
                    qobject_cast<QTextEdit*>(object);
  if (line) return key <= 0xffff || key == Qt::Key_Escape || key == Qt::Key_Return || key == Qt::Key_Enter;
  if (qobject_cast<QAbstractItemView*>(object) || qobject_cast<QComboBox*>(object)) return is_navigation(key);
  if (qobject_cast<QAbstractButton*>(object)) return key == Qt::Key_Space;
  return false;
}

bool Keyboard::key_for_tree(int key) {
  auto* widget = window_->findChild<SceneWidget*>();
  if (!widget) return false;
  view::TreeScene& scene = widget->scene();
  switch (key) {
    case Qt::Key_Left:
      scene.rotate_by(-turn_px, 0.0);
      break;
    case Qt::Key_Right:
      scene.rotate_by(turn_px, 0.0);
      break;
    case Qt::Key_Up:
      scene.rotate_by(0.0, turn_px);
      break;
    case Qt::Key_Down:
      scene.rotate_by(0.0, -turn_px);
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      scene.zoom_by(zoom_step);
      break;
    case Qt::Key_Minus:
      scene.zoom_by(1.0 / zoom_step);
      break;
    case Qt::Key_0:
      widget->go_to(scene.pose_fitted());
      return true;
    default:
      return false;
  }
  widget->request_render();
  return true;
}

bool Keyboard::key_for_profile(int key) {
  auto* widget = window_->findChild<ProfileWidget*>();
  if (!widget) return false;
  session::Property<double>& cursor = widget->view().bench().cursor_mm;
  const double step = key == Qt::Key_Left || key == Qt::Key_Down  ? -0.5
                      : key == Qt::Key_Right || key == Qt::Key_Up ? 0.5
                      : key == Qt::Key_PageUp                     ? -5.0
                      : key == Qt::Key_PageDown                   ? 5.0
                                                                  : 0.0;
  if (step == 0.0) return false;
  cursor.set(cursor.get() + step);
  return true;
}

bool Keyboard::eventFilter(QObject* object, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (kept_from_shortcuts(object, key->key(), key->modifiers())) {
      key->accept();
      return true;
    }
  } else if (event->type() == QEvent::KeyPress) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->modifiers() & ~(Qt::KeypadModifier | Qt::ShiftModifier)) return false;
    const QWidget* focus = QApplication::focusWidget();
    if (object->isWindowType()
            ? object->inherits(tree_window)
            : focus == object && focus->parent() && qobject_cast<SceneWidget*>(focus->parent()))
      return key_for_tree(key->key());
    if (qobject_cast<ProfileWidget*>(object)) return key_for_profile(key->key());
  }
  return false;
}

}  // namespace ostia::workstation
