// Surfaces and meshes through the dialog, by mouse and keys.

#include "meshing_window.h"

#include "shell/main_window.h"
#include "views/frame_log.h"

#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/meshing/mixed_quality.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <thread>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using testing::MeshingWindow;
using testing::pick;
using testing::type;
using testing::wait_until;

constexpr double radius_mm = testing::tube_radius_mm;
constexpr double inset_mm = 0.4 * radius_mm;  // by which both ends are cut

std::vector<std::string> names(const std::vector<geometry::Face>& faces) {
  std::vector<std::string> all;
  for (const geometry::Face& face : faces) all.push_back(face.name);
  return all;
}

TEST_F(MeshingWindow, AMeshIsMadeByTheDialogWhileTheCaseIsEdited) {
  open_case();
  // The wall between the cuts, of the model as it is now.
  const geometry::TriMesh wall = lumen::surface_of(*test->bench().model());
  const double dome = 2.0 / 3.0 * M_PI * std::pow(radius_mm, 3);
  const double enclosed = geometry::volume(wall) - 2.0 * (dome + M_PI * radius_mm * radius_mm * inset_mm);
  ask("file.export_mesh");
  EXPECT_EQ(in_dialog<QLineEdit>("folder")->text().toStdString(), (folder / "tube-mesh").string());
  pick(in_dialog<QComboBox>("size"), 1);
  type(in_dialog<QDoubleSpinBox>("edge_mm"), "0.25");
  EXPECT_TRUE(in_dialog<QLabel>("estimate")->text().contains("cells"));
  click_go();
  ASSERT_FALSE(idle());
  test->bench().edit(lumen::VesselRename{4, "RCA"});  // the snapshot keeps its name
  ASSERT_TRUE(wait_until([&] { return idle(); }, 120000));
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "tube-mesh" / "mesh.vtu");
  EXPECT_THAT(names(mesh.faces), ElementsAre("wall", "inlet_LAD", "outlet_LAD"));
  const meshing::MixedQuality quality = meshing::mixed_quality(mesh);
  EXPECT_NEAR(quality.volume_mm3(), enclosed, 0.01 * enclosed);
  const auto surface = io::read_surface(folder / "tube-mesh" / "lumen.vtp").surface;
  EXPECT_NEAR(quality.volume_mm3(), geometry::volume(surface.mesh), 0.01 * quality.volume_mm3());
  EXPECT_GT(quality.tetrahedra.min_dihedral_deg, 5.0);
  const QString line = left_line("mesh");
  EXPECT_TRUE(line.contains("tube-mesh")) << line.toStdString();
  EXPECT_TRUE(line.contains(QString::number(quality.tetrahedra.count))) << line.toStdString();
  EXPECT_TRUE(line.contains(QString::number(quality.tetrahedra.min_dihedral_deg, 'f', 1)))
      << line.toStdString();
}

/// Clicks the mark of a row, as a person does.
void tick(QListWidget* list, const QString& text) {
  const auto found = list->findItems(text, Qt::MatchStartsWith);
  ASSERT_EQ(found.size(), 1) << text.toStdString();
  list->scrollToItem(found[0]);
  const QRect row = list->visualItemRect(found[0]);
  const Qt::CheckState before = found[0]->checkState();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier,
                    QPoint(row.left() + row.height() / 2, row.center().y()));
  EXPECT_NE(found[0]->checkState(), before) << text.toStdString();
}

