#include "shell/desk.h"

#include <utility>

namespace ostia::workstation {

Desk::Desk(QWidget& window_, const std::filesystem::path& folder, Messages::Line status,
           Messages::Line shown_name)
    : window(window_),
      state_folder(folder),
      machine(folder),
      identity(bench, machine, folder),
      messages(window, std::move(status), std::move(shown_name)),
      jobs(*new Jobs(&window)) {}

}  // namespace ostia::workstation
