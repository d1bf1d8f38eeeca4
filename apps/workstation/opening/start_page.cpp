#include "opening/start_page.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "opening/recent_cases.h"
#include "shell/desk.h"

#include <QAction>
#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int widest = 380;  // units of the interface
constexpr std::size_t most_recent = 4;

QLabel* line(const QString& text) {
  auto* made = new QLabel(text);
  made->setWordWrap(true);
  return made;
}

}  // namespace

StartPage::StartPage(Desk& desk, const CommandTable& commands, QWidget& over)
    : QFrame(&desk.window), desk_(desk), over_(&over) {
  setObjectName("start_page");
  setAutoFillBackground(true);
  setFrameShape(QFrame::StyledPanel);
  build(commands);
  over_->installEventFilter(this);
  own_.push_back(desk.bench.case_changed.observe([this] { refresh(); }));
  own_.push_back(desk.bench.image_changed.observe([this] { refresh(); }));
  own_.push_back(desk.identity.changed.observe([this] { refresh(); }));
  refresh();
}

void StartPage::build(const CommandTable& commands) {
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(18, 16, 18, 16);
  rows->setSpacing(8);
  auto* title = line(tr("No case is open"));
  QFont large = font();
  large.setPointSizeF(1.3 * large.pointSizeF());
  large.setBold(true);
  title->setFont(large);
  rows->addWidget(title);
  rows->addWidget(line(tr("Drop a DICOM folder, an image or a case on this window, or:")));
  for (const char* id : {"file.open", "file.open_folder", "file.sample"}) {
    QAction* action = &commands.action(id);
    QString text = plain_text(action->text());
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) text += QStringLiteral("   %1").arg(keys);
    auto* button = new QPushButton(text);
    button->setObjectName(QStringLiteral("start.") + id);
    button->setToolTip(action->toolTip());
    button->setFocusPolicy(Qt::TabFocus);
    connect(button, &QPushButton::clicked, action, &QAction::trigger);
    rows->addWidget(button);
  }
  recent_ = new QVBoxLayout;
  recent_->setSpacing(4);
  rows->addLayout(recent_);
}

void StartPage::fill_recent() {
  while (QLayoutItem* item = recent_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  std::size_t shown = 0;
  for (const session::RecentCase& one : desk_.machine.recent_cases()) {
    std::error_code ignored;
    if (shown == most_recent || !std::filesystem::exists(one.path, ignored)) continue;
    if (shown++ == 0) recent_->addWidget(line(tr("Recent cases:")));
    const QString path = QString::fromStdString(one.path.string());
    auto* button = new QPushButton;
    const QString text = recent_case_text(desk_, one, QString::fromStdString(one.path.filename().string()));
    const QString fitting = button->fontMetrics().elidedText(text, Qt::ElideMiddle, widest - 80);
    button->setText(QString(fitting).replace('&', QStringLiteral("&&")));
    button->setAccessibleName(text);
    button->setToolTip(text.contains(QStringLiteral("  \u2013  ")) ? text + "\n" + path : path);
    button->setFocusPolicy(Qt::TabFocus);
    button->setFlat(true);
    connect(button, &QPushButton::clicked, this, [this, path] { emit file_chosen(path); });
    recent_->addWidget(button);
  }
}

void StartPage::refresh() {
  wanted_ = !desk_.bench.has_case() && !desk_.bench.image().volume;
  if (wanted_) fill_recent();
  show_or_hide();
}

void StartPage::show_or_hide() {
  const bool shown = wanted_ && over_->isVisibleTo(over_->window());
  setVisible(shown);
  if (shown)
    place();
  else  // all of each view, not the uncovered part alone
    for (QWidget* view : over_->findChildren<QWidget*>()) view->update();
}

void StartPage::place() {
  const QPoint corner = over_->mapTo(&desk_.window, QPoint(0, 0));
  layout()->activate();
  // In a narrow window its buttons reach over the views beside, which have nothing to show yet.
  const int least = std::min(minimumSizeHint().width(), desk_.window.width() - 24);
  const int wide = std::max(least, std::min(widest, over_->width() - 24));
  const int high = std::max(sizeHint().height(), layout()->totalHeightForWidth(wide));
  const int left =
      std::clamp(corner.x() + (over_->width() - wide) / 2, 0, std::max(0, desk_.window.width() - wide));
  setGeometry(left, corner.y() + std::max(30, (over_->height() - high) / 3), wide, high);
  raise();
}

bool StartPage::eventFilter(QObject* object, QEvent* event) {
  const bool other_room =
      event->type() == QEvent::Resize || event->type() == QEvent::Show || event->type() == QEvent::Hide;
  if (object == over_ && other_room) show_or_hide();  // the case is not asked: the window may be going
  return QFrame::eventFilter(object, event);
}

}  // namespace ostia::workstation
