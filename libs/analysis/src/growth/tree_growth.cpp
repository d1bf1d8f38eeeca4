#include "ostia/analysis/tree_growth.h"

#include "growth/cone_grid.h"
#include "growth/growth_random.h"
#include "growth/growth_topology.h"
#include "growth/joint_rule.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::Vec3;
using geometry::VesselGraph;

constexpr double cell_mm = 0.12;              // about two of the shortest segments
constexpr std::int32_t epicardial_order = 9;  // these and higher ones run along the wall
constexpr int most_tries = 60;
constexpr double degree = std::numbers::pi / 180.0;

/// A direction at an angle to `along`, at an azimuth about it.
Vec3 turned(const Vec3& along, double angle, double azimuth) {
  const Vec3 across = along.unitOrthogonal();
  return std::cos(angle) * along +
         std::sin(angle) * (std::cos(azimuth) * across + std::sin(azimuth) * along.cross(across));
}

Vec3 inwards(const GrowthDomain& domain, const Vec3& at) {
  constexpr double step = 0.05;
  Vec3 gradient;
  for (int a = 0; a < 3; ++a)
    gradient[a] = domain(at + step * Vec3::Unit(a)) - domain(at - step * Vec3::Unit(a));
  return gradient.squaredNorm() > 0.0 ? gradient.normalized().eval() : Vec3::Zero().eval();
}

/// Of two segments that share a point: the end of the new one still lies within the other one, so that what
/// comes next would begin there.
bool runs_along(const RoundCone& cone, const RoundCone& other) {
  const double length = (cone.to - cone.from).norm();
  const double clear = 1.6 * (cone.radius_to + std::max(other.radius_from, other.radius_to));
  const RoundCone end{cone.to, cone.to, std::min(clear, 0.75 * length), std::min(clear, 0.75 * length)};
  return contact(end, {other.from, other.to, 0.0, 0.0}).has_value();
}

/// Its end lies within the other one's wall.
bool ends_within(const RoundCone& cone, const RoundCone& other) {
  return contact({cone.to, cone.to, 0.0, 0.0}, other).has_value();
}

/// What an element's next segment starts from.
struct Tip {
  std::int32_t point;
  Vec3 along;             ///< unit
  double angle;           ///< about which it turns away from there
  double azimuth;         ///< where it turns to first
  double least_mm = 0.0;  ///< > 0: it leaves a stem, and is to end outside it
};

class TreeGrower {
 public:
  TreeGrower(const VesselGraph& scanned, const GrowthDomain& domain, const GrowthOptions& options)
      : domain_(domain),
        options_(options),
        table_(coronary_morphometry(options.artery)),
        joints_(tree_.graph, arriving_, {}),
        grid_(cell_mm) {
    tree_.graph.points = scanned.points;
    arriving_.assign(scanned.points.size(), -1);
    std::vector<bool> left(scanned.points.size(), false);
    for (const GraphEdge& edge : scanned.edges) add_scanned(edge, left);
    for (std::size_t p = 0; p < left.size(); ++p)
      if (arriving_[p] >= 0 && !left[p]) add_root(static_cast<std::int32_t>(p));
    if (roots_.empty())
      throw InvalidInput(
          "growth: the tree has no ends to grow from; an end is a point that a segment reaches "
          "and none leaves");
  }
  TreeGrower(const TreeGrower&) = delete;

  GrownTree grow(const core::TaskContext& task) {
    task.set_stage("branching");
    const GrowthTopology plan =
        grow_topology(table_, roots_, options_.seed, options_.most_segments, task.sub(0.0, 0.05));
    task.set_stage("growing");
    first_point_.assign(plan.elements.size(), -1);
    grown_.assign(plan.elements.size(), 0);
    root_of_.assign(plan.elements.size(), -1);
    for (std::size_t i = 0; i < plan.root_element.size(); ++i)
      root_of_[static_cast<std::size_t>(plan.root_element[i])] = static_cast<std::int32_t>(i);
    reserve(static_cast<std::size_t>(plan.segments));
    for (std::size_t e = 0; e < plan.elements.size(); ++e) {
      if (e % 256 == 0) task.throw_if_cancelled();
      if (e % 8192 == 0)
        task.set_progress(0.05 + 0.95 * static_cast<double>(e) / static_cast<double>(plan.elements.size()));
      grow_element(plan, e);
    }
    task.set_progress(1.0);
    return std::move(tree_);
  }

