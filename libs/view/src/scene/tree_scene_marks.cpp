// Marks, volume and looks of the scene.
#include "scene/tree_scene_impl.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>
#include <utility>

namespace ostia::view {
namespace {

void check(const SceneMeasurement& measurement) {
  const std::string name = "measurement " + std::to_string(measurement.id);
  if (measurement.points.empty()) throw InvalidInput(name + " has no points to be shown at");
  for (const Vec3& point : measurement.points)
    if (!point.allFinite()) throw InvalidInput(name + " has a point that is not finite");
  for (const SceneCurve& curve : measurement.curves)
    for (const Vec3& point : curve.points)
      if (!point.allFinite()) throw InvalidInput(name + " has a line through a point that is not finite");
  if (measurement.label_at && !measurement.label_at->allFinite())
    throw InvalidInput(name + " has its label at a place that is not finite");
}

}  // namespace

std::vector<SceneCurve> curves_of(const SceneMeasurement& measurement) {
  if (!measurement.curves.empty()) return measurement.curves;
  if (measurement.points.size() < 2) return {};
  return {{measurement.points, measurement.closed}};
}

void TreeScene::set_cursor(const std::optional<SceneCursor>& cursor) {
  if (cursor && (!cursor->place.allFinite() || !(cursor->radius_mm > 0.0) ||
                 !std::isfinite(cursor->radius_mm) || !std::isfinite(cursor->theta)))
    throw InvalidInput("the 3D scene's cursor has no finite place or a ring of no radius");
  impl_->marks.cursor = cursor;
  impl_->mark_actors.show_cursor(impl_->marks);
}

void TreeScene::set_plane(ScenePlane which, std::optional<ScenePlanePicture> picture) {
  if (picture) {
    reformat::validate(picture->plane);
    const auto pixels =
        static_cast<std::size_t>(picture->plane.width) * static_cast<std::size_t>(picture->plane.height);
    if (picture->gray.size() != pixels)
      throw InvalidInput("a picture of " + std::to_string(picture->plane.width) + " x " +
                         std::to_string(picture->plane.height) + " pixels came with " +
                         std::to_string(picture->gray.size()) + " bytes");
    impl_->marks.planes[which] = std::move(*picture);
  } else {
    impl_->marks.planes.erase(which);
  }
  impl_->mark_actors.show_plane(impl_->marks, which);
}

void TreeScene::set_measurements(std::vector<SceneMeasurement> measurements) {
  for (const SceneMeasurement& measurement : measurements) check(measurement);
  impl_->marks.measurements = std::move(measurements);
  impl_->mark_actors.show_measurements(impl_->marks);
}

void TreeScene::set_draft(std::optional<SceneMeasurement> draft) {
  if (draft) check(*draft);
  impl_->marks.draft = std::move(draft);
  impl_->mark_actors.show_draft(impl_->marks);
}

void TreeScene::set_volume(std::shared_ptr<const imaging::ImageVolume> image) {
  impl_->volume.set_image(std::move(image));
  impl_->start_coarse();
  impl_->join_moving();
}

void TreeScene::set_volume_mode(VolumeMode mode) {
  impl_->volume.set_mode(mode);
  impl_->start_coarse();
  impl_->join_moving();
}

void TreeScene::set_volume_window(double level_hu, double width_hu) {
  impl_->volume.set_window(level_hu, width_hu);
}

void TreeScene::set_volume_look(const VolumeLook& look) {
  if (look == impl_->volume.look()) return;
  impl_->volume.set_look(look);
  impl_->start_coarse();  // a hand on a slider does not wait for a fine picture
}

void TreeScene::set_volume_light(std::shared_ptr<const std::vector<float>> light) {
  impl_->volume.set_ambient_light(std::move(light));
  impl_->start_coarse();
}

bool TreeScene::draws_in_software() const {
  return impl_->renderer->in_software();
}

void TreeScene::set_wall_shown(bool shown) {
  impl_->wall_shown = shown;
  impl_->wall_actor.set_hidden(!shown);
  impl_->moving_actor.set_hidden(!shown);
}

void TreeScene::set_volume_crop(const VolumeCrop& crop) {
  if (crop == impl_->volume.crop()) return;
  impl_->volume.set_crop(crop);
  impl_->start_coarse();
}

void TreeScene::set_interacting(bool interacting) {
  if (impl_->interacting == interacting) return;
  impl_->interacting = interacting;
  impl_->still_quality = VolumeQuality::coarse;
  impl_->apply_quality();
}

bool TreeScene::refine(double patience_ms) {
  if (!(patience_ms > 0.0))
    throw InvalidInput("a patience of " + std::to_string(patience_ms) +
                       " ms is not possible, it has to be above 0");
  const VolumeQuality now = impl_->volume.quality();
  if (impl_->interacting || !impl_->volume_ms || now == VolumeQuality::full) return false;
  if (*impl_->volume_ms * next_level_cost(now) > patience_ms) return false;
  impl_->volume_ms.reset();  // known again when the finer picture is there
  impl_->still_quality = finer(now);
  impl_->apply_quality();
  return true;
}

void TreeScene::set_look(figure::Look look) {
  impl_->settings.look = look;
  impl_->marks.look = look;
  apply_look(*impl_->renderer, look);
  impl_->color_wall();
  impl_->make_axes();
  impl_->mark_actors.show_all(impl_->marks);
}

void TreeScene::set_pixel_ratio(double ratio) {
  if (!(ratio >= 0.5 && ratio <= 8.0))
    throw InvalidInput("a pixel ratio of " + std::to_string(ratio) +
                       " cannot be shown, it has to be between 0.5 and 8");
  impl_->settings.pixel_ratio = ratio;
  impl_->marks.pixel_ratio = ratio;
  impl_->mark_actors.show_all(impl_->marks);
}

double TreeScene::pixel_ratio() const {
  return impl_->settings.pixel_ratio;
}

void TreeScene::set_marker_shown(bool shown) {
  impl_->settings.marker_shown = shown;
}

void TreeScene::set_corner(const figure::Raster& picture, std::string text) {
  impl_->overlay.corner().show(picture, std::move(text));
}

std::vector<SceneText> TreeScene::texts() const {
  std::vector<SceneText> all = impl_->overlay.texts();
  const std::vector<SceneText>& labels = impl_->mark_actors.texts();
  all.insert(all.end(), labels.begin(), labels.end());
  return all;
}

void TreeScene::set_scale_bar_shown(bool shown) {
  impl_->settings.scale_bar_shown = shown;
}

void TreeScene::set_angles_shown(bool shown) {
  impl_->settings.angles_shown = shown;
}

void TreeScene::set_frame(SceneFrame frame) {
  impl_->settings.frame = std::move(frame);
}

void TreeScene::set_lasso(std::vector<geometry::Vec2> corners) {
  impl_->settings.lasso = std::move(corners);
}

}  // namespace ostia::view
