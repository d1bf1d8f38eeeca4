#pragma once
/// \file What a scanner is shown: a material at every place.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace ostia::phantom {

/// Materials, as the truth's label volume numbers them.
enum class Label : std::uint8_t {
  outside_air = 0,
  lung = 1,
  airway = 2,
  fat = 3,
  muscle = 4,
  bone = 5,
  marrow = 6,
  liver = 7,
  epicardial_fat = 8,
  myocardium = 9,
  left_ventricle = 10,
  right_ventricle = 11,
  left_atrium = 12,
  right_atrium = 13,
  aorta = 14,
  pulmonary_artery = 15,
  pulmonary_vessel = 16,
  vein = 17,
  coronary_vein = 18,
  vessel_wall = 19,
  coronary_lumen = 20,
  soft_plaque = 21,
  fibrous_plaque = 22,
  calcified_plaque = 23,
  oesophagus = 24,
  skin = 25,
  metal = 26
};

struct Material {
  Label label = Label::outside_air;
  float hu = -1000.0f;
};

/// What may be met within one box. Asked from one thread, many times.
class ScenePart {
 public:
  virtual ~ScenePart() = default;
  virtual Material at(const geometry::Vec3& point_mm) const = 0;
  /// The one material of the whole box, when it has but one (texture aside); nothing when unsure.
  virtual std::optional<Material> uniform() const = 0;
  /// Whether something thinner than a voxel may be within `reach_mm` of the point: it must then be sampled
  /// finely although its neighbours look alike.
  virtual bool fine_near(const geometry::Vec3& point_mm, double reach_mm) const = 0;
};

/// Immutable; asked from many threads. The same for the same arguments.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual std::unique_ptr<const ScenePart> part(const geometry::Box3& box) const = 0;
};

}  // namespace ostia::phantom
