#include "ostia/glview/carm_camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ostia::glview {
namespace {

constexpr double room = 1.08;  // around what is looked at

/// The bounds of depths within which a scene is drawn; generous, since vessels are not far from the
/// isocentre.
struct Depths {
  double nearest, farthest;
};
Depths depths(double distance) {
  return {0.05 * distance, 6.0 * distance};
}

}  // namespace

Vec3 Camera::towards() const {
  return geometry::towards_receptor(angles);
}

Vec3 Camera::up() const {
  return geometry::receptor_up(angles);
}

Vec3 Camera::right() const {
  return up().cross(towards());
}

Vec3 Camera::centre_of_projection() const {
  return projection == Projection::lit ? Vec3(isocentre + eye_mm * towards())
                                       : Vec3(isocentre - source_mm * towards());
}

Eigen::Matrix4f Camera::clip_of_world(double aspect) const {
  const bool lit = projection == Projection::lit;
  const double distance = lit ? eye_mm : source_mm;
  const Vec3 centre = centre_of_projection(), backwards = lit ? towards() : Vec3(-towards());
  Eigen::Matrix4d camera_of_world = Eigen::Matrix4d::Identity();
  camera_of_world.block<1, 3>(0, 0) = right().transpose();
  camera_of_world.block<1, 3>(1, 0) = up().transpose();
  camera_of_world.block<1, 3>(2, 0) = backwards.transpose();
  camera_of_world.block<3, 1>(0, 3) = -(camera_of_world.block<3, 3>(0, 0) * centre);
  const auto [nearest, farthest] = depths(distance);
  Eigen::Matrix4d clip_of_camera = Eigen::Matrix4d::Zero();
  clip_of_camera(0, 0) = distance / (half_height_mm * aspect);
  clip_of_camera(1, 1) = distance / half_height_mm;
  clip_of_camera(2, 2) = -(farthest + nearest) / (farthest - nearest);
  clip_of_camera(2, 3) = -2.0 * farthest * nearest / (farthest - nearest);
  clip_of_camera(3, 2) = -1.0;
  return (clip_of_camera * camera_of_world).cast<float>();
}

Vec2 Camera::project(const Vec3& point, double width_px, double height_px) const {
  const Vec3 from = point - centre_of_projection();
  const double depth = from.dot(isocentre - centre_of_projection());
  const double distance = projection == Projection::lit ? eye_mm : source_mm;
  const double px_a_mm = height_px / (2.0 * half_height_mm) * distance * distance / depth;
  return {width_px / 2.0 + px_a_mm * from.dot(right()), height_px / 2.0 - px_a_mm * from.dot(up())};
}

Camera camera_on(const std::vector<Vec3>& points, const CarmAngles& angles, double aspect) {
  Camera camera;
  camera.angles = angles;
  geometry::Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (box.isEmpty()) return camera;
  camera.isocentre = box.center();
  camera.eye_mm = std::max(camera.eye_mm, 3.0 * box.diagonal().norm());
  // What is nearer to the eye, or to the source, is larger.
  const double distance = std::min(camera.eye_mm, camera.source_mm);
  const Vec3 up = camera.up(), right = camera.right(), towards = camera.towards();
  double half = 1.0;
  for (const Vec3& p : points) {
    const Vec3 from = p - camera.isocentre;
    const double larger = distance / std::max(0.1 * distance, distance - std::abs(from.dot(towards)));
    half = std::max({half, larger * std::abs(from.dot(up)), larger * std::abs(from.dot(right)) / aspect});
  }
  camera.half_height_mm = half * room;
  return camera;
}

Camera turned(const Camera& camera, double right_px, double up_px, double height_px) {
  Camera result = camera;
  const double degrees_a_px = 180.0 / height_px;
  result.angles.lao_deg = std::remainder(camera.angles.lao_deg - right_px * degrees_a_px, 360.0);
  result.angles.cranial_deg = std::clamp(camera.angles.cranial_deg - up_px * degrees_a_px, -90.0, 90.0);
  return result;
}

Camera shifted(const Camera& camera, double right_px, double up_px, double height_px) {
  Camera result = camera;
  const double mm_a_px = 2.0 * camera.half_height_mm / height_px;
  result.isocentre -= mm_a_px * (right_px * camera.right() + up_px * camera.up());
  return result;
}

Camera enlarged(const Camera& camera, double factor) {
  Camera result = camera;
  result.half_height_mm = std::clamp(camera.half_height_mm / factor, 1.0, 1000.0);
  return result;
}

}  // namespace ostia::glview
