#include "ostia/motion/cage_registration.h"

#include "cage_system.h"
#include "registration_parts.h"
#include "vertex_clustering.h"

#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ostia::motion {
namespace {

using geometry::CageGrid;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double still_mm = 0.01;                                   // a step below ends the last depth
constexpr double strained_jacobian = 0.05, fine_distance_mm = 0.1;  // see is_stuck
constexpr double careful_weight = 0.1;  // of the distances, when a registration is repeated
constexpr double point_share = 0.05;  // of a pair's weight, for all directions; the rest is along the normal

/// Where a depth's rounds end, and how much of the surfaces they look at.
struct Schedule {
  double looseness, still_mm;
  std::size_t every;
};
Schedule schedule_of(int depth, int last) {
  const int left = last - depth;
  return {std::exp2(2.0 * left), still_mm * std::exp2(left), std::size_t{1} << std::min(left, 2)};
}

/// One depth of the hierarchy.
class Depth {
 public:
  Depth(PairedSurface& source, PairedSurface& target, const CageGrid& grid,
        const RegistrationOptions& options)
      : source_(source),
        target_(target),
        grid_(grid),
        max_angle_deg_(options.max_angle_deg),
        system_(grid, source.at_rest, {options.energy, true, options.data_weight, point_share}),
        places_(cage_points(grid, source.at_rest.points)) {}

  const CageSystem& system() const { return system_; }

  /// Of the surfaces as they lie now, all points.
  void tell(const Points& points, RegistrationReport& report) {
    source_.move(carried_points(places_, grid_, points));
    tell_pairs(source_.at_rest, surface_pairs(source_, target_, grid_, {max_angle_deg_, 1.0, 1}), report);
  }

  /// Returns the largest way that a control point has gone.
  double round(Points& points, const Schedule& schedule, RegistrationReport& report) {
    source_.move(carried_points(places_, grid_, points));
    const std::vector<SurfacePair> pairs =
        surface_pairs(source_, target_, grid_, {max_angle_deg_, schedule.looseness, schedule.every});
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
  PairedSurface &source_, &target_;
  CageGrid grid_;
  double max_angle_deg_;
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

Points at_depth(CageGrid grid, Points points, int cells) {
  for (; grid.cells < cells; grid = refined(grid)) points = refined(grid, points);
  return points;
}

Points halfway(Points from, const Points& to) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = 0.5 * (from[i] + to[i]);
  return from;
}

/// What the depths began with, each with its own grid.
struct Stage {
  CageGrid grid;
  Points points;
};
/// Half of the way back to where the last depth began, again and again, until no triangles of the whole
/// surface intersect but those of `allowed`, then towards where the depths before began, at last to rest.
void take_back(const TriMesh& source, const Pairs& allowed, const std::vector<Stage>& stages,
               const CageSystem& system, const core::TaskContext& task, Registration& result) {
  const std::vector<geometry::CagePoint> places = cage_points(result.grid, source.points);
  const auto sound = [&] {
    task.throw_if_cancelled();
    if (system.least_jacobian(result.control_points) < least_jacobian_allowed) return false;
    result.surface = carried_mesh(source, places, result.grid, result.control_points);
    const Pairs now = geometry::self_intersections(result.surface);
    result.report.self_intersections = now.size();
    return std::includes(allowed.begin(), allowed.end(), now.begin(), now.end());
  };
  for (auto stage = stages.rbegin(); stage != stages.rend(); ++stage) {
    const Points safe = at_depth(stage->grid, stage->points, result.grid.cells);
    for (int k = 0; k < most_halvings; ++k) {
      if (sound()) return;
      result.control_points = halfway(result.control_points, safe);
    }
    result.control_points = safe;
  }
  if (sound()) return;
  result.control_points = rest_points(result.grid);
  result.surface = source;
  result.report.self_intersections = allowed.size();
}

/// Through all depths once.
Registration through_depths(const TriMesh& source, const TriMesh& target, const RegistrationOptions& options,
                            const core::TaskContext& task) {
  const auto most = static_cast<std::size_t>(options.most_points);
  const TriMesh thin_source = clustered(source, most), thin_target = clustered(target, most);
  PairedSurface from(thin_source), to(thin_target);
  Registration result;
  result.grid = geometry::cage_around(source.points, 1, options.margin);
  Points& points = result.control_points;
  points = options.start.empty() ? rest_points(result.grid) : every_nth(options, result.grid);
  std::vector<Stage> stages;
  for (int d = 1; d <= options.depth; ++d) {
    if (d > 1) {
      points = refined(result.grid, points);
      result.grid = refined(result.grid);
    }
    Depth depth(from, to, result.grid, options);
    // A start that bends the fine cells alone may fold the coarse ones.
    for (int k = 0; d == 1 && depth.system().least_jacobian(points) < least_jacobian_allowed; ++k)
      points = k < most_halvings ? halfway(points, rest_points(result.grid)) : rest_points(result.grid);
    stages.push_back({result.grid, points});
    const Schedule schedule = schedule_of(d, options.depth);
    for (int k = 0; k < options.most_rounds; ++k) {
      task.throw_if_cancelled();
      if (depth.round(points, schedule, result.report) < schedule.still_mm) break;
    }
    if (d < options.depth) continue;
    const Pairs allowed = geometry::self_intersections(source);
    result.report.source_self_intersections = allowed.size();
    take_back(source, allowed, stages, depth.system(), task, result);
    result.report.least_jacobian = depth.system().least_jacobian(points);
    depth.tell(points, result.report);
  }
  return result;
}

}  // namespace

bool is_stuck(const RegistrationReport& report) {
  return report.least_jacobian < strained_jacobian && report.mean_distance_mm > fine_distance_mm;
}

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
  Registration best = through_depths(source, target, options, task);
  if (!is_stuck(best.report)) return best;
  // Pairs that are wrong at first, as where a branch is lost near another one, press cells less when they
  // weigh less; from there on they are right.
  RegistrationOptions again = options;
  again.data_weight *= careful_weight;
  again.start = through_depths(source, target, again, task).control_points;
  again.data_weight = options.data_weight;
  Registration other = through_depths(source, target, again, task);
  const bool better = other.report.mean_distance_mm < best.report.mean_distance_mm &&
                      other.report.paired_share >= best.report.paired_share;
  return better ? other : best;
}

}  // namespace ostia::motion
