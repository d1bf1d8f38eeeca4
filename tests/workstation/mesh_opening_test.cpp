// Meshes made earlier, here or elsewhere, in the mesh's panel; the plane that cuts them, by the mouse in 3D.

#include "meshing/dock.h"
#include "meshing/histogram.h"
#include "tube_mesh.h"
#include "tube_window.h"

#include "ostia/core/files.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/meshing/mixed_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QListWidget>
#include <QSlider>
#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

namespace ostia::workstation {
namespace {

using io::MeshFormat;
using testing::answer_file_dialog;
using ::testing::HasSubstr;
using testing::message;
using testing::pick;
using testing::wait_until;
using view::Vec3;
namespace fs = std::filesystem;

const geometry::MixedMesh& mesh() {
  static const geometry::MixedMesh made = testing::tube_mesh();
  return made;
}

/// It reaches from 1.5 to 4.5 mm.
struct MeshOpening : testing::TubeWindow {
  const Vec3 middle{0.0, 0.0, 3.0};

  MeshDock& panel() { return *part<MeshDock>("mesh"); }
  std::string name() { return part<QLabel>("mesh_name")->text().toStdString(); }
  fs::path write(MeshFormat format, const std::string& file) {
    fs::create_directories(folder / "earlier");
    const fs::path path = folder / ("earlier/" + file);
    io::export_mesh(mesh(), format, path);
    return path;
  }
  /// By the command and its dialog.
  void open(const fs::path& file) {
    answer_file_dialog(file);
    part<QAction>("file.open_mesh")->trigger();
  }
  bool shown() {
    return wait_until([&] { return idle() && panel().isVisible(); }, 30000);
  }
  QImage look(const char* name) { return testing::on_screen(window(), name); }
  void open_and_look() {
    open_case();
    open(write(MeshFormat::vtu, "mesh.vtu"));
    ASSERT_TRUE(shown());
    look_from_front(middle, 5.0);
  }
  double cut_z() { return panel().cut()->point.z(); }
  int place() { return part<QSlider>("mesh_cut_place")->value(); }
  void drag(const QPoint& from, const QPoint& to) {
    mouse(QEvent::MouseMove, from, Qt::NoButton, Qt::NoButton);
    mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
    for (const double t : {0.3, 0.7, 1.0})
      mouse(QEvent::MouseMove, from + t * (to - from), Qt::NoButton, Qt::LeftButton);
    mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
  }
};

TEST_F(MeshOpening, AMeshMadeEarlierIsShownAndJudgedAsOneThatWasMade) {
  const meshing::MixedQuality quality = meshing::mixed_quality(mesh());
  ASSERT_TRUE(meshing::check(quality).ok());
  open_case();
  open(write(MeshFormat::vtu, "mesh.vtu"));
  ASSERT_TRUE(shown());
  EXPECT_THAT(name(), HasSubstr("earlier/mesh.vtu: " + std::to_string(mesh().tetrahedra.size())));
  EXPECT_EQ(part<QLabel>("mesh_gate")->text(), "Passes the quality control.");
  const auto& counts = panel().findChild<HistogramWidget*>("mesh_histogram")->counts();
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), mesh().tetrahedra.size());
  EXPECT_THAT(part<QLabel>("mesh_figures")->text().toStdString(),
              HasSubstr(QString::number(quality.tetrahedra.min_dihedral_deg, 'f', 1).toStdString()));
  auto* worst = part<QListWidget>("mesh_worst");
  ASSERT_EQ(worst->count(), 20);
  QTest::mouseClick(worst->viewport(), Qt::LeftButton, Qt::NoModifier,
                    worst->visualItemRect(worst->item(0)).center());
  settle();
  EXPECT_LT((window().scene().scene().pose().target - quality.tetrahedra.sharpest_at).norm(), 0.1);
  look_from_front(middle, 5.0);
  pick(part<QComboBox>("mesh_cut"), 2);
  look("opened_mesh");
  EXPECT_TRUE(test->bench().session().file().edits().empty()) << "the case is as it was";
  part<QAction>("file.close")->trigger();
  EXPECT_TRUE(wait_until([&] { return !panel().isVisible(); })) << "it goes with the case";
}

TEST_F(MeshOpening, AMeshThatDoesNotPassTheGateSaysWhy) {
  geometry::MixedMesh turned = mesh();
  std::swap(turned.tetrahedra[7][0], turned.tetrahedra[7][1]);
  io::export_mesh(turned, MeshFormat::vtu, folder / "turned.vtu");
  open_case();
  open(folder / "turned.vtu");
  ASSERT_TRUE(shown());
  EXPECT_THAT(part<QLabel>("mesh_gate")->text().toStdString(), HasSubstr("Does not pass"));
  EXPECT_THAT(part<QLabel>("mesh_gate")->text().toStdString(), HasSubstr("inverted"));
}

