#pragma once
/// \file What a TreeScene holds.

#include "scene/mark_actors.h"
#include "scene/scene_overlay.h"
#include "scene/still_renderer.h"
#include "scene/wall_actor.h"
#include "scene/wall_change.h"

#include "ostia/view/tree_scene.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWeakPointer.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::view {

// What both the scene's window and a snapshot need.
CameraPose pose_of(vtkRenderer& renderer);
void apply_pose(vtkRenderer& renderer, const CameraPose& pose);
void add_lights(vtkRenderer& renderer);
void apply_look(vtkRenderer& renderer, figure::Look look);

struct TreeScene::Impl {
  Impl();
  ~Impl();

  vtkNew<StillRenderer> renderer;  // wall and CT
  vtkNew<vtkRenderer> front;       // what moves, with the same camera, over the other's picture and depths
  vtkNew<vtkCallbackCommand> before, after;
  WallActor wall_actor;    // all of the wall but what is in `moving_box`
  WallActor moving_actor;  // the rest: about a place that is being edited
  WallActor other_actor;   // a wall of another time
  geometry::Box3 moving_box;
  VolumeScene volume;
  MarkActors mark_actors{*front};
  SceneOverlay overlay{*front};
  std::shared_ptr<SceneGuest> guest;  // in place of the wall

  std::shared_ptr<const geometry::TriMesh> wall;
  std::vector<std::shared_ptr<const lumen::VesselLumen>> vessels;
  std::unique_ptr<const WallOwner> owner;
  std::vector<WallPlace> places;
  bool moved = false;  // the wall is at another phase than its owner and its places' abscissas
  std::vector<std::size_t> place_vessel;  // index in `vessels`, one a point
  std::vector<double> values;
  std::vector<ColoredStretch> stretches;
  ValueScale scale;
  double opacity = 1.0;
  bool wall_shown = true;
  std::map<std::int32_t, VesselStyle> styles;
  std::vector<const VesselStyle*> vessel_styles;  // of `styles`, as `vessels` are ordered
  std::optional<std::int32_t> selected;

  Marks marks;
  OverlaySettings settings;

  bool interacting = false;
  bool coarse_is_slow = false;
  int volume_pictures = 0;  // since it was changed: the first takes longer, as shaders are made for it
  VolumeQuality still_quality = VolumeQuality::coarse;  // while the camera rests
  std::optional<double> volume_ms;                      // of the last picture, at the quality it had
  std::chrono::steady_clock::time_point started;
  vtkWeakPointer<vtkRenderWindow> window;

  void follow_model(const lumen::LumenModel& model);
  void make_axes();
  void take_places(const lumen::LumenModel& model, const std::shared_ptr<const geometry::TriMesh>& former,
                   const std::optional<WallChange>& change);
  void show_wall();  // all of it anew
  bool show_moved(const geometry::TriMesh& former, const WallChange& change);
  bool moves_apart() const;  // the part that is being edited may be drawn apart
  void show_moving();
  void join_moving();  // where it may no longer be drawn apart
  void color_wall();
  figure::Color color_at(std::size_t point) const;
  bool shown(std::size_t triangle) const;
  bool visible(std::int32_t point) const;
  const lumen::VesselLumen& vessel(std::int32_t id) const;
  std::vector<Vec3> shown_points() const;
  double aspect() const;
  geometry::Vec2 size_px() const;          // throws InvalidInput without a window
  OverlaySettings shown_settings() const;  // with the guest's bar
  void before_render();
  void set_depths(const CameraPose& pose);
  void after_render();
  void apply_quality();
  void start_coarse();
  std::optional<std::pair<std::size_t, double>> first_hit(const Vec3& origin, const Vec3& direction) const;
  std::optional<ScenePick> wall_pick(const Vec3& origin, const Vec3& direction) const;
  void add_measurement_pick(const geometry::Vec2& display, std::optional<ScenePick>& pick) const;
  geometry::Vec2 project(const Vec3& world) const;
};

}  // namespace ostia::view
