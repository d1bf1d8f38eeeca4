#pragma once
/// \file The coronary tree in three dimensions.

#include "ostia/figure/color.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/view/scene_camera.h"
#include "ostia/view/scene_guest.h"
#include "ostia/view/scene_marks.h"
#include "ostia/view/value_scale.h"
#include "ostia/view/volume_scene.h"
#include "ostia/view/wall_owner.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

class vtkRenderWindow;

namespace ostia::view {

struct VesselStyle {
  bool visible = true;
  figure::Color color;
  bool operator==(const VesselStyle&) const = default;
};

/// A part of a vessel's own wall that is coloured otherwise.
struct ColoredStretch {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
  figure::Color color;
  bool operator==(const ColoredStretch&) const = default;
};

/// What lies under a place of the picture.
struct ScenePick {
  Vec3 point = Vec3::Zero();                ///< on the wall, or on the measurement where no wall is hit
  std::optional<std::int32_t> vessel;       ///< whose wall it is; nothing where no wall is hit
  double s_mm = 0.0;                        ///< the foot of `point` on the vessel's axis
  std::optional<std::int32_t> measurement;  ///< one that passes within 6 pixels (times the pixel ratio)
};

/// The tree's wall, a cursor, measurements, pictures in space and the CT behind them, in a window of
/// the owner's (one without multisampling: only there a cursor moves without the wall being drawn anew).
/// World coordinates are LPS, mm; display coordinates are device pixels of that window from its lower left
/// corner. Rays are parallel, so that the scale bar holds everywhere. Nothing renders by itself: call the
/// window's Render() after changes. One thread.
class TreeScene {
 public:
  TreeScene();
  ~TreeScene();
  TreeScene(const TreeScene&) = delete;
  TreeScene& operator=(const TreeScene&) = delete;

  /// Into a window, as its only contents; two layers of it are used.
  void attach(vtkRenderWindow& window);
  void detach();  ///< before the window goes
  /// False: only the wall and the CT are drawn from the next picture on, without what moves before them. The
  /// first picture of much that is new costs most, as shaders are compiled for it; so it can be had in two.
  void show_front(bool shown);
  bool front_shown() const;
  /// The last Render() put back the picture of wall and CT that was there, as only marks had changed.
  bool kept_picture() const;

  // The wall ------------------------------------------------------------------------------------------------

  /// The wall of a model (LiveModel::wall) and its axes. Each point gets its vessel's colour; values given
  /// for a former wall go where the number of points differs. Throws InvalidInput for no wall, a triangle of
  /// points that are not there, points that are not finite, or a model without vessels.
  void set_wall(std::shared_ptr<const geometry::TriMesh> wall, const lumen::LumenModel& model);
  void clear_wall();
  /// The wall and its axes at another phase of the heart: its points only, as many as there were, and all of
  /// them drawn; set_wall brings the wall back. Throws InvalidInput for another number of points or axes.
  void move_wall(std::shared_ptr<const geometry::TriMesh> moved,
                 const std::vector<std::shared_ptr<const geometry::AxisCurve>>& axes);
  /// Of each point of the wall, whose it is.
  std::span<const WallPlace> wall_places() const;
  /// Colours the wall by a value a point (a diameter, a distance from the truth, in mm; NaN is grey), with a
  /// bar beside the picture. Throws InvalidInput where there are not as many values as points.
  void set_wall_values(std::vector<double> values, const ValueScale& scale);
  void clear_wall_values();  ///< back to the vessels' colours
  /// Mixed into the vessels' colours until others are given; vessels that are not there do not matter.
  void set_colored_stretches(std::vector<ColoredStretch> stretches);
  /// A wall of another time over this one, half transparent and of one colour; null takes it away. It is
  /// neither picked nor framed, and not shown with a guest. Throws InvalidInput as set_wall does.
  void set_other_wall(std::shared_ptr<const geometry::TriMesh> wall);
  /// Something else in the wall's place, with a bar of its own; null: the wall again. A wall that is not
  /// shown is not picked.
  void set_guest(std::shared_ptr<SceneGuest> guest);

  // Vessels keep their style when the wall changes. A vessel that is new gets the colour of its name
  // (vessel_colors.h).
  VesselStyle vessel_style(std::int32_t vessel) const;                   ///< throws InvalidInput
  void set_vessel_style(std::int32_t vessel, const VesselStyle& style);  ///< throws InvalidInput
  /// One vessel in full colour and the others dimmed, or all alike.
  void select_vessel(std::optional<std::int32_t> vessel);
  void set_opacity(double opacity);  ///< of the wall, [0.05, 1]; throws InvalidInput
  /// Not shown: the arteries are those of the CT behind it; the wall is not picked then, but still framed.
  void set_wall_shown(bool shown);
  void set_axes_shown(bool shown);  ///< thin lines over the wall

  // Marks ---------------------------------------------------------------------------------------------------

