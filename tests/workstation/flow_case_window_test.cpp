// Cases for a flow solver written and run through the window, by mouse and keys.

#include "flow/cases.h"
#include "flow_window.h"
#include "meshing/dialog.h"
#include "views/picture_widget.h"

#include "ostia/core/child_process.h"
#include "ostia/solver/openfoam_launch.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QPointer>
#include <QToolButton>
#include <QTreeWidget>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::message;
using testing::pick;
using testing::radius_mm;
using testing::type;
using testing::wait_until;

struct FlowCaseWindow : testing::FlowWindow {};

/// The environment's PATH with a folder of programs before it; as it was at the end.
class PathWith {
 public:
  explicit PathWith(const fs::path& folder, bool alone = false) : before_(qgetenv("PATH")) {
    const QByteArray first = QByteArray::fromStdString(folder.string());
    qputenv("PATH", alone ? first : first + ":" + before_);
  }
  ~PathWith() { qputenv("PATH", before_); }
  PathWith(const PathWith&) = delete;
  PathWith& operator=(const PathWith&) = delete;

 private:
  QByteArray before_;
};

/// A simpleFoam that does what the script says.
void write_solver(const fs::path& folder, const std::string& script) {
  fs::create_directory(folder);
  for (const char* name : {"simpleFoam", "checkMesh"}) {
    core::write_file(folder / name,
                     name == std::string("checkMesh") ? "#!/bin/sh\ntrue\n" : "#!/bin/sh\n" + script);
    fs::permissions(folder / name, fs::perms::owner_all);
  }
}

bool openfoam_is_here() {
  return core::program_on_path("simpleFoam").has_value();
}

TEST_F(FlowCaseWindow, TheDialogListsTheEndsAndSaysWhatIsWrong) {
  write_mesh();
  const fs::path layered = write_mesh(2, "tubes-mesh");  // newer, but of another case
  write_mesh(0, "tube-run");                             // newer still, but the mesh that a case keeps
  core::write_file(folder / "tube-run" / "flow-case.json", "{}");
  open_case();
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(),
            (folder / "tube-mesh" / "mesh.vtu").string());
  EXPECT_EQ(part<QLineEdit>("folder", dialog)->text().toStdString(), (folder / "tube-flow").string());
  ASSERT_TRUE(ready());
  auto* ends = part<QTreeWidget>("flow_ends", dialog);
  ASSERT_EQ(ends->topLevelItemCount(), 2);
  EXPECT_TRUE(ends->topLevelItem(0)->text(0).startsWith("inlet"));
  EXPECT_TRUE(ends->topLevelItem(1)->text(0).startsWith("outlet"));
  const double diameter = ends->topLevelItem(0)->text(1).split(' ')[0].toDouble();
  EXPECT_NEAR(diameter, 2.0 * radius_mm, 0.12);
  EXPECT_NEAR(ends->topLevelItem(0)->text(2).split(' ')[0].toDouble(), solver::usual_flow_ml_s(diameter),
              0.01);
  auto* go = part<QPushButton>("go", dialog);
  const auto pick_outlets = [this](solver::OutletModel model) {
    auto* outlets = part<QComboBox>("flow_outlets", dialog);
    pick(outlets, outlets->findData(static_cast<int>(model)));
  };
  pick(part<QComboBox>("flow_kind", dialog), 1);
  type(part<QDoubleSpinBox>("flow_ml_s", dialog), "0");
  EXPECT_TRUE(trouble("flow").contains("0.001 to 50 ml/s")) << trouble("flow").toStdString();
  EXPECT_FALSE(go->isEnabled());
  type(part<QDoubleSpinBox>("flow_ml_s", dialog), "0.5");
  EXPECT_TRUE(trouble("flow").isEmpty());
  EXPECT_EQ(ends->topLevelItem(1)->text(2), "0.500 ml/s");
  pick_outlets(solver::OutletModel::zero_pressure);
  EXPECT_EQ(ends->topLevelItem(1)->text(2), "computed");
  pick_outlets(solver::OutletModel::split);
  pick(part<QComboBox>("flow_solver", dialog), 1);
  EXPECT_TRUE(trouble("outlets").contains("svMultiPhysics")) << trouble("outlets").toStdString();
  EXPECT_FALSE(part<QCheckBox>("flow_run", dialog)->isEnabled());
  pick_outlets(solver::OutletModel::zero_pressure);
  EXPECT_TRUE(go->isEnabled());
  type(part<QLineEdit>("flow_mesh", dialog), QString::fromStdString(layered.string()));
  EXPECT_TRUE(wait_until([&] { return trouble("mesh").contains("prisms"); }))
      << trouble("mesh").toStdString();
  pick(part<QComboBox>("flow_solver", dialog), 0);
  EXPECT_TRUE(trouble("mesh").isEmpty());
  type(part<QDoubleSpinBox>("flow_viscosity", dialog), "1000");
  EXPECT_TRUE(trouble("blood").contains("viscosity"));
  pick(part<QComboBox>("flow_rheology", dialog), 1);
  EXPECT_TRUE(trouble("blood").isEmpty()) << "the law has viscosities of its own";
  type(part<QDoubleSpinBox>("flow_density", dialog), "1");
  EXPECT_TRUE(trouble("blood").contains("density"));
  type(part<QLineEdit>("folder", dialog), QString::fromStdString((folder / "tube-mesh").string()));
  EXPECT_TRUE(trouble("folder").contains("holds files")) << trouble("folder").toStdString();
  type(part<QLineEdit>("folder", dialog), "/nowhere/at/all");
  EXPECT_TRUE(trouble("folder").contains("no folder"));
  type(part<QLineEdit>("flow_mesh", dialog), "/nowhere/mesh.vtu");
  EXPECT_TRUE(trouble("mesh").contains("no file"));
  type(part<QLineEdit>("flow_mesh", dialog), QString::fromStdString(case_file.string()));
  EXPECT_TRUE(wait_until([&] { return trouble("mesh").contains("tube.ostia"); }))
      << trouble("mesh").toStdString();
  EXPECT_FALSE(go->isEnabled());
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(wait_until([&] { return idle(); }));
}

