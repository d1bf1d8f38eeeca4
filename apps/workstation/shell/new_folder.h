#pragma once
/// \file A folder that is to be made: its name, and what is wrong with it.

#include "shell/form_fields.h"

#include <QObject>
#include <QString>
#include <filesystem>
#include <string>

class QFormLayout;
class QLineEdit;

namespace ostia::workstation {

/// Empty where the folder can be made, as far as can be told without making it: it has a name, its place is
/// there and can be written, no file has the name. A folder that is there already may hold something.
QString folder_trouble(const QString& path);

/// `first`, or `first`-2, `first`-3, ...: the first of which there is nothing yet.
std::filesystem::path free_folder(const std::filesystem::path& first);
/// CASE-`what`, CASE-`what`-2, ... beside the case's file.
std::filesystem::path free_folder_beside(const std::filesystem::path& case_file, const std::string& what);

/// The row of a form that asks for it, with a button that chooses its place.
class NewFolderField final : public QObject {
  Q_OBJECT
 public:
  NewFolderField(QFormLayout* form, const std::filesystem::path& proposed, QObject* parent);
  QString text() const;
  std::filesystem::path path() const;
  void propose(const std::filesystem::path& folder);  ///< unless a person has named one
  /// Marks folder_trouble or, where there is none, `more`; returns whether nothing is wrong.
  bool check(const QString& more = {});
  void set_focus();

 signals:
  void changed();

 private:
  void choose_place();
  QLineEdit* name_;
  FormField field_;
  bool named_ = false;  // by a person
};

}  // namespace ostia::workstation
