#include "mask_bridges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace ostia::coronary {
namespace {

constexpr double direction_mm = 5.0;
constexpr double usual_gap_mm = 10.0;
constexpr double side_share = 0.6;  // a side branch needs its own end to point at the other vessel, no more
constexpr double settled_mm = 2.0;  // over less a gap has no direction of its own: ends are rough
constexpr double side_step_mm = 1.0;

struct Joint {
  std::int32_t end = 0;                // of the part
  std::optional<std::int32_t> to_end;  // of a rooted line
  std::int32_t to_line = -1;
  std::size_t to_point = 0;
  MaskBridge bridge;
};

/// 1 for a direction that is kept, 1/2 at 60 degrees, 0 at right angles and beyond.
double keeps(double cosine) {
  const double t = std::clamp(cosine, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double nearness(double gap_mm) {
  return std::exp(-(gap_mm / usual_gap_mm) * (gap_mm / usual_gap_mm));
}

double like_calibre(double a_mm, double b_mm) {
  const double ratio = std::min(a_mm, b_mm) / std::max({a_mm, b_mm, 1e-6});
  return 0.5 + 0.5 * keeps(1.25 * ratio);
}

class Bridging {
 public:
  Bridging(LineGraph& graph, const std::vector<std::int32_t>& roots, const MaskTreeOptions& options)
      : graph_(graph), roots_(roots.begin(), roots.end()), options_(options) {}

  std::vector<MaskBridge> run() {
    std::vector<MaskBridge> built;
    for (auto joint = likeliest(); joint; joint = likeliest()) {
      build(*joint);
      built.push_back(joint->bridge);
    }
    return built;
  }

 private:
  std::optional<Joint> likeliest() const {
    const auto part = graph_.parts();
    std::set<std::int32_t> rooted;
    for (const std::int32_t root : roots_) rooted.insert(part.at(root));
    std::optional<Joint> best;
    const auto offer = [&](const Joint& joint) {
      if (joint.bridge.probability < std::max(options_.least_probability, 1e-9)) return;
      if (!best || joint.bridge.probability > best->bridge.probability) best = joint;
    };
    for (const auto& [id, node] : graph_.nodes()) {
      if (graph_.degree(id) != 1 || rooted.contains(part.at(id))) continue;
      const LineGraph::Line& own = graph_.lines().at(*graph_.lines_at(id).begin());
      for (const auto& [line_id, line] : graph_.lines()) {
        if (!rooted.contains(part.at(line.from))) continue;
        to_ends(id, own, line, offer);
        to_side(id, own, line_id, line, offer);
      }
    }
    return best;
  }

  template <class Offer>
  void to_ends(std::int32_t id, const LineGraph::Line& own, const LineGraph::Line& line,
               const Offer& offer) const {
    const Vec3 at = graph_.nodes().at(id).at, out = outward(own, own.from == id, direction_mm);
    for (const std::int32_t end : {line.from, line.to}) {
      if (graph_.degree(end) != 1 || roots_.contains(end)) continue;
      const Vec3 to = graph_.nodes().at(end).at, there = outward(line, line.from == end, direction_mm);
      const double gap = (to - at).norm();
      if (gap > options_.longest_gap_mm) continue;
      const Vec3 across = gap > settled_mm ? Vec3((to - at) / gap) : Vec3((out - there).normalized());
      const double probability = nearness(gap) * keeps(out.dot(across)) * keeps(-there.dot(across)) *
                                 like_calibre(mean_radius(own, own.from == id, 1.0, 6.0),
                                              mean_radius(line, line.from == end, 1.0, 6.0));
      Joint joint;
      joint.end = id;
      joint.to_end = end;
      joint.bridge = {at, to, probability, false};
      offer(joint);
    }
  }

  template <class Offer>
  void to_side(std::int32_t id, const LineGraph::Line& own, std::int32_t line_id, const LineGraph::Line& line,
               const Offer& offer) const {
    const Vec3 at = graph_.nodes().at(id).at, out = outward(own, own.from == id, direction_mm);
    double passed = side_step_mm;
    for (std::size_t i = 1; i + 1 < line.points.size(); ++i) {
      passed += (line.points[i] - line.points[i - 1]).norm();
      if (passed < side_step_mm) continue;
      passed = 0.0;
      const Vec3 to = line.points[i];
      const double way = (to - at).norm(), gap = std::max(0.0, way - line.radius_mm[i]);
      if (gap > options_.longest_gap_mm) continue;
      const double points_at = way > settled_mm ? keeps(out.dot(to - at) / way) : 1.0;
      Joint joint;
      joint.end = id;
      joint.to_line = line_id;
      joint.to_point = i;
      joint.bridge = {at, to, side_share * nearness(gap) * points_at, true};
      offer(joint);
    }
  }

  void build(const Joint& joint) {
    const std::int32_t to = joint.to_end ? *joint.to_end : graph_.split(joint.to_line, joint.to_point);
    const LineGraph::Node a = graph_.nodes().at(joint.end), b = graph_.nodes().at(to);
    // Beside a vessel its radius is no measure of the branch.
    const double far = joint.to_end ? b.radius_mm : a.radius_mm;
    const std::vector<Vec3> points = straight_points(a.at, b.at);
    std::vector<double> radius;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(points.size() - 1);
      radius.push_back((1.0 - t) * a.radius_mm + t * far);
    }
    graph_.add_line(joint.end, to, points, radius);
    graph_.tidy(roots_);
  }

  LineGraph& graph_;
  std::set<std::int32_t> roots_;
  const MaskTreeOptions& options_;
};

}  // namespace

std::vector<MaskBridge> bridge_gaps(LineGraph& graph, const std::vector<std::int32_t>& roots,
                                    const MaskTreeOptions& options) {
  return Bridging(graph, roots, options).run();
}

}  // namespace ostia::coronary