TEST_F(MeshOpening, MeshesOfOtherProgramsAreOpenedWithoutACaseToo) {
  test = std::make_unique<testing::TestWindow>(folder / "state");
  const std::string count = std::to_string(mesh().tetrahedra.size()) + " tetrahedra";
  for (const auto& [format, file] : {std::pair(MeshFormat::gmsh2, "two.msh"),
                                     {MeshFormat::gmsh4, "four.msh"},
                                     {MeshFormat::fluent, "fluent.msh"},
                                     {MeshFormat::abaqus, "abaqus.inp"},
                                     {MeshFormat::exodus, "exodus.exo"},
                                     {MeshFormat::cgns, "cgns.cgns"}}) {
    open(write(format, file));
    ASSERT_TRUE(wait_until([&] { return idle() && name().find(file) != std::string::npos; }, 30000)) << file;
    EXPECT_THAT(name(), HasSubstr(count));
  }
  open(write(MeshFormat::xdmf, "xdmf") / "mesh.xdmf");
  ASSERT_TRUE(wait_until([&] { return idle() && name().find("mesh.xdmf") != std::string::npos; }, 30000));
  EXPECT_THAT(name(), HasSubstr(count));
  // Of an OpenFOAM case a file is chosen; what is dropped may be its folder.
  const fs::path foam = write(MeshFormat::openfoam, "foam");
  open(foam / "constant" / "polyMesh" / "points");
  ASSERT_TRUE(wait_until([&] { return idle() && name().find("earlier/foam") != std::string::npos; }, 30000));
  EXPECT_THAT(name(), HasSubstr(count));
  window().open(folder / "earlier/two.msh");
  ASSERT_TRUE(wait_until([&] { return idle() && name().find("two.msh") != std::string::npos; }, 30000));
  EXPECT_TRUE(testing::open_boxes().empty());
}

TEST_F(MeshOpening, WhatIsNoMeshIsSaidOnceAndWhatWasShownStays) {
  open_and_look();
  const std::string before = name();
  const std::string good = core::read_file(folder / "earlier/mesh.vtu");
  core::write_file(folder / "half.vtu", good.substr(0, good.size() / 2));
  core::write_file(folder / "words.msh", "no mesh\n");
  core::write_file(folder / "surface.stl", "solid\nendsolid\n");
  for (const char* bad : {"half.vtu", "words.msh", "surface.stl"}) {
    open(folder / bad);
    EXPECT_THAT(message(), HasSubstr(bad));
    ASSERT_TRUE(wait_until([&] { return idle(); }));
    EXPECT_EQ(name(), before);
    EXPECT_TRUE(panel().isVisible());
  }
  EXPECT_TRUE(testing::open_boxes().empty());
}

TEST_F(MeshOpening, TheReadingIsBesideTheWindowAndGivenUpByItsCross) {
  const fs::path file = write(MeshFormat::vtu, "mesh.vtu");
  open_case();
  std::atomic<bool> held = true;  // all workers are, so that the reading lasts
  for (int i = 0; i < 4; ++i)
    window().jobs().run(
        QString("hold %1").arg(i), "hold",
        [&](const core::TaskContext&) {
          while (held) std::this_thread::sleep_for(std::chrono::milliseconds(5));
          return std::any();
        },
        [](const std::any&) {}, [](const QString&) {});
  open(file);
  ASSERT_TRUE(wait_until([&] { return window().jobs().running("mesh_preview"); }));
  auto* cross = part<QToolButton>("cancel.mesh_preview");
  ASSERT_TRUE(wait_until([&] { return cross->isVisible(); }));
  settle();  // lines find their places
  look("reading");
  QTest::keyClick(cross, Qt::Key_Space);
  EXPECT_TRUE(wait_until([&] { return !window().jobs().running("mesh_preview"); }, 2000));
  held = false;
  ASSERT_TRUE(wait_until([&] { return idle(); }));
  settle();
  EXPECT_FALSE(panel().isVisible());
  EXPECT_TRUE(testing::open_boxes().empty());
}

