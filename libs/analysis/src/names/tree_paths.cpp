#include "names/tree_paths.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <map>
#include <set>

namespace ostia::analysis {
namespace {

template <class Value>
Value interpolated(const std::vector<double>& s_mm, const std::vector<Value>& values, double s) {
  if (s <= s_mm.front()) return values.front();
  if (s >= s_mm.back()) return values.back();
  const auto upper = static_cast<std::size_t>(std::upper_bound(s_mm.begin(), s_mm.end(), s) - s_mm.begin());
  const double t = (s - s_mm[upper - 1]) / (s_mm[upper] - s_mm[upper - 1]);
  return (1.0 - t) * values[upper - 1] + t * values[upper];
}

void make_names_differ(std::vector<BranchPath>& paths) {
  std::map<std::string, int> count;
  for (const BranchPath& path : paths) ++count[path.name];
  std::set<std::string> used;
  for (BranchPath& path : paths) {
    if (count[path.name] > 1) path.name += " (" + std::to_string(path.vessel) + ")";
    while (!used.insert(path.name).second) path.name += "'";
  }
}

}  // namespace

std::vector<BranchPath> branch_paths(const geometry::VesselTree& tree) {
  std::vector<BranchPath> paths;
  std::set<std::int32_t> owned;
  for (const geometry::Vessel& vessel : tree.vessels) {
    BranchPath path{vessel.id, vessel.name.empty() ? "vessel " + std::to_string(vessel.id) : vessel.name, {}};
    for (const std::int32_t id : vessel.segments)
      if (owned.insert(id).second) path.segments.push_back(&geometry::segment(tree, id));
    if (!path.segments.empty()) paths.push_back(std::move(path));
  }
  for (const geometry::TreeSegment& one : tree.segments)
    if (owned.insert(one.id).second) paths.push_back({0, "segment " + std::to_string(one.id), {&one}});
  make_names_differ(paths);
  return paths;
}

geometry::Centerline joined(const BranchPath& path, std::vector<std::size_t>* node_points) {
  geometry::Centerline line;
  for (const geometry::TreeSegment* segment : path.segments) {
    const std::size_t skip = line.points.empty() ? 0 : 1;
    if (node_points != nullptr && skip == 0) node_points->push_back(0);
    const geometry::Centerline& axis = segment->axis;
    line.points.insert(line.points.end(), axis.points.begin() + static_cast<std::ptrdiff_t>(skip),
                       axis.points.end());
    line.radius.insert(line.radius.end(), axis.radius.begin() + static_cast<std::ptrdiff_t>(skip),
                       axis.radius.end());
    if (node_points != nullptr) node_points->push_back(line.points.size() - 1);
  }
  line.abscissa = geometry::abscissas(line.points);
  return line;
}

std::vector<Joint> joints_of(const std::vector<BranchPath>& paths,
                             const std::vector<std::vector<double>>& node_s,
                             const std::vector<MovingBranch>& branches) {
  std::map<std::int32_t, Joint> at_node;
  for (const bool distal : {false, true})
    for (std::size_t b = 0; b < paths.size(); ++b)
      for (std::size_t k = 0; k < paths[b].segments.size(); ++k) {
        const geometry::TreeSegment& segment = *paths[b].segments[k];
        const std::int32_t node = distal ? segment.from : segment.to;
        const double s = node_s[b][distal ? k : k + 1];
        Joint& joint = at_node[node];
        joint.node = node;
        joint.arms.push_back({b, s, distal});
        joint.radius_mm = std::max(joint.radius_mm, at_abscissa(branches[b].s_mm, branches[b].radius_mm, s));
      }
  std::vector<Joint> joints;
  for (auto& [node, joint] : at_node)
    if (std::any_of(joint.arms.begin(), joint.arms.end(),
                    [&](const JointArm& arm) { return arm.branch != joint.arms.front().branch; }))
      joints.push_back(std::move(joint));
  return joints;
}

double at_abscissa(const std::vector<double>& s_mm, const std::vector<double>& values, double s) {
  return interpolated(s_mm, values, s);
}

Vec3 at_abscissa(const std::vector<double>& s_mm, const std::vector<Vec3>& values, double s) {
  return interpolated(s_mm, values, s);
}

}  // namespace ostia::analysis
