#include "shell/card.h"

#include <QEvent>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {

Card::Card(QWidget& window, QWidget& over)
    : QFrame(&window), window_(window), over_(&over), rows_(new QVBoxLayout(this)) {
  setAutoFillBackground(true);
  setFrameShape(QFrame::StyledPanel);
  rows_->setContentsMargins(18, 16, 18, 16);
  rows_->setSpacing(8);
  over_->installEventFilter(this);
}

QLabel* Card::add_line(const QString& text) {
  auto* made = new QLabel(text);
  made->setWordWrap(true);
  rows_->addWidget(made);
  return made;
}

QLabel* Card::add_title(const QString& text) {
  QLabel* title = add_line(text);
  QFont large = font();
  large.setPointSizeF(1.3 * large.pointSizeF());
  large.setBold(true);
  title->setFont(large);
  return title;
}

void Card::want(bool wanted) {
  wanted_ = wanted;
  show_or_hide();
}

void Card::show_or_hide() {
  const bool shown = wanted_ && over_->isVisibleTo(over_->window());
  const bool was_shown = !isHidden();
  setVisible(shown);
  if (shown)
    place();
  else if (was_shown)  // all of each view, not the uncovered part alone
    for (QWidget* view : over_->findChildren<QWidget*>()) view->update();
}

void Card::place() {
  const QPoint corner = over_->mapTo(&window_, QPoint(0, 0));
  layout()->activate();
  // In a narrow window its buttons reach over the views beside, which have nothing to show yet.
  const int least = std::min(minimumSizeHint().width(), window_.width() - 24);
  const int wide = std::max(least, std::min(widest, over_->width() - 24));
  const int high = std::max(sizeHint().height(), layout()->totalHeightForWidth(wide));
  const int left =
      std::clamp(corner.x() + (over_->width() - wide) / 2, 0, std::max(0, window_.width() - wide));
  setGeometry(left, corner.y() + std::max(30, (over_->height() - high) / 3), wide, high);
  raise();
}

bool Card::eventFilter(QObject* object, QEvent* event) {
  const bool other_room =
      event->type() == QEvent::Resize || event->type() == QEvent::Show || event->type() == QEvent::Hide;
  if (object == over_ && other_room) show_or_hide();  // the case is not asked: the window may be going
  return QFrame::eventFilter(object, event);
}

/// As its texts have another size.
bool Card::event(QEvent* event) {
  const bool done = QFrame::event(event);
  if (event->type() == QEvent::LayoutRequest && isVisible()) place();
  return done;
}

}  // namespace ostia::workstation
