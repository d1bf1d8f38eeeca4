#include "ostia/centerline/canal_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/isosurface.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::centerline {
namespace {

void check(const std::vector<geometry::Centerline>& lines, double spacing_mm) {
  if (!(spacing_mm > 0.0) || !std::isfinite(spacing_mm))
    throw InvalidInput("canal surface: the spacing must be positive, not " + std::to_string(spacing_mm) +
                       " mm");
  if (lines.empty()) throw InvalidInput("canal surface: there is no centerline");
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].size() < 2 || lines[i].radius.size() != lines[i].size())
      throw InvalidInput("canal surface: centerline " + std::to_string(i) +
                         " needs two points or more and a radius at each");
}

}  // namespace

geometry::TriMesh canal_surface(const std::vector<geometry::Centerline>& lines, double spacing_mm,
                                const core::TaskContext& task) {
  check(lines, spacing_mm);
  geometry::AnalyticShape shape;
  double largest = 0.0;
  for (const geometry::Centerline& line : lines) {
    for (const geometry::Vec3& p : line.points) shape.box.extend(p);
    largest = std::max(largest, *std::max_element(line.radius.begin(), line.radius.end()));
    shape.tubes.push_back({"", line});
  }
  const geometry::Vec3 margin = geometry::Vec3::Constant(largest + 2.0 * spacing_mm);
  shape.box.min() -= margin;
  shape.box.max() += margin;
  const geometry::TubeDistance distance(shape);
  return geometry::isosurface(distance, shape.box, spacing_mm, task);
}

geometry::TriMesh canal_surface(const geometry::VesselTree& tree, double spacing_mm,
                                const core::TaskContext& task) {
  std::vector<geometry::Centerline> lines;
  for (const geometry::TreeSegment& segment : tree.segments) lines.push_back(segment.axis);
  return canal_surface(lines, spacing_mm, task);
}

}  // namespace ostia::centerline
