#include "opening/start_page.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "opening/recent_cases.h"
#include "shell/desk.h"

#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr std::size_t most_recent = 4;

}  // namespace

StartPage::StartPage(Desk& desk, const CommandTable& commands, QWidget& over)
    : Card(desk.window, over), desk_(desk) {
  setObjectName("start_page");
  build(commands);
  own_.push_back(desk.bench.case_changed.observe([this] { refresh(); }));
  own_.push_back(desk.bench.image_changed.observe([this] { refresh(); }));
  own_.push_back(desk.identity.changed.observe([this] { refresh(); }));
  own_.push_back(desk.failure.observe([this](const Failure&) { refresh(); }));
  refresh();
}

void StartPage::build(const CommandTable& commands) {
  add_title(tr("No case is open"));
  add_line(tr("Drop a DICOM folder, an image or a case on this window, or:"));
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
    rows().addWidget(button);
  }
  recent_ = new QVBoxLayout;
  recent_->setSpacing(4);
  rows().addLayout(recent_);
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
    if (shown++ == 0) recent_->addWidget(new QLabel(tr("Recent cases:")));
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
  const bool wanted =
      !desk_.bench.has_case() && !desk_.bench.image().volume && desk_.failure.get().title.isEmpty();
  if (wanted) fill_recent();
  want(wanted);
}

}  // namespace ostia::workstation
