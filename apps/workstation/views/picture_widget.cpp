#include "views/picture_widget.h"

#include "shell/identity.h"
#include "shell/quantities.h"
#include "views/corner_texts.h"
#include "views/frame_log.h"
#include "views/hand_events.h"
#include "views/overlay_painter.h"
#include "views/paint_queue.h"

#include <QCursor>
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QTimer>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int fade_ms = 40;
constexpr int rest_ms = 150;        // without a new picture until a coarse one is made anew
constexpr int grey_told_ms = 4000;  // after its last change

double milliseconds(const QElapsedTimer& clock) {
  return static_cast<double>(clock.nsecsElapsed()) / 1e6;
}

void tell_frame(const QWidget& view, double paint_ms, std::optional<std::uint64_t> picture = {}) {
  FrameLog& log = FrameLog::instance();
  if (!log.on()) return;
  log.placed(view.objectName(), QRect(view.mapToGlobal(QPoint(0, 0)), view.size()));
  log.painted(view.objectName(), paint_ms, picture);
}

/// Where only a part that was uncovered is painted, the whole view still waits.
void leave_queue(QWidget& view, const QPaintEvent& event) {
  if (QRegion(view.rect()).subtracted(event.region()).isEmpty()) PaintQueue::instance().remove(&view);
}

QFont overlay_font(const QFont& base, double density) {
  QFont font = base;
  font.setPixelSize(static_cast<int>(12.0 * density + 0.5));
  return font;
}

}  // namespace

PictureWidget::PictureWidget(std::unique_ptr<view::PictureView> view, const QString& name, Guard guard,
                             QWidget* parent)
    : QWidget(parent),
      view_(std::move(view)),
      pointer_(std::make_unique<view::Pointer>(*view_)),
      guard_(std::move(guard)) {
  setObjectName(name);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(name);
  // The view under the hand is painted as soon as the event is handled, the others when no event waits.
  stale_ = view_->stale.observe([this] { request_paint(); });
  grey_ = view_->bench().grey.observe([this](const session::GreyWindow&) {
    grey_told_.start();
    request_paint();
  });
  grey_told_.setSingleShot(true);
  grey_told_.setInterval(grey_told_ms);
  grey_told_.setObjectName("grey_told");
  connect(&grey_told_, &QTimer::timeout, this, [this] { update(); });
  view_->allow_drafts();
  rest_.setSingleShot(true);
  rest_.setInterval(rest_ms);
  connect(&rest_, &QTimer::timeout, this, [this] {
    guard_([&] { view_->refine(); });
    if (!underMouse()) return;
    const QPointF at = QPointF(mapFromGlobal(QCursor::pos())) * devicePixelRatioF();
    tell_place({at.x(), at.y()});
  });
}
PictureWidget::~PictureWidget() = default;

void PictureWidget::resizeEvent(QResizeEvent*) {
  take_size();
}

void PictureWidget::take_size() {
  const double density = devicePixelRatioF();
  view_->set_size(static_cast<int>(width() * density + 0.5), static_cast<int>(height() * density + 0.5),
                  density);
}

