#include "views/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "views/camera_commands.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/analysis/aha_segments.h"

#include <array>
#include <cmath>

namespace ostia::workstation {
namespace {

using session::Workbench;

void turn(Workbench& bench, double degrees) {
  bench.theta_deg.set(std::remainder(bench.theta_deg.get() + degrees, 360.0));
}

void walk(Workbench& bench, double mm) {
  bench.cursor_mm.set(bench.cursor_mm.get() + mm);
}

void next_vessel(Workbench& bench, int by) {
  const lumen::LumenModel* model = bench.model();
  if (!model) return;
  const std::vector<std::int32_t> vessels = analysis::vessels_in_reading_order(model->tree);
  const int count = static_cast<int>(vessels.size());
  for (int i = 0; i < count; ++i)
    if (vessels[static_cast<std::size_t>(i)] == bench.vessel.get()) {
      bench.vessel.set(vessels[static_cast<std::size_t>((i + by + count) % count)]);
      return;
    }
}

void change_slab(Workbench& bench, double steps) {
  bench.slab_mm.set(bench.slab_mm.get() + steps * bench.slab_mm.range()->step);
}

void add_walking(CommandTable& table, Workbench& bench) {
  table.add({.id = "view.turn_left",
             .text = Command::tr("Turn the CPRs left"),
             .tip = Command::tr("Turns both CPRs by five degrees about the vessel's axis."),
             .keys = {"[; Alt+Left"},
             .run = [&bench] { turn(bench, -5.0); }});
  table.add({.id = "view.turn_right",
             .text = Command::tr("Turn the CPRs right"),
             .tip = Command::tr("Turns both CPRs by five degrees about the vessel's axis."),
             .keys = {"]; Alt+Right"},
             .run = [&bench] { turn(bench, 5.0); }});
  table.add({.id = "view.proximal",
             .text = Command::tr("To proximal"),
             .tip = Command::tr("The cursor goes half a millimetre towards the ostium."),
             .keys = {"Ctrl+Up", "K; Ctrl+Up"},
             .run = [&bench] { walk(bench, -0.5); }});
  table.add({.id = "view.distal",
             .text = Command::tr("To distal"),
             .tip = Command::tr("The cursor goes half a millimetre towards the vessel's end."),
             .keys = {"Ctrl+Down", "J; Ctrl+Down"},
             .run = [&bench] { walk(bench, 0.5); }});
  table.add({.id = "view.next_vessel",
             .text = Command::tr("Next vessel"),
             .tip = Command::tr("Shows the next vessel of the list."),
             .keys = {"Ctrl+Right", "N; Ctrl+Right"},
             .run = [&bench] { next_vessel(bench, 1); }});
  table.add({.id = "view.previous_vessel",
             .text = Command::tr("Previous vessel"),
             .tip = Command::tr("Shows the previous vessel of the list."),
             .keys = {"Ctrl+Left", "P; Ctrl+Left"},
             .run = [&bench] { next_vessel(bench, -1); }});
  table.add({.id = "view.root",
             .text = Command::tr("Beginning of the vessel"),
             .tip = Command::tr("The cursor goes to where the vessel begins."),
             .keys = {"Ctrl+Home"},
             .run = [&bench] { bench.cursor_mm.set(0.0); }});
  table.add({.id = "view.end",
             .text = Command::tr("End of the vessel"),
             .tip = Command::tr("The cursor goes to where the vessel ends."),
             .keys = {"Ctrl+End"},
             .run = [&bench] {
               if (const auto axis = bench.axis()) bench.cursor_mm.set(axis->length());
             }});
}

void add_drawing(CommandTable& table, Workbench& bench) {
  using reformat::CurvedMode, reformat::Slab;
  table.add({.id = "view.stretched",
             .text = Command::tr("Stretched CPR"),
             .tip = Command::tr("The CPRs keep the vessel's bends in one direction instead of none."),
             .keys = {"T"},
             .bind = [&bench](QAction& action) {
               bind_switch(&action, bench.curved_mode, CurvedMode::straightened, CurvedMode::stretched);
             }});
  table.add(
      {.id = "view.mip",
       .text = Command::tr("Slab: maximum"),
       .tip = Command::tr("2D views show the largest CT number within the slab's thickness."),
       .keys = {"M"},
       .bind = [&bench](QAction& action) { bind_switch(&action, bench.slab, Slab::none, Slab::maximum); }});
  table.add(
      {.id = "view.mean",
       .text = Command::tr("Slab: mean"),
       .tip = Command::tr("2D views show the mean CT number within the slab's thickness."),
       .keys = {"Shift+M"},
       .bind = [&bench](QAction& action) { bind_switch(&action, bench.slab, Slab::none, Slab::mean); }});
  table.add(
      {.id = "view.minip",
       .text = Command::tr("Slab: minimum"),
       .tip = Command::tr("2D views show the smallest CT number within the slab's thickness."),
       .bind = [&bench](QAction& action) { bind_switch(&action, bench.slab, Slab::none, Slab::minimum); }});
  table.add({.id = "view.thinner",
             .text = Command::tr("Thinner slab"),
             .tip = Command::tr("Makes the slab of the 2D views thinner."),
             .keys = {"Ctrl+Shift+Down"},
             .run = [&bench] { change_slab(bench, -1.0); }});
  table.add({.id = "view.thicker",
             .text = Command::tr("Thicker slab"),
             .tip = Command::tr("Makes the slab of the 2D views thicker."),
             .keys = {"Ctrl+Shift+Up"},
             .run = [&bench] { change_slab(bench, 1.0); }});
  table.add({.id = "view.contours",
             .text = Command::tr("Contours"),
             .tip = Command::tr("Shows or hides the lumen's contour on all views."),
             .keys = {"Space"},
             .bind = [&bench](QAction& action) { bind_checked(&action, bench.contours_shown); }});
}

void add_identity(CommandTable& table, Desk& desk) {
  table.add({.id = "view.identity",
             .text = Command::tr("Patient on the views"),
             .tip = Command::tr(
                 "Writes in a corner of each image whose it is. Pictures of a report never have it."),
             .bind = [&desk](QAction& action) { bind_checked(&action, desk.identity.on_views); }});
}

/// Of session::window_presets(), in their order.
void add_grey_levels(CommandTable& table, Workbench& bench) {
  const std::array tips{Command::tr("Grey levels for contrast-filled vessels."),
                        Command::tr("Grey levels for muscle, fat and thrombus."),
                        Command::tr("Grey levels for the lungs."),
                        Command::tr("Grey levels for bone and calcium.")};
  constexpr int first_function_key = 5;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const session::WindowPreset& preset = session::window_presets().at(i);
    const int number = static_cast<int>(i);
    table.add(
        {.id = QStringLiteral("window.%1").arg(number + 1),
         .text = Command::tr("Window: %1").arg(QCoreApplication::translate("presets", preset.name.c_str())),
         .tip = tips[i],
         .keys = {QStringLiteral("F%1").arg(first_function_key + number)},
         .run = [&bench, window = preset.window] { bench.grey.set(window); }});
  }
}

}  // namespace

void add_view_commands(CommandTable& table, Desk& desk, const std::vector<PictureWidget*>& pictures,
                       SceneWidget& scene, QActionGroup& tools) {
  table.add(tool_command(
      {
          .text = Command::tr("Browse"),
          .tip = Command::tr("The cursor goes where you click. Shift and drag: turn the CPR."),
          .keys = {"Esc", "Q; Esc"},
      },
      session::Tool::browse, desk, tools));
  add_walking(table, desk.bench);
  add_drawing(table, desk.bench);
  table.add({.id = "view.fit",
             .text = Command::tr("Fit all views"),
             .tip = Command::tr("All views show all there is."),
             .keys = {"Ctrl+0", "F"},
             .run = [pictures, &scene] {
               for (PictureWidget* picture : pictures) picture->view().fit();
               scene.go_to(scene.scene().pose_fitted());
             }});
  add_grey_levels(table, desk.bench);
  add_identity(table, desk);
  add_camera_commands(table, desk, scene);
}

}  // namespace ostia::workstation