TEST_F(FlowCaseWindow, TheMeshThatWasMadeLastIsProposedForItsCaseAlone) {
  const fs::path other = write_mesh(0, "elsewhere");
  const fs::path beside = write_mesh();
  open_case();
  window().flow_cases().mesh_made(other);
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(), other.string());
  EXPECT_EQ(part<QLineEdit>("folder", dialog)->text().toStdString(), (folder / "elsewhere-flow").string());
  QTest::keyClick(dialog, Qt::Key_Escape);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  part<QAction>("file.close")->trigger();
  ASSERT_TRUE(wait_until([&] { return !test->bench().has_case(); }));
  test->open(case_file);
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(), beside.string());
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(FlowCaseWindow, TheNewestMeshBesideTheCaseIsOfItsOwnNumberedFolders) {
  const auto written = fs::file_time_type::clock::now();
  int age_s = 100;
  for (const char* name :
       {"tube-mesh", "tube-mesh-3", "tube-2-mesh", "tube-mesh-x", "tube-mesh-", "tube-mesh2"})
    fs::last_write_time(write_mesh(0, name), written - std::chrono::seconds(age_s--));
  open_case();
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(),
            (folder / "tube-mesh-3" / "mesh.vtu").string());
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(FlowCaseWindow, WhatWasChosenForACaseIsNotProposedForAnother) {
  write_mesh();
  fs::create_directory(folder / "empty");
  open_case();
  const PathWith path(folder / "empty", true);
  ask();
  ASSERT_TRUE(ready());
  pick(part<QComboBox>("flow_kind", dialog), 1);
  type(part<QDoubleSpinBox>("flow_ml_s", dialog), "0.7");
  type(part<QDoubleSpinBox>("flow_density", dialog), "1055");
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle() && !left_line("flow_case").isEmpty(); }));
  open_other_case();
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(), "");
  EXPECT_EQ(part<QComboBox>("flow_kind", dialog)->currentIndex(), 0) << "a measured flow is a patient's";
  EXPECT_EQ(part<QDoubleSpinBox>("flow_density", dialog)->value(), 1055.0) << "blood's choice is kept";
  EXPECT_TRUE(part<QCheckBox>("flow_run", dialog)->isChecked()) << "so is the run where none was possible";
  // One that is still open when the case goes, goes with it.
  QPointer<FlowDialog> open = dialog;
  part<QAction>("file.close")->trigger();
  EXPECT_TRUE(!open || !open->isVisible());
}

