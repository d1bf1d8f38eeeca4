#include "views/camera_commands.h"

#include "commands/table.h"
#include "shell/desk.h"
#include "views/scene_widget.h"

#include "ostia/geometry/carm_words.h"

#include <QInputDialog>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

struct CarmAngles {
  double lao, cranial;  // degrees
};
constexpr CarmAngles usual_angles[] = {{-30.0, 20.0}, {-30.0, -20.0}, {40.0, 20.0},
                                       {45.0, -25.0}, {0.0, 30.0},    {0.0, -30.0},
                                       {-30.0, 0.0},  {45.0, 0.0},    {90.0, 0.0}};

/// "rao30_cranial20".
QString name_of(const CarmAngles& carm) {
  const char* side = carm.lao < 0.0 ? "rao" : carm.lao > 0.0 ? "lao" : "ap";
  if (carm.cranial == 0.0) return QStringLiteral("%1%2").arg(side).arg(std::abs(carm.lao));
  return QStringLiteral("%1%2_%3%4")
      .arg(side)
      .arg(std::abs(carm.lao))
      .arg(carm.cranial < 0.0 ? "caudal" : "cranial")
      .arg(std::abs(carm.cranial));
}

QString text_of(const CarmAngles& carm) {
  const QString side = carm.lao < 0.0 ? "RAO" : carm.lao > 0.0 ? "LAO" : "AP";
  if (carm.cranial == 0.0) return QStringLiteral("%1 %2\u00b0").arg(side).arg(std::abs(carm.lao));
  const QString tilt = carm.cranial < 0.0 ? Command::tr("caudal") : Command::tr("cranial");
  return QStringLiteral("%1 %2\u00b0, %3 %4\u00b0")
      .arg(side)
      .arg(std::abs(carm.lao))
      .arg(tilt)
      .arg(std::abs(carm.cranial));
}

/// Begins with the angles as they are.
void ask_for_angles(Desk& desk, SceneWidget& scene) {
  const std::string now = geometry::text_of(view::carm_angles(scene.scene().pose()));
  bool given = false;
  const QString text =
      QInputDialog::getText(&desk.window, Command::tr("The C-arm's angles"),
                            Command::tr("AP, LAT, or angles as \"LAO 30 CRA 20\", \"RAO 30 CAU 25\":"),
                            QLineEdit::Normal, QString::fromStdString(now), &given);
  if (!given) return;
  desk.messages.guarded(
      [&] { scene.go_to(scene.scene().pose_from_carm(geometry::carm_angles(text.toStdString()))); }, true);
}

}  // namespace

void add_camera_commands(CommandTable& table, Desk& desk, SceneWidget& scene) {
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
       [&desk, &scene] { return scene.scene().pose_of_vessel(desk.bench.vessel.get()); });
  table.add({.id = "camera.angles",
             .text = Command::tr("C-arm angles\u2026"),
             .tip = Command::tr("Turns the tree in 3D to angles that you type."),
             .run = [&desk, &scene] { ask_for_angles(desk, scene); }});
}

}  // namespace ostia::workstation