 private:
  void add_scanned(const GraphEdge& edge, std::vector<bool>& left) {
    const auto index = static_cast<std::int32_t>(tree_.graph.edges.size());
    const auto count = static_cast<std::int64_t>(tree_.graph.points.size());
    const auto refuse = [index](const std::string& what) {
      throw InvalidInput("growth: segment " + std::to_string(index) + " " + what +
                         "; ostia convert --repair mends what can be mended");
    };
    for (const std::int32_t point : {edge.from, edge.to}) {
      if (point < 0 || point >= count)
        refuse("names point " + std::to_string(point) + ", which is not there");
      if (!tree_.graph.points[static_cast<std::size_t>(point)].allFinite()) refuse("has no place in space");
    }
    for (const double radius : {edge.radius_from, edge.radius_to})
      if (!std::isfinite(radius) || radius <= 0.0) refuse("has the radius " + std::to_string(radius) + " mm");
    if (arriving_[static_cast<std::size_t>(edge.to)] >= 0) refuse("joins another one at its end");
    tree_.graph.edges.push_back(edge);
    tree_.order.push_back(0);
    tree_.element.push_back(-1);
    arriving_[static_cast<std::size_t>(edge.to)] = index;
    left[static_cast<std::size_t>(edge.from)] = true;
    grid_.add(index, round_cone(tree_.graph, index));
  }

  void add_root(std::int32_t point) {
    const GraphEdge& edge =
        tree_.graph.edges[static_cast<std::size_t>(arriving_[static_cast<std::size_t>(point)])];
    roots_.push_back({table_.order_of(2.0 * edge.radius_to), 2.0 * edge.radius_to});
    root_point_.push_back(point);
  }

  void reserve(std::size_t more) {
    tree_.graph.points.reserve(tree_.graph.points.size() + more);
    tree_.graph.edges.reserve(tree_.graph.edges.size() + more);
    tree_.order.reserve(tree_.order.size() + more);
    tree_.element.reserve(tree_.element.size() + more);
    arriving_.reserve(arriving_.size() + more);
  }

  Vec3 direction_at(std::int32_t point) const {
    const std::int32_t edge = arriving_[static_cast<std::size_t>(point)];
    if (edge < 0) return Vec3::UnitX();
    const Vec3 along =
        tree_.graph.points[static_cast<std::size_t>(point)] -
        tree_.graph.points[static_cast<std::size_t>(tree_.graph.edges[static_cast<std::size_t>(edge)].from)];
    return along.squaredNorm() > 0.0 ? along.normalized().eval() : Vec3::UnitX().eval();
  }

  /// Where an element begins; a point of -1 where what it springs from has not grown that far.
  Tip begin(const GrowthTopology& plan, std::size_t e, GrowthRandom& random) const {
    const GrowthElement& own = plan.elements[e];
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    if (own.parent < 0) {
      const std::int32_t point = root_point_[static_cast<std::size_t>(root_of_[e])];
      return {point, direction_at(point), 0.0, azimuth};
    }
    const auto parent = static_cast<std::size_t>(own.parent);
    if (own.fork >= grown_[parent]) return {-1, Vec3::UnitX(), 0.0, 0.0};
    const std::int32_t point = first_point_[parent] + own.fork;
    const bool end = own.fork + 1 == plan.elements[parent].segments;
    // Small branches leave a stem at a wide angle, the two at its end at about 40 degrees each.
    return {point, direction_at(point), (end ? 40.0 : 70.0) * degree, azimuth};
  }

  std::vector<double> cut(const GrowthElement& element, double parent_radius, GrowthRandom& random) const {
    std::vector<double> lengths(static_cast<std::size_t>(element.segments));
    double sum = 0.0;
    for (double& length : lengths) sum += length = random.between(0.7, 1.3);
    for (double& length : lengths) length *= element.length_mm / sum;
    // The first one comes out of the vessel it springs from, at the cost of the others.
    const double least = std::min(0.9 * element.length_mm, 1.2 * parent_radius + element.diameter_mm);
    if (lengths.size() > 1 && lengths[0] < least) {
      const double scale = (element.length_mm - least) / (element.length_mm - lengths[0]);
      for (double& length : lengths) length *= scale;
      lengths[0] = least;
    }
    return lengths;
  }

