// What would fail is shown before meshing, and the mesh after it: by mouse and keys.

#include "flow/dialog.h"
#include "layout_faults.h"
#include "meshing/dock.h"
#include "meshing/forecast.h"
#include "meshing/histogram.h"
#include "meshing_window.h"

#include "ostia/io/volume_mesh_file.h"
#include "ostia/meshing/mixed_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QListWidget>
#include <QRegularExpression>
#include <QSlider>
#include <QSpinBox>
#include <QWindow>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;
using testing::pick;
using testing::type;
using testing::wait_until;
namespace fs = std::filesystem;

/// A lumen that is 0.6 mm wide at its throat.
class NarrowWindow : public testing::MeshingWindow {
 public:
  NarrowWindow() : MeshingWindow(0.8) {}
  ~NarrowWindow() override { QApplication::processEvents(); }

  /// What the screen has of the 3D view.
  QImage look(const char* name) {
    const QImage whole = testing::on_screen(test->window(), name);
    const QPoint corner = test->window().scene().mapTo(&test->window(), QPoint(0, 0));
    return whole.copy(QRect(corner, test->window().scene().size()));
  }
  MeshDock& dock() { return *test->window().findChild<MeshDock*>("mesh"); }
  void wait_for_check() {
    auto* check = in_dialog<QPushButton>("check");
    QTest::mouseClick(check, Qt::LeftButton);
    ASSERT_TRUE(test->window().jobs().running("mesh_check"));
    ASSERT_TRUE(wait_until([&] { return idle(); }, 60000));
  }
  /// Makes a mesh by the dialog and waits for its picture.
  void make_mesh() {
    ask("file.export_mesh");
    type(in_dialog<QDoubleSpinBox>("edges_around"), "12");
    click_go();
    ASSERT_TRUE(wait_until([&] { return idle() && dock().isVisible(); }, 120000));
  }
};

/// Pixels in the colours of places that would fail or come out poor.
int marked(const QImage& picture) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const QColor color = picture.pixelColor(x, y);
      const bool poor = color.green() > 0.85 * color.red() && color.red() > 2.5 * color.blue();
      const bool fails = color.red() > 1.8 * color.green() && color.green() > 2 * color.blue();
      if (color.red() > 100 && (poor || fails)) ++count;
    }
  return count;
}

int greenish(const QImage& picture) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const QColor color = picture.pixelColor(x, y);
      if (color.green() > 60 && color.green() > 1.5 * color.red()) ++count;
    }
  return count;
}

TEST_F(NarrowWindow, WhatWouldFailIsListedShownAndRepaired) {
  open_case();
  ask("file.export_mesh");
  type(in_dialog<QDoubleSpinBox>("edges_around"), "6");
  type(in_dialog<QSpinBox>("layers"), "3");
  type(in_dialog<QDoubleSpinBox>("layer_thickness"), "1.5");
  const view::CameraPose before = test->window().scene().scene().pose();
  wait_for_check();
  auto* list = in_dialog<QListWidget>("check_places");
  ASSERT_GT(list->count(), 0) << in_dialog<QLabel>("check_summary")->text().toStdString();
  look("forecast");
  // By the keys: the first place is chosen, and the camera flies there.
  list->setFocus();
  QTest::keyClick(list, Qt::Key_Home);
  int row = -1;
  for (int i = 0; i < list->count(); ++i)
    if (list->item(i)->text().contains(heading_of(meshing::TroubleKind::no_room_for_layers))) row = i;
  ASSERT_GE(row, 0);
  for (int i = 0; i < row; ++i) QTest::keyClick(list, Qt::Key_Down);
  EXPECT_EQ(list->currentRow(), row);
  QTest::keyClick(list, Qt::Key_Return);
  look("forecast_place");
  const view::CameraPose there = test->window().scene().scene().pose();
  EXPECT_LT(there.half_height_mm, 0.8 * before.half_height_mm);
  EXPECT_NEAR(there.target.z(), testing::throat_mm, testing::half_narrowing_mm) << "at the throat";
  EXPECT_THAT(in_dialog<QLabel>("check_detail")->text().toStdString(), HasSubstr("Way out"));
  // The repair changes the field, and what is listed is old by then.
  auto* repair = in_dialog<QPushButton>("check_repair");
  ASSERT_TRUE(repair->isVisible() && repair->isEnabled());
  QTest::mouseClick(repair, Qt::LeftButton);
  EXPECT_THAT(in_dialog<QLabel>("check_summary")->text().toStdString(), HasSubstr("check again"));
  EXPECT_FALSE(repair->isEnabled());
  EXPECT_LT(in_dialog<QDoubleSpinBox>("layer_thickness")->value(), 1.5);
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(idle());
}

