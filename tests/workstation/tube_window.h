#pragma once
/// \file The window with the tube's case in it, and a hand in its fields.

#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <QWindow>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace ostia::workstation::testing {

namespace fs = std::filesystem;
using view::Vec3;

/// Clicks into the field, selects all and types.
inline void type(QWidget* field, const QString& text) {
  auto* line = qobject_cast<QLineEdit*>(field);
  if (!line) line = field->findChild<QLineEdit*>();
  QTest::mouseClick(line, Qt::LeftButton);
  QTest::keyClick(line, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(line, text);
  QApplication::processEvents();
}

/// By the keys of a combo box, as a person does.
inline void pick(QComboBox* box, int index) {
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Home);
  for (int i = 0; i < index; ++i) QTest::keyClick(box, Qt::Key_Down);
  EXPECT_EQ(box->currentIndex(), index) << box->objectName().toStdString();
}

/// The tube, its image and its case in a folder; a window once the case is opened.
struct TubeWindow : ::testing::Test {
  Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia";
  std::unique_ptr<TestWindow> test;
  QWindow* native = nullptr;  // of the 3D view, once it has been looked at

  explicit TubeWindow(double narrowing = 0.0) {
    imaging::write_image(image, tube_image(narrowing));
    session::CaseFile::create(case_file, tube_model(narrowing), session::image_reference(image));
    session::MachineState(folder / "state").remember_image(session::image_reference(image).sha256, image);
  }
  MainWindow& window() { return test->window(); }
  static void settle() { let_rest(); }
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
  template <class Part>
  Part* part(const char* name, QWidget* of = nullptr) {
    auto* found = (of ? of : &window())->findChild<Part*>(name);
    if (!found) throw std::runtime_error(std::string("there is no ") + name);
    return found;
  }
  /// The 3D view, from the patient's front.
  void look_from_front(const Vec3& target = {0.0, 0.0, 20.0}, double half_height_mm = 24.0) {
    settle();  // the flight of the camera
    for (QWindow* one : QGuiApplication::allWindows())
      if (one->inherits("QVTKOpenGLWindow") && one->isExposed()) native = one;
    ASSERT_TRUE(native);
    window().scene().scene().set_pose(view::pose_from(view::ViewFrom::anterior, target, half_height_mm));
    window().scene().request_render();
    settle();
  }
  /// Where a place of the patient is in the 3D view.
  QPoint at(const Vec3& place) {
    const geometry::Vec2 px = window().scene().scene().project(place);
    const double ratio = native->devicePixelRatio();
    return QPointF(px.x() / ratio, native->height() - px.y() / ratio).toPoint();
  }
  void mouse(QEvent::Type type, const QPoint& where, Qt::MouseButton button, Qt::MouseButtons held) {
    QMouseEvent event(type, where, native->mapToGlobal(where), button, held, Qt::NoModifier);
    QApplication::sendEvent(native, &event);
    QApplication::processEvents();
  }
  bool idle() { return !window().jobs().any(); }
  /// The roles of a picture's coloured pixels.
  std::vector<view::Role> coloured(const char* picture) {
    std::vector<view::Role> found;
    for (const auto& tint : test->picture(picture).view().overlay().tints)
      for (const std::uint8_t code : tint->what)
        if (code != 0) found.push_back(tint->roles[code - 1U]);
    return found;
  }
  QString left_line(const char* kind) {
    auto* line = window().jobs().findChild<QWidget*>(QStringLiteral("left.%1").arg(kind));
    auto* label = line ? line->findChild<QLabel*>() : nullptr;
    return label ? label->text() : QString();
  }
};

}  // namespace ostia::workstation::testing
