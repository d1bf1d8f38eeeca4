#include "ostia/analysis/branch_sections.h"

#include "branches/branch_tubes.h"
#include "branches/plane_outline.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace ostia::analysis {
namespace {

using geometry::Centerline;
using geometry::LinePlace;
using geometry::LineWay;

constexpr double inside_radii = 1e-4;

/// Where a plane stands across a branch.
struct Stand {
  Vec3 point, normal;
  double radius = 0.0;
};

/// The mean of places on the branch's lines; some lines may have none.
std::optional<Stand> stand_at(const std::vector<const BranchTract*>& tracts,
                              const std::vector<std::optional<LinePlace>>& places) {
  WeightedPlace point, direction;
  double widest = 0.0;
  for (std::size_t i = 0; i < tracts.size(); ++i) {
    if (!places[i]) continue;
    const Centerline& axis = tracts[i]->axis;
    const double radius = geometry::value_at(axis.radius, *places[i]);
    point.add(geometry::value_at(axis.points, *places[i]), radius);
    direction.add(geometry::direction_at(axis, *places[i]), radius);
    widest = std::max(widest, radius);
  }
  if (point.empty() || !(direction.mean().norm() > 0.0)) return std::nullopt;
  return Stand{point.mean(), direction.mean().normalized(), widest};
}

/// Where two tubes are equally deep between two neighbours of an outline.
Vec3 equally_deep(const BranchTubes& tubes, std::int32_t group, std::int32_t other, const Vec3& own,
                  const Vec3& foreign) {
  const double here = tubes.value(other, own) - tubes.value(group, own);
  const double there = tubes.value(group, foreign) - tubes.value(other, foreign);
  const double sum = here + there;
  return sum > 0.0 ? Vec3(own + std::clamp(here / sum, 0.0, 1.0) * (foreign - own)) : own;
}

/// The parts of an outline that belong to a branch.
std::vector<PlaneOutline> own_parts(const PlaneOutline& outline, const BranchTubes& tubes,
                                    std::int32_t group) {
  const std::vector<std::int32_t> owners = tubes.nearest(outline.points);
  const auto mine = [&](std::size_t i) { return owners[i] == group; };
  const std::size_t n = owners.size();
  const auto own_count = static_cast<std::size_t>(std::count(owners.begin(), owners.end(), group));
  if (own_count == n) return {outline};
  // A closed line is walked from a foreign place on, so that no part is in two pieces.
  std::size_t start = 0;
  while (outline.closed && own_count > 0 && mine(start)) ++start;
  std::vector<PlaneOutline> parts;
  const std::size_t steps = outline.closed ? n + 1 : n;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t i = (start + k) % n, before = (start + k + n - 1) % n;
    const bool first = k == 0;
    if (mine(i)) {
      if (first || !mine(before)) {
        parts.push_back({});
        if (!first)
          parts.back().points.push_back(
              equally_deep(tubes, group, owners[before], outline.points[i], outline.points[before]));
      }
      parts.back().points.push_back(outline.points[i]);
    } else if (!first && mine(before)) {
      parts.back().points.push_back(
          equally_deep(tubes, group, owners[i], outline.points[before], outline.points[i]));
    }
  }
  return parts;
}

class WallSections {
 public:
  WallSections(const geometry::TriMesh& wall, const geometry::BranchedLines& lines)
      : wall_(wall), tracts_(lines), tubes_(tracts_) {}

  const BranchTracts& tracts() const { return tracts_; }

  /// None where the plane meets no wall of the branch. An axis begins and ends in the plane of an open end:
  /// there it is cut a little inside.
  std::optional<BranchSection> section(std::int32_t group, std::int32_t spheres, const Stand& stand) const {
    for (const double inside : {0.0, inside_radii, -inside_radii}) {
      const Vec3 origin = stand.point + inside * stand.radius * stand.normal;
      const std::optional<PlaneOutline> found = outline_of(group, origin, stand.normal);
      if (!found) continue;
      const PolygonMeasures m = polygon_measures(*found, stand.point, stand.normal);
      return BranchSection{group,         spheres,    stand.point,    stand.normal, found->points,
                           found->closed, m.area_mm2, m.perimeter_mm, m.min_mm,     m.max_mm};
    }
    return std::nullopt;
  }