TEST_F(MeshOpening, ThePlaneIsDraggedAlongItsNormalByItsFrameAndItsArrow) {
  open_and_look();
  EXPECT_FALSE(panel().cut());
  pick(part<QComboBox>("mesh_cut"), 4);
  settle();
  look("cut_handle");
  const view::CameraPose pose = window().scene().scene().pose();
  ASSERT_NEAR(cut_z(), 3.0, 0.05);
  const int slider = place();
  // By the frame, seen as a line across the tube.
  drag(at(middle + Vec3(1.4, 0.0, 0.0)), at(middle + Vec3(1.0, 0.0, 1.0)));
  EXPECT_NEAR(cut_z(), 4.0, 0.03) << "sideways it does not matter";
  EXPECT_GT(place(), slider);
  settle();
  // By the arrow, which went with it.
  drag(at(Vec3(0.0, 0.0, 4.5)), at(Vec3(0.0, 0.0, 2.5)));
  EXPECT_NEAR(cut_z(), 2.0, 0.03);
  // The other side is taken away, and the plane still follows the hand.
  QTest::keyClick(part<QCheckBox>("mesh_cut_turned"), Qt::Key_Space);
  settle();
  EXPECT_LT(panel().cut()->normal.z(), -0.99);
  drag(at(Vec3(1.4, 0.0, 2.0)), at(Vec3(1.4, 0.0, 3.5)));
  EXPECT_NEAR(cut_z(), 3.5, 0.03);
  EXPECT_NEAR((window().scene().scene().pose().towards - pose.towards).norm(), 0.0, 1e-12)
      << "the camera stays";
  look("cut_dragged");
  // Beyond the mesh it stops at its end.
  drag(at(Vec3(1.4, 0.0, 3.5)), at(Vec3(1.4, 0.0, 7.9)));
  EXPECT_NEAR(cut_z(), 4.5, 0.05);
  // Elsewhere a drag turns the camera.
  settle();
  drag(at(Vec3(3.5, 0.0, 1.0)), at(Vec3(2.5, 0.0, 1.0)));
  EXPECT_GT((window().scene().scene().pose().towards - pose.towards).norm(), 0.05);
  EXPECT_NEAR(cut_z(), 4.5, 0.05);
}

TEST_F(MeshOpening, EscapePutsThePlaneBackAndAWholeMeshHasNoHandle) {
  open_and_look();
  const view::CameraPose pose = window().scene().scene().pose();
  drag(at(middle), at(middle + Vec3(1.0, 0.0, 0.0)));
  EXPECT_GT((window().scene().scene().pose().towards - pose.towards).norm(), 0.05)
      << "nothing to take hold of";
  look_from_front(middle, 5.0);
  pick(part<QComboBox>("mesh_cut"), 4);
  settle();
  const QPoint from = at(middle + Vec3(1.4, 0.0, 0.0)), to = at(middle + Vec3(1.4, 0.0, 1.2));
  mouse(QEvent::MouseMove, from, Qt::NoButton, Qt::NoButton);
  EXPECT_EQ(native->cursor().shape(), Qt::SizeAllCursor);
  mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  mouse(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
  EXPECT_NEAR(cut_z(), 4.2, 0.03);
  QTest::keyClick(native, Qt::Key_Escape);
  EXPECT_NEAR(cut_z(), 3.0, 0.03);
  mouse(QEvent::MouseMove, at(middle), Qt::NoButton, Qt::LeftButton);
  mouse(QEvent::MouseButtonRelease, at(middle), Qt::LeftButton, Qt::NoButton);
  EXPECT_NEAR(cut_z(), 3.0, 0.03);
}

TEST_F(MeshOpening, APlaneThatFacesTheViewerGoesAwayFromThemByADragUpwards) {
  open_and_look();
  pick(part<QComboBox>("mesh_cut"), 5);
  settle();
  ASSERT_NEAR(panel().cut()->normal.y(), -1.0, 1e-9);
  ASSERT_NEAR(panel().cut()->point.y(), 0.0, 0.05);
  // The frame is seen from the front: its lower side, 1.5 mm below the middle.
  const double below = 1.5 * 1.04;
  drag(at(middle - Vec3(0.0, 0.0, below)), at(middle - Vec3(0.0, 0.0, below - 0.7)));
  EXPECT_NEAR(panel().cut()->point.y(), 0.7, 0.03);
  // The plane keeps its direction while the tree is turned, until it is chosen again.
  drag(at(Vec3(3.5, 0.0, 1.0)), at(Vec3(2.5, 0.0, 1.0)));
  settle();
  const Vec3 towards = window().scene().scene().pose().towards;
  EXPECT_GT((towards - Vec3(0.0, -1.0, 0.0)).norm(), 0.05);
  part<QSlider>("mesh_cut_place")->setFocus();
  QTest::keyClick(part<QSlider>("mesh_cut_place"), Qt::Key_PageUp);
  EXPECT_NEAR(panel().cut()->normal.y(), -1.0, 1e-9);
  auto* by = part<QComboBox>("mesh_cut");
  pick(by, 0);
  pick(by, 5);
  EXPECT_LT((panel().cut()->normal - towards).norm(), 1e-9);
}

}  // namespace
}  // namespace ostia::workstation
