#pragma once
/// \file Something in the 3D picture that the hand can take hold of.

#include "ostia/geometry/vec.h"

namespace ostia::workstation {

/// Places are in display coordinates, as those of view::TreeScene.
class SceneGrip {
 public:
  SceneGrip() = default;
  virtual ~SceneGrip() = default;
  SceneGrip(const SceneGrip&) = delete;
  SceneGrip& operator=(const SceneGrip&) = delete;
  virtual bool under(const geometry::Vec2& display) const = 0;
  virtual void take(const geometry::Vec2& display) = 0;
  virtual void drag(const geometry::Vec2& display) = 0;
  virtual void put_back() = 0;  ///< to where it was taken
  virtual void let_go() {}      ///< the button went up over the picture
  /// A line over the picture and not something in it: a cross shows that, and it begins anywhere.
  virtual bool draws() const { return false; }
};

}  // namespace ostia::workstation
