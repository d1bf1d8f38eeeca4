#include "motion/motion_scores.h"

#include "ostia/core/parallel.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>

namespace ostia::experiments {

using geometry::TriMesh;
using geometry::Vec3;

namespace {

double mean_distance(const std::vector<Vec3>& from, const TriMesh& to) {
  const geometry::AabbTree tree(to);
  const double sum = core::parallel_reduce(
      from.size(), 1024, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0.0;
        for (std::size_t i = first; i < last; ++i) part += tree.closest(from[i]).distance;
        return part;
      },
      [](double a, double b) { return a + b; });
  return from.empty() ? 0.0 : sum / static_cast<double>(from.size());
}

}  // namespace

std::size_t intersections(const TriMesh& mesh) {
  return geometry::self_intersections(mesh).size();
}

std::size_t inverted_cells(const geometry::CageGrid& grid, const std::vector<Vec3>& control_points) {
  std::size_t inverted = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const geometry::CageCell corners = grid.corners(cell);
    std::array<Vec3, 8> places;
    for (std::size_t c = 0; c < 8; ++c) places[c] = control_points[static_cast<std::size_t>(corners[c])];
    if (geometry::jacobian_bounds(places, grid.cell_mm)[0] <= 0.0) ++inverted;
  }
  return inverted;
}

void score(const BeatingHeart& heart, const HeartPhaseModel& phase, const std::vector<Vec3>& points,
           std::size_t template_intersections, double dice_resolution_mm, MotionRun& run,
           const core::TaskContext& task) {
  run.heart = heart.name;
  run.phase = phase.phase;
  run.lost = phase.lost;
  const TriMesh result{points, heart.model.triangles}, truth{phase.truth, heart.model.triangles};
  run.distance_mm = mean_distance(phase.segmented.points, result);
  run.dice = evaluation::compare_enclosed(truth, result, dice_resolution_mm, {}, task).dice;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = (points[i] - phase.truth[i]).norm();
    sum += off;
    run.vertex_worst_mm = std::max(run.vertex_worst_mm, off);
  }
  run.vertex_mm = sum / static_cast<double>(points.size());
  const std::size_t all = intersections(result);
  run.new_intersections = all > template_intersections ? all - template_intersections : 0;
}

}  // namespace ostia::experiments