TEST_F(MeshingWindow, LayersAndFormatsAreAskedForAndTold) {
  open_case();
  ask("file.export_mesh");
  auto* go = in_dialog<QPushButton>("go");
  auto* formats = in_dialog<QListWidget>("mesh_formats");
  EXPECT_FALSE(in_dialog<QDoubleSpinBox>("layer_thickness")->isEnabled()) << "there are no layers yet";
  const QString without = in_dialog<QLabel>("estimate")->text();
  type(in_dialog<QSpinBox>("layers"), "2");
  EXPECT_TRUE(in_dialog<QDoubleSpinBox>("layer_thickness")->isEnabled());
  EXPECT_NE(in_dialog<QLabel>("estimate")->text(), without);
  type(in_dialog<QDoubleSpinBox>("layer_thickness"), "5");
  EXPECT_TRUE(trouble("layers").contains("up to 3")) << trouble("layers").toStdString();
  EXPECT_FALSE(go->isEnabled());
  type(in_dialog<QDoubleSpinBox>("layer_thickness"), "0.4");
  EXPECT_TRUE(trouble("layers").isEmpty());
  type(in_dialog<QSpinBox>("layers"), "50");
  EXPECT_TRUE(trouble("layers").contains("up to 20")) << trouble("layers").toStdString();
  type(in_dialog<QSpinBox>("layers"), "2");
  tick(formats, "SimVascular");
  EXPECT_TRUE(trouble("mesh_formats").contains("prisms")) << trouble("mesh_formats").toStdString();
  EXPECT_FALSE(go->isEnabled());
  tick(formats, "SimVascular");
  tick(formats, "OpenFOAM");
  pick(in_dialog<QComboBox>("order"), 1);
  EXPECT_TRUE(trouble("mesh_formats").contains("quadratic")) << trouble("mesh_formats").toStdString();
  pick(in_dialog<QComboBox>("order"), 0);
  EXPECT_TRUE(go->isEnabled());
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle() && !left_line("mesh").isEmpty(); }, 120000));
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "tube-mesh" / "mesh.vtu");
  EXPECT_EQ(mesh.prisms.size(),
            2 * std::count(mesh.triangle_face_ids.begin(), mesh.triangle_face_ids.end(), 1));
  EXPECT_TRUE(fs::exists(folder / "tube-mesh" / "openfoam" / "constant" / "polyMesh" / "faces"));
  const QString line = left_line("mesh");
  EXPECT_TRUE(line.contains(QString::number(mesh.prisms.size() + mesh.tetrahedra.size())))
      << line.toStdString();
  EXPECT_TRUE(line.contains("full thickness on 100.0 %")) << line.toStdString();
  EXPECT_TRUE(line.contains("quality passed")) << line.toStdString();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  ask("file.export_mesh");
  EXPECT_EQ(in_dialog<QSpinBox>("layers")->value(), 2) << "the choice is kept";
  EXPECT_EQ(in_dialog<QListWidget>("mesh_formats")->findItems("OpenFOAM", Qt::MatchExactly)[0]->checkState(),
            Qt::Checked);
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(MeshingWindow, CancelledMidwayThereAreNoFilesAndTheWindowWasNeverStuck) {
  const fs::path log = folder / "frames.jsonl";
  ASSERT_TRUE(FrameLog::instance().open(QString::fromStdString(log.string())));
  open_case();
  ask("file.export_mesh");
  pick(in_dialog<QComboBox>("size"), 1);
  type(in_dialog<QDoubleSpinBox>("edge_mm"), "0.15");
  click_go();
  const auto cross = [&] { return test->window().jobs().findChild<QToolButton*>("cancel.mesh"); };
  ASSERT_TRUE(wait_until([&] { return cross() && cross()->isVisible(); }));
  // What was under the dialog is drawn again, by software here; from then on it is the job's doing.
  wait_until([] { return false; }, 700);
  const std::uintmax_t before = fs::file_size(log);
  // Long enough to be in the remeshing; then by the mouse.
  ASSERT_TRUE(wait_until(
      [&] {
        auto* label = test->window().jobs().findChild<QLabel*>();
        return label && label->text().contains("remeshing");
      },
      60000));
  wait_until([] { return false; }, 1500);
  ASSERT_FALSE(idle());
  const std::uintmax_t after = fs::file_size(log);
  QTest::mouseClick(cross(), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return idle(); }, 2000));
  EXPECT_TRUE(left_line("mesh").isEmpty());
  // The thread notices within a second; nothing is left, hidden or not.
  const auto only_the_case = [&] {
    for (const auto& entry : fs::directory_iterator(case_file.parent_path()))
      if (entry.path().filename().string().find("mesh") != std::string::npos) return false;
    return true;
  };
  EXPECT_TRUE(wait_until(only_the_case, 2000));
  wait_until([] { return false; }, 1000);
  EXPECT_TRUE(only_the_case());
  const QString text = QString::fromStdString(core::read_file(log).substr(before, after - before));
  double longest = 0.0;
  auto blocks = QRegularExpression("\"blocked_ms\":([0-9.]+)").globalMatch(text);
  while (blocks.hasNext()) longest = std::max(longest, blocks.next().captured(1).toDouble());
  std::printf("longest block of the interface: %.0f ms\n", longest);
  EXPECT_LE(longest, 100.0);
  test->bench().cursor_mm.set(12.0);
  EXPECT_TRUE(wait_until([&] { return test->picture("section").view().ready(); }, 2000));
}

