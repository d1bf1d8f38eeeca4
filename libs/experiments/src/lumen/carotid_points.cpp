#include "ostia/core/parallel.h"
#include "ostia/experiments/carotid.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/noise.h"
#include "ostia/reformat/section.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::experiments {

using geometry::Vec3;

std::vector<MeasuredPoint> measured_points(const geometry::TriMesh& closed, const CarotidOptions& options) {
  const geometry::AabbTree surface(closed);
  const std::vector<Vec3> normals = geometry::vertex_normals(closed);
  const geometry::Box3 box = geometry::bounds(closed.points);
  std::vector<MeasuredPoint> out;
  for (double z = box.min()[2] + options.section_step_mm; z < box.max()[2]; z += options.section_step_mm) {
    for (const auto& outline : reformat::section(closed, Vec3(0.0, 0.0, z), Vec3::UnitZ())) {
      const double around = reformat::length(outline);
      for (int n = 0; n < options.section_points; ++n) {
        const Vec3 at = geometry::at_abscissa(outline, around * n / options.section_points).point;
        const geometry::SurfacePoint near = surface.closest(at);
        Vec3 normal = Vec3::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
          const auto corner = closed.triangles[static_cast<std::size_t>(near.triangle)][c];
          normal += near.barycentric[static_cast<int>(c)] * normals[static_cast<std::size_t>(corner)];
        }
        normal.normalize();
        const double error =
            options.measured_bias_mm + options.measured_sigma_mm * phantom::normal(options.seed, out.size());
        out.push_back({at + error * normal, normal});
      }
    }
  }
  return out;
}

std::vector<double> distances_to(const std::vector<MeasuredPoint>& measured, const std::vector<Vec3>& points,
                                 const std::vector<Vec3>& normals) {
  constexpr std::size_t neighbours = 6, looked_at = 24;
  std::vector<Vec3> places;
  for (const MeasuredPoint& m : measured) places.push_back(m.point);
  const geometry::KdTree tree(places);
  std::vector<double> out(points.size(), std::numeric_limits<double>::quiet_NaN());
  core::parallel_for(points.size(), 256, [&](std::size_t i) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const std::int32_t n : tree.nearest(points[i], looked_at)) {
      const MeasuredPoint& m = measured[static_cast<std::size_t>(n)];
      if (m.normal.dot(normals[i]) < 0.5) continue;
      sum += (points[i] - m.point).dot((m.normal + normals[i]).normalized());
      if (++count == neighbours) break;
    }
    if (count > 0) out[i] = sum / static_cast<double>(count);
  });
  return out;
}

Spread spread_of(const std::vector<double>& distances) {
  Spread out;
  double sum = 0.0, squares = 0.0;
  for (const double d : distances) {
    if (!std::isfinite(d)) continue;
    out.low = out.points == 0 ? d : std::min(out.low, d);
    out.high = out.points == 0 ? d : std::max(out.high, d);
    ++out.points;
    sum += d;
    squares += d * d;
  }
  if (out.points == 0) return out;
  const auto n = static_cast<double>(out.points);
  out.mean = sum / n;
  out.sd = std::sqrt(std::max(0.0, squares / n - out.mean * out.mean));
  return out;
}

}  // namespace ostia::experiments
