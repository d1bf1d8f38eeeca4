#include "mask_parting.h"

#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace ostia::coronary {
namespace {

constexpr double evened_radius_mm = 1.0;  // the mask's stairs make no thin places
constexpr double near_root_mm = 50.0;     // what touches does so far from the ostia
constexpr double beside_share = 0.4;      // a line that leaves sideways at both of its ends is a bridge
constexpr double label_share = 0.3;       // at the border between two labels
constexpr double straight_on = 0.75;      // cosine of what goes on through a crossing
constexpr double arm_mm = 5.0;
constexpr double longest_crossing_mm = 6.0;
constexpr double hole_mm = 14.0;  // about a hole in a mask, along the lines

/// All ends at a node, the roots as one.
class Joined {
 public:
  Joined(const LineGraph& graph, const std::vector<std::int32_t>& roots) {
    for (const auto& [id, node] : graph.nodes()) index_.emplace(id, static_cast<std::int32_t>(index_.size()));
    sets_.emplace(index_.size());
    for (std::size_t i = 1; i < roots.size(); ++i) sets_->join(index_.at(roots[0]), index_.at(roots[i]));
  }
  bool join(std::int32_t a, std::int32_t b) { return sets_->join(index_.at(a), index_.at(b)); }

 private:
  std::map<std::int32_t, std::int32_t> index_;
  std::optional<geometry::DisjointSets> sets_;
};

int circles(const LineGraph& graph, const std::vector<std::int32_t>& roots) {
  Joined sets(graph, roots);
  int count = 0;
  for (const auto& [id, line] : graph.lines())
    if (!sets.join(line.from, line.to)) ++count;
  return count;
}

int label_at(const imaging::MaskVolume& labels, const Vec3& place) {
  const Vec3 at = labels.geometry.index(place);
  std::array<std::int64_t, 3> v{};
  for (int d = 0; d < 3; ++d)
    v[static_cast<std::size_t>(d)] = std::clamp<std::int64_t>(
        std::lround(at[d]), 0, labels.geometry.size[static_cast<std::size_t>(d)] - 1);
  return labels(v[0], v[1], v[2]);
}

struct ThinPlace {
  double cost = 0.0;  // mm
  std::size_t point = 0;
};

class Parting {
 public:
  Parting(LineGraph& graph, const std::vector<std::int32_t>& roots, const imaging::MaskVolume& labels)
      : graph_(graph), roots_(roots), keep_(roots.begin(), roots.end()), labels_(labels) {}

  std::vector<MaskCut> run() {
    std::vector<MaskCut> cuts;
    while (circles(graph_, roots_) > 0) {
      if (close_hole()) {
        // Told to nobody.
      } else if (const auto crossing = a_crossing()) {
        cuts.push_back({graph_.nodes().at(graph_.lines().at(*crossing).from).at,
                        graph_.nodes().at(graph_.lines().at(*crossing).from).radius_mm});
        continue_by_themselves(*crossing);
      } else {
        cuts.push_back(cut_thinnest());
      }
      graph_.tidy(keep_);
    }
    return cuts;
  }

 private:
  /// Lines about a small hole of the mask are one vessel: the thinner goes, and nothing is told.
  bool close_hole() {
    std::int32_t thinnest = -1;
    double least = 1e9;
    for (const auto& [id, line] : graph_.lines()) {
      const double mm = length_mm(line), mean = mean_radius(line, true, 0.0, mm);
      if (mm > 0.75 * hole_mm || mean >= least) continue;
      if (line.from != line.to && mm + way_round(id, line) > hole_mm) continue;
      thinnest = id;
      least = mean;
    }
    if (thinnest < 0) return false;
    graph_.remove_line(thinnest);
    return true;
  }
  /// Between a line's ends without it.
  double way_round(std::int32_t id, const LineGraph::Line& line) const {
    LineGraph without = graph_;
    without.remove_line(id);
    const auto reach = without.reach(line.from);
    const auto found = reach.find(line.to);
    return found == reach.end() ? 1e9 : found->second.mm;
  }