TEST_F(MeshingWindow, ASizeThatCannotBeIsSaidAtItsField) {
  open_case();
  ask("file.export_mesh");
  auto* go = in_dialog<QPushButton>("go");
  EXPECT_TRUE(go->isEnabled());
  type(in_dialog<QDoubleSpinBox>("edges_around"), "3");
  EXPECT_TRUE(trouble("size").contains("6 to 60")) << trouble("size").toStdString();
  EXPECT_FALSE(go->isEnabled());
  EXPECT_FALSE(in_dialog<QDoubleSpinBox>("edges_around")->accessibleDescription().isEmpty());
  pick(in_dialog<QComboBox>("size"), 1);
  EXPECT_TRUE(trouble("size").isEmpty());
  type(in_dialog<QDoubleSpinBox>("edge_mm"), "9");
  EXPECT_TRUE(trouble("size").contains("0.05 to 3 mm")) << trouble("size").toStdString();
  type(in_dialog<QDoubleSpinBox>("edge_mm"), "0.05");
  EXPECT_TRUE(trouble("size").isEmpty() || trouble("size").contains("million"));
  type(in_dialog<QDoubleSpinBox>("edge_mm"), "0.4");
  EXPECT_TRUE(trouble("size").isEmpty());
  EXPECT_TRUE(go->isEnabled());
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(idle());
}

