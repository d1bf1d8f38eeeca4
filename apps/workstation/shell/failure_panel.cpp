#include "shell/failure_panel.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "shell/desk.h"

#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

/// Over an image of which nothing failed.
const QStringList& ways_without_vessel() {
  static const QStringList ways{"vessel.find", "tool.add_artery", "view.layout_planes",
                                "file.series", "edit.undo",       "edit.redo"};
  return ways;
}

/// Messages of libraries begin in lower case.
QString as_sentence(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString way_text(const QAction& action) {
  QString text = plain_text(action.text());
  const QString keys = action.shortcut().toString(QKeySequence::NativeText);
  if (!keys.isEmpty()) text += QStringLiteral("   %1").arg(keys);
  return text.replace('&', QStringLiteral("&&"));
}

QPushButton* way_button(QAction& action) {
  auto* button = new QPushButton(way_text(action));
  button->setObjectName("way." + action.objectName());
  button->setToolTip(action.toolTip());
  button->setFocusPolicy(Qt::TabFocus);
  QObject::connect(button, &QPushButton::clicked, &action, &QAction::trigger);
  return button;
}

}  // namespace

FailurePanel::FailurePanel(Desk& desk, const CommandTable& commands, QWidget& over)
    : Card(desk.window, over), desk_(desk), commands_(commands) {
  setObjectName("failure");
  title_ = add_title({});
  title_->setObjectName("failure_title");
  reason_ = add_line({});
  reason_->setObjectName("failure_reason");
  reason_->setTextFormat(Qt::PlainText);
  reason_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  ways_ = new QVBoxLayout;
  ways_->setSpacing(6);
  rows().addLayout(ways_);
  waiting_ = add_line({});
  waiting_->setObjectName("failure_waiting");
  const auto look = [this](const auto&...) { refresh(); };
  own_.push_back(desk.failure.observe(look));
  own_.push_back(desk.bench.case_changed.observe(look));
  own_.push_back(desk.bench.image_changed.observe(look));
  own_.push_back(desk.bench.tool.observe(look));
  own_.push_back(desk.bench.first_end.observe(look));
  connect(&desk.jobs, &Jobs::changed, this, &FailurePanel::refresh);
  refresh();
}

bool FailurePanel::vessels_are_coming() const {
  // Of an image that is still being read nobody knows yet.
  return desk_.jobs.running("tree") || desk_.jobs.running("path") || desk_.jobs.running("open");
}

QString FailurePanel::waiting_for() const {
  using session::Tool;
  const Tool tool = desk_.bench.tool.get();
  if (!desk_.bench.image().volume || (tool != Tool::add_artery && tool != Tool::add_vessel)) return {};
  return desk_.bench.first_end.get()
             ? tr("Now click the distal end of this vessel in the slice.")
             : tr("Click the ostium of the artery in the slice, then its distal end.");
}

/// A button stays the one that it is, focus and all, as long as the same ones are shown.
void FailurePanel::fill_ways(const QStringList& ways) {
  std::vector<Way> wanted;
  for (const QString& id : ways + QStringList{"help.messages"})
    if (const QAction& action = commands_.action(id); action.isEnabled())
      wanted.push_back({id, way_text(action), action.toolTip()});
  if (wanted == shown_) return;
  shown_ = wanted;
  while (QLayoutItem* item = ways_->takeAt(0)) {
    if (QWidget* old = item->widget()) {
      old->hide();
      old->deleteLater();  // it may be the one that was clicked
    }
    delete item;
  }
  for (const Way& one : wanted) {
    QPushButton* button = way_button(commands_.action(one.id));
    ways_->addWidget(button);
    button->show();  // a layout has room for what is shown alone
  }
}

void FailurePanel::refresh() {
  const session::Workbench& bench = desk_.bench;
  const Failure& failure = desk_.failure.get();
  const bool image = bench.image().volume != nullptr;
  const bool failed = !failure.title.isEmpty();
  const bool wanted = !bench.has_case() && !vessels_are_coming() && (failed || image);
  if (wanted) {
    title_->setText(failed ? failure.title : tr("No vessel yet"));
    reason_->setText(failed
                         ? as_sentence(failure.reason)
                         : tr("There is an image, and no vessel in it yet. Have the arteries found, or begin "
                              "one by two clicks."));
    fill_ways(failed ? failure.ways : ways_without_vessel());
    waiting_->setText(waiting_for());
    waiting_->setVisible(!waiting_->text().isEmpty());
  }
  want(wanted);
}

}  // namespace ostia::workstation
