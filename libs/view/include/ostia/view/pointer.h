#pragma once
/// \file What the mouse does in a 2D view: from presses and moves to commands on the workbench. No toolkit,
/// so that a test or a replay drives a view as a hand does.

#include "ostia/view/picture_view.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::view {

enum class Button { none, left, middle, right };
struct PointerEvent {
  Vec2 px = Vec2::Zero();  ///< device pixels in the view
  Button button = Button::none;
  bool shift = false, control = false, alt = false;
  /// Of a press that is done again: where the wall was taken hold of, if it was. Lines on a view differ in
  /// their last bits by what was drawn before, and with them what is found.
  bool again = false;
  std::optional<Vec3> taken{};
};

/// A call of one of Pointer's functions.
struct HandAct {
  enum class Kind { press, move, release, double_click, wheel, leave, cancel, erase } kind = Kind::move;
  PointerEvent event;  ///< nothing in it for leave and cancel
  double steps = 0.0;  ///< of the wheel
};

enum class CursorShape { arrow, cross, grab, turn, move, contrast };

/// The hand in one view. While the mouse moves, edits are in the case and on the screen with each call; a
/// drag is one step of undo. Commands that are refused throw as Workbench::edit does; the gesture then goes
/// on from the last good state.
class Pointer {
 public:
  explicit Pointer(PictureView& view);
  ~Pointer();
  Pointer(const Pointer&) = delete;
  Pointer& operator=(const Pointer&) = delete;

  void press(const PointerEvent& event);
  void move(const PointerEvent& event);  ///< with or without a button
  void release(const PointerEvent& event);
  void double_click(const PointerEvent& event);  ///< ends an area, adds a control point
  void wheel(double steps, const PointerEvent& event);
  void leave();
  /// Escape: what is begun is dropped, and what a drag has done to the case so far is taken back; redo brings
  /// it again. Throws as Workbench::undo does.
  void cancel();
  /// What is begun ends where it is: what a drag has done to the case stays.
  void drop();
  /// The button went up unseen (a dialog took the release): a release where the mouse was last.
  void let_go();
  bool erase(const PointerEvent&
                 event);  ///< Delete over a control point or a measurement; false where there is neither

  bool busy() const;                                    ///< a gesture is going on
  bool holding() const { return gesture_ != nullptr; }  ///< one that needs its button
  /// Where the wall was taken hold of by the last press, if it was.
  const std::optional<Vec3>& taken() const { return taken_; }
  CursorShape shape() const { return shape_; }

  /// What a hand did, for who writes it down or counts time: told before it is done, and `acted` after it,
  /// even where it was refused. What one call brings about in another is not told.
  session::Signal<const HandAct&> acting;
  session::Signal<> acted;

  /// "Add a vessel": the distal end that was clicked; the way back is sought elsewhere.
  session::Signal<const Vec3&> end_chosen;

 private:
  class Telling;
  class Gesture;
  class Pan;
  class Contrast;
  class Browse;
  class Turn;
  class TurnPlanes;
  class DragSlab;
  class Drag;
  class Stroke;
  class Brush;
  class MoveAxis;
  class TwoPoints;
  class Outline;
  class Stretch;
  class MoveHandle;
  class MoveEnd;
  std::unique_ptr<Gesture> gesture_of(const PointerEvent& event);
  std::unique_ptr<Gesture> gesture_of_planes(const PointerEvent& event);
  std::unique_ptr<Gesture> gesture_of_tool(const PointerEvent& event);
  bool click_of_tool(const PointerEvent& event);
  bool measuring_click(const PointerEvent& event, const Vec3& place);
  std::optional<HandleHit> handle_at(const PointerEvent& event);
  void hover(const PointerEvent& event);
  void show_clicked();
  PictureView& view_;
  std::shared_ptr<Gesture> gesture_;  // shared with the call that it is in: what it does may drop it
  PointerEvent last_;                 // of the gesture: its button, and where it was last
  std::vector<Vec3> clicked_;         ///< of a measurement made of single clicks
  CursorShape shape_ = CursorShape::arrow;
  int telling_ = 0;
  std::optional<Vec3> taken_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