TEST_F(MeshingWindow, AFolderThatCannotBeMadeIsSaidAtItsField) {
  open_case();
  ask("file.export_surface");
  auto* path = in_dialog<QLineEdit>("folder");
  type(path, "/nowhere/at/all");
  EXPECT_TRUE(trouble("folder").contains("no folder"));
  EXPECT_FALSE(in_dialog<QPushButton>("go")->isEnabled());
  type(path, "/proc/ostia-surface");  // where rights are no use
  click_go();
  EXPECT_TRUE(dialog->isVisible());
  EXPECT_TRUE(trouble("folder").contains("Nothing can be written")) << trouble("folder").toStdString();
  EXPECT_TRUE(idle());
  fs::create_directory(folder / "mine");
  core::write_file(folder / "mine" / "thesis.txt", "mine");
  type(path, QString::fromStdString((folder / "mine").string()));
  click_go();
  EXPECT_TRUE(trouble("folder").contains("holds files")) << trouble("folder").toStdString();
  EXPECT_EQ(core::read_file(folder / "mine" / "thesis.txt"), "mine");
  for (const char* format : {"format.vtp", "format.stl"})
    QTest::keyClick(in_dialog<QWidget>(format), Qt::Key_Space);
  EXPECT_TRUE(trouble("formats").contains("at least one"));
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(MeshingWindow, ASurfaceIsExportedWithNamedEndsAndTheChoiceIsKept) {
  open_case();
  ask("file.export_surface");
  pick(in_dialog<QComboBox>("size"), 2);
  QTest::keyClick(in_dialog<QWidget>("format.ply"), Qt::Key_Space);
  QTest::keyClick(in_dialog<QLineEdit>("folder"), Qt::Key_Return);
  ASSERT_TRUE(wait_until([&] { return idle() && !left_line("surface").isEmpty(); }, 60000));
  const auto surface = io::read_surface(folder / "tube-surface" / "lumen.vtp").surface;
  EXPECT_THAT(names(surface.faces), ElementsAre("wall", "inlet_LAD", "outlet_LAD"));
  for (const char* name : {"lumen.stl", "lumen.ply", "centerlines.vtp", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder / "tube-surface" / name)) << name;
  EXPECT_TRUE(left_line("surface").contains(QString::number(surface.mesh.triangles.size())));
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);  // as a running event loop does
  EXPECT_FALSE(test->window().findChild<MeshingDialog*>());
  ask("file.export_surface");
  EXPECT_EQ(in_dialog<QComboBox>("size")->currentIndex(), 2);
  EXPECT_EQ(in_dialog<QLineEdit>("folder")->text().toStdString(), (folder / "tube-surface-2").string());
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(MeshingWindow, WhatFailsIsOneMessageWithTheWayOut) {
  open_case();
  ask("file.export_mesh");
  const fs::path gone = folder / "gone";
  fs::create_directory(gone);
  type(in_dialog<QLineEdit>("folder"), QString::fromStdString((gone / "mesh").string()));
  click_go();
  // The place goes away while the mesh is made, and cannot be made again: a file takes it, at the same
  // moment.
  core::write_file(folder / "file", "");
  ASSERT_EQ(::renameat2(AT_FDCWD, gone.c_str(), AT_FDCWD, (folder / "file").c_str(), RENAME_EXCHANGE), 0);
  QMessageBox* box = nullptr;
  ASSERT_TRUE(wait_until(
      [&] {
        for (QWidget* widget : QApplication::topLevelWidgets())
          if (auto* one = qobject_cast<QMessageBox*>(widget); one && one->isVisible()) box = one;
        return box != nullptr;
      },
      60000));
  EXPECT_TRUE(box->text().contains("gone")) << box->text().toStdString();
  box->close();
  EXPECT_TRUE(test->bench().has_case());
}

TEST(MeshingCheckPage, AnswersWithoutPlacesGrowOldToo) {
  MeshingCheck page;
  const auto told = [&] { return page.findChild<QLabel*>("check_summary")->text().toStdString(); };
  const std::string before = told();
  page.set_stale();
  EXPECT_EQ(told(), before) << "nothing has been answered yet";
  page.show_running();
  page.show_forecast({});
  EXPECT_THAT(told(), ::testing::HasSubstr("Nothing was found"));
  page.set_stale();
  EXPECT_THAT(told(), ::testing::HasSubstr("check again"));
  page.show_running();
  page.show_failure("It would fail: a hole");
  EXPECT_THAT(told(), ::testing::HasSubstr("a hole"));
  page.set_stale();
  EXPECT_THAT(told(), ::testing::HasSubstr("check again"));
  page.show_running();
  page.set_stale();
  page.show_nothing();
  EXPECT_EQ(told(), before) << "it was given up";
  page.set_stale();
  EXPECT_EQ(told(), before);
}

TEST(Jobs, ANewerOneTakesThePlaceOfOneThatIsDoneButNotYetSeen) {
  Jobs jobs;
  std::atomic<bool> first_ended = false;
  int first = 0, second = 0;
  const auto failed = [](const QString& message) { ADD_FAILURE() << message.toStdString(); };
  jobs.run(
      "open", "first",
      [&](const core::TaskContext&) {
        first_ended = true;
        return std::any(1);
      },
      [&](const std::any&) { ++first; }, failed);
  // The interface does not look meanwhile.
  while (!first_ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  jobs.run(
      "open", "second", [](const core::TaskContext&) { return std::any(2); },
      [&](const std::any&) { ++second; }, failed);
  ASSERT_TRUE(wait_until([&] { return !jobs.any(); }));
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 1);
}

TEST_F(MeshingWindow, EachOfSeveralJobsHasALineOfItsHeight) {
  open_case();
  std::atomic<bool> enough = false;
  const int one_line = window().jobs().line_height();
  for (const char* kind : {"first", "second", "third"})
    window().jobs().run(
        kind, kind,
        [&enough](const core::TaskContext&) {
          while (!enough) std::this_thread::sleep_for(std::chrono::milliseconds(5));
          return std::any();
        },
        [](const std::any&) {}, [](const QString&) {});
  ASSERT_TRUE(wait_until([&] { return part<QToolButton>("cancel.third")->isVisible(); }));
  settle();
  for (const char* button : {"cancel.first", "cancel.second", "cancel.third"})
    EXPECT_GE(part<QToolButton>(button)->height(), one_line) << button;
  EXPECT_GE(window().jobs().height(), 3 * one_line);
  enough = true;
  ASSERT_TRUE(wait_until([&] { return !window().jobs().any(); }));
}

TEST(JobsTime, IsExtrapolatedAndNotGuessed) {
  EXPECT_FALSE(seconds_left(0.5, 1900));
  EXPECT_FALSE(seconds_left(0.04, 60000));
  EXPECT_NEAR(*seconds_left(0.25, 10000), 30.0, 1e-9);
  EXPECT_NEAR(*seconds_left(1.0, 10000), 0.0, 1e-9);
}

}  // namespace
}  // namespace ostia::workstation
