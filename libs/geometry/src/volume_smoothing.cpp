// Smoothing that gives back to each place the volume that the filter took or added there.

#include "mesh_checks.h"
#include "smoothing_steps.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"

#include <string>
#include <utility>

namespace ostia::geometry {
namespace {

/// Each value becomes the mean of its own and its neighbours', so often. Values of points that stay are 0.
void average(const detail::MovingNeighbours& around, int rings, std::vector<double>& values) {
  std::vector<double> from;
  for (int ring = 0; ring < rings; ++ring) {
    from = values;
    core::parallel_for(values.size(), 4096, [&](std::size_t p) {
      const std::size_t first = around.start[p], last = around.start[p + 1];
      if (first == last || around.on_border[p]) return;
      double sum = from[p];
      for (std::size_t i = first; i < last; ++i) sum += from[static_cast<std::size_t>(around.points[i])];
      values[p] = sum / static_cast<double>(last - first + 1);
    });
  }
}

}  // namespace

void validate(const VolumeSmoothingOptions& options) {
  validate(options.filter);
  if (options.restoring_rounds < 0)
    throw InvalidInput("smoothing: restoring_rounds is " + std::to_string(options.restoring_rounds) +
                       "; it must be 0 or more");
  if (options.mean_rings < 1)
    throw InvalidInput("smoothing: mean_rings is " + std::to_string(options.mean_rings) +
                       "; it must be 1 or more");
}

TriMesh smoothed_in_volume(const TriMesh& mesh, const VolumeSmoothingOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  detail::check_indices(mesh, "smoothing");
  detail::check_finite(mesh, "smoothing");
  if (!options.free.empty() && options.free.size() != mesh.points.size())
    throw InvalidInput("smoothing: " + std::to_string(options.free.size()) + " marks for " +
                       std::to_string(mesh.points.size()) + " points");
  task.throw_if_cancelled();
  const detail::MovingNeighbours around = detail::moving_neighbours(mesh, options.free, options.borders_move);
  TriMesh result = mesh;
  detail::taubin_steps(around, options.filter, result.points, task);
  std::vector<double> lost(mesh.points.size());
  for (int round = 0; round < options.restoring_rounds; ++round) {
    task.throw_if_cancelled();
    const std::vector<Vec3> normals = vertex_normals(result);
    for (std::size_t p = 0; p < lost.size(); ++p)
      lost[p] =
          around.moves(p) && !around.on_border[p] ? (mesh.points[p] - result.points[p]).dot(normals[p]) : 0.0;
    average(around, options.mean_rings, lost);
    for (std::size_t p = 0; p < lost.size(); ++p) result.points[p] += lost[p] * normals[p];
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::geometry