 private:
  std::optional<PlaneOutline> outline_of(std::int32_t group, const Vec3& origin, const Vec3& normal) const {
    std::optional<PlaneOutline> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const PlaneOutline& outline : plane_outlines(wall_, origin, normal)) {
      if (distance_to(outline, origin) >= nearest) continue;
      for (PlaneOutline& part : own_parts(outline, tubes_, group)) {
        const double distance = distance_to(part, origin);
        if (part.points.size() < 3 || distance >= nearest) continue;
        nearest = distance;
        best = std::move(part);
      }
    }
    return best;
  }

  const geometry::TriMesh& wall_;
  BranchTracts tracts_;
  BranchTubes tubes_;
};

void add_branch_sections(const WallSections& sections, std::int32_t group, std::int32_t apart,
                         std::vector<BranchSection>& out, std::size_t& missed) {
  const std::vector<const BranchTract*>& tracts = sections.tracts().distinct(group);
  std::vector<std::vector<LinePlace>> steps;
  std::size_t most = 0;
  for (const BranchTract* tract : tracts) {
    steps.push_back(geometry::sphere_steps(tract->axis, {}));
    most = std::max(most, steps.back().size());
  }
  for (std::size_t k = 0; k < most; k += static_cast<std::size_t>(apart)) {
    std::vector<std::optional<LinePlace>> places(tracts.size());
    for (std::size_t i = 0; i < tracts.size(); ++i)
      if (k < steps[i].size()) places[i] = steps[i][k];
    const std::optional<Stand> stand = stand_at(tracts, places);
    if (!stand) continue;
    auto one = sections.section(group, static_cast<std::int32_t>(k), *stand);
    if (one)
      out.push_back(std::move(*one));
    else
      ++missed;
  }
}

void add_bifurcation_section(const WallSections& sections, std::int32_t bifurcation, std::int32_t group,
                             LineWay way, std::int32_t spheres, std::vector<BifurcationSection>& out,
                             std::size_t& missed) {
  const std::vector<const BranchTract*>& tracts = sections.tracts().distinct(group);
  std::vector<std::optional<LinePlace>> places;
  for (const BranchTract* tract : tracts) {
    const bool up = way == LineWay::upstream;
    std::optional<LinePlace> at = up ? LinePlace{tract->axis.size() - 1, 0.0} : LinePlace{};
    for (std::int32_t k = 0; at && k < spheres; ++k) at = geometry::touching_place(tract->axis, *at, way);
    places.push_back(at);
  }
  const std::optional<Stand> stand = stand_at(tracts, places);
  if (!stand) return;  // the branch is shorter
  auto one = sections.section(group, spheres, *stand);
  if (one)
    out.push_back({std::move(*one), bifurcation, way == LineWay::downstream});
  else
    ++missed;
}

}  // namespace

void validate(const SectionOptions& options) {
  for (const auto& [name, value] : {std::pair("spheres_apart", options.spheres_apart),
                                    std::pair("bifurcation_spheres", options.bifurcation_spheres)})
    if (value < 1)
      throw InvalidInput(std::string("sections: ") + name + " is " + std::to_string(value) +
                         "; give 1 or more");
}

SurfaceSections branch_sections(const geometry::TriMesh& wall, const geometry::BranchedLines& lines,
                                const SectionOptions& options, const core::TaskContext& task) {
  validate(options);
  if (lines.lines.empty()) throw InvalidInput("there are no lines across which sections could stand");
  if (wall.triangles.empty()) throw InvalidInput("the wall has no triangles that sections could cut");
  const WallSections sections(wall, lines);
  SurfaceSections out;
  std::size_t missed = 0;
  const std::vector<std::int32_t>&branches = sections.tracts().groups(false),
        &bifurcations = sections.tracts().groups(true);
  const double all = static_cast<double>(branches.size() + bifurcations.size());
  double done = 0.0;
  for (const std::int32_t group : branches) {
    task.throw_if_cancelled();
    add_branch_sections(sections, group, options.spheres_apart, out.branches, missed);
    task.set_progress(++done / all);
  }
  for (const std::int32_t group : bifurcations) {
    task.throw_if_cancelled();
    for (const LineWay way : {LineWay::upstream, LineWay::downstream})
      for (const std::int32_t branch : sections.tracts().neighbours(group, way))
        add_bifurcation_section(sections, group, branch, way, options.bifurcation_spheres, out.bifurcations,
                                missed);
    task.set_progress(++done / all);
  }
  if (missed > 0)
    out.warnings.push_back(std::to_string(missed) +
                           " planes across branches meet no wall of their branch and have no section");
  return out;
}

}  // namespace ostia::analysis
