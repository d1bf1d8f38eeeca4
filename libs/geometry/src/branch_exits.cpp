#include "branch_exits.h"

#include <algorithm>

namespace ostia::geometry {
namespace {

constexpr int exit_halvings = 50;
// As vessel_axis joins segments.
constexpr double joined_within_mm = 1e-3;

std::vector<std::size_t> segment_ends(const VesselTree& tree, const Vessel& vessel) {
  std::vector<std::size_t> ends;
  std::size_t count = 0;
  const Vec3* last = nullptr;
  for (const std::int32_t id : vessel.segments) {
    const std::vector<Vec3>& points = segment(tree, id).axis.points;
    const bool shared = last && !points.empty() && (*last - points.front()).norm() <= joined_within_mm;
    count += points.size() - (shared ? 1 : 0);
    ends.push_back(count - 1);
    if (!points.empty()) last = &points.back();
  }
  return ends;
}

}  // namespace

std::vector<VesselLine> vessel_lines(const VesselTree& tree) {
  std::vector<VesselLine> lines;
  for (const Vessel& vessel : tree.vessels) {
    VesselLine line;
    line.vessel = &vessel;
    line.axis = vessel_axis(tree, vessel);
    line.root = segment(tree, vessel.segments.front()).from;
    line.ends = segment_ends(tree, vessel);
    line.tube = std::make_unique<BallLine>(line.axis);
    lines.push_back(std::move(line));
  }
  return lines;
}

BranchExits::BranchExits(const VesselTree& tree, const std::vector<VesselLine>& lines)
    : tree_(tree), lines_(lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    of_root_[lines[i].root].push_back(i);
    for (const std::int32_t id : lines[i].vessel->segments) through_[id].push_back(i);
  }
}

/// From its point `first` on, where a line leaves the tube of another; both share what lies before, and
/// `segment` is the first on which they do not.
BranchExits::Exit BranchExits::exit(const VesselLine& line, const VesselLine& other, std::size_t first,
                                    std::size_t segment) const {
  const auto& points = line.axis.points;
  bool of_all = true;
  const auto inside = [&](const Vec3& x) {
    const BallLine::Nearest near = other.tube->nearest(x);
    of_all = of_all && near.place.piece < other.ends[segment];
    return near.value <= 0.0;
  };
  std::size_t k = first + 1;
  while (k < points.size() && inside(points[k])) ++k;
  if (k >= points.size()) return {{points.size() - 1, 0.0}, false};
  double in = 0.0, out = 1.0;
  for (int i = 0; i < exit_halvings; ++i) {
    const double middle = 0.5 * (in + out);
    (inside(points[k - 1] + middle * (points[k] - points[k - 1])) ? in : out) = middle;
  }
  const LinePlace place = out >= 1.0 ? LinePlace{k, 0.0} : LinePlace{k - 1, out};
  return {place, of_all && k <= line.ends[segment]};
}

/// ... of the vessels that go on by the segment `other`; `segment` counts the line's own.
LinePlace BranchExits::exit_from(std::size_t line, std::size_t segment, std::int32_t other,
                                 const std::vector<std::size_t>& through) {
  const VesselLine& own = lines_[line];
  const std::pair key{own.vessel->segments[segment], other};
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  const std::size_t first = segment == 0 ? 0 : own.ends[segment - 1];
  LinePlace last;
  for (std::size_t i = 0; i < through.size(); ++i) {
    const Exit one = exit(own, lines_[through[i]], first, segment);
    if (i == 0 && one.of_all) return known_[key] = one.place;
    last = std::max(last, one.place);
  }
  return last;
}

std::vector<ForkOnLine> BranchExits::forks(std::size_t line) {
  const VesselLine& own = lines_[line];
  const std::vector<std::int32_t>& segments = own.vessel->segments;
  std::vector<ForkOnLine> forks;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const std::vector<std::size_t>& together = k == 0 ? of_root_.at(own.root) : through_.at(segments[k - 1]);
    std::map<std::int32_t, std::vector<std::size_t>> others;  // by the segment by which they go on
    for (const std::size_t i : together) {
      const std::vector<std::int32_t>& theirs = lines_[i].vessel->segments;
      if (theirs.size() > k && theirs[k] != segments[k]) others[theirs[k]].push_back(i);
    }
    if (others.empty()) continue;
    LinePlace nearest{own.axis.size() - 1, 0.0}, farthest;
    for (const auto& [other, through] : others) {
      const LinePlace place = exit_from(line, k, other, through);
      nearest = std::min(nearest, place);
      farthest = std::max(farthest, place);
    }
    const LinePlace start = touching_place(own.axis, nearest, LineWay::upstream).value_or(LinePlace{});
    const std::int32_t node = k == 0 ? own.root : segment(tree_, segments[k - 1]).to;
    forks.push_back({node, start, farthest});
  }
  return forks;
}

}  // namespace ostia::geometry