TEST_F(FlowCaseWindow, ARunThatEndsOverAnotherCaseLeavesALineAlone) {
  const auto real = core::program_on_path("simpleFoam");
  if (!real) GTEST_SKIP() << "openfoam is not installed";
  const fs::path go_on = folder / "go_on", begun = folder / "begun";
  write_solver(folder / "bin", "touch " + begun.string() + "\nwhile [ ! -e " + go_on.string() +
                                   " ]; do sleep 0.05; done\nexec " + real->string() + " \"$@\"\n");
  const PathWith path(folder / "bin");
  write_mesh();
  open_case();
  ask();
  ASSERT_TRUE(ready());
  click_go();
  ASSERT_TRUE(wait_until([&] { return fs::exists(begun); }, 30000));
  open_other_case();
  core::write_file(go_on, "");
  ASSERT_TRUE(wait_until([&] { return idle(); }, 120000));
  settle();
  EXPECT_TRUE(left_line("flow_run").contains("converged")) << left_line("flow_run").toStdString();
  EXPECT_FALSE(window().flow_results().shown()) << "it is another patient's";
  EXPECT_TRUE(testing::open_boxes().empty());
  // Nor is it shown when that is asked for, until its own case is open.
  const auto press = [&] {
    QTest::mouseClick(window().jobs().findChild<QToolButton*>("left.flow_run.act"), Qt::LeftButton);
  };
  press();
  const std::string refused = message();
  EXPECT_NE(refused.find("belongs to the case tube.ostia, which is not open"), std::string::npos) << refused;
  ASSERT_TRUE(wait_until([&] { return idle(); }));
  settle();
  EXPECT_FALSE(window().flow_results().shown());
  part<QAction>("file.close")->trigger();
  press();
  EXPECT_NE(message().find("tube.ostia"), std::string::npos) << "with no case open it could be over an image";
  EXPECT_FALSE(window().flow_results().shown());
  test->open(case_file);
  EXPECT_FALSE(window().flow_results().shown());
  press();
  EXPECT_TRUE(wait_until([&] { return window().flow_results().shown(); }));
  EXPECT_TRUE(testing::open_boxes().empty());
}

TEST_F(FlowCaseWindow, LeftAndRightTreeAreTwoSystemsOfOneCase) {
  const fs::path ran = folder / "ran";
  write_solver(folder / "bin", "basename \"$PWD\" >> " + ran.string() + "\nexit 1\n");
  const PathWith path(folder / "bin");
  write_two_tubes();
  const fs::path meshes = write_two_meshes("two-mesh");
  open_case();
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(), meshes.string());
  EXPECT_EQ(part<QLineEdit>("folder", dialog)->text().toStdString(), (folder / "two-flow").string());
  ASSERT_TRUE(ready());
  auto* ends = part<QTreeWidget>("flow_ends", dialog);
  ASSERT_EQ(ends->topLevelItemCount(), 4);
  for (const int outlet : {1, 3})
    EXPECT_EQ(ends->topLevelItem(outlet)->text(2), ends->topLevelItem(outlet - 1)->text(2))
        << "what flows into a tree flows out of it";
  QTest::mouseClick(part<QCheckBox>("flow_run", dialog), Qt::LeftButton);
  EXPECT_FALSE(part<QCheckBox>("flow_run", dialog)->isChecked());
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle() && !left_line("flow_run").isEmpty(); }));
  for (const char* tree : {"LAD", "RCA"}) {
    EXPECT_TRUE(fs::exists(folder / "two-flow" / tree / "Allrun")) << tree;
    EXPECT_TRUE(fs::exists(folder / "two-flow" / tree / "flow-case.json")) << tree;
  }
  EXPECT_TRUE(fs::exists(folder / "two-flow" / "Allrun"));
  EXPECT_NE(core::read_file(folder / "two-flow" / "Allrun").find("RCA"), std::string::npos);
  // Its line runs it: the first one fails here, by name.
  QTest::mouseClick(window().jobs().findChild<QToolButton*>("left.flow_run.act"), Qt::LeftButton);
  const std::string text = message();
  EXPECT_NE(text.find("LAD: "), std::string::npos) << text;
  EXPECT_EQ(core::read_file(ran), "LAD\n");
}

