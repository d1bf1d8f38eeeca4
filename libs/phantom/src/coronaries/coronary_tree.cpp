#include "ostia/phantom/coronary_tree.h"

#include "coronaries/coronary_calibre.h"
#include "coronaries/coronary_courses.h"
#include "coronaries/coronary_disease.h"
#include "coronaries/coronary_segments.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace ostia::phantom {
namespace {

using geometry::Centerline;

constexpr int attempts = 12;
constexpr double bend_in_radii = 3.0;  ///< least radius of curvature
constexpr double clear_mm = 1.2;       ///< least distance between outer walls away from bifurcations

double crux_abscissa(const HeartShape& heart, const Centerline& axis) {
  return geometry::closest(axis.points, heart.epicardium(heart.posterior_groove_rad, 0.02, 4.0)).abscissa;
}

const Course* find(const std::vector<Course>& courses, const std::string& name) {
  for (const Course& c : courses) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

/// The largest radius a course may have anywhere, for the test of distances.
double bound_of(const std::vector<Course>& courses, const Course& course) {
  const Course* parent = find(courses, course.parent);
  constexpr double taper = 0.85;  // what parents have lost where their branches leave
  return parent == nullptr ? course.start_radius_mm
                           : taper * course.start_radius_mm * bound_of(courses, *parent);
}

/// A drawn axis with bounds of its radius at both ends.
struct Bounded {
  const Centerline& axis;
  double start_mm, end_mm;
  double radius(std::size_t i) const {
    return start_mm + (end_mm - start_mm) * axis.abscissa[i] / axis.abscissa.back();
  }
};

/// Whether a vessel, from `skip_mm` on, comes too near to another that it does not spring from (or springs
/// from, but away from there).
bool collides(const Bounded& vessel, const Bounded& other, double skip_mm) {
  constexpr double walls_mm = 1.2;  // both, about
  for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
    if (vessel.axis.abscissa[i] < skip_mm) continue;
    const double most = vessel.radius(i) + other.start_mm + other.end_mm + walls_mm + clear_mm;
    for (std::size_t j = 0; j < other.axis.size();) {
      const double reach = vessel.radius(i) + other.radius(j) + walls_mm + clear_mm;
      const double distance = (vessel.axis.points[i] - other.axis.points[j]).norm();
      if (distance < reach) return true;
      j += 5 + static_cast<std::size_t>(std::max(0.0, distance - most) / 0.1);  // points are 0.1 mm apart
    }
  }
  return false;
}

/// Axes of all courses, each drawn again until it keeps clear of those before it; what may be left out and
/// cannot is.
std::vector<std::pair<Course, Centerline>> draw_axes(const HeartShape& heart, const CoursePlan& plan,
                                                     std::uint64_t seed) {
  std::vector<std::pair<Course, Centerline>> out;
  for (Course course : plan.courses) {
    const Centerline* parent = nullptr;
    std::optional<Vec3> end;
    for (const auto& [known, axis] : out) {
      if (known.name == course.parent) parent = &axis;
      if (known.name == course.joins) end = axis.points[axis.size() / 2];
    }
    if (!course.parent.empty() && parent == nullptr) continue;
    if (course.parent_s_mm == at_crux)
      course.parent_s_mm = std::min(crux_abscissa(heart, *parent), parent->abscissa.back() - 6.0);
    if (parent != nullptr && course.parent_s_mm > parent->abscissa.back() - 5.0) continue;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      Centerline axis = draw_axis(heart, course, parent, bend_in_radii * bound_of(plan.courses, course),
                                  seed + 7919ULL * static_cast<std::uint64_t>(attempt), end);
      const bool last = attempt + 1 == attempts;
      const bool clear = std::none_of(out.begin(), out.end(), [&](const auto& other) {
        const bool related =
            other.first.name == course.parent ||
            (other.first.parent == course.parent &&
             std::abs(other.first.parent_s_mm - course.parent_s_mm) < 6.0 && parent != nullptr);
        return collides({axis, bound_of(plan.courses, course), course.end_radius_mm},
                        {other.second, bound_of(plan.courses, other.first), other.first.end_radius_mm},
                        related ? 11.0 : 0.0);
      });
      if (!clear && !(last && course.keep)) continue;
      out.emplace_back(course, std::move(axis));
      break;
    }
  }
  return out;
}

}  // namespace

const char* word(PlaqueKind kind) {
  switch (kind) {
    case PlaqueKind::soft:
      return "soft";
    case PlaqueKind::fibrous:
      return "fibrous";
    case PlaqueKind::calcified:
      return "calcified";
    case PlaqueKind::mixed:
      return "mixed";
  }
  return "";
}