void PictureWidget::paintEvent(QPaintEvent* event) {
  leave_queue(*this, *event);
  QElapsedTimer clock;
  clock.start();
  const double density = devicePixelRatioF();
  QPainter painter(this);
  painter.scale(1.0 / density, 1.0 / density);
  const QRectF all(0, 0, width() * density, height() * density);
  painter.save();
  if (std::abs(view_->width() - all.width()) > 1.0 || std::abs(view_->height() - all.height()) > 1.0) {
    // A replay has the sizes of another window: all of it is shown, smaller or larger.
    const double fits = std::min(all.width() / view_->width(), all.height() / view_->height());
    painter.fillRect(all, QColor(12, 13, 15));
    if (std::isfinite(fits)) painter.scale(fits, fits);
  }
  bool made_now = false;
  guard_([&] {
    const view::GreyImage& image = view_->image();
    const session::GreyWindow window = view_->bench().grey.get();
    if (revision_ != view_->image_revision() || !(window == painted_window_)) {
      picture_ = grey_picture(image, window, std::move(picture_));
      made_now = revision_ != view_->image_revision();
      revision_ = view_->image_revision();
      painted_window_ = window;
    }
    if (picture_.isNull())
      painter.fillRect(all, QColor(12, 13, 15));
    else
      painter.drawImage(QPointF(0, 0), picture_);
    painter.setFont(overlay_font(font(), density));
    const QSizeF size(view_->width(), view_->height());
    texts_ = paint_overlay(painter, view_->overlay(),
                           {size, density, Ground::image, &label_offsets_, corner_texts(painter, size)});
  });
  painter.restore();
  if (hasFocus()) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2.0 * density));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(all.adjusted(density, density, -density, -density));
  }
  tell_frame(*this, milliseconds(clock), picture_.isNull() ? 0 : revision_);
  if (view_->is_draft() && made_now) rest_.start();
  if (view_->animating()) QTimer::singleShot(fade_ms, this, [this] { update(); });
}

std::vector<view::OverlayText> PictureWidget::corner_texts(const QPainter& painter, const QSizeF& view_px) {
  std::vector<view::OverlayText> texts;
  if (!view_->ready()) return texts;
  const double density = devicePixelRatioF();
  if (identity_ && !of_nobody_ && identity_->on_views.get())
    texts = identity_texts(view_px, identity_parts(identity_->now()), density, text_measure(painter));
  if (!grey_told_.isActive()) return texts;
  const auto grey = grey_window_texts(view_px, view_->bench().grey.get(), density);
  texts.insert(texts.end(), grey.begin(), grey.end());
  return texts;
}

void PictureWidget::show_identity(Identity& identity) {
  identity_ = &identity;
  identity_changed_ = identity.changed.observe([this] { update(); });
}

QImage PictureWidget::picture_of_nobody() {
  of_nobody_ = true;
  view_->refine();
  const QImage shown = grab().toImage();
  of_nobody_ = false;
  return shown;
}

view::PointerEvent PictureWidget::pointer_event(const QPointF& at, Qt::MouseButton button,
                                                Qt::KeyboardModifiers keys) const {
  view::PointerEvent event = hand_event(button, keys);
  event.px = view::Vec2(at.x(), at.y()) * devicePixelRatioF();
  return event;
}

// A repaint paints all that was marked, so others mark themselves when the hand's own view is done.
void PictureWidget::request_paint() {
  if (!handling_) PaintQueue::instance().add(this);
}

void PictureWidget::prepare(const QList<QWidget*>& widgets) {
  std::vector<view::PictureView*> views;
  PictureWidget* first = nullptr;
  for (QWidget* widget : widgets)
    if (auto* picture = qobject_cast<PictureWidget*>(widget)) {
      views.push_back(picture->view_.get());
      if (!first) first = picture;
    }
  if (first) first->guard_([&] { view::prepare(views); });
}

void PictureWidget::hand(const char* kind, const std::function<void()>& act) {
  FrameLog::instance().event(kind);
  handling_ = true;
  guard_(act);
  handling_ = false;
  if (twin_ && twin_->isVisible() && view_->bench().turning.get()) prepare({this, twin_});
  show_cursor();
  repaint();
  PaintQueue::instance().serve_overdue();
}