TEST_F(NarrowWindow, ThePlacesAreInColourWhileTheDialogIsOpen) {
  open_case();
  const int bare = marked(look("bare"));
  ask("file.export_mesh");
  type(in_dialog<QDoubleSpinBox>("edges_around"), "6");
  wait_for_check();
  ASSERT_GT(in_dialog<QListWidget>("check_places")->count(), 0);
  const int shown = marked(look("forecast_dialog"));
  QTest::keyClick(dialog, Qt::Key_Escape);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  const int after = marked(look("bare_again"));
  std::printf("marked pixels: %d before, %d shown, %d after\n", bare, shown, after);
  EXPECT_GT(shown, bare + 5000);
  EXPECT_NEAR(after, bare, 500);
}

TEST_F(NarrowWindow, ACheckIsGivenUp) {
  open_case();
  ask("file.export_mesh");
  auto* check = in_dialog<QPushButton>("check");
  QTest::mouseClick(check, Qt::LeftButton);
  ASSERT_TRUE(test->window().jobs().running("mesh_check"));
  const QString stop = check->text();
  QTest::mouseClick(check, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return idle(); }, 5000));
  EXPECT_NE(check->text(), stop);
  EXPECT_EQ(in_dialog<QListWidget>("check_places")->count(), 0);
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(NarrowWindow, ACheckOfSettingsThatChangedMeanwhileIsOld) {
  open_case();
  ask("file.export_mesh");
  type(in_dialog<QDoubleSpinBox>("edges_around"), "6");
  type(in_dialog<QSpinBox>("layers"), "3");
  type(in_dialog<QDoubleSpinBox>("layer_thickness"), "1.5");
  // All workers are held, so that the check does not end before the settings have changed.
  std::atomic<bool> held = true;
  for (int i = 0; i < 8; ++i)
    test->window().jobs().run(
        QString("hold %1").arg(i), "hold",
        [&](const core::TaskContext&) {
          while (held) std::this_thread::sleep_for(std::chrono::milliseconds(5));
          return std::any();
        },
        [](const std::any&) {}, [](const QString&) {});
  QTest::mouseClick(in_dialog<QPushButton>("check"), Qt::LeftButton);
  type(in_dialog<QDoubleSpinBox>("layer_thickness"), "1.2");
  EXPECT_TRUE(test->window().jobs().running("mesh_check"));
  held = false;
  ASSERT_TRUE(wait_until([&] { return idle(); }, 60000));
  auto* list = in_dialog<QListWidget>("check_places");
  ASSERT_GT(list->count(), 0);
  EXPECT_THAT(in_dialog<QLabel>("check_summary")->text().toStdString(), HasSubstr("check again"));
  for (int i = 0; i < list->count(); ++i) {
    list->setCurrentRow(i);
    EXPECT_FALSE(in_dialog<QPushButton>("check_repair")->isEnabled()) << i;
  }
  wait_for_check();
  EXPECT_THAT(in_dialog<QLabel>("check_summary")->text().toStdString(), HasSubstr("Would fail"));
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(NarrowWindow, AMeshThatIsDoneOverAnotherCaseLeavesALineAlone) {
  open_case();
  ask("file.export_mesh");
  type(in_dialog<QDoubleSpinBox>("edges_around"), "12");
  click_go();
  ASSERT_TRUE(test->window().jobs().running("mesh"));
  open_other_case();
  ASSERT_TRUE(wait_until([&] { return idle(); }, 120000));
  EXPECT_TRUE(left_line("mesh").contains("tube-mesh")) << left_line("mesh").toStdString();
  EXPECT_FALSE(dock().isVisible()) << "it is another patient's";
  test->window().findChild<QAction*>("file.flow_case")->trigger();
  auto* flow = test->window().findChild<FlowDialog*>();
  ASSERT_TRUE(flow);
  EXPECT_EQ(flow->findChild<QLineEdit*>("flow_mesh")->text().toStdString(), "");
  QTest::keyClick(flow, Qt::Key_Escape);
}

TEST_F(NarrowWindow, AMinimisedWindowComesBackWithWhatWasShown) {
  open_case();
  make_mesh();
  SceneWidget& scene = test->window().scene();
  int changes = 0;
  QObject::connect(&scene, &SceneWidget::guest_changed, &scene, [&] { ++changes; });
  scene.show_guest(nullptr);
  ASSERT_EQ(changes, 1);
  test->window().hide();  // what the docks see of a window that is minimised
  settle();
  test->window().show();
  settle();
  EXPECT_TRUE(dock().isVisible());
  EXPECT_EQ(changes, 1) << "the mesh has taken the view";
  auto* command = test->window().findChild<QAction*>("view.mesh");
  command->trigger();
  ASSERT_TRUE(wait_until([&] { return !dock().isVisible(); }));
  command->trigger();
  ASSERT_TRUE(wait_until([&] { return dock().isVisible(); }));
  EXPECT_EQ(changes, 2) << "asked for, it comes back";
}

TEST_F(NarrowWindow, AllOfItHasRoomInASmallWindow) {
  open_case();
  test->window().resize(800, 600);
  ask("file.export_mesh");
  dialog->move(0, 0);
  auto* pages = dialog->findChild<QTabWidget*>("pages");
  for (int i = 0; i < pages->count(); ++i) {
    QTest::mouseClick(pages->tabBar(), Qt::LeftButton, Qt::NoModifier, pages->tabBar()->tabRect(i).center());
    look(QString("small_page_%1").arg(i).toUtf8());
    EXPECT_LE(dialog->width(), 800) << i;
    EXPECT_LE(dialog->height(), 600) << i;
    const QStringList faults = testing::layout_faults(*dialog);
    EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
  }
  QTest::keyClick(dialog, Qt::Key_Escape);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  test->window().findChild<QAction*>("view.mesh")->trigger();
  ASSERT_TRUE(wait_until([&] { return dock().isVisible(); }));
  look("small_panel");
  EXPECT_LE(test->window().width(), 800);
  EXPECT_LE(test->window().height(), 600);
  const QStringList faults = testing::layout_faults(test->window());
  EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
}

TEST_F(NarrowWindow, ASmallWindowShowsTheMeshAloneBesideItsDock) {
  open_case();
  test->window().resize(800, 600);
  make_mesh();
  EXPECT_TRUE(wait_until([&] { return test->window().scene().isVisible(); }, 5000));
  look("small_mesh");
  EXPECT_GT(test->window().scene().width(), 300);
  EXPECT_TRUE(dock().isVisible());
}

TEST_F(NarrowWindow, ExtensionsAndSizesReachTheMesh) {
  open_case();
  ask("file.export_mesh");
  type(in_dialog<QDoubleSpinBox>("flow_extensions"), "0.1");
  EXPECT_THAT(trouble("flow_extensions").toStdString(), HasSubstr("0.25 to 100"));
  EXPECT_FALSE(in_dialog<QPushButton>("go")->isEnabled());
  type(in_dialog<QDoubleSpinBox>("flow_extensions"), "2");
  type(in_dialog<QDoubleSpinBox>("stenosis_edges"), "0.5");
  type(in_dialog<QDoubleSpinBox>("curvature_ratio"), "0.4");
  type(in_dialog<QDoubleSpinBox>("size_radii"), "1.5");
  EXPECT_TRUE(in_dialog<QPushButton>("go")->isEnabled());
  const pipeline::MeshExportOptions options = dialog->mesh_options();
  ASSERT_TRUE(options.extensions);
  EXPECT_EQ(options.extensions->inlet_diameters, 2.0);
  EXPECT_EQ(options.extensions->outlet_diameters, 2.0);
  EXPECT_EQ(options.sizing.throat_share, 0.5);
  EXPECT_EQ(options.sizing.curvature_ratio, 0.4);
  EXPECT_EQ(options.sizing.most_distance_radii, 1.5);
  type(in_dialog<QDoubleSpinBox>("edges_around"), "10");
  click_go();
  ASSERT_TRUE(wait_until([&] { return idle(); }, 120000));
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "tube-mesh" / "mesh.vtu");
  geometry::Box3 box;
  for (const geometry::Vec3& point : mesh.points) box.extend(point);
  // Two diameters of 3 mm on either side of a tube that is cut 0.6 mm inside its ends.
  EXPECT_NEAR(box.sizes().z(), testing::tube_length_mm - 1.2 + 12.0, 1.0);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  ask("file.export_mesh");
  EXPECT_EQ(in_dialog<QDoubleSpinBox>("flow_extensions")->value(), 2.0) << "the choice is kept";
  EXPECT_EQ(in_dialog<QDoubleSpinBox>("stenosis_edges")->value(), 0.5);
  QTest::keyClick(dialog, Qt::Key_Escape);
}

