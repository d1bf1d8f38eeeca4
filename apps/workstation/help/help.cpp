#include "help/help.h"

#include "commands/palette.h"
#include "commands/shortcuts_page.h"
#include "commands/table.h"
#include "help/about_dialog.h"
#include "help/manual_dialog.h"
#include "help/tour.h"
#include "shell/desk.h"
#include "shell/one_dialog.h"

namespace ostia::workstation {
namespace {

constexpr const char* tour_setting = "tour";

}  // namespace

Help::Help(Desk& desk, const CommandTable& commands)
    : QObject(&desk.window), desk_(desk), commands_(commands) {}

bool Help::wants_tour(const session::MachineState& machine) {
  const std::map<std::string, std::string> settings = machine.settings();
  const auto wish = settings.find(tour_setting);
  return wish != settings.end() ? wish->second == "again"
                                : settings.empty() && machine.recent_cases().empty();
}

void Help::greet() {
  if (wants_tour(desk_.machine) && qEnvironmentVariableIsEmpty("OSTIA_NO_TOUR")) show_tour();
}

void Help::show_tour() {
  delete tour_;  // keys may be others by now
  tour_ = new Tour(desk_.window, commands_.keys());
  connect(tour_, &Tour::ended, this, [this](bool again) {
    desk_.messages.guarded([&] { desk_.machine.set_setting(tour_setting, again ? "again" : "seen"); });
  });
  tour_->begin();
}

void Help::show_palette() {
  (new Palette(commands_, desk_.window))->begin();
}

void Help::show_shortcuts() {
  show_one<ShortcutsPage>(desk_.window, commands_, &desk_.window);
}

void Help::show_manual() {
  show_one<ManualDialog>(desk_.window, &desk_.window);
}

void Help::show_about() {
  show_one<AboutDialog>(desk_.window, &desk_.window);
}

}  // namespace ostia::workstation