/// A dialog over the window takes the releases from now on.
bool PictureWidget::event(QEvent* event) {
  if (event->type() == QEvent::WindowBlocked && pointer_->holding())
    hand("release", [&] { pointer_->let_go(); });
  return QWidget::event(event);
}
void PictureWidget::let_go_if_lost(const QMouseEvent& event) {
  if (pointer_->holding() && button_.lost(event)) hand("release", [&] { pointer_->let_go(); });
}
void PictureWidget::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  let_go_if_lost(*event);
  if (!pointer_->holding()) button_.pressed(*event);
  hand("press",
       [&] { pointer_->press(pointer_event(event->localPos(), event->button(), event->modifiers())); });
}
void PictureWidget::mouseMoveEvent(QMouseEvent* event) {
  let_go_if_lost(*event);
  const view::PointerEvent at = pointer_event(event->localPos(), Qt::NoButton, event->modifiers());
  if (event->buttons() != Qt::NoButton) {
    hand("drag", [&] { pointer_->move(at); });
  } else {
    guard_([&] { pointer_->move(at); });
    show_cursor();
  }
  tell_place(at.px);
}
void PictureWidget::mouseReleaseEvent(QMouseEvent* event) {
  hand("release",
       [&] { pointer_->release(pointer_event(event->localPos(), event->button(), event->modifiers())); });
}
void PictureWidget::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton)
    hand("double", [&] {
      pointer_->double_click(pointer_event(event->localPos(), event->button(), event->modifiers()));
    });
}
void PictureWidget::wheelEvent(QWheelEvent* event) {
  const double steps =
      (event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x()) / 120.0;
  hand("wheel",
       [&] { pointer_->wheel(steps, pointer_event(event->position(), Qt::NoButton, event->modifiers())); });
  tell_place(view::Vec2(event->position().x(), event->position().y()) * devicePixelRatioF());
  event->accept();
}
void PictureWidget::leaveEvent(QEvent*) {
  guard_([&] { pointer_->leave(); });
  emit hovered({});
}

