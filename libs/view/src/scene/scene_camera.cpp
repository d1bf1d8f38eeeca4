#include "ostia/view/scene_camera.h"

#include "ostia/core/error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::view {
namespace {

using geometry::Mat3;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double least_half_height_mm = 1e-3, most_half_height_mm = 1e5;

/// A pose that looks from a direction with something roughly up.
CameraPose looking(const Vec3& target, const Vec3& towards, const Vec3& up_about, double half_height_mm) {
  CameraPose pose;
  pose.target = target;
  pose.towards = towards.normalized();
  Vec3 across = up_about - up_about.dot(pose.towards) * pose.towards;
  if (across.norm() < 1e-6) across = pose.towards.unitOrthogonal();
  pose.up = across.normalized();
  pose.half_height_mm = std::clamp(half_height_mm, least_half_height_mm, most_half_height_mm);
  return pose;
}

Mat3 axes(const CameraPose& pose) {
  Mat3 result;
  result << pose.right(), pose.up, pose.towards;
  return result;
}

void set_axes(CameraPose& pose, const Mat3& rotation) {
  pose.towards = rotation.col(2).normalized();
  pose.up = (rotation.col(1) - rotation.col(1).dot(pose.towards) * pose.towards).normalized();
}

double mm_per_px(const CameraPose& pose, int height_px) {
  if (height_px < 1)
    throw InvalidInput("a picture of " + std::to_string(height_px) + " pixels has no height");
  return 2.0 * pose.half_height_mm / height_px;
}

}  // namespace

void validate(const CameraPose& pose) {
  if (!pose.target.allFinite() || !pose.towards.allFinite() || !pose.up.allFinite())
    throw InvalidInput("the camera's target or direction is not finite");
  if (std::abs(pose.towards.norm() - 1.0) > 1e-6 || std::abs(pose.up.norm() - 1.0) > 1e-6 ||
      std::abs(pose.towards.dot(pose.up)) > 1e-6)
    throw InvalidInput("the camera's directions have to be unit vectors, normal to each other");
  if (!(pose.half_height_mm >= least_half_height_mm && pose.half_height_mm <= most_half_height_mm))
    throw InvalidInput("the camera's half height is " + std::to_string(pose.half_height_mm) +
                       " mm, it has to be between 0.001 and 100000 mm");
}

CameraPose pose_from(ViewFrom from, const Vec3& target, double half_height_mm) {
  const Vec3 head = Vec3::UnitZ(), front = -Vec3::UnitY();
  switch (from) {
    case ViewFrom::anterior:
      return looking(target, front, head, half_height_mm);
    case ViewFrom::posterior:
      return looking(target, -front, head, half_height_mm);
    case ViewFrom::left:
      return looking(target, Vec3::UnitX(), head, half_height_mm);
    case ViewFrom::right:
      return looking(target, -Vec3::UnitX(), head, half_height_mm);
    case ViewFrom::cranial:
      return looking(target, head, front, half_height_mm);
    case ViewFrom::caudal:
      return looking(target, -head, front, half_height_mm);
  }
  throw InvalidInput("there is no such view");
}

CameraPose pose_of_carm(const CarmAngles& angles, const Vec3& target, double half_height_mm) {
  return looking(target, geometry::towards_receptor(angles), geometry::receptor_up(angles), half_height_mm);
}

CarmAngles carm_angles(const CameraPose& pose) {
  const Vec3& d = pose.towards;
  CarmAngles angles;
  angles.cranial_deg = std::asin(std::clamp(d.z(), -1.0, 1.0)) / degree;
  if (std::hypot(d.x(), d.y()) > 1e-9) angles.lao_deg = std::atan2(d.x(), -d.y()) / degree;
  return angles;
}

