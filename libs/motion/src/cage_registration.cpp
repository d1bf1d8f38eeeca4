#include "ostia/motion/cage_registration.h"

#include "cage_system.h"
#include "registration_parts.h"
#include "thinned.h"

#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>

namespace ostia::motion {
namespace {

using geometry::CageGrid;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double still_mm = 0.01;     // a step below ends a depth
constexpr double point_share = 0.05;  // of a pair's weight, for all directions; the rest is along the normal

/// One depth of the hierarchy.
class Depth {
 public:
  Depth(const TriMesh& source, const PairingTarget& target, const CageGrid& grid,
        const RegistrationOptions& options)
      : source_(source),
        target_(target),
        grid_(grid),
        options_(options),
        system_(grid, source, {options.energy, true, options.data_weight, point_share}),
        places_(cage_points(grid, source.points)) {}

  TriMesh surface(const Points& points) const { return carried_mesh(source_, places_, grid_, points); }
  const CageSystem& system() const { return system_; }

  /// Returns the largest way that a control point has gone.
  double round(Points& points, double looseness, RegistrationReport& report) const {
    const std::vector<SurfacePair> pairs =
        surface_pairs(surface(points), source_, grid_, target_, options_.max_angle_deg, looseness);
    tell_pairs(source_, pairs, report);
    ++report.rounds;
    const Points step = system_.step(points, pairs);
    const double before = system_.energy(points, pairs);
    double share = 1.0;
    for (int k = 0; k < most_halvings; ++k, share /= 2.0) {
      Points moved = points;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += share * step[i];
      system_.follow(moved);
      if (system_.least_jacobian(moved) < least_jacobian_allowed) continue;
      if (system_.energy(moved, pairs) >= before) continue;
      double way = 0.0;
      for (std::size_t i = 0; i < moved.size(); ++i) way = std::max(way, (moved[i] - points[i]).norm());
      points = std::move(moved);
      return way;
    }
    return 0.0;
  }

 private:
  const TriMesh& source_;
  const PairingTarget& target_;
  CageGrid grid_;
  const RegistrationOptions& options_;
  CageSystem system_;
  std::vector<geometry::CagePoint> places_;
};

/// The start's control points that the coarsest grid has, too.
Points every_nth(const RegistrationOptions& options, const CageGrid& coarse) {
  CageGrid fine = coarse;
  fine.cells = 1 << options.depth;
  if (options.start.size() != fine.point_count())
    refuse_registration("the start is of a cage of another depth");
  const int step = fine.cells / coarse.cells;
  Points points(coarse.point_count());
  for (int k = 0; k <= coarse.cells; ++k)
    for (int j = 0; j <= coarse.cells; ++j)
      for (int i = 0; i <= coarse.cells; ++i)
        points[static_cast<std::size_t>(coarse.point(i, j, k))] =
            options.start[static_cast<std::size_t>(fine.point(step * i, step * j, step * k))];
  return points;
}

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Half of the way back to `safe`, again and again, until no triangles intersect but those of `allowed` and
/// no cell is inverted; `safe` itself is so.
template <class Surface>
void take_back(const Depth& depth, const Surface& surface, const Points& safe, const Pairs& allowed,
               Points& points, const core::TaskContext& task) {
  for (int k = 0; k < most_halvings; ++k) {
    task.throw_if_cancelled();
    const Pairs now = geometry::self_intersections(surface(points));
    if (std::includes(allowed.begin(), allowed.end(), now.begin(), now.end()) &&
        depth.system().least_jacobian(points) >= least_jacobian_allowed)
      return;
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = 0.5 * (points[i] + safe[i]);
  }
  points = safe;
}

}  // namespace

void validate(const RegistrationOptions& options) {
  check_cage_options(options.depth, options.margin, options.max_angle_deg, options.energy);
  if (!(options.data_weight >= 1e-9 && options.data_weight <= 1e9))
    refuse_registration("the weight of distances must be positive");
  if (options.most_points < 100) refuse_registration("surfaces must keep 100 points at least");
  if (options.most_rounds < 1 || options.most_rounds > 1000)
    refuse_registration("the rounds must be 1 to 1000");
}

Registration register_cage(const TriMesh& source, const TriMesh& target, const RegistrationOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  check_surfaces(source, target);
  const auto most = static_cast<std::size_t>(options.most_points);
  const TriMesh thin_target = thinned(target, most), thin = thinned(source, most);
  const PairingTarget prepared(thin_target);
  Registration result;
  result.grid = geometry::cage_around(source.points, 1, options.margin);
  Points points = options.start.empty() ? rest_points(result.grid) : every_nth(options, result.grid);
  const Pairs allowed = geometry::self_intersections(source),
              allowed_thin = geometry::self_intersections(thin);
  result.report.source_self_intersections = allowed.size();
  for (int d = 1; d <= options.depth; ++d) {
    if (d > 1) {
      points = refined(result.grid, points);
      result.grid = refined(result.grid);
    }
    const Depth depth(thin, prepared, result.grid, options);
    const Points safe = points;
    const double looseness = std::exp2(2.0 * (options.depth - d));
    for (int k = 0; k < options.most_rounds; ++k) {
      task.throw_if_cancelled();
      if (depth.round(points, looseness, result.report) < still_mm) break;
    }
    if (d < options.depth) {
      take_back(
          depth, [&](const Points& p) { return depth.surface(p); }, safe, allowed_thin, points, task);
      continue;
    }
    const std::vector<geometry::CagePoint> places = cage_points(result.grid, source.points);
    const auto whole = [&](const Points& p) { return carried_mesh(source, places, result.grid, p); };
    take_back(depth, whole, safe, allowed, points, task);
    result.report.least_jacobian = depth.system().least_jacobian(points);
    result.surface = whole(points);
    result.report.self_intersections = geometry::self_intersections(result.surface).size();
  }
  result.control_points = std::move(points);
  return result;
}

}  // namespace ostia::motion