TEST_F(NarrowWindow, TheMeshIsShownInTheColoursOfItsQualityAndCut) {
  open_case();
  make_mesh();
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "tube-mesh" / "mesh.vtu");
  const meshing::MixedQuality quality = meshing::mixed_quality(mesh);
  look("mesh");
  EXPECT_THAT(dock().findChild<QLabel*>("mesh_name")->text().toStdString(),
              HasSubstr(std::to_string(mesh.tetrahedra.size()) + " tetrahedra"));
  const auto& counts = dock().findChild<HistogramWidget*>("mesh_histogram")->counts();
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), mesh.tetrahedra.size());
  // The worst of each measure is what the quality's report says of the mesh.
  auto* measure = dock().findChild<QComboBox*>("mesh_measure");
  auto* figures = dock().findChild<QLabel*>("mesh_figures");
  const auto worst = [&] {
    return QRegularExpression("[0-9.]+").match(figures->text()).captured(0).toDouble();
  };
  const std::vector<double> expected{
      quality.tetrahedra.min_dihedral_deg, quality.tetrahedra.min_scaled_jacobian,
      quality.openfoam.max_non_orthogonality_deg, quality.openfoam.max_skewness};
  for (int i = 0; i < 4; ++i) {
    pick(measure, i);
    EXPECT_NEAR(worst(), expected[static_cast<std::size_t>(i)], 0.051) << i;
  }
  look("mesh_skewness");
  pick(measure, 0);
  // The worst element, by the mouse.
  auto* list = dock().findChild<QListWidget*>("mesh_worst");
  ASSERT_GT(list->count(), 1);
  QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier,
                    list->visualItemRect(list->item(0)).center());
  look("mesh_worst");
  EXPECT_LT((test->window().scene().scene().pose().target - quality.tetrahedra.sharpest_at).norm(), 0.1);
  test->window().scene().scene().set_pose(test->window().scene().scene().pose_fitted());
  // Cut across the vessel; the slider moves the plane by its keys.
  auto* cut = dock().findChild<QComboBox*>("mesh_cut");
  auto* place = dock().findChild<QSlider*>("mesh_cut_place");
  EXPECT_FALSE(place->isEnabled());
  pick(cut, 1);
  QApplication::processEvents();
  EXPECT_TRUE(place->isEnabled());
  ASSERT_TRUE(dock().cut());
  EXPECT_NEAR(dock().cut()->point.z(), 20.0, 0.1);
  place->setFocus();
  for (int i = 0; i < 4; ++i) QTest::keyClick(place, Qt::Key_PageUp);
  EXPECT_NEAR(dock().cut()->point.z(), 28.0, 0.1);
  EXPECT_GT(dock().cut()->normal.z(), 0.99);
  QTest::keyClick(dock().findChild<QCheckBox*>("mesh_cut_turned"), Qt::Key_Space);
  EXPECT_LT(dock().cut()->normal.z(), -0.99);
  look("mesh_cut");
  pick(cut, 3);
  look("mesh_cut_front");
}

TEST_F(NarrowWindow, TheMeshIsHiddenAndShownAgainAndGoesWithItsCase) {
  open_case();
  auto* command = test->window().findChild<QAction*>("view.mesh");
  ASSERT_TRUE(command);
  const QImage bare = look("hidden_bare");
  make_mesh();
  const QImage shown = look("hidden_shown");
  command->trigger();
  wait_until([&] { return !dock().isVisible(); });
  const view::CameraPose pose = test->window().scene().scene().pose();
  const QImage hidden = look("hidden");
  command->trigger();
  wait_until([&] { return dock().isVisible(); });
  EXPECT_TRUE(dock().isVisible());
  test->window().scene().scene().set_pose(pose);
  const QImage again = look("hidden_again");
  // The mesh is green and blue, the vessel is not.
  EXPECT_GT(greenish(shown), greenish(bare) + 3000);
  EXPECT_LT(greenish(hidden), greenish(bare) + 1000);
  EXPECT_GT(greenish(again), greenish(bare) + 3000);
  test->window().findChild<QAction*>("file.close")->trigger();
  ASSERT_TRUE(wait_until([&] { return !test->bench().has_case(); }));
  EXPECT_FALSE(dock().isVisible());
}

}  // namespace
}  // namespace ostia::workstation
