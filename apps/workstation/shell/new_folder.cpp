#include "shell/new_folder.h"

#include "shell/file_dialogs.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QFormLayout>
#include <QLineEdit>
#include <QPushButton>
#include <system_error>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

/// The words of the dialogs that export surfaces and meshes.
QString words(const char* text) {
  return QCoreApplication::translate("ostia::workstation::MeshingDialog", text);
}

constexpr const char* no_name = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "Name a new folder.");
constexpr const char* a_file = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog",
                                                 "There is a file of this name. Name another folder.");
constexpr const char* nowhere =
    QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "There is no folder %1.");
constexpr const char* closed = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog",
                                                 "Nothing can be written in %1. Choose another place.");
constexpr const char* new_folder = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "&New folder");
constexpr const char* that_is_made =
    QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "Folder that is made");
constexpr const char* choose = QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "&Choose\u2026");
constexpr const char* where =
    QT_TRANSLATE_NOOP("ostia::workstation::MeshingDialog", "Where the folder is to be");

}  // namespace

QString folder_trouble(const QString& path) {
  const QFileInfo folder(path), parent(folder.absolutePath());
  if (path.isEmpty() || folder.fileName().isEmpty() || folder.fileName() == "." || folder.fileName() == "..")
    return words(no_name);
  if (folder.exists() && !folder.isDir()) return words(a_file);
  if (!parent.exists()) return words(nowhere).arg(parent.filePath());
  if (!parent.isDir() || !parent.isWritable()) return words(closed).arg(parent.filePath());
  return {};
}

fs::path free_folder(const fs::path& first) {
  std::error_code ignored;
  fs::path folder = first;
  for (int number = 2; fs::exists(folder, ignored); ++number)
    folder = first.string() + "-" + std::to_string(number);
  return folder;
}

fs::path free_folder_beside(const fs::path& case_file, const std::string& what) {
  return free_folder(case_file.parent_path() / (case_file.stem().string() + "-" + what));
}

NewFolderField::NewFolderField(QFormLayout* form, const fs::path& proposed, QObject* parent)
    : QObject(parent), name_(new QLineEdit(QString::fromStdString(proposed.string()))) {
  name_->setObjectName("folder");
  name_->setAccessibleName(words(that_is_made));
  auto* button = new QPushButton(words(choose));
  button->setObjectName("choose_folder");
  button->setAutoDefault(false);
  field_ = add_form_field(form, words(new_folder), in_a_row({name_, button}), name_, "folder");
  connect(name_, &QLineEdit::textEdited, this, [this] { named_ = true; });
  connect(name_, &QLineEdit::textChanged, this, &NewFolderField::changed);
  connect(button, &QPushButton::clicked, this, &NewFolderField::choose_place);
}

QString NewFolderField::text() const {
  return name_->text();
}

fs::path NewFolderField::path() const {
  return name_->text().toStdString();
}

void NewFolderField::propose(const fs::path& folder) {
  if (!named_) name_->setText(QString::fromStdString(folder.string()));
}

bool NewFolderField::check(const QString& more) {
  const QString own = folder_trouble(name_->text());
  return mark(field_, own.isEmpty() ? more : own);
}

void NewFolderField::set_focus() {
  name_->setFocus();
}

void NewFolderField::choose_place() {
  const QFileInfo now(name_->text());
  const QString inside = ask_folder(name_->window(), words(where), now.absolutePath());
  if (inside.isEmpty()) return;
  named_ = true;
  name_->setText(inside + "/" + now.fileName());
}

}  // namespace ostia::workstation