TEST_F(FlowCaseWindow, AMeshFolderWithoutAMeshIsRefused) {
  fs::create_directory(folder / "nothing");
  open_case();
  ask();
  type(part<QLineEdit>("flow_mesh", dialog), QString::fromStdString((folder / "nothing").string()));
  EXPECT_TRUE(wait_until([&] { return trouble("mesh").contains("no mesh.vtu"); }))
      << trouble("mesh").toStdString();
  EXPECT_FALSE(part<QPushButton>("go", dialog)->isEnabled());
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(FlowCaseWindow, BothTreesAreMeshedRunAndShown) {
  if (!openfoam_is_here()) GTEST_SKIP() << "openfoam is not installed";
  write_two_tubes();
  open_case();
  part<QAction>("file.export_mesh")->trigger();
  auto* export_dialog = window().findChild<MeshingDialog*>();
  ASSERT_TRUE(export_dialog && QTest::qWaitForWindowExposed(export_dialog));
  type(part<QDoubleSpinBox>("edges_around", export_dialog), "10");
  QTest::mouseClick(part<QPushButton>("go", export_dialog), Qt::LeftButton);
  auto* dock = part<QDockWidget>("mesh");
  ASSERT_TRUE(wait_until([&] { return idle() && dock->isVisible(); }, 180000));
  for (const char* tree : {"LAD", "RCA"})
    EXPECT_TRUE(fs::exists(folder / "two-mesh" / tree / "mesh.vtu")) << tree;
  ask();
  EXPECT_EQ(part<QLineEdit>("flow_mesh", dialog)->text().toStdString(), (folder / "two-mesh").string());
  ASSERT_TRUE(ready());
  pick(part<QComboBox>("flow_kind", dialog), 1);
  type(part<QDoubleSpinBox>("flow_ml_s", dialog), "0.5");
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }, 240000))
      << left_line("flow_run").toStdString();
  EXPECT_TRUE(left_line("flow_run").contains("converged, LAD ")) << left_line("flow_run").toStdString();
  EXPECT_TRUE(left_line("flow_run").contains(", RCA ")) << left_line("flow_run").toStdString();
  look_from_front({4.0, 0.0, 20.0});
  // Poiseuille's, 4 mu Q / (pi r^3), in both; a coarse mesh.
  const double theory = 4.0 * 3.5e-3 * 0.5e-6 / (std::numbers::pi * std::pow(1e-3 * radius_mm, 3));
  EXPECT_NEAR(value_told({0.2, -radius_mm, 20.0}), theory, 0.15 * theory);
  EXPECT_NEAR(value_told({testing::second_tube_x_mm + 0.2, -radius_mm, 20.0}), theory, 0.15 * theory);
  // And along each: the fall of pressure is 8 mu Q / (pi r^4), of which a decagon in the circle has 1.14.
  const double slope = 2.0 * theory / radius_mm;  // Pa/mm
  auto* profile = window().findChild<ProfileWidget*>();
  for (const std::int32_t vessel : {4, 14}) {
    test->bench().vessel.set(vessel);
    settle();
    const auto pressure_at = [&](double s) {
      test->bench().cursor_mm.set(s);
      for (const auto& text : profile->view().overlay().texts)
        if (text.role == view::Role::pressure && text.text.find("Pa: ") != std::string::npos)
          return std::stod(text.text.substr(text.text.find("Pa: ") + 4));
      return std::nan("");
    };
    EXPECT_NEAR((pressure_at(10.0) - pressure_at(30.0)) / 20.0, slope, 0.25 * slope) << vessel;
  }
  if (const char* pictures = std::getenv("OSTIA_PICTURES")) {
    const QRect all = window().frameGeometry();
    window()
        .screen()
        ->grabWindow(0, all.x(), all.y(), all.width(), all.height())
        .save(QString("%1/both_trees.png").arg(pictures));
  }
}

TEST_F(FlowCaseWindow, ATubeIsWrittenRunAndItsShearStressShown) {
  if (!openfoam_is_here()) GTEST_SKIP() << "openfoam is not installed";
  write_mesh(2);
  open_case();
  ask();
  ASSERT_TRUE(ready());
  pick(part<QComboBox>("flow_kind", dialog), 1);
  type(part<QDoubleSpinBox>("flow_ml_s", dialog), "0.5");
  EXPECT_TRUE(part<QCheckBox>("flow_run", dialog)->isChecked());
  QTest::keyClick(part<QLineEdit>("folder", dialog), Qt::Key_Return);
  ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }, 120000))
      << left_line("flow_case").toStdString();
  EXPECT_TRUE(left_line("flow_run").contains("converged")) << left_line("flow_run").toStdString();
  EXPECT_FALSE(left_line("flow_run").contains("not"));
  const fs::path made = folder / "tube-flow";
  EXPECT_NE(core::read_file(made / "log.simpleFoam").find("SIMPLE solution converged"), std::string::npos);
  EXPECT_TRUE(fs::exists(made / "result" / "wall.vtp"));
  look_from_front();
  // Poiseuille's, 4 mu Q / (pi r^3); a coarse mesh.
  const double theory = 4.0 * 3.5e-3 * 0.5e-6 / (std::numbers::pi * std::pow(1e-3 * radius_mm, 3));
  EXPECT_NEAR(value_told({0.2, -radius_mm, 3.0}), theory, 0.12 * theory);
}

