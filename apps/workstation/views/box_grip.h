#pragma once
/// \file The box about the heart in 3D, with a handle on each side.

#include "views/scene_grip.h"

#include "ostia/session/property.h"
#include "ostia/view/volume_box.h"

#include <QObject>
#include <array>
#include <optional>
#include <vector>

namespace ostia::workstation {

class HeartVolume;
class SceneWidget;

/// While HeartVolume::box_shown and a volume is there. A side that is pulled moves along the patient's axis;
/// Escape takes it back.
class BoxGrip final : public QObject, public SceneGrip {
  Q_OBJECT
 public:
  BoxGrip(HeartVolume& heart, SceneWidget& scene);
  bool under(const geometry::Vec2& display) const override;
  void take(const geometry::Vec2& display) override;
  void drag(const geometry::Vec2& display) override;
  void put_back() override;
  void let_go() override;

 private:
  void refresh();
  bool is_there() const;
  std::array<view::BoxFace, 6> faces() const;
  std::optional<std::size_t> face_at(const geometry::Vec2& display) const;
  struct Taken {
    std::size_t face = 0;
    view::BoxFace as_taken;
    view::VolumeCrop crop;
    geometry::Vec2 at = geometry::Vec2::Zero();
  };
  HeartVolume& heart_;
  SceneWidget& scene_;
  std::optional<Taken> taken_;
  SceneGrip* former_ = nullptr;
  bool in_hand_ = false;  // it is the scene's grip, or that of the scissors' return
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
