#include "qa/walk_player.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "qa/walk_hand.h"
#include "qa/walk_widgets.h"
#include "views/picture_widget.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <QApplication>
#include <QKeyEvent>
#include <QKeySequence>
#include <QLineEdit>
#include <QMainWindow>
#include <QMessageBox>
#include <QPixmap>
#include <QScreen>
#include <QWheelEvent>
#include <QWindow>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int walk_tick_ms = 16;          // a hand's events come no faster
constexpr int walk_rest_ms = 200;         // nothing painted for so long
constexpr int most_walk_ms = 20 * 60000;  // the search of a whole tree on a slow machine ends before
constexpr int most_restless_ms = 5000;    // of a window that goes on painting (a beating heart)
constexpr int walk_beat_ms = 5;

double ms(const QElapsedTimer& clock) {
  return static_cast<double>(clock.nsecsElapsed()) / 1e6;
}

struct CannotWalk {
  QString why;
};

bool is_drawing(QEvent::Type type) {
  return type == QEvent::Paint || type == QEvent::UpdateRequest || type == QEvent::LayoutRequest ||
         type == QEvent::Resize || type == QEvent::Expose;
}

}  // namespace

WalkPlayer::WalkPlayer(Stage stage, std::vector<WalkStep> steps, QObject* parent)
    : QObject(parent), stage_(std::move(stage)), steps_(std::move(steps)) {
  stage_.counts.emplace("blocked_ms", [this] { return longest_block_ms(); });
  stage_.counts.emplace("complaints", [] {
    const auto all = QApplication::topLevelWidgets();
    return static_cast<double>(std::count_if(all.begin(), all.end(), [](QWidget* one) {
      return qobject_cast<QMessageBox*>(one) && one->isVisible();
    }));
  });
  heartbeat_.setInterval(walk_beat_ms);
  heartbeat_.setTimerType(Qt::PreciseTimer);
  connect(&heartbeat_, &QTimer::timeout, this, [this] {
    blocked_ms_ = std::max(blocked_ms_, ms(beat_) - walk_beat_ms);
    beat_.start();
  });
}

WalkPlayer::~WalkPlayer() = default;

double WalkPlayer::longest_block_ms() const {
  double longest = std::max(blocked_ms_, opening_blocked_ms_);
  for (const Done& one : done_) longest = std::max(longest, one.blocked_ms);
  return longest;
}

void WalkPlayer::start() {
  core::write_file(stage_.folder / "walk.csv", {});  // makes the folder, or says why it cannot be written
  qApp->installEventFilter(this);
  for (QElapsedTimer* clock : {&step_clock_, &quiet_, &beat_}) clock->start();
  heartbeat_.start();
  QTimer::singleShot(walk_tick_ms, this, &WalkPlayer::tick);
}

bool WalkPlayer::eventFilter(QObject* object, QEvent* event) {
  // A cursor that blinks in a field is no change.
  if (is_drawing(event->type()) && !qobject_cast<QLineEdit*>(object)) quiet_.start();
  return false;
}

void WalkPlayer::tick() {
  if (ended_) return;
  QTimer::singleShot(walk_tick_ms, this, &WalkPlayer::tick);  // first: what is done now may wait for a dialog
  try {
    if (acts_.empty()) return wait_for_rest();
    const auto act = std::move(acts_.front());
    acts_.pop_front();
    quiet_.start();
    act();
  } catch (const CannotWalk& failed) {
    fail(failed.why);
  } catch (const Error& error) {
    fail(QString::fromStdString(error.what()));
  }
}

void WalkPlayer::wait_for_rest() {
  const bool idle = stage_.idle();
  if (!idle) quiet_.start();
  if (step_clock_.elapsed() > most_walk_ms) throw CannotWalk{"the window does not come to rest"};
  const bool rests = idle && (quiet_.elapsed() >= walk_rest_ms || step_clock_.elapsed() > most_restless_ms);
  if (!rests) return;
  if (doing_) {
    finish_step();
  } else {
    opening_ms_ = ms(step_clock_);
    opening_blocked_ms_ = blocked_ms_;
  }
  if (done_.size() == steps_.size()) return end();
  doing_ = true;
  step_clock_.start();
  blocked_ms_ = 0.0;
  begin(steps_[done_.size()]);
}

