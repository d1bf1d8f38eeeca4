#pragma once
/// \file What every part of the workstation works with.

#include "shell/identity.h"
#include "shell/jobs.h"
#include "shell/messages.h"

#include "ostia/session/machine_state.h"
#include "ostia/session/workbench.h"

#include <filesystem>

namespace ostia::workstation {

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
  std::filesystem::path case_path;  ///< of the case that is open; empty where none is
};

}  // namespace ostia::workstation
