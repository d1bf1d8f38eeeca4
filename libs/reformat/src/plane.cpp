#include "ostia/reformat/plane.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::reformat {
namespace {

constexpr int kMaxPixels = 32767;

std::string text(const Vec3& p) {
  return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ")";
}

/// The plane through `position` with the given axes that covers all corners of the image.
Plane covering_plane(const imaging::Geometry& image, const Vec3& position, const Vec3& u, const Vec3& v,
                     double pixel_mm) {
  if (image.size[0] < 1 || image.size[1] < 1 || image.size[2] < 1) {
    throw InvalidInput("cannot lay a plane through an image without voxels");
  }
  if (!position.allFinite()) throw InvalidInput("the plane's position " + text(position) + " is not finite");
  if (pixel_mm == 0.0) pixel_mm = image.spacing.minCoeff();
  if (!(pixel_mm > 0.0) || !std::isfinite(pixel_mm)) {
    throw InvalidInput("the plane's pixel size " + std::to_string(pixel_mm) + " mm is not positive");
  }
  Vec2 low = Vec2::Constant(INFINITY);
  Vec2 high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 index;
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = ((corner >> axis) & 1) ? static_cast<double>(image.size[axis]) - 0.5 : -0.5;
    }
    const Vec3 offset = image.world(index) - position;
    const Vec2 p(offset.dot(u), offset.dot(v));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 pixels = ((high - low) / pixel_mm - Vec2::Constant(1e-6)).array().ceil().max(1.0);
  if (!(pixels.maxCoeff() <= kMaxPixels)) {
    throw InvalidInput("a plane through the image would be " + std::to_string(pixels.maxCoeff()) +
                       " pixels long (at most 32767); take larger pixels than " + std::to_string(pixel_mm) +
                       " mm");
  }
  Plane plane;
  plane.origin = position + low.x() * u + low.y() * v;
  plane.u = u;
  plane.v = v;
  plane.pixel_mm = pixel_mm;
  plane.width = static_cast<int>(pixels.x());
  plane.height = static_cast<int>(pixels.y());
  return plane;
}

void require_section(double abscissa_mm, double side_mm, double pixel_mm) {
  if (!std::isfinite(abscissa_mm)) throw InvalidInput("the cross-section's abscissa is not finite");
  if (!(side_mm > 0.0) || !(pixel_mm > 0.0) || !(side_mm / pixel_mm <= kMaxPixels)) {
    throw InvalidInput("a cross-section of " + std::to_string(side_mm) + " mm with pixels of " +
                       std::to_string(pixel_mm) + " mm cannot be pictured");
  }
}

Plane square_about(const Vec3& middle, const Vec3& u, const Vec3& v, double side_mm, double pixel_mm) {
  Plane plane;
  plane.u = u;
  plane.v = v;
  plane.pixel_mm = pixel_mm;
  plane.width = std::max(1, static_cast<int>(std::lround(side_mm / pixel_mm)));
  plane.height = plane.width;
  plane.origin = middle - 0.5 * plane.width * pixel_mm * (u + v);
  validate(plane);
  return plane;
}

}  // namespace

void validate(const Plane& plane) {
  if (plane.width < 1 || plane.height < 1 || plane.width > kMaxPixels || plane.height > kMaxPixels) {
    throw InvalidInput("a plane of " + std::to_string(plane.width) + " x " + std::to_string(plane.height) +
                       " pixels cannot be pictured; both must lie between 1 and 32767");
  }
  if (!(plane.pixel_mm > 0.0) || !std::isfinite(plane.pixel_mm)) {
    throw InvalidInput("the plane's pixel size " + std::to_string(plane.pixel_mm) + " mm is not positive");
  }
  if (!plane.origin.allFinite())
    throw InvalidInput("the plane's origin " + text(plane.origin) + " is not finite");
  const bool unit = std::abs(plane.u.norm() - 1.0) < 1e-6 && std::abs(plane.v.norm() - 1.0) < 1e-6;
  if (!unit || !(std::abs(plane.u.dot(plane.v)) < 1e-6)) {
    throw InvalidInput("the plane's axes " + text(plane.u) + " and " + text(plane.v) +
                       " are not unit vectors normal to each other");
  }
}

