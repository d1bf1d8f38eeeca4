#include "mask_ends.h"

#include "mask_cut_place.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace ostia::coronary {
namespace {

using geometry::Centerline;
using geometry::TreeSegment;
using geometry::VesselTree;

constexpr double trim_step_mm = 0.25;
constexpr double most_trimmed_mm = 4.0, most_trimmed_share = 0.4;  // of an end; the larger counts
constexpr double near_fork_radii = 3.0;  // of both vessels: what is no farther along the tree cannot part
constexpr double parted_share = 0.6;     // of both radii: walls give way to half of them
constexpr double most_led_radii = 3.0;
constexpr double forked_tip_radii = 3.0;  // so long its shorter branch may be; the other twice that
constexpr double straight_on_rad = 0.6;
constexpr double dome_window_radii = 2.0, dome_share = 1.1;  // of what a vessel is before its end

/// The tree while its ends are settled.
class EndSettling {
 public:
  EndSettling(VesselTree& tree, std::vector<MaskEndChange> already)
      : tree_(tree), changes_(std::move(already)) {}

  std::vector<MaskEndChange> run() {
    while (drop_a_stub()) {
    }
    for (const std::int32_t node : geometry::ends(tree_)) shorten(node);
    for (const std::int32_t node : geometry::roots(tree_)) lead_on(node);
    for (std::size_t i = 0; i < tree_.vessels.size(); ++i) {
      const auto id = static_cast<std::int32_t>(i) + 1;
      for (MaskEndChange& change : changes_)
        if (change.vessel == tree_.vessels[i].id) change.vessel = -id;
      tree_.vessels[i].id = id;
      tree_.vessels[i].name = "V" + std::to_string(id);
    }
    for (MaskEndChange& change : changes_) change.vessel = std::max(0, -change.vessel);
    return changes_;
  }

 private:
  struct Obstacles {
    bool near_fork = false, far = false;
    bool too_near = false;  // for their walls to be parted
    bool none() const { return !near_fork && !far; }
  };

  TreeSegment& segment_to(std::int32_t node) {
    return *std::find_if(tree_.segments.begin(), tree_.segments.end(),
                         [&](const TreeSegment& s) { return s.to == node; });
  }
  std::vector<std::int32_t> leaving(std::int32_t node) const {
    std::vector<std::int32_t> ids;
    for (const TreeSegment& s : tree_.segments)
      if (s.from == node) ids.push_back(s.id);
    return ids;
  }
  bool is_root(std::int32_t node) const {
    return std::none_of(tree_.segments.begin(), tree_.segments.end(),
                        [&](const TreeSegment& s) { return s.to == node; });
  }

  /// Ways along the tree from a node to all others, without one segment.
  std::map<std::int32_t, double> ways_from(std::int32_t node, std::int32_t without) const {
    std::map<std::int32_t, double> mm{{node, 0.0}};
    std::vector<std::int32_t> open{node};
    while (!open.empty()) {
      const std::int32_t at = open.back();
      open.pop_back();
      for (const TreeSegment& s : tree_.segments) {
        if (s.id == without || (s.from != at && s.to != at)) continue;
        const std::int32_t to = s.from == at ? s.to : s.from;
        if (mm.emplace(to, mm.at(at) + s.axis.abscissa.back()).second) open.push_back(to);
      }
    }
    return mm;
  }

  /// Of the ball that closes a vessel's wall: at its very end the axis' radius says little. Elsewhere the
  /// radius of the segment's last point.
  double dome_radius(const TreeSegment& s) const {
    double radius = s.axis.radius.back();
    if (std::any_of(tree_.segments.begin(), tree_.segments.end(),
                    [&](const TreeSegment& next) { return next.from == s.to; }))
      return radius;
    const double from = s.axis.abscissa.back() - dome_window_radii * radius;
    for (std::size_t i = 0; i < s.axis.size(); ++i)
      if (s.axis.abscissa[i] >= from) radius = std::max(radius, s.axis.radius[i]);
    return dome_share * radius;
  }

  /// What of the other vessels is in the way of a cut. `fork`: the segment's other node.
  Obstacles obstacles(const CutPlace& cut, std::int32_t segment,
                      const std::map<std::int32_t, double>& from_fork) const {
    Obstacles found;
    for (const TreeSegment& s : tree_.segments) {
      if (s.id == segment) continue;
      const auto from = from_fork.find(s.from), to = from_fork.find(s.to);
      const double dome_mm = dome_radius(s);
      for (std::size_t i = 0; i < s.axis.size(); ++i) {
        const double radius = i + 1 == s.axis.size() ? dome_mm : s.axis.radius[i];
        if (!in_the_way(cut, s.axis.points[i], radius)) continue;
        double along = 1e9;
        if (from != from_fork.end()) along = std::min(along, from->second + s.axis.abscissa[i]);
        if (to != from_fork.end())
          along = std::min(along, to->second + s.axis.abscissa.back() - s.axis.abscissa[i]);
        const bool near = along < near_fork_radii * (s.axis.radius[i] + cut.radius_mm) + 1.0;
        (near ? found.near_fork : found.far) = true;
        if ((s.axis.points[i] - cut.place).norm() <
            parted_share * (s.axis.radius[i] + cut.radius_mm) + 2.0 * apart_mm)
          found.too_near = true;
      }
    }
    return found;
  }

