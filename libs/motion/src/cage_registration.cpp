#include "ostia/motion/cage_registration.h"

#include "cage_system.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::motion {
namespace {

using geometry::CageGrid;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double least_jacobian = 0.02;  // of what a cell may become
constexpr double still_mm = 0.01;        // a step below ends a depth
constexpr int most_halvings = 12;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("cannot register a surface: " + what);
}

TriMesh carried_mesh(const TriMesh& mesh, const std::vector<geometry::CagePoint>& places,
                     const CageGrid& grid, const Points& control_points) {
  TriMesh out;
  out.triangles = mesh.triangles;
  out.points.reserve(places.size());
  for (const geometry::CagePoint& p : places) out.points.push_back(carried(grid, p, control_points));
  return out;
}

/// One depth of the hierarchy.
class Depth {
 public:
  Depth(const TriMesh& source, const PairingTarget& target, const CageGrid& grid,
        const RegistrationOptions& options)
      : source_(source),
        target_(target),
        grid_(grid),
        options_(options),
        system_(grid, source, options.energy, options.data_weight) {
    for (const Vec3& p : source.points) places_.push_back(cage_point(grid, p));
  }

  TriMesh surface(const Points& points) const { return carried_mesh(source_, places_, grid_, points); }
  const CageSystem& system() const { return system_; }

  /// Returns the largest way that a control point has gone.
  double round(Points& points, double looseness, RegistrationReport& report) const {
    const std::vector<SurfacePair> pairs =
        surface_pairs(surface(points), source_, grid_, target_, options_.max_angle_deg, looseness);
    tell(pairs, report);
    ++report.rounds;
    const Points step = system_.step(points, pairs);
    const double before = system_.energy(points, pairs);
    double share = 1.0;
    for (int k = 0; k < most_halvings; ++k, share /= 2.0) {
      Points moved = points;
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += share * step[i];
      system_.follow(moved);
      if (system_.least_jacobian(moved) < least_jacobian) continue;
      if (system_.energy(moved, pairs) >= before) continue;
      double way = 0.0;
      for (std::size_t i = 0; i < moved.size(); ++i) way = std::max(way, (moved[i] - points[i]).norm());
      points = std::move(moved);
      return way;
    }
    return 0.0;
  }

 private:
  void tell(const std::vector<SurfacePair>& pairs, RegistrationReport& report) const {
    const std::vector<double> areas = point_areas(source_);
    double all = 0.0, paired = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < source_.points.size(); ++i) {
      all += areas[i];
      if (pairs[i].weight <= 0.0) continue;
      paired += areas[i];
      sum += areas[i] * pairs[i].distance;
    }
    report.paired_share = paired / all;
    report.mean_distance_mm = paired > 0.0 ? sum / paired : 0.0;
  }

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
  if (options.start.size() != fine.point_count()) refuse("the start is of a cage of another depth");
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
void take_back(const Depth& depth, const Points& safe, const Pairs& allowed, Points& points,
               const core::TaskContext& task) {
  for (int k = 0; k < most_halvings; ++k) {
    task.throw_if_cancelled();
    const Pairs now = geometry::self_intersections(depth.surface(points));
    if (std::includes(allowed.begin(), allowed.end(), now.begin(), now.end()) &&
        depth.system().least_jacobian(points) >= least_jacobian)
      return;
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = 0.5 * (points[i] + safe[i]);
  }
  points = safe;
}

}  // namespace

void validate(const RegistrationOptions& options) {
  const auto bad = [](double v, double low, double high) { return !(v >= low && v <= high); };
  if (options.depth < 1 || options.depth > 5) refuse("the depth must be 1 to 5");
  if (bad(options.margin, 0.01, 10.0)) refuse("the margin must be 0.01 to 10");
  if (bad(options.max_angle_deg, 1e-3, 180.0))
    refuse("the angle between normals must be above 0, up to 180 degrees");
  for (const double w : {options.energy.length, options.energy.area, options.energy.volume})
    if (bad(w, 0.0, 1e9)) refuse("the energy's weights must be 0 to 1e9");
  if (options.energy.length <= 0.0) refuse("the weight of lengths must be positive");
  if (bad(options.data_weight, 1e-9, 1e9)) refuse("the weight of distances must be positive");
  if (options.most_rounds < 1 || options.most_rounds > 1000) refuse("the rounds must be 1 to 1000");
}

Registration register_cage(const TriMesh& source, const TriMesh& target, const RegistrationOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  if (source.triangles.empty() || target.triangles.empty()) refuse("one of the two has no triangles");
  const PairingTarget prepared(target);
  Registration result;
  result.grid = geometry::cage_around(source.points, 1, options.margin);
  Points points = options.start.empty() ? rest_points(result.grid) : every_nth(options, result.grid);
  const Pairs allowed = geometry::self_intersections(source);
  result.report.source_self_intersections = allowed.size();
  for (int d = 1; d <= options.depth; ++d) {
    if (d > 1) {
      points = refined(result.grid, points);
      result.grid = refined(result.grid);
    }
    const Depth depth(source, prepared, result.grid, options);
    const Points safe = points;
    const double looseness = std::exp2(2.0 * (options.depth - d));
    for (int k = 0; k < options.most_rounds; ++k) {
      task.throw_if_cancelled();
      if (depth.round(points, looseness, result.report) < still_mm) break;
    }
    take_back(depth, safe, allowed, points, task);
    if (d < options.depth) continue;
    result.report.least_jacobian = depth.system().least_jacobian(points);
    result.surface = depth.surface(points);
    result.report.self_intersections = geometry::self_intersections(result.surface).size();
  }
  result.control_points = std::move(points);
  return result;
}

}  // namespace ostia::motion