Vec3 world(const Plane& plane, const Vec2& picture_px) {
  return plane.origin + plane.pixel_mm * (picture_px.x() * plane.u + picture_px.y() * plane.v);
}

Vec3 centre(const Plane& plane) {
  return world(plane, Vec2(0.5 * plane.width, 0.5 * plane.height));
}

PlanePoint project(const Plane& plane, const Vec3& world_mm) {
  const Vec3 offset = world_mm - plane.origin;
  return {Vec2(offset.dot(plane.u), offset.dot(plane.v)) / plane.pixel_mm, offset.dot(plane.normal())};
}

Plane axial_plane(const imaging::Geometry& image, const Vec3& position, double pixel_mm) {
  return covering_plane(image, position, Vec3::UnitX(), Vec3::UnitY(), pixel_mm);
}

Plane coronal_plane(const imaging::Geometry& image, const Vec3& position, double pixel_mm) {
  return covering_plane(image, position, Vec3::UnitX(), -Vec3::UnitZ(), pixel_mm);
}

Plane sagittal_plane(const imaging::Geometry& image, const Vec3& position, double pixel_mm) {
  return covering_plane(image, position, Vec3::UnitY(), -Vec3::UnitZ(), pixel_mm);
}

Plane cross_section_plane(const geometry::Centerline& axis, double abscissa_mm, double side_mm,
                          double pixel_mm) {
  if (axis.size() < 2 || axis.abscissa.size() != axis.size() || axis.frames.size() != axis.size()) {
    throw InvalidInput("a cross-section needs an axis of two points or more with abscissas and frames, not " +
                       std::to_string(axis.size()) + " points, " + std::to_string(axis.abscissa.size()) +
                       " abscissas and " + std::to_string(axis.frames.size()) + " frames");
  }
  require_section(abscissa_mm, side_mm, pixel_mm);
  const double s = std::clamp(abscissa_mm, axis.abscissa.front(), axis.abscissa.back());
  const auto after = std::upper_bound(axis.abscissa.begin() + 1, axis.abscissa.end() - 1, s);
  const auto next = static_cast<std::size_t>(after - axis.abscissa.begin());
  const std::size_t previous = next - 1;
  const double step = axis.abscissa[next] - axis.abscissa[previous];
  const double t = step > 0.0 ? (s - axis.abscissa[previous]) / step : 0.0;

  const geometry::Frame& a = axis.frames[previous];
  const geometry::Frame& b = axis.frames[next];
  const Vec3 tangent = ((1.0 - t) * a.tangent + t * b.tangent).normalized();
  const Vec3 normal = (1.0 - t) * a.normal + t * b.normal;
  const Vec3 u = (normal - normal.dot(tangent) * tangent).normalized();
  const Vec3 middle = (1.0 - t) * axis.points[previous] + t * axis.points[next];
  return square_about(middle, u, tangent.cross(u).normalized(), side_mm, pixel_mm);
}

Plane cross_section_plane(const geometry::AxisCurve& axis, double abscissa_mm, double side_mm,
                          double pixel_mm) {
  require_section(abscissa_mm, side_mm, pixel_mm);
  const geometry::Frame frame = axis.frame(abscissa_mm);
  return square_about(axis.point(abscissa_mm), frame.normal, frame.binormal, side_mm, pixel_mm);
}

std::string patient_letters(const Vec3& direction, double tolerance_deg) {
  constexpr std::array<char, 3> kPositive{'L', 'P', 'S'};
  constexpr std::array<char, 3> kNegative{'R', 'A', 'I'};
  const double norm = direction.norm();
  if (!(norm > 0.0)) return {};
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::abs(direction[a]) > std::abs(direction[b]) + 1e-9 * norm;
  });
  const double threshold = std::sin(tolerance_deg * std::numbers::pi / 180.0);
  std::string letters;
  for (const int axis : order) {
    const double share = direction[axis] / norm;
    if (!letters.empty() && std::abs(share) <= threshold) continue;
    letters +=
        share > 0.0 ? kPositive[static_cast<std::size_t>(axis)] : kNegative[static_cast<std::size_t>(axis)];
  }
  return letters;
}

}  // namespace ostia::reformat
