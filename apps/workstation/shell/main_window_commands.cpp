// The commands of all parts, and what is made of them.

#include "archive/commands.h"
#include "archive/keyring.h"
#include "archive/outbox.h"
#include "calcium/commands.h"
#include "calcium/page.h"
#include "calcium/reading.h"
#include "commands/keyboard.h"
#include "commands/keyboard_commands.h"
#include "commands/table.h"
#include "comparison/commands.h"
#include "comparison/page.h"
#include "flow/commands.h"
#include "help/commands.h"
#include "help/crash_reports.h"
#include "help/help.h"
#include "measuring/commands.h"
#include "measuring/lesions.h"
#include "meshing/commands.h"
#include "opening/commands.h"
#include "opening/orientation.h"
#include "opening/recent_cases.h"
#include "phases/commands.h"
#include "plugins/commands.h"
#include "plugins/plugins.h"
#include "pressure/commands.h"
#include "pressure/page.h"
#include "qa/commands.h"
#include "qa/dock.h"
#include "shell/commands.h"
#include "shell/layouts.h"
#include "shell/main_window.h"
#include "shell/menus.h"
#include "shell/tool_bars.h"
#include "trees/commands.h"
#include "trees/opening.h"
#include "vessels/commands.h"
#include "vessels/doubts.h"
#include "vessels/fat.h"
#include "vessels/finder.h"
#include "views/commands.h"
#include "views/grey_presets.h"
#include "views/heart_commands.h"
#include "views/heart_dock.h"
#include "views/heart_volume.h"
#include "views/planes_dock.h"
#include "views/scissors.h"

#include <QActionGroup>
#include <QMenuBar>
#include <QTimer>

namespace ostia::workstation {

/// Of what is no step of the case on the table.
StepsBeside MainWindow::steps_beside() {
  return {
      [this] {
        return calcium_->can_take_back() || finder_->can_take_back() || orientation_->can_take_back();
      },
      [this] { return calcium_->can_do_again() || finder_->can_do_again() || orientation_->can_do_again(); },
      [this] {
        if (calcium_->can_take_back())
          calcium_->take_back();
        else
          finder_->can_take_back() ? finder_->take_back() : orientation_->take_back();
      },
      [this] {
        if (calcium_->can_do_again())
          calcium_->do_again();
        else
          finder_->can_do_again() ? finder_->do_again() : orientation_->do_again();
      }};
}

void MainWindow::build_commands() {
  commands_ = new CommandTable(desk_);
  trees_ = std::make_unique<TreeOpening>(desk_, *this, *commands_);
  auto& tools = *new QActionGroup(commands_);
  auto* keyboard = new Keyboard(this);
  auto* help = new Help(desk_, *commands_);
  add_shell_commands(*commands_, desk_, panels_->scene(), steps_beside());
  add_keyboard_commands(*commands_, *keyboard);
  add_opening_commands(*commands_, desk_, *opening_, *orientation_);
  auto* outbox = new Outbox(desk_, desktop_keyring());
  add_archive_commands(*commands_, desk_, *opening_, *outbox, desktop_keyring());
  auto* greys = new GreyPresets(desk_);
  add_grey_preset_commands(*commands_, *greys);
  add_layout_commands(*commands_, desk_, *layouts_, *planes_);
  add_floating_commands(*commands_, panels_->floating());
  add_view_commands(*commands_, desk_, panels_->pictures(), panels_->scene(), tools);
  add_heart_commands(*commands_, desk_, *heart_, *scissors_, *heart_dock_);
  heart_dock_->add_buttons(*commands_);
  add_vessel_commands(*commands_, desk_, *finder_, *outer_walls_, *evaluability_, tools);
  add_lesion_commands(*commands_, desk_, *lesions_);
  add_doubt_commands(*commands_, desk_, panels_->doubts());
  add_measuring_commands(*commands_, desk_, *reporting_, tools);
  add_meshing_commands(*commands_, desk_, *meshing_);
  add_flow_commands(*commands_, desk_, *flow_cases_, *flow_results_);
  add_tree_commands(*commands_, *trees_);
  add_pressure_commands(*commands_, desk_, *pressures_, *pressure_page_);
  pressure_page_->add_buttons(*commands_);
  add_calcium_commands(*commands_, desk_, *calcium_, *calcium_page_);
  calcium_page_->add_buttons(*commands_);
  add_fat_commands(*commands_, *fat_page_);
  add_comparison_commands(*commands_, desk_, *comparing_, *comparison_page_, panels_->scene(), *reporting_);
  comparison_page_->add_buttons(*commands_);
  add_phase_commands(*commands_, desk_, *beating_);
  add_series_commands(*commands_, desk_, *series_);
  auto* plugins = new Plugins(desk_, *opening_, *flow_results_);
  add_plugin_commands(*commands_, *plugins);
  add_qa_commands(*commands_, *qa_);
  add_help_commands(*commands_, *help);
  auto* crashes = new CrashReports(desk_);
  add_crash_commands(*commands_, *crashes);
  QTimer::singleShot(0, crashes, &CrashReports::offer);
  const BuiltMenus menus = build_menus(*menuBar(), *commands_);
  list_recent_cases(*menus.recent, desk_, [this](const QString& path) { open(path.toStdString()); });
  list_own_layouts(*menus.layouts, *layouts_);
  list_grey_presets(*menus.greys, *greys);
  list_plugins_in(*menus.plugins, *commands_, *plugins);
  QTimer::singleShot(0, plugins, [plugins] { plugins->look(); });
  connect(&commands_->action("view.fit"), &QAction::triggered, planes_, &PlanesDock::fit);
  connect(&commands_->action("view.fit"), &QAction::triggered, comparison_page_, &ComparisonPage::fit);
  commands_->arrange(menus.order);
  commands_->dress();
  build_tool_bars(*this, *commands_, desk_);
}

}  // namespace ostia::workstation
