#include "views/heart_behind.h"

#include "opening/opening.h"
#include "shell/main_window.h"

#include "ostia/imaging/reduced_volume.h"

#include <QComboBox>

namespace ostia::workstation {
namespace {

using SharedImage = std::shared_ptr<const imaging::ImageVolume>;

void reduce(MainWindow& window) {
  const SharedImage image = window.bench().image().volume;
  window.jobs().run(
      "volume", MainWindow::tr("Preparing the heart"),
      [image](const core::TaskContext& task) {
        return std::any(
            std::make_shared<const imaging::ImageVolume>(imaging::reduced_volume(*image, {}, task)));
      },
      [&window, image](const std::any& reduced) {
        if (window.bench().image().volume != image) return;  // another heart by now
        window.scene().scene().set_volume(std::any_cast<SharedImage>(reduced));
        window.scene().request_render();
      },
      [&window](const QString& message) { window.say(message); });
}

}  // namespace

QComboBox* heart_behind(MainWindow& window, const Opening& opening) {
  SceneWidget& scene = window.scene();
  QObject::connect(&scene, &SceneWidget::volume_wanted, &window, [&window, &opening] {
    if (window.bench().image().volume && !opening.reading()) reduce(window);
  });
  auto* heart = new QComboBox;
  heart->setObjectName("volume_mode");
  heart->addItem(MainWindow::tr("Tree alone"), static_cast<int>(view::VolumeMode::off));
  heart->addItem(MainWindow::tr("With the heart"), static_cast<int>(view::VolumeMode::rendering));
  heart->addItem(MainWindow::tr("With a MIP"), static_cast<int>(view::VolumeMode::mip));
  heart->setAccessibleName(MainWindow::tr("What is behind the tree"));
  QObject::connect(heart, QOverload<int>::of(&QComboBox::activated), &scene, [&scene, heart](int index) {
    scene.set_volume_mode(static_cast<view::VolumeMode>(heart->itemData(index).toInt()));
  });
  return heart;
}

}  // namespace ostia::workstation
