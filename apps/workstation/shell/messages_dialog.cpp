#include "shell/messages_dialog.h"

#include "shell/desk.h"
#include "shell/hanging.h"

#include <QApplication>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QVBoxLayout>

namespace ostia::workstation {

MessagesDialog::MessagesDialog(Desk& desk)
    : QDialog(&desk.window), desk_(desk), text_(new QPlainTextEdit(this)) {
  setObjectName("messages");
  setWindowTitle(tr("Messages"));
  resize_within(*this, QSize(640, 360));
  text_->setObjectName("messages_text");
  text_->setAccessibleName(tr("Messages"));
  text_->setReadOnly(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text_->setPlaceholderText(tr("Nothing was said yet."));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton(tr("Copy all"), QDialogButtonBox::ActionRole);
  copy->setAutoDefault(false);
  connect(copy, &QPushButton::clicked, this,
          [this] { QApplication::clipboard()->setText(text_->toPlainText()); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* rows = new QVBoxLayout(this);
  rows->addWidget(text_, 1);
  rows->addWidget(buttons);
  more_ = desk.messages.logged.observe([this] { fill(); });
  fill();
}

void MessagesDialog::fill() {
  QStringList lines;
  for (const Said& one : desk_.messages.log())
    lines << one.time.toString(QStringLiteral("HH:mm:ss")) + QStringLiteral("   ") + one.text;
  text_->setPlainText(lines.join('\n'));
  text_->verticalScrollBar()->setValue(text_->verticalScrollBar()->maximum());
}

}  // namespace ostia::workstation