  void grow_element(const GrowthTopology& plan, std::size_t e) {
    const GrowthElement& own = plan.elements[e];
    GrowthRandom random(options_.seed, 10'000U + e);
    Tip tip = begin(plan, e, random);
    ++tree_.elements;
    if (tip.point < 0) {
      ++tree_.elements_left_out;
      return;
    }
    const double parent_radius =
        own.parent < 0 ? 0.0 : 0.5 * plan.elements[static_cast<std::size_t>(own.parent)].diameter_mm;
    if (own.parent >= 0) tip.least_mm = parent_radius + 0.5 * own.diameter_mm;
    double owed = 0.0;
    first_point_[e] = static_cast<std::int32_t>(tree_.graph.points.size());
    for (const double length : cut(own, parent_radius, random)) {
      const double placed = place(tip, length + owed, own, random);
      if (placed <= 0.0) break;
      owed += length - placed;
      tree_.element.back() = static_cast<std::int32_t>(e);
      ++grown_[e];
      tip = {static_cast<std::int32_t>(tree_.graph.points.size()) - 1,
             direction_at(static_cast<std::int32_t>(tree_.graph.points.size()) - 1), 0.0,
             random.between(0.0, 2.0 * std::numbers::pi)};
    }
    if (grown_[e] == 0)
      ++tree_.elements_left_out;
    else if (grown_[e] < own.segments || owed > 1e-9 * own.length_mm)
      ++tree_.elements_shortened;
  }

  /// Tries directions further and further off, then shorter segments. Returns the length that had room; 0:
  /// none.
  double place(const Tip& tip, double length, const GrowthElement& element, GrowthRandom& random) {
    const Vec3 from = tree_.graph.points[static_cast<std::size_t>(tip.point)];
    const double depth = domain_(from);
    Vec3 inward = Vec3::Zero();
    bool looked = false;
    for (int round = 0; round < 4 && (round == 0 || length >= tip.least_mm); ++round, length *= 0.6)
      for (int k = 0; k < most_tries; ++k) {
        const double angle = tip.angle + std::abs(random.normal()) * (8.0 + 2.0 * k) * degree;
        const double turn = k == 0 ? 0.0 : random.between(0.0, 2.0 * std::numbers::pi);
        Vec3 along = turned(tip.along, angle, tip.azimuth + turn);
        const bool near_border = depth < length || k > 2;
        if (!looked && (near_border || element.order >= epicardial_order)) {
          inward = inwards(domain_, from);
          looked = true;
        }
        if (element.order >= epicardial_order)
          along -= 0.9 * along.dot(inward) * inward;
        else if (near_border && along.dot(inward) < 0.0)
          along -= random.between(1.0, 2.0) * along.dot(inward) * inward;
        if (depth < element.diameter_mm) along += random.uniform() * inward;
        if (!(along.squaredNorm() > 1e-12)) continue;
        if (fits(tip, from + length * along.normalized(), depth, element)) return length;
      }
    return 0.0;
  }

  /// Keeps the segment where it lies inside and meets nothing.
  bool fits(const Tip& tip, const Vec3& to, double depth, const GrowthElement& element) {
    const std::int32_t point = tip.point;
    const double radius = 0.5 * element.diameter_mm;
    const Vec3& from = tree_.graph.points[static_cast<std::size_t>(point)];
    const double needed = std::min(radius, depth + 0.2 * (to - from).norm());
    if (domain_(to) < needed || domain_(0.5 * (from + to)) < std::min(needed, depth)) return false;
    const auto index = static_cast<std::int32_t>(tree_.graph.edges.size());
    const RoundCone cone{from, to, radius, radius};
    tree_.graph.edges.push_back(
        {point, static_cast<std::int32_t>(tree_.graph.points.size()), radius, radius});
    tree_.graph.points.push_back(to);
    arriving_.push_back(index);
    const bool meets = grid_.any_near(cone, [&](std::int32_t other) {
      const RoundCone near = round_cone(tree_.graph, other);
      if (joints_.share_a_point(index, other))
        return runs_along(cone, near) || (tip.least_mm > 0.0 && ends_within(cone, near));
      const std::optional<ConeContact> hit = contact(cone, near);
      return hit && !joints_.covers(index, other, *hit);
    });
    if (meets) {
      tree_.graph.edges.pop_back();
      tree_.graph.points.pop_back();
      arriving_.pop_back();
      return false;
    }
    tree_.order.push_back(element.order);
    tree_.element.push_back(-1);
    grid_.add(index, cone);
    return true;
  }

  const GrowthDomain& domain_;
  GrowthOptions options_;
  const Morphometry& table_;
  GrownTree tree_;
  std::vector<std::int32_t> arriving_;
  JointRule joints_;
  ConeGrid grid_;
  std::vector<GrowthRoot> roots_;
  std::vector<std::int32_t> root_point_;   ///< of each root
  std::vector<std::int32_t> root_of_;      ///< of each element; -1: none
  std::vector<std::int32_t> first_point_;  ///< of each element: its first own point; the others follow
  std::vector<std::int32_t> grown_;        ///< segments of each element that had room
};

}  // namespace

GrownTree grow_tree(const VesselGraph& scanned, const GrowthDomain& domain, const GrowthOptions& options,
                    const core::TaskContext& task) {
  return TreeGrower(scanned, domain, options).grow(task);
}

}  // namespace ostia::analysis