void WalkPlayer::finish_step() {
  doing_ = false;
  done_.push_back({steps_[done_.size()], ms(step_clock_), blocked_ms_});
}

void WalkPlayer::begin(const WalkStep& step) {
  using Kind = WalkStep::Kind;
  switch (step.kind) {
    case Kind::command: {
      const Command* command = stage_.commands->find(step.what);
      if (!command) throw CannotWalk{"there is no command " + step.what};
      if (!command->action->isEnabled())
        throw CannotWalk{step.what + " is not enabled. " + CommandTable::why_not(*command)};
      acts_.push_back([action = command->action] { action->trigger(); });
      return;
    }
    case Kind::key:
    case Kind::type:
      return keys(step);
    case Kind::click:
    case Kind::double_click:
    case Kind::drag:
    case Kind::wheel:
      return mouse(step);
    case Kind::go:
      acts_.push_back([this, to = step.world_mm] { stage_.bench->place.set({to[0], to[1], to[2]}); });
      return;
    case Kind::file:
      return answer_file_dialog(step);
    case Kind::look:
      return look(step.what);
    case Kind::expect:
      return expect(step);
  }
}

QWidget& WalkPlayer::widget(const QString& name) const {
  QWidget* found = walk_widget(name);
  if (!found) throw CannotWalk{"there is no " + name + " to be seen"};
  const QWidget* front = QApplication::activeModalWidget();
  if (front && found->window() != front && !front->isAncestorOf(found))
    throw CannotWalk{name + " is behind a dialog: " + front->windowTitle()};
  return *found;
}

QPointF WalkPlayer::on_picture(const WalkPlace& place, PictureWidget& picture) const {
  view::PictureView& view = picture.view();
  auto shown = view.ready() ? view.project(stage_.bench->place.get()) : std::nullopt;
  if (!shown) throw CannotWalk{picture.objectName() + " does not show the cursor"};
  view::Vec2 px = shown->px;
  if (place.of == WalkPlace::Of::wall) {
    const auto wall = wall_right_of(view, px);
    if (!wall) throw CannotWalk{picture.objectName() + " shows no wall right of the cursor"};
    px = *wall;
  }
  return QPointF(px.x(), px.y()) / picture.devicePixelRatioF();
}

QPointF WalkPlayer::at(const WalkPlace& place, QWidget& widget) const {
  if (place.of == WalkPlace::Of::widget)
    return QPointF(place.part.x() * widget.width(), place.part.y() * widget.height()) + place.beside;
  auto* picture = qobject_cast<PictureWidget*>(&widget);
  if (!picture) throw CannotWalk{widget.objectName() + " is no view of the image"};
  return on_picture(place, *picture) + place.beside;
}

void WalkPlayer::mouse(const WalkStep& step) {
  QWidget* const on = &widget(step.what);
  std::vector<QPointF> places;
  for (const WalkPlace& place : step.places) places.push_back(at(place, *on));
  const auto send = [this, name = step.what, step](QEvent::Type type, QPointF to, Qt::MouseButtons down) {
    acts_.push_back([this, name, step, type, to, down] { send_mouse(widget(name), type, to, step, down); });
  };
  send(QEvent::MouseMove, places.front(), Qt::NoButton);
  if (step.kind == WalkStep::Kind::wheel) {
    acts_.push_back([this, step, to = places.front()] {
      QWidget& under = widget(step.what);
      const int turned = static_cast<int>(std::lround(step.number * walk_notch));
      QWheelEvent event(to, under.mapToGlobal(to.toPoint()), {}, {0, turned}, Qt::NoButton, step.held,
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&under, &event);
    });
    return;
  }
  send(QEvent::MouseButtonPress, places.front(), step.button);
  for (const QPointF& to : way_through(places)) send(QEvent::MouseMove, to, step.button);
  send(QEvent::MouseButtonRelease, places.back(), Qt::NoButton);
  if (step.kind != WalkStep::Kind::double_click) return;
  send(QEvent::MouseButtonDblClick, places.back(), step.button);
  send(QEvent::MouseButtonRelease, places.back(), Qt::NoButton);
}