  /// By how much an end must be shortened until it is clean; nothing where that is nowhere. `may_stay`: all
  /// that is in the way of the end as it is lies far along the tree.
  std::optional<double> clean_after(const TreeSegment& leaf, bool& may_stay) const {
    const InwardLine line(leaf.axis, false);
    const std::map<std::int32_t, double> from_fork = ways_from(leaf.from, leaf.id);
    double most = std::max(most_trimmed_mm, most_trimmed_share * line.length());
    may_stay = false;
    for (double gone = 0.0; gone <= most && line.length() - gone > 1.0; gone += trim_step_mm) {
      const Obstacles found = obstacles(line.cut(gone), leaf.id, from_fork);
      if (found.none()) return gone;
      if (gone > 0.0) continue;
      may_stay = !found.near_fork && !found.too_near;
      if (!may_stay) most = line.length();
    }
    return std::nullopt;
  }

  /// By how much the way from one segment to the next turns where they meet, within a diameter of it.
  static double turn_between(const TreeSegment& before, const TreeSegment& after) {
    const double window = 2.0 * after.axis.radius.front();
    const InwardLine back(before.axis, false), ahead(after.axis, true);
    const Vec3 way = (back.point(0.0) - back.point(window)).normalized();
    return std::acos(std::clamp(way.dot((ahead.point(window) - ahead.point(0.0)).normalized()), -1.0, 1.0));
  }

  /// A tip that forks: two ends behind one fork, hardly longer than it is wide. Planes may see them as two,
  /// but the wall leans over from the one to the other there, which skews the elements of layers. True of the
  /// shorter, where the vessel goes on straight into the other.
  bool is_half_of_a_tip(const TreeSegment& leaf) {
    const double mm = leaf.axis.abscissa.back(), most = forked_tip_radii * leaf.axis.radius.front();
    const std::vector<std::int32_t> both = leaving(leaf.from);
    if (both.size() != 2 || mm > most) return false;
    const TreeSegment& other = geometry::segment(tree_, both[0] == leaf.id ? both[1] : both[0]);
    const double other_mm = other.axis.abscissa.back();
    return leaving(other.to).empty() && mm <= other_mm && other_mm <= 2.0 * most &&
           turn_between(segment_to(leaf.from), other) <= straight_on_rad;
  }

  bool drop_a_stub() {
    std::optional<std::int32_t> shortest;
    double shortest_mm = 1e9;
    for (const std::int32_t node : geometry::ends(tree_)) {
      const TreeSegment& leaf = segment_to(node);
      const double mm = leaf.axis.abscissa.back();
      bool may_stay = false;
      if (mm >= shortest_mm || is_root(leaf.from)) continue;
      if (!is_half_of_a_tip(leaf) && (clean_after(leaf, may_stay) || may_stay)) continue;
      shortest = node;
      shortest_mm = mm;
    }
    if (!shortest) return false;
    changes_.push_back(
        {MaskEndChange::Kind::left_out, geometry::node(tree_, *shortest).position, shortest_mm, 0});
    drop(*shortest);
    return true;
  }

  void drop(std::int32_t node) {
    const TreeSegment leaf = segment_to(node);
    std::erase_if(tree_.segments, [&](const TreeSegment& s) { return s.id == leaf.id; });
    std::erase_if(tree_.nodes, [&](const geometry::TreeNode& n) { return n.id == node; });
    std::erase_if(tree_.vessels, [&](const geometry::Vessel& v) { return v.segments.back() == leaf.id; });
    const std::vector<std::int32_t> on = leaving(leaf.from);
    if (on.size() == 1 && !is_root(leaf.from)) join(segment_to(leaf.from).id, on.front());
  }
  /// What is left at a node becomes one segment.
  void join(std::int32_t before, std::int32_t after) {
    const TreeSegment second = geometry::segment(tree_, after);
    TreeSegment& first = *std::find_if(tree_.segments.begin(), tree_.segments.end(),
                                       [&](const TreeSegment& s) { return s.id == before; });
    std::erase_if(tree_.nodes, [&](const geometry::TreeNode& n) { return n.id == first.to; });
    first.to = second.to;
    first.axis.points.insert(first.axis.points.end(), second.axis.points.begin() + 1,
                             second.axis.points.end());
    first.axis.radius.insert(first.axis.radius.end(), second.axis.radius.begin() + 1,
                             second.axis.radius.end());
    completed(first.axis);
    std::erase_if(tree_.segments, [&](const TreeSegment& s) { return s.id == after; });
    for (geometry::Vessel& vessel : tree_.vessels) std::erase(vessel.segments, after);
  }
  static void completed(Centerline& axis) { geometry::complete(axis, axis.frames.front().normal); }

