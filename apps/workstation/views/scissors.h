#pragma once
/// \file Scissors: a line drawn freely over the 3D picture, along which the volume is cut.

#include "views/scene_grip.h"

#include "ostia/view/volume_cuts.h"

#include <functional>
#include <vector>

namespace ostia::workstation {

class SceneWidget;

/// One cut each time they are taken up; Escape lays them down.
class Scissors final : public SceneGrip {
 public:
  using Cut = std::function<void(const view::VolumeCut&)>;
  Scissors(SceneWidget& scene, Cut cut) : scene_(scene), cut_(std::move(cut)) {}
  ~Scissors() override = default;
  /// The next line that is drawn with the left button cuts: what lies inside goes, or all else.
  void take_up(bool keep_inside);
  bool taken_up() const { return taken_up_; }

  bool under(const geometry::Vec2& display) const override;
  void take(const geometry::Vec2& display) override;
  void drag(const geometry::Vec2& display) override;
  void put_back() override;  ///< lays them down, nothing is cut
  void let_go() override;
  bool draws() const override { return taken_up_; }

 private:
  void show();
  SceneWidget& scene_;
  Cut cut_;
  SceneGrip* former_ = nullptr;
  std::vector<geometry::Vec2> line_;
  bool taken_up_ = false, keep_inside_ = false;
};

}  // namespace ostia::workstation
