#include "views/heart_behind.h"

#include "views/scene_widget.h"

#include <QComboBox>

namespace ostia::workstation {

QComboBox* heart_behind(SceneWidget& scene) {
  auto* heart = new QComboBox;
  heart->setObjectName("volume_mode");
  heart->addItem(SceneWidget::tr("Tree alone"), static_cast<int>(view::VolumeMode::off));
  heart->addItem(SceneWidget::tr("With the heart"), static_cast<int>(view::VolumeMode::rendering));
  heart->addItem(SceneWidget::tr("With a MIP"), static_cast<int>(view::VolumeMode::mip));
  heart->setAccessibleName(SceneWidget::tr("What is behind the tree"));
  QObject::connect(heart, QOverload<int>::of(&QComboBox::activated), &scene, [&scene, heart](int index) {
    scene.set_volume_mode(static_cast<view::VolumeMode>(heart->itemData(index).toInt()));
  });
  QObject::connect(&scene, &SceneWidget::volume_mode_changed, heart, [heart](view::VolumeMode mode) {
    heart->setCurrentIndex(heart->findData(static_cast<int>(mode)));
  });
  return heart;
}

}  // namespace ostia::workstation
