#include "tree_paths.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <map>

namespace ostia::coronary {

std::size_t TreePath::index(double s) const {
  const auto found = std::lower_bound(s_mm.begin(), s_mm.end() - 1, s);
  return static_cast<std::size_t>(found - s_mm.begin());
}

HeartPlace TreePath::ending(double mm) const {
  HeartPlace mean;
  const std::size_t first = index(length() - mm);
  const double part = 1.0 / static_cast<double>(at.size() - first);
  for (std::size_t i = first; i < at.size(); ++i) {
    mean.depth_mm += part * at[i].depth_mm;
    mean.angle_deg += part * at[i].angle_deg;
    mean.away_mm += part * at[i].away_mm;
  }
  return mean;
}

std::vector<TreePath> paths_of(const geometry::VesselTree& tree) {
  std::map<std::int32_t, const geometry::TreeSegment*> into;
  for (const geometry::TreeSegment& segment : tree.segments) into[segment.to] = &segment;
  std::vector<TreePath> paths;
  for (const std::int32_t end : geometry::ends(tree)) {
    if (!into.contains(end)) continue;  // a node without any segment
    TreePath path;
    path.end = path.root = end;
    std::vector<const geometry::TreeSegment*> way;
    for (auto up = into.find(end); up != into.end(); up = into.find(path.root)) {
      way.push_back(up->second);
      path.root = up->second->from;
    }
    std::reverse(way.begin(), way.end());
    std::vector<Vec3> points;
    for (const geometry::TreeSegment* segment : way) {
      path.segments.push_back(segment->id);
      const double before = path.segment_ends_mm.empty() ? 0.0 : path.segment_ends_mm.back();
      path.segment_ends_mm.push_back(before + geometry::length(segment->axis.points));
      points.insert(points.end(), segment->axis.points.begin() + (points.empty() ? 0 : 1),
                    segment->axis.points.end());
    }
    path.points = geometry::resample(points, 1.0);
    path.s_mm = geometry::abscissas(path.points);
    paths.push_back(std::move(path));
  }
  return paths;
}

double shared_mm(const TreePath& a, const TreePath& b) {
  std::size_t same = 0;
  while (same < std::min(a.segments.size(), b.segments.size()) && a.segments[same] == b.segments[same])
    ++same;
  return same == 0 ? 0.0 : a.segment_ends_mm[same - 1];
}

}  // namespace ostia::coronary
