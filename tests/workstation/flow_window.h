#pragma once
/// \file The window with a tube in it, a hand in its flow dialog and its results, and a wall of known values.

#include "flow_dialog.h"
#include "flow_results.h"
#include "solver_test_support.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_fields.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScreen>
#include <QTest>
#include <QWindow>
#include <cmath>

namespace ostia::workstation::testing {

namespace fs = std::filesystem;
using view::Vec3;

constexpr double radius_mm = tube_radius_mm;

/// Shear that rises along the tube, and a pressure that falls.
inline double shear_pa(double z) {
  return 1.0 + 0.25 * z;
}
inline double pressure_pa(double z) {
  return 100.0 - 2.0 * z;
}

/// The tube's wall, open, with both at its points; the pressure may be another one.
inline void write_wall(const fs::path& file, double first_pa = pressure_pa(0.0),
                       double last_pa = pressure_pa(40.0)) {
  constexpr int around = 48, along = 80;
  geometry::FacedSurface wall;
  io::PointFields fields;
  fields["wall_shear_stress_Pa"].components = fields["pressure_Pa"].components = 1;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * M_PI * i / around, z = 40.0 * k / along;
      wall.mesh.points.push_back({radius_mm * std::cos(angle), radius_mm * std::sin(angle), z});
      fields["wall_shear_stress_Pa"].values.push_back(shear_pa(z));
      fields["pressure_Pa"].values.push_back(first_pa + (last_pa - first_pa) * z / 40.0);
    }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const int a = around * k + i, b = around * k + (i + 1) % around;
      wall.mesh.triangles.push_back({a, b, b + around});
      wall.mesh.triangles.push_back({a, b + around, a + around});
    }
  wall.face_ids.assign(wall.mesh.triangles.size(), 1);
  wall.faces = {geometry::Face{}};
  io::write_vtp_with_fields(file, wall, fields);
}

struct FlowWindow : ::testing::Test {
  Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", wall = folder / "wall.vtp";
  std::unique_ptr<TestWindow> test;
  QWindow* native = nullptr;
  FlowDialog* dialog = nullptr;

  FlowWindow() {
    imaging::write_image(image, tube_image());
    session::CaseFile::create(case_file, tube_model(), session::image_reference(image));
    session::MachineState(folder / "state").remember_image(session::image_reference(image).sha256, image);
  }
  MainWindow& window() { return test->window(); }
  static void settle(int ms = 400) {
    wait_until([] { return false; }, ms);
  }
  void open_case(const QSize& size = {1600, 1150}) {
    test = std::make_unique<TestWindow>(folder / "state");
    window().resize(size);
    test->open(case_file);
    settle();
  }
  /// Of another patient, beside the tube's.
  void open_other_case() {
    const fs::path other = folder / "other.ostia";
    if (!fs::exists(other)) session::CaseFile::create(other, tube_model(), session::image_reference(image));
    part<QAction>("file.close")->trigger();
    ASSERT_FALSE(test->bench().has_case());
    window().open(other);
    ASSERT_TRUE(wait_until([&] { return test->bench().has_case(); }));
    settle();
  }
  template <class Widget>
  Widget* part(const char* name, QWidget* of = nullptr) {
    auto* found = (of ? of : &window())->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("there is no ") + name);
    return found;
  }
  static void type(QWidget* field, const QString& text) {
    auto* line = qobject_cast<QLineEdit*>(field);
    if (!line) line = field->findChild<QLineEdit*>();
    QTest::mouseClick(line, Qt::LeftButton);
    QTest::keyClick(line, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(line, text);
    QApplication::processEvents();
  }
  /// By the keys of a combo box, as a person does.
  static void pick(QComboBox* box, int index) {
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Home);
    for (int i = 0; i < index; ++i) QTest::keyClick(box, Qt::Key_Down);
    EXPECT_EQ(box->currentIndex(), index) << box->objectName().toStdString();
  }
  bool idle() { return !window().jobs().any(); }

  // Results ------------------------------------------------------------------------------------------------

  void open_wall() {
    write_wall(wall);
    answer_file_dialog(wall);
    part<QAction>("file.flow_results")->trigger();
    ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }));
    look_from_front();
  }
  void look_from_front() {
    settle();  // the flight of the camera
    for (QWindow* one : QGuiApplication::allWindows())
      if (one->inherits("QVTKOpenGLWindow") && one->isExposed()) native = one;
    ASSERT_TRUE(native);
    window().scene().scene().set_pose(view::pose_from(view::ViewFrom::anterior, {0.0, 0.0, 20.0}, 24.0));
    window().scene().request_render();
    settle();
  }
  QPoint at(const Vec3& place) {
    const geometry::Vec2 px = window().scene().scene().project(place);
    const double ratio = native->devicePixelRatio();
    return QPointF(px.x() / ratio, native->height() - px.y() / ratio).toPoint();
  }
  QString told(const Vec3& place) {
    QTest::mouseMove(native, at(place) + QPoint(1, 0));
    QTest::mouseMove(native, at(place));
    settle(50);
    return part<QLabel>("place")->text();
  }
  /// The number in what the status line says.
  double value_told(const Vec3& place) {
    const QStringList words = told(place).split(' ');
    for (const QString& word : words) {
      bool is_number = false;
      const double value = word.toDouble(&is_number);
      if (is_number) return value;
    }
    return std::nan("");
  }
  QColor color_at(const Vec3& place) {
    const QPoint on_screen = native->mapToGlobal(at(place));
    return QGuiApplication::primaryScreen()
        ->grabWindow(0, on_screen.x(), on_screen.y(), 1, 1)
        .toImage()
        .pixelColor(0, 0);
  }

  // Cases --------------------------------------------------------------------------------------------------

  /// A tube of 6 mm with an inlet and an outlet, 1.5 mm in radius; its mesh beside the case.
  fs::path write_mesh(int layers = 0, const std::string& name = "tube-mesh") {
    fs::create_directory(folder / name);
    const fs::path file = folder / name / "mesh.vtu";
    io::export_mesh(solver::vessel(geometry::straight_tube(6.0, radius_mm), 0.5, layers), io::MeshFormat::vtu,
                    file);
    return file;
  }
  void ask() {
    part<QAction>("file.flow_case")->trigger();
    ASSERT_TRUE(wait_until([&] {
      dialog = window().findChild<FlowDialog*>();
      return dialog && dialog->isVisible();
    }));
    ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog));
  }
  QString trouble(const char* field) {
    auto* label = part<QLabel>((std::string(field) + "_trouble").c_str(), dialog);
    return label->isVisible() ? label->text() : QString();
  }
  bool ready() {
    return wait_until([&] { return part<QPushButton>("go", dialog)->isEnabled(); });
  }
  void click_go() {
    QTest::mouseClick(part<QPushButton>("go", dialog), Qt::LeftButton);
    QApplication::processEvents();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  QString left_line(const char* kind) {
    auto* line = window().jobs().findChild<QWidget*>(QStringLiteral("left.%1").arg(kind));
    auto* label = line ? line->findChild<QLabel*>() : nullptr;
    return label ? label->text() : QString();
  }
};

}  // namespace ostia::workstation::testing
