#include "help/tour.h"

#include <QApplication>
#include <QCheckBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int ring_width = 3;
constexpr int gap = 10;
constexpr int text_width = 340;

QString key(const ShortcutKeys& keys, const char* id) {
  const QList<QKeySequence> found = keys.keys(id);
  return found.isEmpty() ? Tour::tr("no key") : found.front().toString(QKeySequence::NativeText);
}

}  // namespace

std::vector<TourStep> tour_steps(const ShortcutKeys& keys) {
  return {
      {Tour::tr("Welcome"),
       Tour::tr("Ostia turns a CT angiogram into a corrected model of the coronary arteries. Drop a DICOM "
                "folder, an image or a case on the window, or use File. File > The sample case opens a "
                "computed patient to try everything on."),
       {}},
      {Tour::tr("The vessels"),
       Tour::tr("Every artery with its segments, its length, and its largest narrowing. Click one, and all "
                "views show it; %1 goes to the next. Tick Done when you have gone through it. A right click "
                "renames, cuts, joins or deletes.")
           .arg(key(keys, "view.next_vessel")),
       {"vessels"}},
      {Tour::tr("Two CPRs"),
       Tour::tr(
           "The selected artery laid straight, seen from two sides 90 degrees apart; its ostium is at the "
           "top. Shift and drag turns both, and so do %1 and %2. The wheel goes along the vessel, Ctrl "
           "and wheel zooms, the right button sets the grey levels.")
           .arg(key(keys, "view.turn_left"), key(keys, "view.turn_right")),
       {"curved"}},
      {Tour::tr("The section"),
       Tour::tr("The cut across the artery at the cursor, with its area and diameters. Below are its "
                "neighbours, and a slice of the patient."),
       {"section"}},
      {Tour::tr("The tree"),
       Tour::tr("The lumen in three dimensions. Drag turns it, a click on a vessel goes there. The list in "
                "its title shows the heart behind it."),
       {"tree"}},
      {Tour::tr("The profile"),
       Tour::tr("Diameter and area along the artery; the dashed line is the calibre without disease, red "
                "bands are stenoses. Click to go there; %1 goes from stenosis to stenosis.")
           .arg(key(keys, "view.next_lesion")),
       {"profile"}},
      {Tour::tr("Editing"),
       Tour::tr("Pull (%1) takes the contour where you grip it. Draw (%2) replaces the wall by your line, on "
                "a CPR or around the section. The brush (%3) pushes. All views follow while the mouse moves, "
                "and every step is saved at once.")
           .arg(key(keys, "tool.drag"), key(keys, "tool.draw"), key(keys, "tool.brush")),
       {"tools"}},
      {Tour::tr("Undo and steps"),
       Tour::tr("%1 takes back, %2 does again. The tab Steps lists everything since the case began: click a "
                "line to go back to it.")
           .arg(key(keys, "edit.undo"), key(keys, "edit.redo")),
       {"lists"}},
      {Tour::tr("Measuring"),
       Tour::tr(
           "Distance, angle, area, diameter, stenosis, volume, and CT numbers around the lumen. What you "
           "place can be moved by its points, is listed under Measurements, and follows the wall."),
       {"tools"}},
      {Tour::tr("Report and help"),
       Tour::tr("%1 makes the report with key images, segments, stenoses and measurements. %2 shows all keys "
                "and mouse gestures, Help > Manual leads from DICOM to the report, Help > Tour repeats this "
                "tour. Ostia is research software, not a medical device.")
           .arg(key(keys, "file.report"), key(keys, "help.shortcuts")),
       {"menus"}},
  };
}

TourRing::TourRing(QWidget* window) : QWidget(window) {
  // Above the tree's native window, which would cover a widget without a window of its own.
  setAttribute(Qt::WA_NativeWindow);
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  hide();
}

void TourRing::point_at(const QRect& target) {
  const QRect outer = target.intersected(parentWidget()->rect());
  setGeometry(outer);
  QRegion ring(rect());
  setMask(ring.subtracted(rect().adjusted(ring_width, ring_width, -ring_width, -ring_width)));
  show();
  raise();
}

void TourRing::paintEvent(QPaintEvent*) {
  QPainter(this).fillRect(rect(), QColor(255, 176, 46));
}

Tour::Tour(QWidget& window, const ShortcutKeys& keys)
    : QFrame(&window), window_(window), steps_(tour_steps(keys)), ring_(new TourRing(&window)) {
  setObjectName("tour");
  setAccessibleName(tr("Tour"));
  setAttribute(Qt::WA_NativeWindow);
  setAutoFillBackground(true);
  setFrameShape(QFrame::Box);
  setLineWidth(2);
  build();
  hide();
  window.installEventFilter(this);
}

