#include "shell/menus.h"

#include "commands/table.h"

#include <QMenu>
#include <QMenuBar>
#include <initializer_list>
#include <stdexcept>

namespace ostia::workstation {
namespace {

constexpr const char* line = "";  // between commands

class MenuBuilder {
  Q_DECLARE_TR_FUNCTIONS(ostia::workstation::Menus)
 public:
  MenuBuilder(QMenuBar& bar, const CommandTable& commands) : bar_(bar), commands_(commands) {}
  void file() {
    QMenu* menu = bar_.addMenu(tr("&File"));
    fill(menu, {"file.open", "file.open_folder", "file.archive", "file.series", "file.orientation"});
    fill(menu->addMenu(tr("PACS")), {"file.send", "file.outbox", "file.servers"});
    made.recent = menu->addMenu(tr("&Recent cases"));
    fill(menu, {"file.sample", line, "file.compare"});
    fill(menu->addMenu(tr("Compared with the &last scan")),
         {"compare.page", "compare.again", line, "compare.previous", "compare.next", "compare.blink",
          "compare.side", "compare.in_3d", line, "compare.report", "compare.save", line, "compare.close"});
    fill(menu, {line, "file.save_as", "file.close", line, "file.report_notes", "file.report", "file.pin"});
    fill(menu->addMenu(tr("&Export")),
         {"file.export_surface", "file.export_mesh", "file.flow_case", "file.export_centerlines"});
    fill(menu, {"file.open_mesh", "file.flow_results", "file.motion", "file.phases", line, "file.quit"});
  }
  void edit() { fill(bar_.addMenu(tr("&Edit")), {"edit.undo", "edit.redo", line, "edit.preferences"}); }
  void vessel() {
    QMenu* menu = bar_.addMenu(tr("Ve&ssel"));
    fill(menu, {"vessel.find", "vessel.split", "vessel.merge", "vessel.cut", "vessel.connect", line,
                "vessel.evaluable", "vessel.limited", "vessel.not_evaluable", "vessel.judged_by_program",
                "view.evaluability", line, "lesion.accept", "lesion.reject", "lesion.open", "lesion.comment",
                "lesion.copy", line});
    fill(menu->addMenu(tr("Calci&um score")),
         {"calcium.score", line, "calcium.lm", "calcium.lad", "calcium.lcx", "calcium.rca", "calcium.none",
          line, "calcium.report", "calcium.save"});
    QMenu* pressure = menu->addMenu(tr("&Pressure"));
    pressure->setToolTipsVisible(true);
    fill(pressure, {"view.pressure", "pressure.map", line, "pressure.open", "pressure.narrow",
                    "pressure.clear", line, "pressure.report"});
  }
  void tools() {
    QMenu* menu = bar_.addMenu(tr("&Tools"));
    fill(menu, {"tool.browse",     "tool.drag",
                "tool.draw",       "tool.brush",
                "tool.axis",       "tool.add_vessel",
                "tool.add_artery", line,
                "tool.distance",   "tool.angle",
                "tool.area",       "tool.diameter",
                "tool.stenosis",   "tool.volume",
                "tool.ring_hu",    "tool.arrow",
                "tool.note",       line,
                "view.play",       "view.own_phase"});
    fill(menu->addMenu(tr("Vessel t&ree")),
         {"tree.select", "tree.straight", "tree.along", "tree.angle", "tree.region", line, "tree.grid",
          "tree.subtree", line, "tree.fit", "tree.copy", "tree.export", "tree.clear", "tree.close"});
    fill(menu, {line, "tool.smaller", "tool.larger"});
    fill(menu->addMenu(tr("Mouse by keys")),
         {"mouse.left", "mouse.right", "mouse.up", "mouse.down", "mouse.press"});
    made.plugins = menu->addMenu(tr("Plug-&ins"));
    fill(made.plugins, {"plugins.look", "plugins.folder"});
  }
  void view() {
    QMenu* menu = bar_.addMenu(tr("&View"));
    menu->setToolTipsVisible(true);  // why a command cannot be used
    fill(menu, {"view.turn_left", "view.turn_right", "view.proximal", "view.distal", "view.next_vessel",
                "view.previous_vessel", line, "view.stretched", "view.contours", "view.outer_wall",
                "view.plaque", "view.fat", "view.identity", "view.fit", line});
    fill(menu->addMenu(tr("S&lab")),
         {"view.mip", "view.mean", "view.minip", line, "view.thinner", "view.thicker"});
    made.greys = menu->addMenu(tr("&Grey levels"));
    fill(made.greys, {"window.1", "window.2", "window.3", "window.4", line, "window.save", "window.forget"});
    fill(menu->addMenu(tr("Look at the tree from")),
         {"camera.front", "camera.left", "camera.right", "camera.above", "camera.rao30_cranial20",
          "camera.rao30_caudal20", "camera.lao40_cranial20", "camera.lao45_caudal25", "camera.ap0_cranial30",
          "camera.ap0_caudal30", "camera.rao30", "camera.lao45", "camera.lao90", "camera.angles", line,
          "camera.broadside"});
    fill(menu->addMenu(tr("Heart in &3D")),
         {"heart.controls", "heart.alone", "heart.tree", line, "heart.look_coronary", "heart.look_vessels",
          "heart.look_soft_tissue", "heart.look_bone", line, "heart.box", "heart.cut_inside",
          "heart.cut_outside", "heart.undo_cut", "heart.all_back"});
    made.layouts = menu->addMenu(tr("La&youts"));
    fill(made.layouts,
         {"view.layout_reading", "view.layout_planes", "view.layout_flat", line, "view.planes"});
    fill(made.layouts->addMenu(tr("Windows of their own")),
         {"view.float_vessels", "view.float_lists", "view.float_cpr1", "view.float_cpr2",
          "view.float_section", "view.float_neighbours", "view.float_slice", "view.float_tree",
          "view.float_profile", "view.float_lesions"});
    fill(made.layouts, {line, "view.layout_save", "view.layout_forget", "view.layout_first"});
    fill(menu->addMenu(tr("Series and phases")),
         {"view.series", "view.series_play", "view.best_phase", "view.own_series"});
    fill(menu, {line, "view.theme", "view.qa", "view.mesh"});
    fill(menu->addMenu(tr("Go to")), {"view.root", "view.end", "view.next_lesion", "view.previous_lesion",
                                      "view.next_doubt", "view.previous_doubt"});
    fill(menu->addMenu(tr("Panels")),
         {"panel.next", "panel.previous", "panel.alone", line, "panel.vessels", "panel.cpr1", "panel.cpr2",
          "panel.section", "panel.slice", "panel.tree", "panel.profile", "panel.measurements", "panel.steps",
          "panel.lesions"});
  }
  void help() {
    fill(bar_.addMenu(tr("&Help")), {"help.find_command", "help.manual", "help.shortcuts", "help.tour", line,
                                     "help.messages", "help.crash_reports", line, "help.about"});
  }
  BuiltMenus made;

 private:
  void fill(QMenu* menu, std::initializer_list<const char*> ids) {
    for (const char* id : ids) {
      if (!*id) {
        menu->addSeparator();
        continue;
      }
      menu->addAction(&commands_.action(id));
      made.order << id;
    }
  }
  QMenuBar& bar_;
  const CommandTable& commands_;
};

}  // namespace

BuiltMenus build_menus(QMenuBar& bar, const CommandTable& commands) {
  bar.setObjectName("menus");
  MenuBuilder builder(bar, commands);
  builder.file();
  builder.edit();
  builder.vessel();
  builder.tools();
  builder.view();
  builder.help();
  for (const Command& one : commands.all())
    if (!builder.made.order.contains(one.id))
      throw std::logic_error("no menu has the command " + one.id.toStdString());
  return builder.made;
}

}  // namespace ostia::workstation
