#include "help/crash_reports.h"

#include "shell/crash_watch.h"
#include "shell/desk.h"
#include "shell/hanging.h"
#include "shell/one_dialog.h"

#include "ostia/core/files.h"

#include <QApplication>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr const char* offered_setting = "crash_report.offered";  // the newest of those that were

}  // namespace

CrashReports::CrashReports(Desk& desk) : QObject(&desk.window), desk_(desk) {
  left();
}

std::vector<std::filesystem::path> CrashReports::left() {
  std::vector<std::filesystem::path> all = crash_reports(crash_folder(desk_.state_folder));
  any_ = !all.empty();
  return all;
}

void CrashReports::offer() {
  const auto reports = left();
  if (reports.empty()) return;
  const std::string newest = reports.back().filename().string();
  if (desk_.machine.setting(offered_setting).value_or("") >= newest) return;
  desk_.messages.guarded([&] { desk_.machine.set_setting(offered_setting, newest); });
  auto* box = new QMessageBox(
      QMessageBox::Information, tr("The last session"),
      tr("The program ended by itself the last time; the case is as it was. It has left a report on this "
         "computer, with its version, the last commands and where in the program it was, and with no name "
         "and "
         "no path. It is sent to nobody."),
      QMessageBox::NoButton, &desk_.window);
  box->setObjectName("crash_report");
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* look = box->addButton(tr("Look at it"), QMessageBox::AcceptRole);
  QPushButton* remove = box->addButton(tr("Delete it"), QMessageBox::DestructiveRole);
  box->setEscapeButton(box->addButton(tr("Later"), QMessageBox::RejectRole));
  connect(box, &QMessageBox::buttonClicked, this, [this, look, remove](QAbstractButton* button) {
    if (button == look) show();
    if (button == remove) delete_all();
  });
  box->open();
}

void CrashReports::show() {
  show_one<CrashReportDialog>(desk_.window, desk_, *this, left());
}

void CrashReports::delete_all() {
  for (const std::filesystem::path& one : left()) {
    std::error_code error;
    std::filesystem::remove(one, error);
    if (error) return desk_.messages.complain(tr("A report could not be deleted."));
  }
  left();
  desk_.messages.say(tr("There is no report of a crash any more."));
}

CrashReportDialog::CrashReportDialog(Desk& desk, CrashReports& reports,
                                     const std::vector<std::filesystem::path>& left)
    : QDialog(&desk.window) {
  setObjectName("crash_reports");
  setWindowTitle(tr("Reports of crashes"));
  resize_within(*this, QSize(620, 420));
  auto* rows = new QVBoxLayout(this);
  auto* about = new QLabel(tr("Whoever looks for the fault needs this text. Copy it into your message, or "
                              "delete it."),
                           this);
  about->setWordWrap(true);
  rows->addWidget(about);
  auto* text = new QPlainTextEdit(this);
  text->setObjectName("crash_text");
  text->setAccessibleName(tr("Reports of crashes"));
  text->setReadOnly(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text->setLineWrapMode(QPlainTextEdit::NoWrap);
  QString all;
  desk.messages.guarded([&] {
    for (const std::filesystem::path& one : left) all += QString::fromStdString(core::read_file(one)) + '\n';
  });
  text->setPlainText(all);
  rows->addWidget(text, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton(tr("Copy all"), QDialogButtonBox::ActionRole);
  QPushButton* remove = buttons->addButton(tr("Delete"), QDialogButtonBox::DestructiveRole);
  remove->setObjectName("crash_delete");
  for (QPushButton* one : {copy, remove}) one->setAutoDefault(false);
  connect(copy, &QPushButton::clicked, this,
          [text] { QApplication::clipboard()->setText(text->toPlainText()); });
  connect(remove, &QPushButton::clicked, this, [this, &reports] {
    reports.delete_all();
    accept();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  rows->addWidget(buttons);
}

}  // namespace ostia::workstation
