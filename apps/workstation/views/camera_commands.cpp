#include "views/camera_commands.h"

#include "commands/table.h"
#include "views/scene_widget.h"

#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

struct CarmAngles {
  double lao, cranial;  // degrees
};
constexpr CarmAngles usual_angles[] = {
    {-30.0, 20.0}, {-30.0, -20.0}, {40.0, 20.0}, {45.0, -25.0}, {0.0, 30.0}};

/// "rao30_cranial20".
QString name_of(const CarmAngles& carm) {
  const char* side = carm.lao < 0.0 ? "rao" : carm.lao > 0.0 ? "lao" : "ap";
  return QStringLiteral("%1%2_%3%4")
      .arg(side)
      .arg(std::abs(carm.lao))
      .arg(carm.cranial < 0.0 ? "caudal" : "cranial")
      .arg(std::abs(carm.cranial));
}

QString text_of(const CarmAngles& carm) {
  const QString side = carm.lao < 0.0 ? "RAO" : carm.lao > 0.0 ? "LAO" : "AP";
  const QString tilt = carm.cranial < 0.0 ? Command::tr("caudal") : Command::tr("cranial");
  return QStringLiteral("%1 %2\u00b0, %3 %4\u00b0")
      .arg(side)
      .arg(std::abs(carm.lao))
      .arg(tilt)
      .arg(std::abs(carm.cranial));
}

}  // namespace

void add_camera_commands(CommandTable& table, const session::Workbench& bench, SceneWidget& scene) {
  const auto from = [&](const QString& name, const QString& text, std::function<view::CameraPose()> pose) {
    table.add({.id = "camera." + name,
               .text = text,
               .tip = Command::tr("Turns the tree in 3D so that it is seen from there."),
               .run = [&scene, pose = std::move(pose)] { scene.go_to(pose()); }});
  };
  using view::ViewFrom;
  const auto side = [&scene](ViewFrom where) {
    return [&scene, where] { return scene.scene().pose_from_side(where); };
  };
  from("front", Command::tr("the front"), side(ViewFrom::anterior));
  from("left", Command::tr("the left"), side(ViewFrom::left));
  from("right", Command::tr("the right"), side(ViewFrom::right));
  from("above", Command::tr("above"), side(ViewFrom::cranial));
  for (const CarmAngles& carm : usual_angles)
    from(name_of(carm), text_of(carm), [&scene, carm] {
      return scene.scene().pose_from_carm({carm.lao, carm.cranial});
    });
  from("broadside", Command::tr("broadside of the vessel"),
       [&bench, &scene] { return scene.scene().pose_of_vessel(bench.vessel.get()); });
}

}  // namespace ostia::workstation