CoronaryTree draw_coronaries(const HeartShape& heart, const CoronaryOptions& options) {
  if (!(options.disease >= 0.0 && options.disease <= 10.0))
    throw InvalidInput("disease must lie in [0, 10], not " + std::to_string(options.disease));
  if (!(options.calibre >= 0.5 && options.calibre <= 1.3))
    throw InvalidInput("calibre must lie in [0.5, 1.3], not " + std::to_string(options.calibre));
  CoursePlan plan = plan_courses(heart, options.seed);
  change_origins(plan, heart, options.anatomy);
  CoronaryTree tree;
  tree.dominance = plan.dominance;
  const auto drawn = draw_axes(heart, plan, options.seed);
  for (const auto& [course, axis] : drawn) {
    CoronaryVessel vessel;
    vessel.id = static_cast<std::int32_t>(tree.vessels.size());
    vessel.name = course.name;
    for (const CoronaryVessel& v : tree.vessels) {
      if (v.name == course.parent) vessel.parent = v.id;
    }
    vessel.parent_s_mm = vessel.parent < 0 ? 0.0 : course.parent_s_mm;
    vessel.axis = axis;
    std::vector<BranchShare> branches;
    for (const auto& [other, unused] : drawn) {
      if (other.parent == course.name) branches.push_back({other.parent_s_mm, other.start_radius_mm});
    }
    const double start = vessel.parent < 0
                             ? options.calibre * course.start_radius_mm
                             : course.start_radius_mm *
                                   radius_before_branch(tree.vessels[static_cast<std::size_t>(vessel.parent)],
                                                        course.parent_s_mm);
    set_calibre(vessel, start, options.calibre * course.end_radius_mm, course.taper_power, branches,
                options.seed);
    tree.vessels.push_back(std::move(vessel));
  }
  for (CoronaryVessel& vessel : tree.vessels) {
    if (vessel.parent >= 0)
      vessel.s_free_mm = free_abscissa(vessel, tree.vessels[static_cast<std::size_t>(vessel.parent)]);
    add_segments(vessel, tree, tree.dominance);
  }
  draw_disease(tree, options.disease, options.seed);
  return tree;
}

geometry::VesselTree vessel_tree(const CoronaryTree& tree) {
  geometry::VesselTree out;
  std::int32_t next_segment = 1;
  std::map<std::int32_t, std::vector<std::int32_t>> path;  // vessel -> segments so far from its ostium
  // Cut each axis where branches leave, so that segments join at nodes.
  std::map<std::int32_t, std::map<double, std::int32_t>> nodes_on;  // vessel -> abscissa -> node
  const auto add_node = [&](const Vec3& p) {
    const auto id = static_cast<std::int32_t>(out.nodes.size()) + 1;
    out.nodes.push_back({id, p});
    return id;
  };
  std::map<std::int32_t, std::map<double, std::vector<std::int32_t>>>
      prefix;  // segments from the root to a node
  for (const CoronaryVessel& vessel : tree.vessels) {
    const Centerline& axis = vessel.axis;
    std::vector<std::size_t> cuts{0, axis.size() - 1};
    for (const CoronaryVessel& child : tree.vessels) {
      if (child.parent != vessel.id) continue;
      const auto at = std::lower_bound(axis.abscissa.begin(), axis.abscissa.end(), child.parent_s_mm) -
                      axis.abscissa.begin();
      cuts.push_back(std::clamp<std::size_t>(static_cast<std::size_t>(at), 1, axis.size() - 2));
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    std::vector<std::int32_t> chain;
    std::int32_t from = 0;
    if (vessel.parent < 0) {
      from = add_node(axis.points[0]);
    } else {
      const auto& known = nodes_on[vessel.parent];
      auto nearest = known.begin();
      for (auto it = known.begin(); it != known.end(); ++it) {
        if (std::abs(it->first - vessel.parent_s_mm) < std::abs(nearest->first - vessel.parent_s_mm))
          nearest = it;
      }
      from = nearest->second;
      chain = prefix[vessel.parent][nearest->first];
    }
    nodes_on[vessel.id][0.0] = from;
    prefix[vessel.id][0.0] = chain;
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      geometry::TreeSegment segment;
      segment.id = next_segment++;
      segment.from = from;
      for (std::size_t i = cuts[c]; i <= cuts[c + 1]; ++i) {
        segment.axis.points.push_back(axis.points[i]);
        segment.axis.radius.push_back(axis.radius[i]);
      }
      if (c == 0) {  // the branch's axis begins on its parent's, within a step of the node
        const Vec3 node_at = out.nodes[static_cast<std::size_t>(from - 1)].position;
        if ((segment.axis.points[0] - node_at).norm() > 1e-9) {
          if ((segment.axis.points[1] - node_at).norm() > 1e-6) segment.axis.points[0] = node_at;
        }
      }
      from = add_node(axis.points[cuts[c + 1]]);
      segment.to = from;
      geometry::complete(segment.axis, axis.frames[cuts[c]].normal);
      chain.push_back(segment.id);
      nodes_on[vessel.id][axis.abscissa[cuts[c + 1]]] = from;
      prefix[vessel.id][axis.abscissa[cuts[c + 1]]] = chain;
      out.segments.push_back(std::move(segment));
    }
    out.vessels.push_back({vessel.id + 1, vessel.name, chain});
  }
  return out;
}

}  // namespace ostia::phantom