void Tour::build() {
  title_ = new QLabel(this);
  QFont bold = font();
  bold.setBold(true);
  bold.setPointSizeF(bold.pointSizeF() * 1.15);
  title_->setFont(bold);
  number_ = new QLabel(this);
  number_->setEnabled(false);
  text_ = new QLabel(this);
  text_->setWordWrap(true);
  text_->setFixedWidth(text_width);
  not_again_ = new QCheckBox(tr("Do not show again"), this);
  not_again_->setChecked(true);
  not_again_->setToolTip(tr("Without the tick the next start begins with this tour; Help > Tour repeats it"));
  auto* close = new QToolButton(this);
  close->setText(QStringLiteral("\u2715"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Ends the tour (Esc)"));
  close->setAccessibleName(tr("End the tour"));
  back_ = new QPushButton(tr("Back"), this);
  back_->setToolTip(tr("The part before (Left)"));
  next_ = new QPushButton(this);
  next_->setToolTip(tr("The next part (Right, Enter)"));
  auto* head = new QHBoxLayout;
  head->addWidget(title_, 1);
  head->addWidget(number_);
  head->addWidget(close);
  auto* row = new QHBoxLayout;
  row->addWidget(not_again_);
  row->addStretch(1);
  row->addWidget(back_);
  row->addWidget(next_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head);
  layout->addWidget(text_);
  layout->addLayout(row);
  for (QWidget* child : findChildren<QWidget*>()) child->installEventFilter(this);
  connect(close, &QToolButton::clicked, this, &Tour::end);
  connect(back_, &QPushButton::clicked, this, [this] { go(step_ - 1); });
  connect(next_, &QPushButton::clicked, this, [this] { go(step_ + 1); });
}

void Tour::begin() {
  show();
  go(0);
}

void Tour::end() {
  ring_->hide();
  hide();
  emit ended(!not_again_->isChecked());
  if (QWidget* first = window_.findChild<QWidget*>("vessels")) first->setFocus();
}

void Tour::go(int step) {
  if (step >= count()) return end();
  step_ = std::clamp(step, 0, count() - 1);
  const TourStep& now = steps_[static_cast<std::size_t>(step_)];
  title_->setText(now.title);
  text_->setText(now.text);
  number_->setText(tr("%1 of %2").arg(step_ + 1).arg(count()));
  back_->setEnabled(step_ > 0);
  const bool last = step_ + 1 == count();
  next_->setText(last ? tr("Finish") : tr("Next"));
  setAccessibleDescription(now.title + ". " + now.text);
  place();
  next_->setFocus(Qt::OtherFocusReason);
}

QRect Tour::target() const {
  for (const QString& name : steps_[static_cast<std::size_t>(step_)].targets) {
    const auto* widget = window_.findChild<QWidget*>(name);
    if (!widget || !widget->isVisible()) continue;
    return {widget->mapTo(&window_, QPoint(0, 0)), widget->size()};
  }
  return {};
}

void Tour::place() {
  if (!isVisible()) return;
  const QRect at = target();
  layout()->activate();
  QSize size = sizeHint();  // knows nothing of the lines that the text takes
  size.setHeight(std::max(size.height(), layout()->totalHeightForWidth(size.width())));
  const QRect room = window_.rect().adjusted(gap, gap, -gap, -gap);
  QPoint corner = room.center() - QPoint(size.width() / 2, size.height() / 2);
  if (at.isNull()) {
    ring_->hide();
  } else {
    ring_->point_at(at);
    const int y = std::clamp(at.top() + gap, room.top(), std::max(room.top(), room.bottom() - size.height()));
    const int x =
        std::clamp(at.left() + gap, room.left(), std::max(room.left(), room.right() - size.width()));
    if (at.right() + gap + size.width() <= room.right())
      corner = QPoint(at.right() + gap, y);
    else if (at.left() - gap - size.width() >= room.left())
      corner = QPoint(at.left() - gap - size.width(), y);
    else if (at.bottom() + gap + size.height() <= room.bottom())
      corner = QPoint(x, at.bottom() + gap);
    else if (at.top() - gap - size.height() >= room.top())
      corner = QPoint(x, at.top() - gap - size.height());
  }
  setGeometry(QRect(corner, size));
  raise();
}

bool Tour::take_key(int key) {
  switch (key) {
    case Qt::Key_Escape:
      end();
      return true;
    case Qt::Key_Left:
      go(step_ - 1);
      return true;
    case Qt::Key_Right:
    case Qt::Key_Return:
    case Qt::Key_Enter:
      go(step_ + 1);
      return true;
    default:
      return false;
  }
}

void Tour::keyPressEvent(QKeyEvent* event) {
  if (!take_key(event->key())) QFrame::keyPressEvent(event);
}

bool Tour::event(QEvent* event) {
  // These keys are the tour's while it has the focus, whatever command they may run elsewhere.
  if (event->type() == QEvent::ShortcutOverride) {
    const int pressed = static_cast<QKeyEvent*>(event)->key();
    if (pressed == Qt::Key_Escape || pressed == Qt::Key_Space) {
      event->accept();
      return true;
    }
  }
  return QFrame::event(event);
}

bool Tour::eventFilter(QObject* object, QEvent* event) {
  if (object == &window_ && event->type() == QEvent::Resize && isVisible()) place();
  // Buttons would move the focus among themselves.
  if (object != &window_ && event->type() == QEvent::KeyPress)
    return take_key(static_cast<QKeyEvent*>(event)->key());
  return QFrame::eventFilter(object, event);
}

}  // namespace ostia::workstation
