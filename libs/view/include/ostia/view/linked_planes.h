#pragma once
/// \file Three planes at right angles through the cursor's place, each shown in a view: straight in the
/// patient, or double-oblique along a vessel, a valve, a lesion.

#include "ostia/view/plane_view.h"

#include <array>
#include <memory>
#include <optional>

namespace ostia::view {

enum class LinkedPlane { axial, coronal, sagittal };

/// How the three stand. Their normals are at right angles to each other, whatever is done.
class LinkedPlanes {
 public:
  /// As reformat::Plane has them: u runs to the right of the picture, v down, u x v away from the viewer.
  struct Axes {
    Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
    Vec3 normal() const { return u.cross(v); }
  };
  LinkedPlanes() { reset(); }
  const Axes& axes(LinkedPlane plane) const { return axes_[static_cast<std::size_t>(plane)]; }
  /// The other two turn about this one's normal, from its u towards its v; its own picture stays. An angle
  /// that is not finite turns nothing.
  void turn(LinkedPlane about, double angle_rad);
  void reset();  ///< axial, coronal and sagittal as radiologists hang them
  bool straight() const { return straight_; }

  session::Signal<> changed;

 private:
  std::array<Axes, 3> axes_;
  bool straight_ = true;
};

/// One of the three. The others are drawn in it as lines through the cursor, in their colours: by a ring near
/// its end a line is turned, by a dot on its slab's border the slab becomes thicker or thinner.
class LinkedPlaneView final : public PlaneView {
 public:
  LinkedPlaneView(session::Workbench& bench, LinkedPlane kind, std::shared_ptr<LinkedPlanes> planes);
  bool ready() const override;
  void scroll(double steps) override;  ///< the cursor goes through the plane
  LinkedPlane kind() const { return kind_; }
  LinkedPlanes& planes() { return *planes_; }

  enum class Grip { turn, slab };
  /// What can be taken hold of at a place: a ring or a dot of the line of `plane`.
  struct Hold {
    Grip grip = Grip::turn;
    LinkedPlane plane = LinkedPlane::axial;
  };
  std::optional<Hold> hold_at(const Vec2& px);
  /// Where a ring (or, with a slab, a dot) of another plane's line is, one of two.
  Vec2 grip_px(const Hold& hold, bool other_side);
  /// From u towards v as seen from the cursor.
  double angle_at(const Vec2& px);
  /// The slab's border comes to this place; without a slab there is a maximum then.
  void drag_slab(LinkedPlane plane, const Vec2& px);
  void thicken(double steps);  ///< by a millimetre a step

 protected:
  std::optional<Placement> placement() const override;
  void add_to_overlay(Overlay& overlay) override;

 private:
  struct Line {
    LinkedPlane plane;
    Vec2 along, across;  ///< unit, in pixels
  };
  std::array<Line, 2> lines() const;
  Line line_of(LinkedPlane plane) const;
  Vec2 centre_px();
  void add_line(Overlay& overlay, const Line& line);
  LinkedPlane kind_;
  std::shared_ptr<LinkedPlanes> planes_;
};

}  // namespace ostia::view
