#include "views/heart_commands.h"

#include "commands/table.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "views/heart_dock.h"
#include "views/heart_volume.h"
#include "views/scissors.h"

#include <utility>

namespace ostia::workstation {
namespace {

Command needs_image(Command command, const Desk& desk) {
  command.enabled = [&desk] { return desk.bench.image().volume != nullptr; };
  command.why_not = [] { return Command::tr("No image is open."); };
  return command;
}

void add_looks(CommandTable& table, const Desk& desk, HeartVolume& heart) {
  const auto add = [&](const char* id, const QString& text, const QString& tip, view::VolumePreset preset) {
    table.add(needs_image({.id = id,
                           .text = text,
                           .tip = tip,
                           .run =
                               [&heart, preset] {
                                 heart.preset.set(preset);
                                 heart.reset_look();
                                 heart.show();
                               }},
                          desk));
  };
  using view::VolumePreset;
  add("heart.look_coronary", Command::tr("Look: coronary arteries"),
      Command::tr("The heart closed and lit, contrast light on dark muscle."), VolumePreset::coronary);
  add("heart.look_vessels", Command::tr("Look: contrast alone"),
      Command::tr("Muscle is hardly there: vessels and chambers are seen through it."),
      VolumePreset::vessels);
  add("heart.look_soft_tissue", Command::tr("Look: soft tissue"), Command::tr("All that is denser than fat."),
      VolumePreset::soft_tissue);
  add("heart.look_bone", Command::tr("Look: bone"), Command::tr("Bone, calcium and dense contrast alone."),
      VolumePreset::bone);
}

void add_scissors(CommandTable& table, const Desk& desk, HeartVolume& heart, Scissors& scissors) {
  const auto take_up = [&desk, &heart, &scissors](bool keep_inside) {
    heart.show();
    scissors.take_up(keep_inside);
    desk.messages.say(keep_inside ? Command::tr("Draw a line in 3D about what is to stay; Escape: no cut.")
                                  : Command::tr("Draw a line in 3D about what is to go; Escape: no cut."));
  };
  table.add(needs_image({.id = "heart.cut_inside",
                         .text = Command::tr("Cut away what I draw around"),
                         .tip = Command::tr("Scissors: what lies behind the line's inside goes."),
                         .run = [take_up] { take_up(false); }},
                        desk));
  table.add(needs_image({.id = "heart.cut_outside",
                         .text = Command::tr("Keep only what I draw around"),
                         .tip = Command::tr("Scissors: what lies outside of the line goes."),
                         .run = [take_up] { take_up(true); }},
                        desk));
  table.add(needs_image({.id = "heart.undo_cut",
                         .text = Command::tr("Take the last cut back"),
                         .run =
                             [&desk, &heart] {
                               if (!heart.undo_cut()) desk.messages.say(Command::tr("Nothing has been cut."));
                             }},
                        desk));
  table.add(needs_image({.id = "heart.all_back",
                         .text = Command::tr("All cuts and the box back"),
                         .run =
                             [&heart] {
                               heart.crop.set({});
                               heart.reset_cuts();
                             }},
                        desk));
}

}  // namespace

void add_heart_commands(CommandTable& table, Desk& desk, HeartVolume& heart, Scissors& scissors,
                        HeartDock& dock) {
  table.add({.id = "heart.controls",
             .text = Command::tr("&Heart in 3D"),
             .tip = Command::tr("Look, box and scissors of the CT behind the tree."),
             .action = dock.toggleViewAction()});
  table.add({.id = "heart.alone",
             .text = Command::tr("Heart without bones"),
             .tip = Command::tr("Ribs, breastbone, spine and what lies far from the arteries are left out."),
             .bind = [&heart](QAction& action) { bind_checked(&action, heart.alone); }});
  table.add({.id = "heart.tree",
             .text = Command::tr("Tree over the heart"),
             .tip = Command::tr("Without it the arteries are those of the CT, as the look shows them."),
             .bind = [&heart](QAction& action) { bind_checked(&action, heart.tree_over_it); }});
  table.add({.id = "heart.box",
             .text = Command::tr("Box with handles"),
             .tip = Command::tr("A frame about the heart; a side that is pulled cuts away what lies beyond."),
             .bind = [&heart](QAction& action) { bind_checked(&action, heart.box_shown); }});
  add_looks(table, desk, heart);
  add_scissors(table, desk, heart, scissors);
}

}  // namespace ostia::workstation
