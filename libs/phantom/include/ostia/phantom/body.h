#pragma once
/// \file The chest of a phantom: heart, great vessels, lungs, bones, and the coronary arteries in it.

#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"
#include "ostia/phantom/heart_warp.h"
#include "ostia/phantom/scene.h"

#include <cstdint>
#include <memory>

namespace ostia::phantom {

/// CT numbers in the arterial phase at 120 kV (usual values; docs/methods/phantom-anatomy.md).
struct TissueHu {
  float arterial = 400.0f;  ///< left heart, aorta; 250 to 600
  float coronary_drop =
      0.12f;  ///< share of the contrast above blood that is lost along the arteries' first 100 mm
  float right_heart = 190.0f, pulmonary = 230.0f, vein = 200.0f, superior_vena_cava = 420.0f, blood = 45.0f;
  float myocardium = 105.0f, muscle = 55.0f, fat = -98.0f, epicardial_fat = -88.0f;
  float lung = -862.0f, marrow = 190.0f, bone = 620.0f, liver = 85.0f;
};

struct BodyOptions {
  std::uint64_t seed = 1;
  TissueHu hu;
  double texture = 1.0;  ///< scales the tissues' inner variation, in [0, 3]
  double mixing = 0.0;   ///< ScanRealism::mixing, in [0, 1]
  double vein_closeness = 0.0, lobes = 0.0, groove_fat = 1.0;  ///< as Obstacles has them
};
/// Options with CT numbers drawn about their usual values.
BodyOptions draw_body(std::uint64_t seed);

/// The scene a scanner is shown. Immutable.
class Body : public Scene {
 public:
  /// With a map, heart and chest are bent by it; the arteries are where the tree has them.
  Body(const HeartShape& heart, const CoronaryTree& tree, const BodyOptions& options = {},
       std::shared_ptr<const HeartWarp> warp = nullptr);
  ~Body() override;
  std::unique_ptr<const ScenePart> part(const geometry::Box3& box) const override;
  Material at(const Vec3& point_mm) const;  ///< slow; for single questions

  struct Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace ostia::phantom