/// A process that is not a zombie.
bool alive(int pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::ostringstream read;  // a process that dies meanwhile is an end of file, no exception
  read << in.rdbuf();
  const std::string text = read.str();
  const std::size_t end = text.rfind(") ");
  return end != std::string::npos && text.size() > end + 2 && text[end + 2] != 'Z';
}

TEST_F(FlowCaseWindow, ARunTellsHowFarItIsAndEndsAllItsProcessesWhenItIsCancelled) {
  const fs::path pid_file = folder / "pid";
  write_solver(folder / "bin",
               "echo\necho 'Time = 7'\necho 'Solving for p, Initial residual = 0.004, Final'\n"
               "echo 'ExecutionTime = 1 s'\necho $$ > " +
                   pid_file.string() + "\nsleep 600\ntrue\n");
  const PathWith path(folder / "bin");
  write_mesh();
  open_case();
  ask();
  ASSERT_TRUE(ready());
  click_go();
  const auto told = [&] {
    for (const QLabel* label : window().jobs().findChildren<QLabel*>())
      if (label->text().contains("7, 4e-03")) return true;
    return false;
  };
  ASSERT_TRUE(wait_until(told, 30000));
  const int pid = std::stoi(core::read_file(pid_file));
  EXPECT_TRUE(alive(pid));
  QTest::mouseClick(window().jobs().findChild<QToolButton*>("cancel.flow_run"), Qt::LeftButton);
  EXPECT_TRUE(wait_until([&] { return idle(); }, 2000));
  EXPECT_TRUE(wait_until([&] { return !alive(pid); }, 3000));
  EXPECT_FALSE(window().flow_results().shown());
  // The case is there, and its line runs it again.
  EXPECT_TRUE(fs::exists(folder / "tube-flow" / "Allrun"));
  EXPECT_TRUE(wait_until([&] { return left_line("flow_run").contains("tube-flow"); }));
  fs::remove(pid_file);
  QTest::mouseClick(window().jobs().findChild<QToolButton*>("left.flow_run.act"), Qt::LeftButton);
  EXPECT_TRUE(wait_until([&] { return fs::exists(pid_file); }, 10000));
  window().jobs().cancel("flow_run");
  EXPECT_TRUE(wait_until([&] { return idle(); }, 2000));
}

TEST_F(FlowCaseWindow, ARunThatFailsIsToldWithTheEndOfItsLog) {
  write_solver(folder / "bin", "echo 'FOAM FATAL ERROR: cannot be'\nexit 1\n");
  const PathWith path(folder / "bin");
  write_mesh();
  open_case();
  ask();
  ASSERT_TRUE(ready());
  click_go();
  const std::string text = message();
  EXPECT_NE(text.find("FOAM FATAL ERROR: cannot be"), std::string::npos) << text;
  EXPECT_NE(text.find("log.simpleFoam"), std::string::npos) << text;
  EXPECT_FALSE(window().flow_results().shown());
  EXPECT_TRUE(left_line("flow_run").contains("tube-flow")) << "it can be run again";
}

TEST_F(FlowCaseWindow, WithoutTheSolverTheCaseIsWrittenAndTheWayOutIsSaid) {
  const fs::path mesh = write_mesh();
  fs::create_directory(folder / "empty");
  open_case();
  const PathWith path(folder / "empty", true);
  ask();
  ASSERT_TRUE(ready());
  EXPECT_FALSE(part<QCheckBox>("flow_run", dialog)->isEnabled());
  EXPECT_TRUE(part<QLabel>("flow_note", dialog)->text().contains("apt install openfoam"));
  EXPECT_TRUE(part<QLabel>("flow_note", dialog)->text().contains("Allrun"));
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle() && !left_line("flow_case").isEmpty(); }));
  EXPECT_TRUE(fs::exists(folder / "tube-flow" / "Allrun"));
  EXPECT_EQ(window().jobs().findChild<QToolButton*>("left.flow_case.act")->text(), "Open folder");
}

}  // namespace
}  // namespace ostia::workstation
