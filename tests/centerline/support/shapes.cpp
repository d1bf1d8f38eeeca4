#include "support/shapes.h"

#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::testing {
namespace {

using geometry::AnalyticShape;
using geometry::Centerline;
using geometry::Vec3;

struct OnAxis {
  double distance = 1e300;
  double radius = 0.0;
};

OnAxis nearest_on(const Centerline& axis, const Vec3& p) {
  const auto place = geometry::closest(axis.points, p);
  const std::size_t next = std::min(place.segment + 1, axis.size() - 1);
  return {(place.point - p).norm(),
          (1.0 - place.t) * axis.radius[place.segment] + place.t * axis.radius[next]};
}

OnAxis nearest_on(const AnalyticShape& shape, std::size_t tubes, const Vec3& p) {
  OnAxis best;
  for (std::size_t t = 0; t < tubes; ++t) {
    const OnAxis here = nearest_on(shape.tubes[t].axis, p);
    if (here.distance < best.distance) best = here;
  }
  return best;
}

struct Place {
  Vec3 position;
  double radius;
};

std::vector<Place> left_out(const AnalyticShape& shape) {
  std::vector<Place> places;
  for (std::size_t t = 0; t < shape.tubes.size(); ++t) {
    const Centerline& axis = shape.tubes[t].axis;
    places.push_back({axis.points.front(), axis.radius.front()});
    places.push_back({axis.points.back(), axis.radius.back()});
    for (std::size_t i = 0; t > 0 && i < axis.size(); ++i) {
      const OnAxis other = nearest_on(shape, t, axis.points[i]);
      if (other.distance > other.radius + axis.radius[i]) break;
      places.push_back({axis.points[i], std::max(other.radius, axis.radius[i])});
    }
  }
  return places;
}

}  // namespace

geometry::TriMesh capsule(double length, double radius, double spacing) {
  const auto f = [=](const Vec3& p) {
    const Vec3 on_axis(0.0, 0.0, std::clamp(p.z(), 0.0, length));
    return (p - on_axis).norm() - radius;
  };
  const Vec3 margin = Vec3::Constant(radius + 2.0 * spacing);
  return geometry::isosurface(f, geometry::Box3(Vec3(-margin), Vec3(margin + Vec3(0.0, 0.0, length))),
                              spacing);
}

bool identical(const centerline::CenterlineResult& a, const centerline::CenterlineResult& b) {
  if (a.lines.size() != b.lines.size()) return false;
  for (std::size_t i = 0; i < a.lines.size(); ++i)
    if (a.lines[i].points != b.lines[i].points || a.lines[i].radius != b.lines[i].radius) return false;
  return true;
}

AxisError axis_error(const std::vector<Centerline>& lines, const AnalyticShape& shape, double margin) {
  const std::vector<Place> excluded = left_out(shape);
  AxisError error;
  for (const Centerline& line : lines)
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vec3& p = line.points[i];
      const bool skip = std::any_of(excluded.begin(), excluded.end(), [&](const Place& place) {
        return (place.position - p).norm() < margin * place.radius;
      });
      if (skip) continue;
      const OnAxis truth = nearest_on(shape, shape.tubes.size(), p);
      const double radius_error = std::abs(line.radius[i] / truth.radius - 1.0);
      const Vec3 before = (p - line.points[i - 1]).normalized(),
                 after = (line.points[i + 1] - p).normalized();
      ++error.points;
      error.mean_mm += truth.distance;
      error.max_mm = std::max(error.max_mm, truth.distance);
      error.mean_radius += radius_error;
      error.max_radius = std::max(error.max_radius, radius_error);
      error.mean_turn_deg +=
          std::atan2(before.cross(after).norm(), before.dot(after)) * 180.0 / std::numbers::pi;
    }
  const double count = std::max<double>(1.0, static_cast<double>(error.points));
  error.mean_mm /= count;
  error.mean_radius /= count;
  error.mean_turn_deg /= count;
  return error;
}

}  // namespace ostia::testing
