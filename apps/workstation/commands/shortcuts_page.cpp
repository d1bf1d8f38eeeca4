#include "commands/shortcuts_page.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "shell/hanging.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int keys_width = 230;

}  // namespace

ShortcutsPage::ShortcutsPage(const CommandTable& commands, QWidget* parent)
    : QDialog(parent), search_(new QLineEdit(this)), list_(new QTreeWidget(this)) {
  setObjectName("shortcuts_page");
  setWindowTitle(tr("Keys and mouse"));
  resize_within(*this, QSize(1180, 680));
  search_->setObjectName("search");
  search_->setPlaceholderText(tr("Search: a word, or a key"));
  search_->setAccessibleName(tr("Search"));
  search_->setToolTip(tr("Only lines with all of these words stay"));
  search_->setClearButtonEnabled(true);
  list_->setColumnCount(3);
  list_->setHeaderLabels({tr("Command"), tr("Keys"), tr("What it does")});
  list_->setAccessibleName(tr("Keys and mouse gestures"));
  list_->setRootIsDecorated(false);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setWordWrap(true);
  fill(commands);
  list_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  list_->header()->resizeSection(1, keys_width);
  list_->header()->setStretchLastSection(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(search_);
  layout->addWidget(list_, 1);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(search_, &QLineEdit::textChanged, this, &ShortcutsPage::search);
  search_->setFocus();
}

void ShortcutsPage::fill(const CommandTable& commands) {
  QTreeWidgetItem* group = nullptr;
  const auto head = [&](const QString& title) {
    if (group && group->text(0) == title) return;
    group = nullptr;
    for (int i = 0; i < list_->topLevelItemCount(); ++i)
      if (list_->topLevelItem(i)->text(0) == title) group = list_->topLevelItem(i);
    if (group) return;
    group = new QTreeWidgetItem(list_, {title});
    QFont bold = font();
    bold.setBold(true);
    group->setFont(0, bold);
    group->setFlags(Qt::ItemIsEnabled);
    group->setExpanded(true);
  };
  for (const Command& command : commands.all()) {
    head(command_group(command.id));
    QStringList keys;
    for (const QKeySequence& one : command.action->shortcuts())
      keys << one.toString(QKeySequence::NativeText);
    auto* line = new QTreeWidgetItem(group, {plain_text(command.text), keys.join(", "), command.tip});
    line->setToolTip(2, command.tip);
  }
  for (const MouseGesture& one : mouse_gestures()) {
    head(tr("Mouse and keys in the views"));
    auto* line = new QTreeWidgetItem(group, {one.where, one.gesture, one.does});
    line->setToolTip(1, one.gesture);
    line->setToolTip(2, one.does);
  }
}

void ShortcutsPage::search(const QString& text) {
  const QStringList words = text.split(' ', Qt::SkipEmptyParts);
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* group = list_->topLevelItem(i);
    bool any = false;
    for (int j = 0; j < group->childCount(); ++j) {
      QTreeWidgetItem* line = group->child(j);
      const QString all = group->text(0) + ' ' + line->text(0) + ' ' + line->text(1) + ' ' + line->text(2);
      bool found = true;
      for (const QString& word : words) found = found && all.contains(word, Qt::CaseInsensitive);
      line->setHidden(!found);
      any = any || found;
    }
    group->setHidden(!any);
  }
}

}  // namespace ostia::workstation
