#pragma once
/// \file The window with a tube in it, a hand in its flow dialog and its results, and a wall of known values.

#include "flow/dialog.h"
#include "flow/results.h"
#include "tube_mesh.h"
#include "tube_window.h"

#include "ostia/io/surface_fields.h"

#include <QScreen>
#include <cmath>

namespace ostia::workstation::testing {

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

struct FlowWindow : TubeWindow {
  fs::path wall = folder / "wall.vtp";
  FlowDialog* dialog = nullptr;

  // Results ------------------------------------------------------------------------------------------------

  void open_wall() {
    write_wall(wall);
    answer_file_dialog(wall);
    part<QAction>("file.flow_results")->trigger();
    ASSERT_TRUE(wait_until([&] { return idle() && window().flow_results().shown(); }));
    look_from_front();
  }
  QString told(const Vec3& place) {
    QTest::mouseMove(native, at(place) + QPoint(1, 0));
    QTest::mouseMove(native, at(place));
    let_work(50);
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

  /// A mesh of the tube beside the case.
  fs::path write_mesh(int layers = 0, const std::string& name = "tube-mesh") {
    fs::create_directory(folder / name);
    const fs::path file = folder / name / "mesh.vtu";
    io::export_mesh(tube_mesh(layers), io::MeshFormat::vtu, file);
    return file;
  }
  /// A mesh of each of two trees, as an export of left and right artery leaves them.
  fs::path write_two_meshes(const std::string& name = "tube-mesh") {
    const fs::path made = folder / name;
    for (const char* tree : {"LAD", "RCA"}) {
      fs::create_directories(made / tree);
      geometry::MixedMesh mesh = tube_mesh();
      if (tree == std::string("RCA"))
        for (Vec3& point : mesh.points) point.x() += second_tube_x_mm;
      io::export_mesh(mesh, io::MeshFormat::vtu, made / tree / "mesh.vtu");
    }
    return made;
  }
  /// Another case in the tube's place: two tubes, each a tree of its own.
  void write_two_tubes() {
    case_file = folder / "two.ostia";
    session::CaseFile::create(case_file, two_tubes(), session::image_reference(image));
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
};

}  // namespace ostia::workstation::testing
