#pragma once
/// \file Asking for files and folders without leaving a trace of what was chosen.

#include <QString>

class QWidget;

namespace ostia::workstation {

/// Each shows a modal dialog and returns the absolute path that was chosen, empty where none was. Nothing
/// about it is written anywhere: paths may name a patient, and Qt's file dialogs, or those of the desktop,
/// would keep them among the user's settings and recent files.
///
/// `start`: the folder to begin in, or a file there to suggest; empty: the folder that was last chosen from
/// since the program began, at first the current one. `filter` as of QFileDialog: "Cases (*.ostia);;All
/// files (*)".
QString ask_open_file(QWidget* parent, const QString& title, const QString& filter = {},
                      const QString& start = {});
/// Asks again before the name of a file that is there is returned.
QString ask_save_file(QWidget* parent, const QString& title, const QString& filter = {},
                      const QString& start = {});
/// For a file that must not be there yet: does not offer to replace one.
QString ask_new_file(QWidget* parent, const QString& title, const QString& filter = {},
                     const QString& start = {});
QString ask_folder(QWidget* parent, const QString& title, const QString& start = {});

}  // namespace ostia::workstation