void WalkPlayer::keys(const WalkStep& step) {
  const auto send = [this, name = step.what](int key, Qt::KeyboardModifiers held, const QString& text) {
    acts_.push_back([this, name, key, held, text] {
      QWidget& on = widget(name);
      on.setFocus();
      for (const QEvent::Type type : {QEvent::KeyPress, QEvent::KeyRelease}) {
        QKeyEvent event(type, key, held, text);
        QApplication::sendEvent(&on, &event);
      }
    });
  };
  if (step.kind == WalkStep::Kind::type) {
    for (const QChar letter : step.text) send(letter.toUpper().unicode(), Qt::NoModifier, letter);
    return;
  }
  const int all = QKeySequence(step.text)[0];
  const int key = all & ~static_cast<int>(Qt::KeyboardModifierMask);
  send(key, Qt::KeyboardModifiers(all & static_cast<int>(Qt::KeyboardModifierMask)),
       key < 0x80 ? QString(QChar(key)) : QString());
}

void WalkPlayer::answer_file_dialog(const WalkStep& step) {
  QWidget* dialog = QApplication::activeModalWidget();
  if (!dialog || !dialog->inherits("QFileDialog")) throw CannotWalk{"there is no file dialog to answer"};
  acts_.push_back(
      [dialog, path = QString::fromStdString((stage_.folder / step.what.toStdString()).string())] {
        dialog->findChild<QLineEdit*>()->setText(path);
        QMetaObject::invokeMethod(dialog, "accept");
      });
}

/// Dialogs in front of the window are in its picture, and whose image it is where the views show it.
void WalkPlayer::look(const QString& name) {
  const QWidget& window = *stage_.window;
  const QPoint at = window.mapToGlobal(QPoint(0, 0));  // without the frame, whose title names the patient
  const QPixmap picture = window.screen()->grabWindow(0, at.x(), at.y(), window.width(), window.height());
  const std::filesystem::path file = stage_.folder / (name + ".png").toStdString();
  if (!picture.save(QString::fromStdString(file.string()), "PNG"))
    throw IoError("the picture " + file.filename().string() + " cannot be written");
  beat_.start();  // the time that this took is the walk's own
}

void WalkPlayer::expect(const WalkStep& step) {
  const auto found = stage_.counts.find(step.what);
  if (found == stage_.counts.end()) {
    QStringList known;
    for (const auto& [name, count] : stage_.counts) known << name;
    throw CannotWalk{"nothing counts " + step.what + "; known are " + known.join(", ")};
  }
  const double is = found->second();
  const bool so = step.text == "="    ? is == step.number
                  : step.text == "<=" ? is <= step.number
                                      : is >= step.number;
  if (!so)
    throw CannotWalk{
        QStringLiteral("%1 is %2, not %3 %4").arg(step.what).arg(is).arg(step.text).arg(step.number)};
}

void WalkPlayer::fail(const QString& why) {
  const int line = done_.size() < steps_.size() ? steps_[done_.size()].line : 0;
  failure_ = QStringLiteral("line %1: %2").arg(line).arg(why);
  end();
}

void WalkPlayer::end() {
  ended_ = true;
  heartbeat_.stop();
  qApp->removeEventFilter(this);
  std::string table = core::csv_line({"line", "step", "ms", "blocked_ms"});
  const auto add = [&table](int line, const std::string& step, double took_ms, double blocked_ms) {
    table += core::csv_line({std::to_string(line), step, QString::number(took_ms, 'f', 1).toStdString(),
                             QString::number(blocked_ms, 'f', 1).toStdString()});
  };
  add(0, "opening", opening_ms_, opening_blocked_ms_);
  for (const Done& one : done_) add(one.step.line, walk_line(one.step).toStdString(), one.ms, one.blocked_ms);
  try {
    core::write_file(stage_.folder / "walk.csv", table);
  } catch (const Error& error) {
    if (failure_.isEmpty()) failure_ = QString::fromStdString(error.what());
  }
  emit ended();
}

}  // namespace ostia::workstation
