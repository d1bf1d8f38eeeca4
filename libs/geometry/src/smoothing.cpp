#include "ostia/geometry/smoothing.h"

#include "edge_table.h"
#include "mesh_checks.h"
#include "smoothing_steps.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

double inflating_weight(const TaubinOptions& options) {
  return 1.0 / (options.pass_band - 1.0 / options.lambda);
}

/// to = from + weight * (mean of the neighbours - from), all points at once.
void smoothing_step(const detail::MovingNeighbours& around, double weight, const std::vector<Vec3>& from,
                    std::vector<Vec3>& to) {
  core::parallel_for(from.size(), 4096, [&](std::size_t p) {
    const std::size_t first = around.start[p], last = around.start[p + 1];
    if (first == last) {
      to[p] = from[p];
      return;
    }
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = first; i < last; ++i) sum += from[static_cast<std::size_t>(around.points[i])];
    to[p] = from[p] + weight * (sum / static_cast<double>(last - first) - from[p]);
  });
}

}  // namespace

namespace detail {

MovingNeighbours moving_neighbours(const TriMesh& mesh, const std::vector<bool>& free, bool borders_move) {
  const std::vector<HalfEdge> table = half_edges(mesh);
  MovingNeighbours result;
  result.on_border.assign(mesh.points.size(), 0);
  const auto is_open = [](const HalfEdge* first, const HalfEdge* last) { return last - first == 1; };
  for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    if (!is_open(first, last)) return;
    result.on_border[static_cast<std::size_t>(first->low)] = 1;
    result.on_border[static_cast<std::size_t>(first->high)] = 1;
  });
  result.start.assign(mesh.points.size() + 1, 0);
  const auto for_each_link = [&](const auto& use) {
    for_each_edge(table, [&](const HalfEdge* edge, const HalfEdge* last) {
      const bool open = is_open(edge, last);
      const auto link = [&](std::int32_t from, std::int32_t to) {
        const auto point = static_cast<std::size_t>(from);
        if (!free.empty() && !free[point]) return;
        if (result.on_border[point] && !(borders_move && open)) return;
        use(point, to);
      };
      link(edge->high, edge->low);
      link(edge->low, edge->high);
    });
  };
  for_each_link([&](std::size_t point, std::int32_t) { ++result.start[point + 1]; });
  for (std::size_t p = 0; p < mesh.points.size(); ++p) result.start[p + 1] += result.start[p];
  result.points.resize(result.start.back());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for_each_link([&](std::size_t point, std::int32_t other) { result.points[next[point]++] = other; });
  return result;
}

void taubin_steps(const MovingNeighbours& around, const TaubinOptions& options, std::vector<Vec3>& points,
                  const core::TaskContext& task) {
  const double inflate = inflating_weight(options);
  std::vector<Vec3> between(points.size());
  for (int i = 0; i < options.iterations; ++i) {
    task.throw_if_cancelled();
    smoothing_step(around, options.lambda, points, between);
    smoothing_step(around, inflate, between, points);
    task.set_progress(static_cast<double>(i + 1) / options.iterations);
  }
}

}  // namespace detail

void validate(const TaubinOptions& options) {
  const auto fail = [](const std::string& what) { throw InvalidInput("Taubin smoothing: " + what); };
  if (options.iterations < 0) {
    fail("iterations is " + std::to_string(options.iterations) + "; it must be 0 or more");
  }
  if (!(options.pass_band > 0.0 && options.pass_band < 2.0)) {
    fail("pass_band is " + std::to_string(options.pass_band) + "; it must lie in (0, 2)");
  }
  if (!(options.lambda > 0.0 && options.lambda < 1.0)) {
    fail("lambda is " + std::to_string(options.lambda) + "; it must lie in (0, 1)");
  }
  // The roughest ripple has k = 2; a gain beyond 1 there would grow it at every step.
  const double gain = (1.0 - 2.0 * options.lambda) * (1.0 - 2.0 * inflating_weight(options));
  if (options.pass_band * options.lambda >= 1.0 || !(std::abs(gain) <= 1.0)) {
    fail("lambda " + std::to_string(options.lambda) + " with pass_band " + std::to_string(options.pass_band) +
         " would make ripples grow; lower lambda, 0.33 is usual");
  }
}

TriMesh taubin_smoothed(const TriMesh& mesh, const TaubinOptions& options, const core::TaskContext& task) {
  validate(options);
  detail::check_indices(mesh, "Taubin smoothing");
  detail::check_finite(mesh, "Taubin smoothing");
  task.throw_if_cancelled();
  TriMesh result = mesh;
  detail::taubin_steps(detail::moving_neighbours(mesh, {}, false), options, result.points, task);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::geometry
