#pragma once
/// \file What stands in the 3D scene in the wall's place: a surface with a solver's result.

#include "ostia/geometry/vec.h"
#include "ostia/view/value_scale.h"

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

namespace ostia::view {

/// A guest of TreeScene::set_guest. World LPS, mm. One thread.
class SceneGuest {
 public:
  SceneGuest() = default;
  virtual ~SceneGuest() = default;
  SceneGuest(const SceneGuest&) = delete;
  SceneGuest& operator=(const SceneGuest&) = delete;
  /// What is drawn; the same one as long as the guest stays.
  virtual vtkProp& prop() = 0;
  /// Another prop over the same data, for a picture in a second window.
  virtual vtkSmartPointer<vtkProp> twin() const = 0;
  /// Points that a fitted view has to show; at least one.
  virtual std::vector<geometry::Vec3> outline() const = 0;
  /// What the bar beside the picture says; nothing: no bar.
  virtual std::optional<ValueScale> bar() const = 0;
  /// Before each picture: how large it will be seen.
  virtual void seen_at(double mm_per_px) { static_cast<void>(mm_per_px); }
};

/// A ray from the eye into the scene.
struct SceneRay {
  geometry::Vec3 origin = geometry::Vec3::Zero();
  geometry::Vec3 direction = geometry::Vec3::UnitZ();  ///< unit
};

}  // namespace ostia::view
