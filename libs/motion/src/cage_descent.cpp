#include "ostia/motion/cage_descent.h"

#include "cage_system.h"
#include "registration_parts.h"

#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::motion {
namespace {

using geometry::CageGrid;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double enough_descent = 1e-4;  // of what the gradient promises (Armijo)
constexpr int most_descent_halvings = 30;
constexpr double settled_mm = 1e-6;  // no control point goes farther: the depth is done

double dot(const Points& a, const Points& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double steepest(const Points& gradient) {
  double most = 0.0;
  for (const Vec3& g : gradient) most = std::max(most, g.norm());
  return most;
}

Points difference(const Points& a, const Points& b) {
  Points out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

/// The cell is the unit of volume. Distances squared count whole and in all directions (equation 6).
CageCost cost_of(const DescentOptions& options, const CageGrid& grid) {
  CageCost cost;
  const double cell_mm3 = grid.cell_mm.prod();
  cost.elastic = options.with_energy;
  cost.energy = {options.energy.length / cell_mm3, options.energy.area / cell_mm3,
                 options.energy.volume / cell_mm3};
  cost.data_weight = 2.0;
  cost.point_share = 1.0;
  return cost;
}

/// One depth of the hierarchy.
class Descent {
 public:
  Descent(const TriMesh& source, const PairingVertices& target, const CageGrid& grid,
          const DescentOptions& options)
      : source_(source),
        target_(target),
        grid_(grid),
        options_(options),
        system_(grid, source, cost_of(options, grid)),
        places_(cage_points(grid, source.points)) {}

  TriMesh surface(const Points& points) const { return carried_mesh(source_, places_, grid_, points); }
  double least_jacobian(const Points& points) const { return system_.least_jacobian(points); }

  /// False where nothing moves any more.
  bool iterate(Points& points, RegistrationReport& report) {
    const std::vector<SurfacePair> pairs =
        vertex_pairs(surface(points), places_, target_, options_.max_angle_deg);
    tell_pairs(source_, pairs, report);
    ++report.rounds;
    const Points gradient = system_.gradient(points, pairs);
    const double squared = dot(gradient, gradient);
    double length = first_length(points, gradient, pairs);
    last_points_ = points;
    last_gradient_ = gradient;
    const double before = system_.energy(points, pairs);
    for (int k = 0; k < most_descent_halvings && length * steepest(gradient) > settled_mm;
         ++k, length /= 2.0) {
      Points moved = points;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= length * gradient[i];
      if (!(system_.energy(moved, pairs) <= before - enough_descent * length * squared)) continue;
      system_.follow(moved);
      if (options_.with_energy && system_.least_jacobian(moved) < least_jacobian_allowed) continue;
      points = std::move(moved);
      return true;
    }
    return false;
  }

 private:
  /// Barzilai and Borwein: the length that fits the last step's change of gradient best. The first is that
  /// which the distances alone allow.
  double first_length(const Points& points, const Points& gradient,
                      const std::vector<SurfacePair>& pairs) const {
    if (!last_points_.empty()) {
      const Points way = difference(points, last_points_), change = difference(gradient, last_gradient_);
      const double along = dot(way, change);
      if (along > 0.0) return dot(way, way) / along;
    }
    return 1.0 / system_.greatest_curvature(pairs);
  }

  const TriMesh& source_;
  const PairingVertices& target_;
  CageGrid grid_;
  const DescentOptions& options_;
  CageSystem system_;
  std::vector<geometry::CagePoint> places_;
  Points last_points_, last_gradient_;
};

}  // namespace

void validate(const DescentOptions& options) {
  check_cage_options(options.depth, options.margin, options.max_angle_deg, options.energy);
  if (options.iterations < options.depth || options.iterations > 100000)
    refuse_registration("the iterations must be one at each depth at least, 100000 at most");
}

Registration register_cage_by_descent(const TriMesh& source, const TriMesh& target,
                                      const DescentOptions& options, const core::TaskContext& task) {
  validate(options);
  check_surfaces(source, target);
  const PairingVertices prepared(target);
  Registration result;
  result.grid = geometry::cage_around(source.points, 1, options.margin);
  Points points = rest_points(result.grid);
  const int at_each = options.iterations / options.depth;
  for (int d = 1; d <= options.depth; ++d) {
    if (d > 1) {
      points = refined(result.grid, points);
      result.grid = refined(result.grid);
    }
    Descent descent(source, prepared, result.grid, options);
    for (int k = 0; k < at_each; ++k) {
      task.throw_if_cancelled();
      if (!descent.iterate(points, result.report)) break;
      task.set_progress((d - 1 + (k + 1.0) / at_each) / options.depth);
    }
    task.set_progress(static_cast<double>(d) / options.depth);
    if (d < options.depth) continue;
    result.report.least_jacobian = descent.least_jacobian(points);
    result.surface = descent.surface(points);
  }
  result.report.source_self_intersections = geometry::self_intersections(source).size();
  result.report.self_intersections = geometry::self_intersections(result.surface).size();
  result.control_points = std::move(points);
  return result;
}

}  // namespace ostia::motion
