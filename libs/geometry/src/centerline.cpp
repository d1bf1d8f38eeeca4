#include "ostia/geometry/centerline.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

namespace ostia::geometry {

void complete(Centerline& line, const Vec3& first_normal) {
  const std::vector<Vec3> t = tangents(line.points);
  const Vec3 normal = first_normal.isZero(0.0) ? initial_normal(t.front()) : first_normal;
  line.frames = rotation_minimising_frames(line.points, t, normal);
  line.abscissa = abscissas(line.points);
}

Centerline resample(const Centerline& line, double step_mm) {
  const std::size_t n = line.size();
  if (line.radius.size() != n && !line.radius.empty()) {
    throw InvalidInput("the centerline has " + std::to_string(n) + " points and " +
                       std::to_string(line.radius.size()) + " radii; give one a point");
  }
  Centerline result;
  result.points = resample(line.points, step_mm);
  if (!line.radius.empty()) {
    const std::vector<double> along = abscissas(line.points);
    const std::size_t pieces = result.points.size() - 1;
    result.radius.reserve(pieces + 1);
    std::size_t segment = 0;
    for (std::size_t i = 0; i <= pieces; ++i) {
      const double s = along.back() * static_cast<double>(i) / static_cast<double>(pieces);
      while (segment + 2 < n && along[segment + 1] <= s) ++segment;
      const double piece = along[segment + 1] - along[segment];
      const double t = piece > 0.0 ? (s - along[segment]) / piece : 0.0;
      result.radius.push_back((1.0 - t) * line.radius[segment] + t * line.radius[segment + 1]);
    }
    result.radius.back() = line.radius.back();
  }
  complete(result, line.frames.empty() ? Vec3(Vec3::Zero()) : line.frames.front().normal);
  return result;
}

}  // namespace ostia::geometry
