#include "qa/walk_recorder.h"

#include "commands/table.h"
#include "qa/walk_widgets.h"

#include "ostia/core/error.h"

#include <QApplication>
#include <QKeyEvent>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>
#include <QMouseEvent>
#include <QToolButton>
#include <QWheelEvent>
#include <fstream>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr double still_px = 3.0;  // a click that trembles

/// What runs commands: they are written down as such.
bool runs_commands(const QWidget& widget) {
  const auto* button = qobject_cast<const QToolButton*>(&widget);
  return qobject_cast<const QMenu*>(&widget) || qobject_cast<const QMenuBar*>(&widget) ||
         (button && button->defaultAction() && !button->defaultAction()->objectName().isEmpty());
}

}  // namespace

WalkRecorder::WalkRecorder(const CommandTable& commands, std::filesystem::path file, QObject* parent)
    : QObject(parent), file_(std::move(file)) {
  std::ofstream begun(file_, std::ios::trunc);
  begun << "# A walk through the window of ostia-workstation.\n";
  if (!begun.flush()) throw IoError("the walk " + file_.filename().string() + " cannot be written");
  qApp->installEventFilter(this);
  for (const Command& one : commands.all())
    connect(one.action, &QAction::triggered, this, [this, id = one.id] {
      WalkStep step;
      step.kind = WalkStep::Kind::command;
      step.what = id;
      write(step);
    });
}

WalkRecorder::~WalkRecorder() {
  write_typed();
}

bool WalkRecorder::eventFilter(QObject* object, QEvent* event) {
  auto* widget = qobject_cast<QWidget*>(object);
  if (!widget || runs_commands(*widget)) return false;
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
      mouse(*widget, static_cast<const QMouseEvent&>(*event));
      break;
    case QEvent::Wheel: {
      const auto& wheel = static_cast<const QWheelEvent&>(*event);
      WalkStep step;
      step.kind = WalkStep::Kind::wheel;
      step.what = walk_name(*widget);
      step.places << place(*widget, wheel.position());
      step.number = wheel.angleDelta().y() / walk_notch;
      step.held = wheel.modifiers();
      if (step.number != 0.0 && widget->objectName() != "qt_scrollarea_viewport") write(step);
      break;
    }
    case QEvent::KeyPress:
      key(*widget, static_cast<const QKeyEvent&>(*event));
      break;
    default:
      break;
  }
  return false;
}

WalkPlace WalkRecorder::place(const QWidget& widget, const QPointF& at) {
  WalkPlace place;
  place.part = {at.x() / widget.width(), at.y() / widget.height()};
  return place;
}

void WalkRecorder::mouse(QWidget& widget, const QMouseEvent& event) {
  const WalkPlace here = place(widget, event.localPos());
  if (event.type() == QEvent::MouseButtonPress || event.type() == QEvent::MouseButtonDblClick) {
    if (holding_ && widget.isAncestorOf(holding_)) return;  // the same press, offered to the parent
    if (holding_) write(gesture_);                          // a menu took its release
    gesture_ = {};
    gesture_.kind =
        event.type() == QEvent::MouseButtonPress ? WalkStep::Kind::click : WalkStep::Kind::double_click;
    gesture_.what = walk_name(widget);
    if (gesture_.kind == WalkStep::Kind::double_click && clicked_ && clicked_->what == gesture_.what)
      clicked_.reset();
    gesture_.button = event.button();
    gesture_.held = event.modifiers();
    gesture_.places << here;
    holding_ = &widget;
    return;
  }
  if (holding_ != &widget) return;
  const QPointF first(gesture_.places.front().part.x() * widget.width(),
                      gesture_.places.front().part.y() * widget.height());
  const bool moved =
      gesture_.kind == WalkStep::Kind::drag || (event.localPos() - first).manhattanLength() > still_px;
  if (moved && gesture_.kind == WalkStep::Kind::click) gesture_.kind = WalkStep::Kind::drag;
  if (moved && gesture_.kind == WalkStep::Kind::drag) gesture_.places << here;
  if (event.type() != QEvent::MouseButtonRelease) return;
  holding_ = nullptr;
  if (gesture_.kind != WalkStep::Kind::click) return write(gesture_);
  write_typed();
  clicked_ = gesture_;
}

void WalkRecorder::key(const QWidget& widget, const QKeyEvent& event) {
  if (&widget != QApplication::focusWidget()) return;  // the same press, offered to the parent
  const int key = event.key();
  if (key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt || key == Qt::Key_Meta || key <= 0)
    return;
  const QString name = walk_name(widget), text = event.text();
  const bool is_letter = text.size() == 1 && text[0].isPrint() &&
                         (!text[0].isSpace() || !typed_.text.isEmpty()) &&
                         !(event.modifiers() & (Qt::ControlModifier | Qt::AltModifier));
  if (is_letter) {
    if (typed_.what != name) write_typed();
    typed_.kind = WalkStep::Kind::type;
    typed_.what = name;
    typed_.text += text;
    return;
  }
  WalkStep step;
  step.kind = WalkStep::Kind::key;
  step.what = name;
  step.text = QKeySequence(static_cast<int>(event.modifiers() & ~Qt::KeypadModifier) | key)
                  .toString(QKeySequence::PortableText);
  write(step);
}

void WalkRecorder::write_typed() {
  if (const auto clicked = std::exchange(clicked_, std::nullopt)) write(*clicked);
  const WalkStep typed = std::exchange(typed_, {});
  if (!typed.text.isEmpty()) write(typed);
}

void WalkRecorder::write(const WalkStep& step) {
  write_typed();
  std::ofstream(file_, std::ios::app) << walk_line(step).toStdString() << '\n' << std::flush;
}

}  // namespace ostia::workstation