void PictureWidget::keyPressEvent(QKeyEvent* event) {
  const QPointF at = mapFromGlobal(QCursor::pos());
  const view::PointerEvent place = pointer_event(at, Qt::NoButton, event->modifiers());
  const view::Vec2 middle(view_->width() / 2.0, view_->height() / 2.0);
  switch (event->key()) {
    case Qt::Key_Escape:
      hand("key", [&] { pointer_->cancel(); });
      return;
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      hand("key", [&] { pointer_->erase(place); });
      return;
    case Qt::Key_Up:
    case Qt::Key_PageUp:
      hand("key", [&] { view_->scroll(event->key() == Qt::Key_Up ? 1.0 : 10.0); });
      if (underMouse()) tell_place(place.px);
      return;
    case Qt::Key_Down:
    case Qt::Key_PageDown:
      hand("key", [&] { view_->scroll(event->key() == Qt::Key_Down ? -1.0 : -10.0); });
      if (underMouse()) tell_place(place.px);
      return;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      hand("key", [&] { view_->zoom(1.2, middle); });
      return;
    case Qt::Key_Minus:
      hand("key", [&] { view_->zoom(1.0 / 1.2, middle); });
      return;
    case Qt::Key_0:
      hand("key", [&] { view_->fit(); });
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

void PictureWidget::tell_place(const view::Vec2& px) {
  if (!view_->ready()) return;
  const std::optional<view::Vec3> place = view_->world(px);
  if (!place) return;
  const std::optional<double> value = view_->value_at(px);
  const QString hu = value ? quantity::hu(*value) + QStringLiteral(" HU") : tr("outside the image");
  emit hovered(
      QStringLiteral("%1   x %2  y %3  z %4 mm")
          .arg(hu, quantity::length(place->x()), quantity::length(place->y()), quantity::length(place->z())));
}

void PictureWidget::show_cursor() {
  setCursor(cursor_of(pointer_->shape()));
}

ProfileWidget::ProfileWidget(session::Workbench& bench, Guard guard, QWidget* parent)
    : QWidget(parent), view_(bench), pointer_(view_), guard_(std::move(guard)) {
  setObjectName("profile");
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Lumen profile"));
  stale_ = view_.stale.observe([this] { PaintQueue::instance().add(this); });
}

void ProfileWidget::resizeEvent(QResizeEvent*) {
  const double density = devicePixelRatioF();
  view_.set_size(static_cast<int>(width() * density + 0.5), static_cast<int>(height() * density + 0.5),
                 density);
}

void ProfileWidget::paintEvent(QPaintEvent* event) {
  leave_queue(*this, *event);
  QElapsedTimer clock;
  clock.start();
  const double density = devicePixelRatioF();
  QPainter painter(this);
  painter.scale(1.0 / density, 1.0 / density);
  painter.fillRect(QRectF(0, 0, width() * density, height() * density), palette().color(QPalette::Base));
  painter.setFont(overlay_font(font(), density));
  texts_ =
      paint_overlay(painter, view_.overlay(), {QSizeF(width(), height()) * density, density, Ground::paper});
  tell_frame(*this, milliseconds(clock));
}

view::PointerEvent ProfileWidget::pointer_event(const QPointF& at, Qt::MouseButton button) const {
  view::PointerEvent event = hand_event(button, Qt::NoModifier);
  event.px = view::Vec2(at.x(), at.y()) * devicePixelRatioF();
  return event;
}
void ProfileWidget::hand(const std::function<void()>& act) {
  FrameLog::instance().event("profile");
  guard_(act);
  setCursor(cursor_of(pointer_.shape()));
}
bool ProfileWidget::event(QEvent* event) {
  if (event->type() == QEvent::WindowBlocked && pointer_.holding()) hand([&] { pointer_.let_go(); });
  if (event->type() == QEvent::ToolTip) {
    show_tip(*static_cast<QHelpEvent*>(event));
    return true;
  }
  // Escape drops what is in the hand, and is the shortcut for browsing only then.
  if (event->type() == QEvent::ShortcutOverride && pointer_.holding() &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}
void ProfileWidget::show_tip(const QHelpEvent& event) {
  const double density = devicePixelRatioF();
  const auto lesion = view_.lesion_at(view::Vec2(event.x(), event.y()) * density);
  if (lesion && lesion_tip_)
    QToolTip::showText(event.globalPos(), lesion_tip_(*lesion), this);
  else
    QToolTip::hideText();
}
void ProfileWidget::let_go_if_lost(const QMouseEvent& event) {
  if (pointer_.holding() && button_.lost(event)) hand([&] { pointer_.let_go(); });
}
void ProfileWidget::mousePressEvent(QMouseEvent* event) {
  let_go_if_lost(*event);
  if (!pointer_.holding()) button_.pressed(*event);
  hand([&] { pointer_.press(pointer_event(event->localPos(), event->button())); });
}
void ProfileWidget::mouseMoveEvent(QMouseEvent* event) {
  let_go_if_lost(*event);
  const view::PointerEvent at = pointer_event(event->localPos(), Qt::NoButton);
  if (event->buttons() != Qt::NoButton) {
    hand([&] { pointer_.move(at); });
  } else {
    guard_([&] { pointer_.move(at); });
    setCursor(cursor_of(pointer_.shape()));
  }
}
void ProfileWidget::mouseReleaseEvent(QMouseEvent* event) {
  hand([&] { pointer_.release(pointer_event(event->localPos(), event->button())); });
}
void ProfileWidget::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && pointer_.holding()) return hand([&] { pointer_.cancel(); });
  if (event->key() != Qt::Key_Delete && event->key() != Qt::Key_Backspace)
    return QWidget::keyPressEvent(event);
  hand([&] { pointer_.erase(pointer_event(mapFromGlobal(QCursor::pos()), Qt::NoButton)); });
}
void ProfileWidget::wheelEvent(QWheelEvent* event) {
  session::Property<double>& cursor = view_.bench().cursor_mm;
  cursor.set(cursor.get() - 0.5 * event->angleDelta().y() / 120.0);
  event->accept();
}

}  // namespace ostia::workstation