  void set_cursor(const std::optional<SceneCursor>& cursor);  ///< throws InvalidInput
  /// A picture on its plane, cut by the wall; nothing takes it away. Throws InvalidInput.
  void set_plane(ScenePlane which, std::optional<ScenePlanePicture> picture);
  void set_measurements(std::vector<SceneMeasurement> measurements);  ///< throws InvalidInput
  /// One that is being placed: shown as chosen, never picked. Throws InvalidInput.
  void set_draft(std::optional<SceneMeasurement> draft);

  // The CT --------------------------------------------------------------------------------------------------

  /// As `reduced_volume` makes it; null takes it away. Throws as VolumeScene::set_image does.
  void set_volume(std::shared_ptr<const imaging::ImageVolume> image);
  void set_volume_mode(VolumeMode mode);
  void set_volume_window(double level_hu, double width_hu);  ///< of the MIP
  void set_volume_look(const VolumeLook& look);              ///< of the rendering; throws InvalidInput
  /// As VolumeScene::set_ambient_light; for machines that do not draw in software.
  void set_volume_light(std::shared_ptr<const std::vector<float>> light);
  /// Pictures are drawn by the processor (llvmpipe and the like) and not by a graphics card; known once one
  /// has been drawn, until then true.
  bool draws_in_software() const;
  void set_volume_crop(const VolumeCrop& crop);  ///< throws InvalidInput
  /// While the camera moves the volume is drawn coarsely, or not at all where a coarse picture takes longer
  /// than 80 ms. Each picture is timed.
  void set_interacting(bool interacting);
  /// Prepares a finer picture of the volume where one is to be had within `patience_ms`, going by the time of
  /// the last: call it when the window has been idle for a moment, and render as long as it returns true. A
  /// new volume is drawn coarsely first. Throws InvalidInput for a patience that is not positive.
  bool refine(double patience_ms = 120.0);
  /// Draws the wall whole again, after a place was edited whose surroundings were drawn apart from the rest:
  /// then each picture takes less. Call it when the hand has let go; true where there is something to render.
  bool settle();

  // The camera ----------------------------------------------------------------------------------------------

  CameraPose pose() const;
  void set_pose(const CameraPose& pose);  ///< throws InvalidInput
  // Poses that show all visible vessels (or the CT, where there is no wall); `blended` leads there smoothly.
  CameraPose pose_from_side(ViewFrom from) const;
  CameraPose pose_from_carm(const CarmAngles& angles) const;
  CameraPose pose_fitted() const;                        ///< the direction stays
  CameraPose pose_of_vessel(std::int32_t vessel) const;  ///< broadside; throws InvalidInput
  // By a drag of the mouse, in pixels to the right and up.
  void rotate_by(double right_px, double up_px);
  void pan_by(double right_px, double up_px);
  /// Above 1: larger. What is at `display`, or in the middle, stays where it is.
  void zoom_by(double factor, const std::optional<geometry::Vec2>& display = {});

  // Places --------------------------------------------------------------------------------------------------

  /// What the eye meets first on the visible wall, whatever else is shown; nothing on the background. Does
  /// not render. Throws InvalidInput where the scene is in no window.
  std::optional<ScenePick> pick(const geometry::Vec2& display) const;
  geometry::Vec2 project(const Vec3& world) const;  ///< display coordinates; throws InvalidInput as above
  /// A closed line over the picture, display coordinates, as a cut through the volume. Throws InvalidInput
  /// for fewer than three corners, and as above.
  VolumeCut cut_along(const std::vector<geometry::Vec2>& corners, bool keep_inside) const;
  SceneRay ray(
      const geometry::Vec2& display) const;  ///< from before all there is; throws InvalidInput as above

  // Looks ---------------------------------------------------------------------------------------------------

  void set_look(figure::Look look);
  void set_pixel_ratio(double ratio);  ///< device pixels per unit of lines and texts, [0.5, 8]
  double pixel_ratio() const;
  void set_marker_shown(bool shown);  ///< the cube with the patient's directions
  void set_scale_bar_shown(bool shown);
  /// A small picture at the lower left, above the cube, of the window's own, in which `text` is written; no
  /// snapshot has it. An empty picture takes it away.
  void set_corner(const figure::Raster& picture, std::string text);
  /// All texts over the picture, as they were laid out for the last one in this window.
  std::vector<SceneText> texts() const;
  void set_angles_shown(bool shown);  ///< "LAO 30 CRA 20" in a corner; not at first
  /// A line that is being drawn over the picture, display coordinates, closed; none: nothing.
  void set_lasso(std::vector<geometry::Vec2> corners);
  /// A frame with places to take hold of, over all else; no snapshot has it. An empty one takes it away.
  void set_frame(SceneFrame frame);

  /// The scene as it is, in another size and perhaps another look, from a window of its own that is never
  /// shown; a volume as fine as `patience_ms` a picture allows. Throws InvalidInput for sizes not in [16,
  /// 8192] and ResourceError where no OpenGL 3.2 context can be made.
  figure::Raster snapshot(int width_px, int height_px, std::optional<figure::Look> look = {},
                          double patience_ms = 1000.0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::view
