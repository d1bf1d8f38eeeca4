#include "shell/floating_views.h"

#include "shell/panel.h"
#include "shell/screen_room.h"

#include <QCloseEvent>
#include <QGuiApplication>
#include <QMainWindow>
#include <QScreen>
#include <QSplitter>
#include <QStringList>
#include <QVBoxLayout>
#include <memory>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int screens_settle_ms = 400;
constexpr int least_wide = 240, least_high = 180, cascade = 48;

/// Its closing puts the view back.
class ViewWindow final : public QWidget {
 public:
  ViewWindow(QWidget& main, std::function<void()> close)
      : QWidget(&main, Qt::Tool | Qt::CustomizeWindowHint | Qt::WindowTitleHint | Qt::WindowSystemMenuHint |
                           Qt::WindowMaximizeButtonHint | Qt::WindowCloseButtonHint),
        close_(std::move(close)) {
    auto* whole = new QVBoxLayout(this);
    whole->setContentsMargins(0, 0, 0, 0);
  }

 protected:
  void closeEvent(QCloseEvent* event) override {
    if (qApp->isSavingSession()) return;  // who logs out is not held up
    event->ignore();
    // Not while the window handles its own closing.
    QTimer::singleShot(0, this, close_);
  }

 private:
  std::function<void()> close_;
};

QString text_of_place(const QString& name, const QRect& at) {
  return QStringLiteral("%1 %2 %3 %4 %5").arg(name).arg(at.x()).arg(at.y()).arg(at.width()).arg(at.height());
}

}  // namespace

FloatingView in_splitter(QWidget& view, const QString& title) {
  auto* splitter = qobject_cast<QSplitter*>(view.parentWidget());
  auto gap = std::make_shared<QPointer<QWidget>>();
  return {&view, title,
          [&view, splitter, gap] {
            *gap = make_gap();
            splitter->replaceWidget(splitter->indexOf(&view), *gap);
            (*gap)->hide();
          },
          [&view, splitter, gap] {
            splitter->replaceWidget(splitter->indexOf(*gap), &view);
            delete *gap;
            view.show();
          }};
}

FloatingViews::FloatingViews(QWidget& main) : QObject(&main), main_(main) {
  main.installEventFilter(this);
  soon_.setSingleShot(true);
  soon_.setInterval(screens_settle_ms);
  connect(&soon_, &QTimer::timeout, this, &FloatingViews::look_after);
  const auto look = [this] { soon_.start(); };
  const auto watch = [this, look](QScreen* screen) {
    connect(screen, &QScreen::availableGeometryChanged, this, look);
  };
  connect(qGuiApp, &QGuiApplication::screenRemoved, this, look);
  connect(qGuiApp, &QGuiApplication::screenAdded, this, watch);
  for (QScreen* screen : QGuiApplication::screens()) watch(screen);
}

void FloatingViews::add(FloatingView view) {
  all_.push_back(std::move(view));
}

const FloatingView* FloatingViews::find(const QString& name) const {
  for (const FloatingView& one : all_)
    if (one.view->objectName() == name) return &one;
  return nullptr;
}

void FloatingViews::set_floating(const QString& name, bool floating) {
  const FloatingView* view = find(name);
  if (!view || floats(name) == floating) return;
  if (floating)
    float_at(*view, stood_.value(name, first_place(*view)));
  else
    come_back(name);
  emit changed();
}

void FloatingViews::bring_all_back() {
  if (windows_.isEmpty()) return;
  for (const QString& name : windows_.keys()) come_back(name);
  emit changed();
}

void FloatingViews::float_at(const FloatingView& view, const QRect& place) {
  const QString name = view.view->objectName();
  auto* window = new ViewWindow(main_, [this, name] { set_floating(name, false); });
  window->setObjectName(name + "_window");
  window->setWindowTitle(tr("%1 \u2013 Ostia").arg(view.title));
  window->setGeometry(on_some_screen(place, screen_rooms()));
  windows_[name] = window;
  view.leave();
  window->layout()->addWidget(view.view);
  view.view->show();
  if (main_.isVisible()) window->show();
}

void FloatingViews::come_back(const QString& name) {
  const QPointer<QWidget> window = windows_.take(name);
  if (!window) return;
  stood_[name] = window->geometry();
  find(name)->come_back();
  window->hide();
  window->deleteLater();
}

/// On the next monitor; where there is one alone, over the main window.
QRect FloatingViews::first_place(const FloatingView& view) const {
  const QSize size = view.view->size().expandedTo({least_wide, least_high});
  for (const QRect& screen : screen_rooms())
    if (!screen.intersects(main_.geometry())) return {screen.topLeft(), size.boundedTo(screen.size())};
  const QPoint at = view.view->isVisible() ? view.view->mapToGlobal({cascade, cascade})
                                           : main_.geometry().topLeft() + QPoint(cascade, cascade);
  return {at, size};
}

std::string FloatingViews::places() const {
  QStringList all;
  for (auto window = windows_.begin(); window != windows_.end(); ++window)
    if (*window) all << text_of_place(window.key(), (*window)->geometry());
  return all.join(';').toStdString();
}

void FloatingViews::restore(const std::string& places) {
  bring_all_back();
  for (const QString& one : QString::fromStdString(places).split(';', Qt::SkipEmptyParts)) {
    const QStringList parts = one.split(' ', Qt::SkipEmptyParts);
    const FloatingView* view = parts.size() == 5 ? find(parts.front()) : nullptr;
    if (!view || floats(parts.front())) continue;
    const QRect place(parts[1].toInt(), parts[2].toInt(), parts[3].toInt(), parts[4].toInt());
    if (place.width() > 0 && place.height() > 0) float_at(*view, place);
  }
  if (!windows_.isEmpty()) emit changed();
}

/// A monitor has gone, or its size is another.
void FloatingViews::look_after() {
  for (const QPointer<QWidget>& window : windows_)
    if (window) bring_back(*window);
  if (auto* main = qobject_cast<QMainWindow*>(&main_)) bring_back_docks(*main);
  if (!main_.isMinimized()) bring_back(main_);
}

bool FloatingViews::eventFilter(QObject* object, QEvent* event) {
  if (object == &main_ && !event->spontaneous() &&
      (event->type() == QEvent::Show || event->type() == QEvent::Hide))
    for (const QPointer<QWidget>& window : windows_)
      if (window) window->setVisible(event->type() == QEvent::Show);
  return QObject::eventFilter(object, event);
}

}  // namespace ostia::workstation
