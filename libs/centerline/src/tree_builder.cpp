#include "ostia/centerline/tree_builder.h"

#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

// A point of a chain.
struct ChainPoint {
  std::int32_t chain = 0;
  std::size_t index = 0;
};

// All points of the chains so far, for nearest-point queries.
struct Cloud {
  std::vector<Vec3> points;
  std::vector<ChainPoint> owners;

  void add(const Axis& axis, std::int32_t chain, std::size_t first) {
    for (std::size_t i = first; i < axis.points.size(); ++i) {
      points.push_back(axis.points[i]);
      owners.push_back({chain, i});
    }
  }
};

Axis tail_of(const Axis& path, std::size_t first) {
  Axis axis;
  axis.points.assign(path.points.begin() + static_cast<std::ptrdiff_t>(first), path.points.end());
  axis.radius.assign(path.radius.begin() + static_cast<std::ptrdiff_t>(first), path.radius.end());
  return axis;
}

// The path from point `first` on, led over from its parent's point to its own course within two radii.
Axis branch_of(const Axis& path, std::size_t first, const Vec3& joint, double joint_radius) {
  Axis axis = tail_of(path, first);
  const Vec3 jump = joint - axis.points.front();
  const double reach = 2.0 * axis.radius.front();
  const std::vector<double> s = geometry::abscissas(axis.points);
  for (std::size_t i = 0; i + 1 < axis.points.size(); ++i) {
    const double t = s[i] / std::min(reach, s.back());
    if (t >= 1.0) break;
    axis.points[i] += (1.0 - t * t * (3.0 - 2.0 * t)) * jump;
  }
  axis.points.front() = joint;
  axis.radius.front() = joint_radius;
  return axis;
}

// Bifurcations closer than this many points to a chain's end or to each other are one.
constexpr std::size_t snap_points = 2;

// Indices at which chains are cut, ascending, from first to last point.
class Cuts {
 public:
  explicit Cuts(std::size_t count) : last_(count - 1), at_{0, count - 1} {}

  // The cut that serves for a node at point `index`; made where there is none near.
  std::size_t cut(std::size_t index) {
    if (index <= snap_points) return 0;
    if (index + snap_points >= last_) return last_;
    const auto after = at_.lower_bound(index > snap_points ? index - snap_points : 0);
    if (after != at_.end() && *after <= index + snap_points) return *after;
    at_.insert(index);
    return index;
  }
  const std::set<std::size_t>& all() const { return at_; }

 private:
  std::size_t last_;
  std::set<std::size_t> at_;
};

class TreeMaker {
 public:
  TreeMaker(const ChainTree& chains, double step_mm) : chains_(chains), step_mm_(step_mm) {
    for (const Chain& chain : chains.chains) {
      starts_.push_back(chain.parent < 0 ? 0 : cuts_[static_cast<std::size_t>(chain.parent)].cut(chain.at));
      cuts_.emplace_back(chain.axis.points.size());
    }
    for (const auto& [chain, index] : chains.ends)
      ends_.push_back(cuts_[static_cast<std::size_t>(chain)].cut(index));
  }