CameraPose pose_broadside(std::span<const Vec3> curve, double aspect) {
  if (curve.size() < 2) throw InvalidInput("a curve of fewer than two points has no side to look at");
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : curve) mean += point / static_cast<double>(curve.size());
  if (!mean.allFinite()) throw InvalidInput("the curve to look at has points that are not finite");
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : curve) spread += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  const double widest = std::max(solver.eigenvalues()[2], 1e-12);
  Vec3 towards = solver.eigenvectors().col(0);
  if (solver.eigenvalues()[1] < 1e-3 * widest) {  // straight: any side will do, so the one nearest the front
    const Vec3 along = solver.eigenvectors().col(2), front = -Vec3::UnitY();
    const Vec3 across = front - front.dot(along) * along;
    towards = across.norm() > 1e-3 ? Vec3(across.normalized()) : Vec3(along.unitOrthogonal());
  }
  if (towards.dot(Vec3(0.2, -1.0, 0.1)) < 0.0) towards = -towards;
  const bool from_above = std::abs(towards.z()) > 0.95;
  return fitted(looking(mean, towards, from_above ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ()), 1.0), curve,
                aspect);
}

CameraPose fitted(const CameraPose& pose, std::span<const Vec3> points, double aspect) {
  if (points.empty()) throw InvalidInput("there is nothing to fit into the picture");
  Eigen::AlignedBox3d seen;
  for (const Vec3& point : points)
    seen.extend(Vec3(point.dot(pose.right()), point.dot(pose.up), point.dot(pose.towards)));
  if (!seen.min().allFinite() || !seen.max().allFinite())
    throw InvalidInput("what is to be fitted into the picture has points that are not finite");
  CameraPose result = pose;
  const Vec3 middle = seen.center();
  result.target = middle.x() * pose.right() + middle.y() * pose.up + middle.z() * pose.towards;
  const double wide = seen.sizes().x() / std::max(aspect, 1e-3), high = seen.sizes().y();
  result.half_height_mm =
      std::clamp(0.5 * 1.08 * std::max({wide, high, 2.0}), least_half_height_mm, most_half_height_mm);
  return result;
}

CameraPose rotated(const CameraPose& pose, double right_px, double up_px, int height_px) {
  if (height_px < 1)
    throw InvalidInput("a picture of " + std::to_string(height_px) + " pixels has no height");
  const double length = std::hypot(right_px, up_px);
  if (length == 0.0) return pose;
  // The pointer takes the near side of the ball with it, so the camera goes the other way.
  const Vec3 drag = (right_px * pose.right() + up_px * pose.up) / length;
  const Vec3 axis = pose.towards.cross(drag).normalized();
  const Mat3 turn = Eigen::AngleAxisd(-std::numbers::pi * length / height_px, axis).toRotationMatrix();
  CameraPose result = pose;
  set_axes(result, turn * axes(pose));
  return result;
}

CameraPose panned(const CameraPose& pose, double right_px, double up_px, int height_px) {
  CameraPose result = pose;
  result.target -= mm_per_px(pose, height_px) * (right_px * pose.right() + up_px * pose.up);
  return result;
}

CameraPose zoomed(const CameraPose& pose, double factor, const Vec3& fixed) {
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw InvalidInput("a zoom of " + std::to_string(factor) + " is not possible, it has to be above 0");
  CameraPose result = pose;
  result.half_height_mm = std::clamp(pose.half_height_mm / factor, least_half_height_mm, most_half_height_mm);
  const double ratio = result.half_height_mm / pose.half_height_mm;
  const Vec3 away = pose.target - fixed;
  const Vec3 across = away - away.dot(pose.towards) * pose.towards;
  result.target = pose.target + (ratio - 1.0) * across;
  return result;
}

CameraPose rolled(const CameraPose& pose, double degrees) {
  CameraPose result = pose;
  set_axes(result, Eigen::AngleAxisd(-degree * degrees, pose.towards).toRotationMatrix() * axes(pose));
  return result;
}

CameraPose blended(const CameraPose& from, const CameraPose& to, double t) {
  if (t <= 0.0) return from;
  if (t >= 1.0) return to;
  CameraPose result;
  result.target = (1.0 - t) * from.target + t * to.target;
  const Eigen::Quaterniond turn = Eigen::Quaterniond(axes(from)).slerp(t, Eigen::Quaterniond(axes(to)));
  set_axes(result, turn.toRotationMatrix());
  result.half_height_mm =
      std::exp((1.0 - t) * std::log(from.half_height_mm) + t * std::log(to.half_height_mm));
  return result;
}

}  // namespace ostia::view
