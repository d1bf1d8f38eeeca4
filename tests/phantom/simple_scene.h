#pragma once
/// \file Scenes of one shape whose partial volumes are known.

#include "ostia/phantom/scan.h"
#include "ostia/phantom/scene.h"

#include <functional>
#include <memory>
#include <utility>

namespace ostia::testing {

/// A scene given by a function; `fine_reach_mm` makes every place look as if something thin were near.
class FunctionScene : public phantom::Scene {
 public:
  using Function = std::function<phantom::Material(const geometry::Vec3&)>;
  explicit FunctionScene(Function function, bool fine = false)
      : function_(std::move(function)), fine_(fine) {}
  std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3&) const override {
    return std::make_unique<Part>(function_, fine_);
  }

 private:
  class Part : public phantom::ScenePart {
   public:
    Part(const Function& function, bool fine) : function_(function), fine_(fine) {}
    phantom::Material at(const geometry::Vec3& point) const override { return function_(point); }
    std::optional<phantom::Material> uniform() const override { return std::nullopt; }
    bool fine_near(const geometry::Vec3&, double) const override { return fine_; }

   private:
    const Function& function_;
    bool fine_;
  };
  Function function_;
  bool fine_;
};

/// A ball of 1000 HU in fat of 0 HU.
inline FunctionScene ball_scene(const geometry::Vec3& centre, double radius_mm, bool fine = false) {
  return FunctionScene(
      [=](const geometry::Vec3& p) {
        return (p - centre).squaredNorm() < radius_mm * radius_mm
                   ? phantom::Material{phantom::Label::coronary_lumen, 1000.0f}
                   : phantom::Material{phantom::Label::fat, 0.0f};
      },
      fine);
}

/// `hu` everywhere.
inline FunctionScene flat_scene(float hu) {
  return FunctionScene([=](const geometry::Vec3&) { return phantom::Material{phantom::Label::fat, hu}; });
}

/// Options without noise on a grid of `size` voxels centred at the origin.
inline phantom::ScanOptions quiet_scan(std::array<std::int64_t, 3> size, const geometry::Vec3& spacing) {
  phantom::ScanOptions options;
  options.grid.size = size;
  options.grid.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis)
    options.grid.origin[axis] =
        -0.5 * spacing[axis] * static_cast<double>(size[static_cast<std::size_t>(axis)] - 1);
  options.noise_hu = 0.0;
  return options;
}

}  // namespace ostia::testing
