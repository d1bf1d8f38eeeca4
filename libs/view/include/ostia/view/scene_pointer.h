#pragma once
/// \file What the mouse does on the wall in the 3D view: it places and moves measurements. No toolkit, so
/// that a test drives the scene as a hand does.

#include "ostia/analysis/measurement.h"
#include "ostia/session/workbench.h"
#include "ostia/view/pointer.h"
#include "ostia/view/tree_scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::view {

/// The hand in a 3D scene. Events have display coordinates in `px`: device pixels from the window's lower
/// left corner. A click is a left button's press and release with less than 3 units of movement between. What
/// a drag does that does not start on a handle is the owner's affair: it turns the camera.
///
/// Clicks on the wall place, by the workbench's tool: a distance (two clicks; the straight line), an angle
/// (three, the vertex second), a stenosis or a volume (two places of one vessel, a branch's way through its
/// parent among them), and with one click the section's diameter or outline there, or a ring of CT numbers
/// about it. With the other tools a click chooses vessel, place and measurement. Handles of the selected
/// measurement can be dragged over the wall, with any tool; a drag is one step of undo. Clicks that place
/// nothing say why through Workbench::noted. Commands that are refused throw as Workbench::annotate does;
/// the hand then goes on from the last good state. One thread.
class ScenePointer {
 public:
  /// Both have to outlive it.
  ScenePointer(TreeScene& scene, session::Workbench& bench);
  ~ScenePointer();
  ScenePointer(const ScenePointer&) = delete;
  ScenePointer& operator=(const ScenePointer&) = delete;

  /// True where a handle was taken hold of: the drag is the hand's. Throws as TreeScene::pick does, here and
  /// below.
  bool press(const PointerEvent& event);
  void move(const PointerEvent& event);  ///< with or without a button
  void release(const PointerEvent& event);
  void leave();  ///< what follows the mouse goes; what was clicked stays
  /// Escape: what is begun is dropped, and a measurement in the hand goes back to where it was; redo brings
  /// the drag again. Throws as Workbench::undo does.
  void cancel();
  void let_go();  ///< the button went up unseen: what is in the hand stays where it is; no click comes of it
  bool erase(const PointerEvent& event);  ///< Delete: the measurement under the mouse, or the selected one

  bool busy() const;  ///< a gesture is going on
  CursorShape shape() const { return shape_; }

  session::Signal<> stale;  ///< the scene is to be rendered again

 private:
  struct Held;
  void click(const geometry::Vec2& px);
  void choose(const std::optional<ScenePick>& hit);
  void place(analysis::MeasureKind kind, const ScenePick& hit);
  void hover(const geometry::Vec2& px);
  void show_draft(const std::optional<ScenePick>& hovered);
  void show_draft(std::optional<SceneMeasurement> draft);
  void drag(const geometry::Vec2& px);
  void drop();
  std::optional<std::size_t> handle_near(const geometry::Vec2& px) const;
  TreeScene& scene_;
  session::Workbench& bench_;
  std::vector<ScenePick> clicked_;  ///< of a measurement of several clicks
  std::shared_ptr<Held> held_;      // shared with the call that moves it: what it does may drop it
  Button button_ = Button::none;
  geometry::Vec2 pressed_ = geometry::Vec2::Zero();
  bool moved_ = false, draft_shown_ = false;
  CursorShape shape_ = CursorShape::arrow;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
