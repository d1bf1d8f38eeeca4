#pragma once
/// \file What every part of the workstation works with.

#include "shell/identity.h"
#include "shell/jobs.h"
#include "shell/messages.h"

#include "ostia/session/machine_state.h"
#include "ostia/session/property.h"
#include "ostia/session/workbench.h"

#include <QString>
#include <QStringList>
#include <filesystem>
#include <vector>

namespace ostia::workstation {

/// Of the machine's settings: the name that stands at steps; empty or missing for none.
constexpr const char* author_setting = "author";

/// Why there is nothing to see, and what can be done.
struct Failure {
  QString title{}, reason{};
  QStringList ways{};  ///< ids of commands
  bool operator==(const Failure& other) const = default;
};

/// The workbench, what is known of this machine, long work, and the words to the person. A part that needs
/// more than this is given it by name.
struct Desk {
  /// `window` is what dialogs belong to; it owns the jobs' lines. `folder` is this machine's: recent cases,
  /// places of images, settings.
  Desk(QWidget& window, const std::filesystem::path& folder, Messages::Line status = {},
       Messages::Line shown_name = {});
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  QWidget& window;
  const std::filesystem::path state_folder;
  session::Workbench bench;
  session::MachineState machine;
  Identity identity;  ///< whose image is on the table
  Messages messages;
  Jobs& jobs;
  /// Stands in place of the empty views, until there is a case or another image. None: without a title.
  session::Property<Failure> failure;
  /// Why nothing could be opened: in the views' place where they are empty, else in a dialog.
  void cannot_open(const QString& reason, const QString& title);
  std::filesystem::path case_path;  ///< of the case that is open; empty where none is

 private:
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
