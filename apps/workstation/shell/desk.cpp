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
      jobs(*new Jobs(&window)) {
  const auto over = [this](const auto&...) { failure.set({}); };
  own_.push_back(bench.case_changed.observe(over));
  own_.push_back(bench.image_changed.observe(over));
}

void Desk::cannot_open(const QString& reason, const QString& title) {
  if (bench.has_case() || bench.image().volume) return messages.complain(reason, title);
  messages.keep(title + ": " + reason);
  failure.set({title, reason, {"file.series", "file.open", "file.open_folder", "file.sample"}});
}

}  // namespace ostia::workstation
