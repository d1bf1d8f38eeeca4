#include "ostia/geometry/smoothing.h"

#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;

double inflating_weight(const TaubinOptions& options) {
  return 1.0 / (options.pass_band - 1.0 / options.lambda);
}

/// The neighbours of each free point, one list after the other. A border point has none: it stays.
struct Neighbourhood {
  std::vector<std::size_t> start;
  std::vector<std::int32_t> points;
};

Neighbourhood free_neighbourhood(const TriMesh& mesh) {
  const std::vector<HalfEdge> table = detail::half_edges(mesh);
  std::vector<char> fixed(mesh.points.size(), 0);
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first > 1) return;
    fixed[static_cast<std::size_t>(first->low)] = 1;
    fixed[static_cast<std::size_t>(first->high)] = 1;
  });
  Neighbourhood result;
  result.start.assign(mesh.points.size() + 1, 0);
  const auto for_each_link = [&](const auto& use) {
    detail::for_each_edge(table, [&](const HalfEdge* edge, const HalfEdge*) {
      const auto low = static_cast<std::size_t>(edge->low), high = static_cast<std::size_t>(edge->high);
      if (!fixed[high]) use(high, edge->low);
      if (!fixed[low]) use(low, edge->high);
    });
  };
  for_each_link([&](std::size_t point, std::int32_t) { ++result.start[point + 1]; });
  for (std::size_t p = 0; p < mesh.points.size(); ++p) result.start[p + 1] += result.start[p];
  result.points.resize(result.start.back());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for_each_link([&](std::size_t point, std::int32_t other) { result.points[next[point]++] = other; });
  return result;
}

/// to = from + weight * (mean of the neighbours - from), all points at once.
void step(const Neighbourhood& around, double weight, const std::vector<Vec3>& from, std::vector<Vec3>& to) {
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
  const Neighbourhood around = free_neighbourhood(mesh);
  const double inflate = inflating_weight(options);
  TriMesh result = mesh;
  std::vector<Vec3> between(mesh.points.size());
  for (int i = 0; i < options.iterations; ++i) {
    task.throw_if_cancelled();
    step(around, options.lambda, result.points, between);
    step(around, inflate, between, result.points);
    task.set_progress(static_cast<double>(i + 1) / options.iterations);
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::geometry
