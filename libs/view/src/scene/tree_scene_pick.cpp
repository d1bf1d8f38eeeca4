// The scene's camera, and places between the picture and the world.
#include "scene/tree_scene_impl.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::view {
namespace {

using geometry::Vec2;

/// The nearest place of a piece to `at`, in the picture: its share of the way and the distance.
std::pair<double, double> nearest_on_piece(const Vec2& a, const Vec2& b, const Vec2& at) {
  const Vec2 along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((at - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return {t, (a + t * along - at).norm()};
}

/// How far out a ray meets a triangle, its border included; infinite where it does not (Moeller and Trumbore
/// 1997).
double ray_triangle(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double never = std::numeric_limits<double>::infinity();
  constexpr double border = 1e-9;
  const Vec3 ab = b - a, ac = c - a, across = direction.cross(ac);
  const double volume = ab.dot(across);
  if (volume == 0.0) return never;
  const Vec3 from_a = origin - a;
  const double u = from_a.dot(across) / volume;
  if (u < -border || u > 1.0 + border) return never;
  const Vec3 turned = from_a.cross(ab);
  const double v = direction.dot(turned) / volume;
  if (v < -border || u + v > 1.0 + border) return never;
  const double distance = ac.dot(turned) / volume;
  return distance >= 0.0 ? distance : never;
}

}  // namespace

geometry::Vec2 TreeScene::Impl::size_px() const {
  if (renderer->GetVTKWindow() == nullptr)
    throw InvalidInput("the 3D scene is in no window yet, so it has no picture coordinates");
  const int* size = const_cast<StillRenderer*>(renderer.Get())->GetSize();
  if (size[0] < 1 || size[1] < 1)
    throw InvalidInput("the 3D scene's window has no size yet, so it has no picture coordinates");
  return {size[0], size[1]};
}

double TreeScene::Impl::aspect() const {
  if (renderer->GetVTKWindow() == nullptr) return 1.0;
  const int* size = const_cast<StillRenderer*>(renderer.Get())->GetSize();
  return size[1] > 0 ? std::max(static_cast<double>(size[0]) / size[1], 0.05) : 1.0;
}

std::vector<Vec3> TreeScene::Impl::shown_points() const {
  std::vector<Vec3> points;
  if (guest) return guest->outline();
  if (wall)
    for (const geometry::Triangle& t : wall->triangles)
      if (visible(t[0])) points.push_back(wall->points[static_cast<std::size_t>(t[0])]);
  if (points.empty())
    for (const auto& each : vessels)
      for (const Vec3& point : each->axis->sampled(2.0).points) points.push_back(point);
  if (points.empty() && volume.has_image()) points = volume.corners();
  if (points.empty()) points = {Vec3::Constant(-30.0), Vec3::Constant(30.0)};
  return points;
}

CameraPose TreeScene::pose() const {
  return pose_of(*impl_->renderer);
}

void TreeScene::set_pose(const CameraPose& pose) {
  validate(pose);
  apply_pose(*impl_->renderer, pose);
}

CameraPose TreeScene::pose_from_side(ViewFrom from) const {
  return fitted(pose_from(from, Vec3::Zero(), 1.0), impl_->shown_points(), impl_->aspect());
}

CameraPose TreeScene::pose_from_carm(const CarmAngles& angles) const {
  return fitted(pose_of_carm(angles, Vec3::Zero(), 1.0), impl_->shown_points(), impl_->aspect());
}

CameraPose TreeScene::pose_fitted() const {
  return fitted(pose(), impl_->shown_points(), impl_->aspect());
}

CameraPose TreeScene::pose_of_vessel(std::int32_t vessel) const {
  const lumen::VesselLumen& shown = impl_->vessel(vessel);
  const std::vector<Vec3> curve = shown.axis->sampled(0.5).points;
  return pose_broadside(curve, impl_->aspect());
}

void TreeScene::rotate_by(double right_px, double up_px) {
  set_pose(rotated(pose(), right_px, up_px, static_cast<int>(impl_->size_px().y())));
}

void TreeScene::pan_by(double right_px, double up_px) {
  set_pose(panned(pose(), right_px, up_px, static_cast<int>(impl_->size_px().y())));
}

void TreeScene::zoom_by(double factor, const std::optional<Vec2>& display) {
  const CameraPose before = pose();
  Vec3 fixed = before.target;
  if (display) {
    const Vec2 size = impl_->size_px();
    const Vec2 off = (*display - 0.5 * size) * (2.0 * before.half_height_mm / size.y());
    fixed += off.x() * before.right() + off.y() * before.up;
  }
  set_pose(zoomed(before, factor, fixed));
}

Vec2 TreeScene::Impl::project(const Vec3& world) const {
  const Vec2 size = size_px();
  const CameraPose pose = pose_of(*const_cast<StillRenderer*>(renderer.Get()));
  const double px_per_mm = 0.5 * size.y() / pose.half_height_mm;
  const Vec3 off = world - pose.target;
  return 0.5 * size + px_per_mm * Vec2(off.dot(pose.right()), off.dot(pose.up));
}

Vec2 TreeScene::project(const Vec3& world) const {
  return impl_->project(world);
}

/// The nearest visible triangle that the ray meets, and how far out. All are asked: that takes less than a
/// search tree would for one ray, and the wall changes often.
std::optional<std::pair<std::size_t, double>> TreeScene::Impl::first_hit(const Vec3& origin,
                                                                         const Vec3& direction) const {
  constexpr std::size_t grain = 8192;
  using Hit = std::pair<double, std::size_t>;
  const Hit none{std::numeric_limits<double>::infinity(), 0};
  const auto of_chunk = [&](std::size_t first, std::size_t last) {
    Hit nearest = none;
    for (std::size_t i = first; i < last; ++i) {
      const geometry::Triangle& t = wall->triangles[i];
      const auto corner = [&](std::size_t c) -> const Vec3& {
        return wall->points[static_cast<std::size_t>(t[c])];
      };
      const double distance = ray_triangle(origin, direction, corner(0), corner(1), corner(2));
      if (distance < nearest.first && visible(t[0])) nearest = {distance, i};
    }
    return nearest;
  };
  const Hit hit = core::parallel_reduce(wall->triangles.size(), grain, none, of_chunk,
                                        [](const Hit& a, const Hit& b) { return std::min(a, b); });
  if (!std::isfinite(hit.first)) return {};
  return std::pair(hit.second, hit.first);
}

std::optional<ScenePick> TreeScene::Impl::wall_pick(const Vec3& origin, const Vec3& direction) const {
  constexpr double window_mm = 3.0;
  if (!wall || guest || !wall_shown) return {};
  const auto hit = first_hit(origin, direction);
  if (!hit) return {};
  const Vec3 point = origin + hit->second * direction;
  // A triangle is drawn or not by its first corner; so is it told whose it is where it lies between two.
  WallPlace place =
      moved ? places[static_cast<std::size_t>(wall->triangles[hit->first][0])] : owner->at(point);
  if (!styles.at(place.vessel).visible)
    place = places[static_cast<std::size_t>(wall->triangles[hit->first][0])];
  const geometry::AxisCurve& axis = *vessel(place.vessel).axis;
  const auto foot =
      moved ? std::optional<geometry::AxisFoot>() : axis.foot_near(point, place.s_mm, window_mm);
  return ScenePick{point, place.vessel, foot ? foot->s_mm : axis.nearest_foot(point).s_mm, {}};
}

void TreeScene::Impl::add_measurement_pick(const Vec2& display, std::optional<ScenePick>& pick) const {
  double nearest = 6.0 * settings.pixel_ratio;
  const auto offer = [&](std::int32_t id, const Vec3& a, const Vec3& b) {
    const auto [t, away] = nearest_on_piece(project(a), project(b), display);
    if (away > nearest) return;
    nearest = away;
    if (!pick) pick.emplace();
    pick->measurement = id;
    if (!pick->vessel) pick->point = a + t * (b - a);
  };
  for (const SceneMeasurement& measurement : marks.measurements) {
    for (const SceneCurve& curve : curves_of(measurement)) {
      const std::size_t count = curve.points.size();
      for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < count; ++i)
        offer(measurement.id, curve.points[i], curve.points[(i + 1) % count]);
    }
    for (const Vec3& point : measurement.points) offer(measurement.id, point, point);
  }
}

SceneRay TreeScene::ray(const Vec2& display) const {
  const Vec2 size = impl_->size_px();
  const CameraPose from = pose();
  const Vec2 off = (display - 0.5 * size) * (2.0 * from.half_height_mm / size.y());
  constexpr double far_mm = 1e4;
  return {from.target + off.x() * from.right() + off.y() * from.up + far_mm * from.towards, -from.towards};
}

VolumeCut TreeScene::cut_along(const std::vector<Vec2>& corners, bool keep_inside) const {
  const Vec2 size = impl_->size_px();
  const CameraPose from = pose();
  const Vec2 middle(from.target.dot(from.right()), from.target.dot(from.up));
  VolumeCut cut{from.right(), from.up, {}, keep_inside};
  for (const Vec2& corner : corners)
    cut.outline_mm.emplace_back(middle + (corner - 0.5 * size) * (2.0 * from.half_height_mm / size.y()));
  validate(cut);
  return cut;
}

std::optional<ScenePick> TreeScene::pick(const Vec2& display) const {
  const SceneRay from = ray(display);
  std::optional<ScenePick> found = impl_->wall_pick(from.origin, from.direction);
  impl_->add_measurement_pick(display, found);
  return found;
}

}  // namespace ostia::view
