#include "shell/panel.h"

#include "commands/icons.h"

#include <QContextMenuEvent>
#include <QEvent>
#include <QHBoxLayout>
#include <QMainWindow>
#include <QMenu>
#include <QSplitter>
#include <QTabWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int settled_ms = 100;  // until the columns have taken their places
constexpr const char* gap_property = "gap";

}  // namespace

Panel::Panel(const QString& title, QWidget* content, QWidget* parent) : QFrame(parent), content_(content) {
  setFrameShape(QFrame::NoFrame);
  setAccessibleName(title);
  bar_ = new QWidget(this);
  bar_->installEventFilter(this);
  bar_->setToolTip(tr("Double click: this view alone, and back\nRight click: a window of its own, and back"));
  title_ = new QLabel(title, bar_);
  auto* largest = new QToolButton(bar_);
  largest->setIcon(command_icon(QStringLiteral("panel.alone")));
  largest->setIconSize(QSize(14, 14));
  largest->setAutoRaise(true);
  largest->setToolTip(tr("This view alone, and back"));
  largest->setAccessibleName(tr("Maximise %1").arg(title));
  connect(largest, &QToolButton::clicked, this, &Panel::maximise_wanted);
  auto* line = new QHBoxLayout(bar_);
  line->setContentsMargins(6, 1, 2, 1);
  line->setSpacing(4);
  line->addWidget(title_);
  line->addStretch(1);
  line->addWidget(largest);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(bar_);
  layout->addWidget(content, 1);
}

void Panel::set_title(const QString& title) {
  title_->setText(title);
}

void Panel::add_control(QWidget* control) {
  auto* line = static_cast<QHBoxLayout*>(bar_->layout());
  line->insertWidget(line->count() - 1, control);
}

bool Panel::eventFilter(QObject* object, QEvent* event) {
  if (object == bar_ && event->type() == QEvent::MouseButtonDblClick) {
    emit maximise_wanted();
    return true;
  }
  if (object == bar_ && event->type() == QEvent::ContextMenu) {
    auto* menu = new QMenu(this);
    menu->setObjectName("panel_menu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const bool away = !qobject_cast<QMainWindow*>(window());
    menu->addAction(away ? tr("Back into the window") : tr("A window of its own"), this,
                    &Panel::own_window_wanted);
    menu->popup(static_cast<QContextMenuEvent*>(event)->globalPos());
    return true;
  }
  return QFrame::eventFilter(object, event);
}

QWidget* make_gap() {
  auto* gap = new QWidget;
  gap->setProperty(gap_property, true);
  return gap;
}

bool has_views(const QWidget& part) {
  const auto* splitter = qobject_cast<const QSplitter*>(&part);
  if (!splitter) return !part.property(gap_property).toBool();
  for (int i = 0; i < splitter->count(); ++i)
    if (has_views(*splitter->widget(i))) return true;
  return false;
}

void show_alone(QWidget* root, Panel* alone) {
  QList<QSplitter*> splitters = root->findChildren<QSplitter*>();
  if (auto* outermost = qobject_cast<QSplitter*>(root)) splitters.prepend(outermost);
  // Whatever stands beside the panel would keep its room: other panels, columns of them, lists. From within,
  // so that a splitter that is shown again finds its parts there, and with them its sizes.
  for (auto splitter = splitters.crbegin(); splitter != splitters.crend(); ++splitter)
    for (int i = 0; i < (*splitter)->count(); ++i) {
      QWidget* part = (*splitter)->widget(i);
      part->setVisible(has_views(*part) && (!alone || part == alone || part->isAncestorOf(alone)));
    }
}

void reveal(QWidget& widget) {
  QWidget* window = widget.window();
  if (!qobject_cast<QMainWindow*>(window) && window->isVisible()) window->activateWindow();
  for (QWidget* page = &widget; page->parentWidget(); page = page->parentWidget()) {
    auto* tabs = qobject_cast<QTabWidget*>(page->parentWidget()->parentWidget());
    if (tabs && tabs->indexOf(page) >= 0) tabs->setCurrentWidget(page);
  }
  // A small window may have no room for it beside a dock that has just come: then it is shown alone.
  QTimer::singleShot(settled_ms, &widget, [&widget] {
    if (widget.isVisible() || !widget.window()->isVisible()) return;
    for (QWidget* above = widget.parentWidget(); above; above = above->parentWidget())
      if (auto* panel = qobject_cast<Panel*>(above)) return emit panel->maximise_wanted();
  });
}

}  // namespace ostia::workstation
