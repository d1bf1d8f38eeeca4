#pragma once
/// \file What the mouse does on the lumen profile. No toolkit.

#include "ostia/view/pointer.h"
#include "ostia/view/profile_view.h"

#include <memory>
#include <vector>

namespace ostia::view {

/// The hand on the lumen profile: it takes measurements along the vessel by their ends, as on the CPRs; a
/// drag is one step of undo. Everywhere else the cursor goes where it is. Throws as Workbench::annotate does.
class ProfilePointer {
 public:
  explicit ProfilePointer(ProfileView& view);  ///< which has to outlive it
  ~ProfilePointer();
  ProfilePointer(const ProfilePointer&) = delete;
  ProfilePointer& operator=(const ProfilePointer&) = delete;

  void press(const PointerEvent& event);
  void move(const PointerEvent& event);  ///< with or without a button
  void release(const PointerEvent& event);
  bool erase(const PointerEvent& event);  ///< Delete over an end; false where there is none
  /// Escape: what is in the hand is dropped, and a measurement goes back to where it was; redo brings the
  /// drag again. Throws as Workbench::undo does.
  void cancel();
  void let_go();  ///< the button went up unseen: what is in the hand stays where it is
  bool holding() const { return held_ != nullptr || walking_; }
  CursorShape shape() const { return shape_; }

 private:
  class Held;
  void go_to(const Vec2& px);
  void hover(const Vec2& px);
  std::optional<HandleHit> handle_near(const Vec2& px) const;
  ProfileView& view_;
  std::shared_ptr<Held> held_;  // shared with the call that moves it: what it does may drop it
  bool walking_ = false;        ///< the cursor is in the hand
  CursorShape shape_ = CursorShape::arrow;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
