// What the window shows in each of its states, held against accepted pictures.
#include "views/raster_image.h"
#include "window_states.h"

#include "ostia/figure/picture_difference.h"

#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>

#include <QPainter>
#include <QSurfaceFormat>
#include <QTextBrowser>
#include <algorithm>
#include <clocale>
#include <filesystem>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::Stage;

const QSize size(1280, 800);
// In S-CIELAB's Delta E, mean of the worst block of 16 pixels. A missing word makes 10 and more.
constexpr double most = 4.0;
constexpr double most_in_3d = 12.0;  // another version of the renderer rounds edges and light otherwise

QImage image_of(const figure::Raster& raster) {
  return QImage(raster.rgba.data(), raster.width, raster.height, 4 * raster.width, QImage::Format_RGBA8888)
      .convertToFormat(QImage::Format_RGB888);
}

QImage without(QImage image, const QRect& part) {
  QPainter(&image).fillRect(part, Qt::gray);
  return image;
}

void save(const QImage& image, const fs::path& path) {
  fs::create_directories(path.parent_path());
  ASSERT_TRUE(
      image.convertToFormat(QImage::Format_RGB888).save(QString::fromStdString(path.string()), "PNG", 0))
      << path;
}

/// Where the tree is drawn by the 3D renderer, in the window's pixels.
QRect part_in_3d(MainWindow& window) {
  const QWidget& tree = window.scene();
  if (!tree.isVisible()) return {};
  return QRect(tree.mapTo(&window, QPoint(0, 0)), tree.size());
}

/// Where a page of the manual is shown, but for its beginning: its text and pictures have their own tests.
QRect part_of_the_manual(const QWidget& window) {
  const auto* page = window.findChild<const QTextBrowser*>("page");
  if (!page || !page->isVisible()) return {};
  constexpr int beginning = 110;
  return QRect(page->viewport()->mapToGlobal(QPoint(0, beginning)),
               page->viewport()->size() - QSize(0, beginning));
}

class Screenshot : public ::testing::TestWithParam<std::string> {
 protected:
  void hold(const QImage& made, const QImage& accepted, double limit, const std::string& what) {
    const figure::Raster now = raster_of(made);
    const figure::PictureDifference found = figure::picture_difference(raster_of(accepted), now);
    RecordProperty("worst_" + what, std::to_string(found.worst));
    std::printf("%s, %s: worst block %.2f, mean %.4f\n", GetParam().c_str(), what.c_str(), found.worst,
                found.mean);
    if (found.worst <= limit) return;
    const fs::path folder = OSTIA_SCREENSHOTS_MADE;
    const fs::path picture = folder / (GetParam() + ".png");
    const fs::path difference = folder / (GetParam() + "-" + what + "-difference.png");
    save(made_, picture);
    save(image_of(figure::difference_picture(now, found)), difference);
    ADD_FAILURE() << GetParam() << ", " << what << ": " << found.worst << " where " << limit
                  << " is allowed, at " << found.worst_x << ", " << found.worst_y << ". Look at " << picture
                  << " and " << difference
                  << "; where the new picture is right, take it with scripts/accept_screenshots.sh.";
  }
  QImage made_;
};

TEST_P(Screenshot, LooksAsItWasAccepted) {
  Stage stage(size);
  stage.enter(GetParam());
  made_ = without(stage.settled(), part_of_the_manual(stage.window()));
  const fs::path file = fs::path(OSTIA_SCREENSHOTS) / (GetParam() + ".png");
  if (!qEnvironmentVariableIsEmpty("OSTIA_WRITE_GOLDEN")) return save(made_, file);
  const QImage accepted(QString::fromStdString(file.string()));
  ASSERT_FALSE(accepted.isNull()) << "there is no picture " << file
                                  << ": scripts/accept_screenshots.sh makes it";
  ASSERT_EQ(accepted.size(), made_.size());
  const QRect tree = part_in_3d(stage.window());
  hold(without(made_, tree), without(accepted, tree), most, "window");
  if (!tree.isEmpty()) hold(made_.copy(tree), accepted.copy(tree), most_in_3d, "tree");
}

INSTANTIATE_TEST_SUITE_P(States, Screenshot, ::testing::ValuesIn(testing::window_states()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace ostia::workstation

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const ostia::workstation::testing::Folder folder;
  ostia::workstation::testing::pin_fonts(folder);
  qunsetenv("QT_SCALE_FACTOR");
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication::setAttribute(Qt::AA_DontCreateNativeWidgetSiblings);
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  ostia::workstation::testing::pin_look();
  return RUN_ALL_TESTS();
}