  struct Arms {
    std::int32_t a = -1, b = -1;
  };
  std::optional<Arms> arms_at(std::int32_t node, std::int32_t without) const {
    Arms arms;
    for (const std::int32_t id : graph_.lines_at(node)) {
      if (id == without) continue;
      (arms.a < 0 ? arms.a : arms.b) = id;
    }
    if (graph_.degree(node) != 3 || arms.a < 0 || arms.b < 0 || arms.a == arms.b) return std::nullopt;
    for (const std::int32_t id : {arms.a, arms.b})
      if (graph_.lines().at(id).from == graph_.lines().at(id).to) return std::nullopt;
    return arms;
  }
  Vec3 leaving(std::int32_t line, std::int32_t node) const {
    const LineGraph::Line& l = graph_.lines().at(line);
    return -outward(l, l.from == node, arm_mm);
  }
  double straight(std::int32_t a, std::int32_t at_a, std::int32_t b, std::int32_t at_b) const {
    return -leaving(a, at_a).dot(leaving(b, at_b));
  }

  struct Pairs {
    std::int32_t first_u, first_v, second_u, second_v;
    double least = -1.0;
  };
  std::optional<Pairs> pairs_of(std::int32_t id) const {
    const LineGraph::Line& line = graph_.lines().at(id);
    if (line.from == line.to) return std::nullopt;
    const auto u = arms_at(line.from, id), v = arms_at(line.to, id);
    if (!u || !v) return std::nullopt;
    const std::set<std::int32_t> all{u->a, u->b, v->a, v->b};
    if (all.size() < 4) return std::nullopt;
    const auto least = [&](std::int32_t va, std::int32_t vb) {
      return std::min(straight(u->a, line.from, va, line.to), straight(u->b, line.from, vb, line.to));
    };
    const double same = least(v->a, v->b), other = least(v->b, v->a);
    return same >= other ? Pairs{u->a, v->a, u->b, v->b, same} : Pairs{u->a, v->b, u->b, v->a, other};
  }

  /// A short line on which two vessels cross: both go on straight, and parted the lines still hang together.
  std::optional<std::int32_t> a_crossing() const {
    std::optional<std::int32_t> best;
    double straightest = straight_on;
    const int before = circles(graph_, roots_);
    for (const auto& [id, line] : graph_.lines()) {
      if (length_mm(line) > longest_crossing_mm) continue;
      const auto pairs = pairs_of(id);
      if (!pairs || pairs->least <= straightest) continue;
      LineGraph trial = graph_;
      Parting part(trial, roots_, labels_);
      part.continue_by_themselves(id);
      trial.tidy(keep_);
      if (circles(trial, roots_) != before - 1 || !hangs_together(trial)) continue;
      straightest = pairs->least;
      best = id;
    }
    return best;
  }
  /// Whether as many parts are there as were.
  bool hangs_together(const LineGraph& trial) const {
    const auto parts = [&](const LineGraph& graph) {
      std::set<std::int32_t> all;
      const auto part = graph.parts();
      for (const auto& [node, first] : part) all.insert(first);
      std::set<std::int32_t> rooted;
      for (const std::int32_t root : roots_) rooted.insert(part.at(root));
      return all.size() - rooted.size();
    };
    return parts(trial) == parts(graph_);
  }

  void continue_by_themselves(std::int32_t id) {
    const LineGraph::Line crossing = graph_.lines().at(id);
    const auto pairs = pairs_of(id);
    graph_.remove_line(id);
    through(pairs->first_u, crossing.from, pairs->first_v, crossing.to);
    through(pairs->second_u, crossing.from, pairs->second_v, crossing.to);
  }
  /// One line of two arms, straight where they were led to the crossing.
  void through(std::int32_t a, std::int32_t at_a, std::int32_t b, std::int32_t at_b) {
    struct Arm {
      std::int32_t far;
      std::vector<Vec3> points;  // from the far end
      std::vector<double> radius_mm;
    };
    const auto arm = [&](std::int32_t id, std::int32_t near) {
      LineGraph::Line line = graph_.lines().at(id);
      if (line.from == near) {
        std::swap(line.from, line.to);
        std::reverse(line.points.begin(), line.points.end());
        std::reverse(line.radius_mm.begin(), line.radius_mm.end());
      }
      // Beside the crossing the line was drawn to the other vessel; no more than half of it goes.
      const double give_up = std::min(2.0 * line.radius_mm.back() + 1.0, 0.5 * length_mm(line));
      double gone = 0.0;
      while (line.points.size() > 2 && gone < give_up) {
        gone += (line.points.back() - line.points[line.points.size() - 2]).norm();
        line.points.pop_back();
        line.radius_mm.pop_back();
      }
      return Arm{line.from, line.points, line.radius_mm};
    };
    Arm first = arm(a, at_a), second = arm(b, at_b);
    graph_.remove_line(a);
    graph_.remove_line(b);
    const std::vector<Vec3> between = straight_points(first.points.back(), second.points.back());
    const double r0 = first.radius_mm.back(), r1 = second.radius_mm.back();
    for (std::size_t i = 1; i < between.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(between.size() - 1);
      first.points.push_back(between[i]);
      first.radius_mm.push_back((1.0 - t) * r0 + t * r1);
    }
    for (std::size_t i = second.points.size() - 1; i-- > 0;) {
      first.points.push_back(second.points[i]);
      first.radius_mm.push_back(second.radius_mm[i]);
    }
    graph_.add_line(first.far, second.far, std::move(first.points), std::move(first.radius_mm));
  }

