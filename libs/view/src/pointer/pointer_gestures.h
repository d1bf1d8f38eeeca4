#pragma once
// What a hand can do between press and release.

#include "pictures/own_steps.h"
#include "pointer/measure_placing.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/linked_planes.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/pointer.h"

namespace ostia::view {

/// One press, moves, one release. Dropped without release: cancelled. A release comes where the last move
/// was: what is done with each move is done.
class Pointer::Gesture {
 public:
  virtual ~Gesture() = default;
  virtual void move(const PointerEvent& event) = 0;
  virtual void release(const PointerEvent&) {}
  virtual void cancel() {}     ///< what is drawn of it goes from the view
  virtual void take_back() {}  ///< what it did to the case is undone
  virtual CursorShape shape() const { return CursorShape::arrow; }
};

/// The vessel on whose wall a place lies: the selected one where it is on its wall, too.
std::int32_t vessel_of_wall(const session::Workbench& bench, const Vec3& place);
/// The vessel whose axis passes nearest to a place, and how near.
struct NearestAxis {
  std::int32_t vessel = session::Workbench::no_vessel;
  geometry::AxisFoot foot;
};
/// What a hand that browses can take hold of in a view of three linked planes.
std::optional<LinkedPlaneView::Hold> held_of_planes(PictureView& view, const PointerEvent& event);
NearestAxis nearest_axis(const session::Workbench& bench, const Vec3& place);

// What is shown.
class Pointer::Pan final : public Gesture {
 public:
  Pan(PictureView& view, const PointerEvent& event) : view_(view), last_(event.px) {}
  void move(const PointerEvent& event) override;
  CursorShape shape() const override { return CursorShape::move; }

 private:
  PictureView& view_;
  Vec2 last_;
};
class Pointer::Contrast final : public Gesture {
 public:
  Contrast(PictureView& view, const PointerEvent& event) : view_(view), last_(event.px) {}
  void move(const PointerEvent& event) override;
  CursorShape shape() const override { return CursorShape::contrast; }

 private:
  PictureView& view_;
  Vec2 last_;
};
class Pointer::Turn final : public Gesture {
 public:
  Turn(PictureView& view, const PointerEvent& event);
  ~Turn() override;
  void move(const PointerEvent& event) override;
  CursorShape shape() const override { return CursorShape::turn; }

 private:
  PictureView& view_;
  Vec2 last_;
};
/// Two of three linked planes about the third's normal.
class Pointer::TurnPlanes final : public Gesture {
 public:
  TurnPlanes(LinkedPlaneView& view, const PointerEvent& event);
  void move(const PointerEvent& event) override;
  CursorShape shape() const override { return CursorShape::turn; }

 private:
  LinkedPlaneView& view_;
  double last_rad_;
};
/// The border of the slab, as another plane shows it.
class Pointer::DragSlab final : public Gesture {
 public:
  DragSlab(LinkedPlaneView& view, LinkedPlane plane) : view_(view), plane_(plane) {}
  void move(const PointerEvent& event) override { view_.drag_slab(plane_, event.px); }
  CursorShape shape() const override { return CursorShape::move; }

 private:
  LinkedPlaneView& view_;
  LinkedPlane plane_;
};
class Pointer::Browse final : public Gesture {
 public:
  Browse(PictureView& view, const PointerEvent& event);
  void move(const PointerEvent& event) override;
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  PictureView& view_;
};

// The wall and the axis.
class Pointer::Drag final : public Gesture {
 public:
  Drag(PictureView& view, const Vec3& taken);
  void move(const PointerEvent& event) override;
  void take_back() override { steps_.take_back(view_.bench()); }
  CursorShape shape() const override { return CursorShape::grab; }

 private:
  PictureView& view_;
  lumen::WallDrag edit_;
  bool moved_ = false;
  OwnSteps steps_;
};
class Pointer::Stroke final : public Gesture {
 public:
  Stroke(PictureView& view, const PointerEvent& event);
  void move(const PointerEvent& event) override;
  void release(const PointerEvent& event) override;
  void cancel() override;
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  void add(const Vec2& px);
  void show() const;
  PictureView& view_;
  std::vector<Vec2> px_;
  std::vector<Vec3> points_;
};
class Pointer::Brush final : public Gesture {
 public:
  Brush(PictureView& view, const PointerEvent& event);
  void move(const PointerEvent& event) override;
  void cancel() override;
  void take_back() override { steps_.take_back(view_.bench()); }
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  void push(const PointerEvent& event);
  PictureView& view_;
  lumen::WallPush edit_;
  OwnSteps steps_;
};
class Pointer::MoveAxis final : public Gesture {
 public:
  MoveAxis(PictureView& view, const PointerEvent& event, std::int32_t vessel, const Vec3& from);
  void move(const PointerEvent& event) override;
  void release(const PointerEvent& event) override;
  void cancel() override;
  void take_back() override { steps_.take_back(view_.bench()); }
  CursorShape shape() const override { return CursorShape::grab; }

 private:
  PictureView& view_;
  lumen::AxisMove edit_;
  Vec2 start_;
  bool live_;  // false in a CPR, whose axis is what it is laid out by: it follows on release
  bool moved_ = false;
  OwnSteps steps_;
};

// Measurements.
/// Two places on a view (distance, diameter).
class Pointer::TwoPoints final : public Gesture {
 public:
  TwoPoints(PictureView& view, const PointerEvent& event, analysis::MeasureKind kind);
  void move(const PointerEvent& event) override;
  void release(const PointerEvent& event) override;
  void cancel() override;
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  PictureView& view_;
  analysis::MeasureKind kind_;
  Vec2 start_, end_;
};
/// A line drawn around an area.
class Pointer::Outline final : public Gesture {
 public:
  Outline(PictureView& view, const PointerEvent& event);
  void move(const PointerEvent& event) override;
  void release(const PointerEvent& event) override;
  void cancel() override;
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  PictureView& view_;
  std::vector<Vec2> px_;
};
/// Two abscissas of the selected vessel on a CPR (stenosis, volume).
class Pointer::Stretch final : public Gesture {
 public:
  Stretch(CurvedView& view, const PointerEvent& event, analysis::MeasureKind kind);
  void move(const PointerEvent& event) override;
  void release(const PointerEvent& event) override;
  void cancel() override;
  CursorShape shape() const override { return CursorShape::cross; }

 private:
  CurvedView& view_;
  analysis::MeasureKind kind_;
  double from_mm_, to_mm_;
};
class Pointer::MoveHandle final : public Gesture {
 public:
  MoveHandle(PictureView& view, const PointerEvent& event, const HandleHit& hit);
  void move(const PointerEvent& event) override;
  void take_back() override { held_.take_back(); }
  CursorShape shape() const override { return CursorShape::grab; }

 private:
  PictureView& view_;
  Vec2 start_;
  HeldMeasurement held_;
  std::size_t point_;
  bool moved_ = false;
};
/// An end of a stretch on a CPR.
class Pointer::MoveEnd final : public Gesture {
 public:
  MoveEnd(CurvedView& view, const PointerEvent& event, const HandleHit& hit);
  void move(const PointerEvent& event) override;
  void cancel() override;
  void take_back() override { held_.take_back(); }
  CursorShape shape() const override { return CursorShape::grab; }

 private:
  CurvedView& view_;
  Vec2 start_;
  HeldEnd held_;
  double grip_px_;  // from the hand to the end
  bool moved_ = false;
};

}  // namespace ostia::view