  SplitTree make(const std::vector<std::string>& names) {
    for (std::size_t c = 0; c < chains_.chains.size(); ++c) add_chain(c);
    SplitTree result;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const std::int32_t end = nodes_.at({static_cast<std::size_t>(chains_.ends[i].first), ends_[i]});
      result.target_segments.push_back(segments_to(end));
      const bool passed = std::any_of(tree_.segments.begin(), tree_.segments.end(),
                                      [&](const geometry::TreeSegment& s) { return s.from == end; });
      if (passed)
        result.passed_targets.push_back(i);
      else
        tree_.vessels.push_back({static_cast<std::int32_t>(i),
                                 i < names.size() ? names[i] : "vessel_" + std::to_string(i + 1),
                                 result.target_segments.back()});
    }
    result.tree = std::move(tree_);
    return result;
  }

 private:
  using Key = std::pair<std::size_t, std::size_t>;  // chain, cut

  std::int32_t add_node(const Vec3& position) {
    const auto id = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.push_back({id, position});
    return id;
  }

  void add_chain(std::size_t c) {
    const Chain& chain = chains_.chains[c];
    std::int32_t node = 0;
    if (chain.parent < 0 && c == 0)
      node = add_node(chain.axis.points.front());
    else if (chain.parent >= 0)
      node = nodes_.at({static_cast<std::size_t>(chain.parent), starts_[c]});
    nodes_[{c, 0}] = node;
    Axis axis = chain.axis;
    axis.points.front() = tree_.nodes[static_cast<std::size_t>(node)].position;
    const geometry::ArcLengthSpline curve(axis.points, axis.radius);
    const std::vector<double> chord = geometry::abscissas(axis.points);
    const double stretch = curve.length() / chord.back();
    const double least_radius = *std::min_element(axis.radius.begin(), axis.radius.end());
    std::size_t from = 0;
    for (const std::size_t to : cuts_[c].all()) {
      if (to == 0) continue;
      const std::int32_t start = nodes_.at({c, from});
      add_segment(curve, least_radius, stretch * chord[from], stretch * chord[to], start, c, to);
      from = to;
    }
  }

  void add_segment(const geometry::ArcLengthSpline& curve, double least_radius, double from_mm, double to_mm,
                   std::int32_t start, std::size_t chain, std::size_t to) {
    const auto pieces =
        static_cast<std::size_t>(std::max(1.0, std::ceil((to_mm - from_mm) / step_mm_ - 1e-6)));
    geometry::TreeSegment segment;
    for (std::size_t i = 0; i <= pieces; ++i) {
      const double s = from_mm + (to_mm - from_mm) * static_cast<double>(i) / static_cast<double>(pieces);
      segment.axis.points.push_back(curve.point(s));
      // Where a lumen narrows at once a cubic swings below both radii, and may go below nothing.
      segment.axis.radius.push_back(std::max(curve.scalar(s), least_radius));
    }
    segment.axis.points.front() = tree_.nodes[static_cast<std::size_t>(start)].position;
    const std::int32_t end = add_node(segment.axis.points.back());
    nodes_[{chain, to}] = end;
    const auto before = last_normals_.find(start);
    geometry::complete(segment.axis, before == last_normals_.end() ? Vec3(Vec3::Zero()) : before->second);
    last_normals_[end] = segment.axis.frames.back().normal;
    segment.id = static_cast<std::int32_t>(tree_.segments.size());
    segment.from = start;
    segment.to = end;
    segment_to_[end] = segment.id;
    tree_.segments.push_back(std::move(segment));
  }

  std::vector<std::int32_t> segments_to(std::int32_t node) const {
    std::vector<std::int32_t> segments;
    for (auto into = segment_to_.find(node); into != segment_to_.end(); into = segment_to_.find(node)) {
      segments.push_back(into->second);
      node = tree_.segments[static_cast<std::size_t>(into->second)].from;
    }
    std::reverse(segments.begin(), segments.end());
    return segments;
  }

  const ChainTree& chains_;
  double step_mm_;
  std::vector<Cuts> cuts_;
  std::vector<std::size_t> starts_, ends_;
  geometry::VesselTree tree_;
  std::map<Key, std::int32_t> nodes_;
  std::map<std::int32_t, std::int32_t> segment_to_;  // by node
  std::map<std::int32_t, Vec3> last_normals_;        // by node
};

}  // namespace

ChainTree merge_paths(const std::vector<Axis>& paths, const std::vector<std::size_t>& order,
                      double merge_fraction) {
  ChainTree result;
  result.ends.resize(paths.size());
  Cloud cloud;
  for (const std::size_t p : order) {
    const Axis& path = paths[p];
    const auto chain = static_cast<std::int32_t>(result.chains.size());
    if (cloud.points.empty()) {
      result.chains.push_back({-1, 0, path});
      result.ends[p] = {0, path.points.size() - 1};
      cloud.add(path, 0, 0);
      continue;
    }
    // From the target upstream, the first point that touches what is there; the source always does.
    const geometry::KdTree tree(cloud.points);
    std::size_t leave = path.points.size() - 1;
    std::size_t nearest = 0;
    for (;; --leave) {
      nearest = static_cast<std::size_t>(tree.nearest(path.points[leave]));
      if (leave == 0 ||
          (cloud.points[nearest] - path.points[leave]).norm() <= merge_fraction * path.radius[leave])
        break;
    }
    const ChainPoint joint = cloud.owners[nearest];
    if (leave + 3 >= path.points.size()) {  // no way of its own: it ends on the other
      result.ends[p] = {joint.chain, joint.index};
      continue;
    }
    const Axis& parent = result.chains[static_cast<std::size_t>(joint.chain)].axis;
    Axis own = branch_of(path, leave, parent.points[joint.index], parent.radius[joint.index]);
    result.ends[p] = {chain, own.points.size() - 1};
    cloud.add(own, chain, 1);
    result.chains.push_back({joint.chain, joint.index, std::move(own)});
  }
  return result;
}

SplitTree split_tree(const ChainTree& chains, double step_mm, const std::vector<std::string>& names) {
  return TreeMaker(chains, step_mm).make(names);
}

}  // namespace ostia::centerline