  ThinPlace thinnest(std::int32_t id, const std::map<std::int32_t, double>& from_root) const {
    const LineGraph::Line& line = graph_.lines().at(id);
    const std::vector<double> s = geometry::abscissas(line.points);
    double share = 1.0;
    if (sideways(id, line.from) && sideways(id, line.to)) share = beside_share;
    ThinPlace best{1e9, line.points.size() / 2};
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (line.points.size() > 4 && (i < 2 || i + 2 >= s.size())) continue;
      double radius = 0.0, weights = 0.0;
      for (std::size_t j = 0; j < s.size(); ++j) {
        if (std::abs(s[j] - s[i]) > evened_radius_mm) continue;
        radius += line.radius_mm[j];
        weights += 1.0;
      }
      radius /= weights;
      const auto far = [&](std::int32_t node, double along) {
        const auto found = from_root.find(node);
        return found == from_root.end() ? near_root_mm : found->second + along;
      };
      const double root_mm = std::min(far(line.from, s[i]), far(line.to, s.back() - s[i]));
      double cost = radius * share * (1.0 + std::max(0.0, near_root_mm - root_mm) / near_root_mm);
      const std::size_t before = i >= 2 ? i - 2 : 0, after = std::min(s.size() - 1, i + 2);
      const int a = label_at(labels_, line.points[before]), b = label_at(labels_, line.points[after]);
      if (a != b && a != 0 && b != 0) cost *= label_share;
      if (cost < best.cost) best = {cost, i};
    }
    return best;
  }
  /// Whether the others at a node go on through it straighter than this line does.
  bool sideways(std::int32_t id, std::int32_t node) const {
    const auto arms = arms_at(node, id);
    if (!arms) return false;
    const double through = straight(arms->a, node, arms->b, node);
    return through > straight(id, node, arms->a, node) && through > straight(id, node, arms->b, node) &&
           through > 0.5;
  }

  MaskCut cut_thinnest() {
    std::map<std::int32_t, double> from_root;
    for (const std::int32_t root : roots_)
      for (const auto& [node, here] : graph_.reach(root)) {
        const auto [found, fresh] = from_root.emplace(node, here.mm);
        if (!fresh) found->second = std::min(found->second, here.mm);
      }
    std::vector<std::tuple<double, std::int32_t, std::size_t>> lines;  // thick ones first
    for (const auto& [id, line] : graph_.lines()) {
      const ThinPlace place = thinnest(id, from_root);
      lines.emplace_back(-place.cost, id, place.point);
    }
    std::sort(lines.begin(), lines.end());
    Joined sets(graph_, roots_);
    std::int32_t cut = -1;
    std::size_t at = 0;
    for (const auto& [cost, id, point] : lines) {
      const LineGraph::Line& line = graph_.lines().at(id);
      if (sets.join(line.from, line.to)) continue;
      cut = id;  // the thinnest that closes a circle comes last
      at = point;
    }
    const MaskCut made{graph_.lines().at(cut).points[at], graph_.lines().at(cut).radius_mm[at]};
    graph_.cut(cut, at);
    return made;
  }

  LineGraph& graph_;
  const std::vector<std::int32_t>& roots_;
  std::set<std::int32_t> keep_;
  const imaging::MaskVolume& labels_;
};

}  // namespace

std::vector<MaskCut> part_touching(LineGraph& graph, const std::vector<std::int32_t>& roots,
                                   const imaging::MaskVolume& labels) {
  graph.tidy({roots.begin(), roots.end()});
  return Parting(graph, roots, labels).run();
}

}  // namespace ostia::coronary
