#include "ostia/core/error.h"
#include "ostia/figure/scene.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::figure {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// Bounds of the scene along the view's axes, and the farthest that perspective needs to stand back.
struct Extent {
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  void include(const Vec3& p, double radius) {
    low = low.cwiseMin(p - Vec3::Constant(radius));
    high = high.cwiseMax(p + Vec3::Constant(radius));
  }
};

/// Calls visit(point, radius) for everything that must be seen.
template <class Visit>
void each_point(const Scene& scene, const Visit& visit) {
  for (const MeshActor& actor : scene.meshes) {
    for (const geometry::Triangle& triangle : actor.mesh.triangles) {
      for (const std::int32_t corner : triangle)
        visit(actor.mesh.points[static_cast<std::size_t>(corner)], 0.0);
    }
  }
  for (const TubeActor& tube : scene.tubes) {
    for (std::size_t i = 0; i < tube.points.size(); ++i) {
      visit(tube.points[i], tube.radius_mm[tube.radius_mm.size() > 1 ? i : 0]);
    }
  }
}

void validate(const Camera& camera, double width_px, double height_px) {
  if (!(width_px >= 1.0) || !(height_px >= 1.0))
    throw InvalidInput("a view needs a width and a height of a pixel or more");
  if (!camera.direction.allFinite() || !camera.up.allFinite() ||
      !(camera.direction.cross(camera.up).norm() > 1e-6 * camera.direction.norm() * camera.up.norm())) {
    throw InvalidInput(
        "a camera's direction and its upward direction must be finite and not along each other");
  }
  if (!(camera.field_of_view_deg >= 1.0 && camera.field_of_view_deg <= 120.0)) {
    throw InvalidInput("a camera's field of view must lie between 1 and 120 degrees, not " +
                       std::to_string(camera.field_of_view_deg));
  }
  if (!(camera.margin >= 0.0 && camera.margin <= 0.4)) {
    throw InvalidInput("a camera's margin must lie between 0 and 0.4, not " + std::to_string(camera.margin));
  }
  if (camera.height_mm && !(*camera.height_mm > 0.0 && std::isfinite(*camera.height_mm))) {
    throw InvalidInput("a camera's visible height must be positive, not " +
                       std::to_string(*camera.height_mm) + " mm");
  }
  if (camera.focus && !camera.focus->allFinite()) throw InvalidInput("a camera's focus is not finite");
}

}  // namespace

Vec2 View::project(const Vec3& point) const {
  const Vec3 offset = point - eye;
  double scale = 1.0 / mm_per_px;
  if (projection == Projection::perspective) scale *= focus_distance_mm / std::max(1e-9, offset.dot(forward));
  return Vec2(0.5 * width_px + scale * offset.dot(right), 0.5 * height_px + scale * offset.dot(down));
}

View fitted_view(const Scene& scene, const Camera& camera, double width_px, double height_px) {
  validate(camera, width_px, height_px);
  View view;
  view.projection = camera.projection;
  view.width_px = width_px;
  view.height_px = height_px;
  view.forward = camera.direction.normalized();
  view.right = view.forward.cross(camera.up).normalized();
  view.down = view.forward.cross(view.right);

  geometry::Mat3 axes;
  axes << view.right, view.down, view.forward;
  Extent extent;
  each_point(scene, [&](const Vec3& p, double radius) { extent.include(axes.transpose() * p, radius); });
  if (!(extent.low.x() <= extent.high.x())) throw InvalidInput("there is nothing in the scene to be seen");
  const Vec3 middle =
      camera.focus ? Vec3(axes.transpose() * *camera.focus) : Vec3(0.5 * (extent.low + extent.high));
  const double used = 1.0 - 2.0 * camera.margin;
  const double half_tangent = std::tan(0.5 * camera.field_of_view_deg * kRadians);
  const double smallest = 1e-6;  // mm a pixel, so that a single flat point can be shown

  if (camera.projection == Projection::orthographic) {
    const Vec3 half = (extent.high - middle).cwiseMax(middle - extent.low);
    view.mm_per_px =
        std::max({2.0 * half.x() / (used * width_px), 2.0 * half.y() / (used * height_px), smallest});
    if (camera.height_mm) view.mm_per_px = *camera.height_mm / height_px;
    view.focus_distance_mm = std::max(1.0, middle.z() - extent.low.z() + 1.0);
  } else {
    double distance = smallest;
    const Vec2 tangent(half_tangent * used * width_px / height_px, half_tangent * used);
    each_point(scene, [&](const Vec3& p, double radius) {
      const Vec3 q = axes.transpose() * p - middle;
      distance = std::max(distance, (std::abs(q.x()) + radius) / tangent.x() - q.z() + radius);
      distance = std::max(distance, (std::abs(q.y()) + radius) / tangent.y() - q.z() + radius);
    });
    if (camera.height_mm) distance = 0.5 * *camera.height_mm / half_tangent;
    view.focus_distance_mm = distance;
    view.mm_per_px = 2.0 * distance * half_tangent / height_px;
  }
  view.eye = axes * middle - view.focus_distance_mm * view.forward;
  return view;
}

namespace cameras {

Camera angiographic(double lao_deg, double cranial_deg) {
  const double lao = lao_deg * kRadians;
  const double cranial = cranial_deg * kRadians;
  const Vec3 viewer(std::sin(lao) * std::cos(cranial), -std::cos(lao) * std::cos(cranial), std::sin(cranial));
  Camera camera;
  camera.direction = -viewer;
  if (std::abs(viewer.z()) > 0.999) camera.up = Vec3(0.0, -1.0, 0.0);
  return camera;
}

Camera broadside(const std::vector<Vec3>& points) {
  if (points.empty()) throw InvalidInput("a broadside view needs points");
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  geometry::Mat3 spread = geometry::Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  if (!spread.allFinite()) throw InvalidInput("a broadside view needs finite points");
  const Eigen::SelfAdjointEigenSolver<geometry::Mat3> solver(spread);
  Camera camera;
  camera.direction = solver.eigenvectors().col(0);
  camera.up = solver.eigenvectors().col(2);
  // From the front and head up, as far as the shape allows.
  const Vec3 front(0.1, 1.0, 0.01);
  if (camera.direction.dot(front) < 0.0) camera.direction = -camera.direction;
  if (camera.up.dot(Vec3(0.1, 0.01, 1.0)) < 0.0) camera.up = -camera.up;
  return camera;
}

}  // namespace cameras
}  // namespace ostia::figure
