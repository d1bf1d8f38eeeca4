#include "views/heart_behind.h"

#include "shell/desk.h"
#include "views/scene_widget.h"

#include "ostia/imaging/reduced_volume.h"

#include <QComboBox>

namespace ostia::workstation {
namespace {

using SharedImage = std::shared_ptr<const imaging::ImageVolume>;

void reduce(Desk& desk, SceneWidget& scene) {
  const SharedImage image = desk.bench.image().volume;
  desk.jobs.run(
      "volume", SceneWidget::tr("Preparing the heart"),
      [image](const core::TaskContext& task) {
        return std::any(
            std::make_shared<const imaging::ImageVolume>(imaging::reduced_volume(*image, {}, task)));
      },
      [&desk, &scene, image](const std::any& reduced) {
        if (desk.bench.image().volume != image) return;  // another heart by now
        scene.scene().set_volume(std::any_cast<SharedImage>(reduced));
        scene.request_render();
      },
      [&desk](const QString& message) { desk.messages.say(message); });
}

}  // namespace

QComboBox* heart_behind(Desk& desk, SceneWidget& scene, const std::function<bool()>& is_being_read) {
  QObject::connect(&scene, &SceneWidget::volume_wanted, &scene, [&desk, &scene, is_being_read] {
    if (desk.bench.image().volume && !is_being_read()) reduce(desk, scene);
  });
  auto* heart = new QComboBox;
  heart->setObjectName("volume_mode");
  heart->addItem(SceneWidget::tr("Tree alone"), static_cast<int>(view::VolumeMode::off));
  heart->addItem(SceneWidget::tr("With the heart"), static_cast<int>(view::VolumeMode::rendering));
  heart->addItem(SceneWidget::tr("With a MIP"), static_cast<int>(view::VolumeMode::mip));
  heart->setAccessibleName(SceneWidget::tr("What is behind the tree"));
  QObject::connect(heart, QOverload<int>::of(&QComboBox::activated), &scene, [&scene, heart](int index) {
    scene.set_volume_mode(static_cast<view::VolumeMode>(heart->itemData(index).toInt()));
  });
  return heart;
}

}  // namespace ostia::workstation