  std::int32_t vessel_of(std::int32_t segment) const {
    for (const geometry::Vessel& vessel : tree_.vessels)
      if (std::find(vessel.segments.begin(), vessel.segments.end(), segment) != vessel.segments.end())
        return vessel.id;
    return 0;
  }
  void move_node(std::int32_t id, const Vec3& to) {
    for (geometry::TreeNode& node : tree_.nodes)
      if (node.id == id) node.position = to;
  }

  void shorten(std::int32_t node) {
    TreeSegment& leaf = segment_to(node);
    bool may_stay = false;
    const double gone = clean_after(leaf, may_stay).value_or(0.0);
    if (gone <= 0.0) return;
    changes_.push_back(
        {MaskEndChange::Kind::shortened, geometry::node(tree_, node).position, gone, vessel_of(leaf.id)});
    const geometry::PolylineLocation end =
        geometry::at_abscissa(leaf.axis.points, leaf.axis.abscissa.back() - gone);
    const double radius =
        (1.0 - end.t) * leaf.axis.radius[end.segment] + end.t * leaf.axis.radius[end.segment + 1];
    const std::size_t kept = std::max<std::size_t>(1, end.segment + (end.t > 0.2 ? 1 : 0));
    leaf.axis.points.resize(kept);
    leaf.axis.radius.resize(kept);
    leaf.axis.points.push_back(end.point);
    leaf.axis.radius.push_back(radius);
    completed(leaf.axis);
    move_node(node, end.point);
  }

  /// An ostium right at its first fork begins earlier, in the aorta.
  void lead_on(std::int32_t node) {
    const std::vector<std::int32_t> all = leaving(node);
    if (all.size() != 1) return;
    TreeSegment& first = *std::find_if(tree_.segments.begin(), tree_.segments.end(),
                                       [&](const TreeSegment& s) { return s.id == all.front(); });
    const std::map<std::int32_t, double> from_fork = ways_from(first.to, first.id);
    const InwardLine line(first.axis, true);
    const CutPlace here = line.cut(0.0);
    if (!obstacles(here, first.id, from_fork).near_fork) return;
    const Vec3 outward = (line.point(0.0) - line.point(std::max(1.0, here.radius_mm))).normalized();
    for (double more = trim_step_mm; more <= most_led_radii * here.radius_mm; more += trim_step_mm) {
      CutPlace cut = here;
      cut.outward = outward;
      cut.place = line.point(0.0) + (more - std::min(cut_inside_mm(here.radius_mm), 0.5 * more)) * outward;
      if (obstacles(cut, first.id, from_fork).near_fork) continue;
      begin_earlier(first, outward, more, here.radius_mm);
      return;
    }
  }
  void begin_earlier(TreeSegment& first, const Vec3& outward, double more_mm, double radius_mm) {
    const std::int32_t vessel = vessel_of(first.id);
    const auto known = std::find_if(changes_.begin(), changes_.end(), [&](const MaskEndChange& change) {
      return change.kind == MaskEndChange::Kind::led_on && change.vessel == vessel;
    });
    if (known != changes_.end())
      known->length_mm += more_mm;
    else
      changes_.push_back({MaskEndChange::Kind::led_on, first.axis.points.front(), more_mm, vessel});
    const int steps = std::max(1, static_cast<int>(std::lround(more_mm / 0.5)));
    std::vector<Vec3> points;
    for (int k = steps; k > 0; --k)
      points.push_back(first.axis.points.front() + (more_mm * k / steps) * outward);
    first.axis.points.insert(first.axis.points.begin(), points.begin(), points.end());
    first.axis.radius.insert(first.axis.radius.begin(), points.size(), radius_mm);
    completed(first.axis);
    move_node(first.from, first.axis.points.front());
  }

  VesselTree& tree_;
  std::vector<MaskEndChange> changes_;
};

}  // namespace

std::vector<MaskEndChange> settle_ends(MaskAxes& axes) {
  return EndSettling(axes.tree, axes.led_on).run();
}

}  // namespace ostia::coronary
