#include "pressure/pressure_branches.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

using geometry::AxisCurve;
using geometry::Vec3;
using hemodynamics::Branch;
using hemodynamics::Station;

constexpr double least_gap_mm = 1e-3;

/// Of the circle through three points of the axis.
double curvature_at(const AxisCurve& axis, double s, double chord) {
  const double half = std::min({chord, s, axis.length() - s});
  if (!(half > 0.25 * chord))
    return curvature_at(axis, std::clamp(s, 0.5 * chord, axis.length() - 0.5 * chord), 0.5 * chord);
  const Vec3 a = axis.point(s - half), b = axis.point(s), c = axis.point(s + half);
  const double sides = (b - a).norm() * (c - b).norm() * (c - a).norm();
  return sides > 0.0 ? 2.0 * (b - a).cross(c - b).norm() / sides : 0.0;
}

double bend_at(const AxisCurve& axis, double s, double chord) {
  return axis.length() > 2.0 * chord ? curvature_at(axis, s, chord) : 0.0;
}

/// The section at an abscissa between two that are known.
Station station_between(const PressureVessel& vessel, std::size_t a, std::size_t b, double s) {
  const auto& sections = vessel.profile.sections;
  const double length = sections[b].s_mm - sections[a].s_mm;
  const double t = length > 0.0 ? std::clamp((s - sections[a].s_mm) / length, 0.0, 1.0) : 0.0;
  Station station;
  station.s_mm = s;
  const double root = (1.0 - t) * std::sqrt(sections[a].area_mm2) + t * std::sqrt(sections[b].area_mm2);
  station.area_mm2 = root * root;
  const auto mix = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  station.shape.viscous = mix(vessel.shapes[a].viscous, vessel.shapes[b].viscous);
  station.shape.perimeter = mix(vessel.shapes[a].perimeter, vessel.shapes[b].perimeter);
  return station;
}

/// The sections that count: those that are found, and those that are shut.
std::vector<std::size_t> known_sections(const PressureVessel& vessel, double from, double to) {
  std::vector<std::size_t> known;
  const auto& sections = vessel.profile.sections;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (!sections[i].open && sections[i].s_mm >= from - 1e-6 && sections[i].s_mm <= to + 1e-6)
      known.push_back(i);
  return known;
}

struct BranchStretch {
  double from = 0.0, to = 0.0;
  bool begins_tree = false, ends_tree = false;
  double joint = 0.0;  // where its axis leaves its parent's
};

/// What lies within a quarter of a calibre of the tree's own ends is not the vessel's wall, but where it was
/// cut; and a lumen that is shut there is its end. An axis with radii ends where it ends.
void trim_ends(const PressureVessel& vessel, const BranchStretch& stretch, std::vector<std::size_t>& known) {
  if (!vessel.of_walls) return;
  const auto& sections = vessel.profile.sections;
  const auto beyond = [&](std::size_t i, double end) {
    return !sections[i].found || std::abs(sections[i].s_mm - end) < 0.25 * vessel.reference.diameter_mm[i];
  };
  if (stretch.begins_tree)
    while (known.size() > 2 && beyond(known.front(), stretch.from)) known.erase(known.begin());
  if (stretch.ends_tree)
    while (known.size() > 2 && beyond(known.back(), stretch.to)) known.pop_back();
}

std::vector<Station> stations_of(const PressureVessel& vessel, const BranchStretch& stretch, double chord) {
  std::vector<std::size_t> known = known_sections(vessel, stretch.from, stretch.to);
  trim_ends(vessel, stretch, known);
  std::vector<Station> stations;
  if (known.empty() || !(stretch.to > stretch.from + least_gap_mm)) return stations;
  const auto& sections = vessel.profile.sections;
  const auto add = [&](std::size_t a, std::size_t b, double s) {
    if (!stations.empty() && s < stations.back().s_mm + least_gap_mm) return;
    stations.push_back(station_between(vessel, a, b, s));
    stations.back().curvature_per_mm = bend_at(*vessel.axis, s, chord);
    stations.back().point = vessel.axis->point(s);
  };
  const double last = stretch.ends_tree ? sections[known.back()].s_mm : stretch.to;
  const double first = stretch.begins_tree ? sections[known.front()].s_mm : stretch.from;
  // At the stretch's ends: between the sections on either side, where both are known.
  const auto beside = [&](std::size_t i, std::size_t other) {
    return other < sections.size() && sections[other].found ? other : i;
  };
  add(beside(known.front(), known.front() - 1), known.front(), first);
  for (const std::size_t i : known)
    if (sections[i].s_mm > first && sections[i].s_mm < last - least_gap_mm) add(i, i, sections[i].s_mm);
  add(known.back(), beside(known.back(), known.back() + 1), last);
  if (stations.size() < 2) stations.clear();
  return stations;
}

Vec3 chord_of(const AxisCurve& axis, double from, double to) {
  const Vec3 way = axis.point(to) - axis.point(from);
  return way.norm() > 1e-9 ? Vec3(way.normalized()) : axis.frame(from).tangent;
}

/// Angles of the branches of one fork: between chords of about a diameter on either side; on one side of the
/// plane that the parent and the branch that turns most lie in positive, on the other negative.
void set_angles(PressureTree& tree, std::size_t parent, const std::vector<std::size_t>& children,
                const std::vector<BranchStretch>& stretches) {
  const auto& branches = tree.network.branches;
  const AxisCurve& axis = *tree.vessels.at(branches[parent].vessel).axis;
  const double end = stretches[parent].to;
  const Vec3 before =
      chord_of(axis, std::max(stretches[parent].from, end - 2.0 * axis.radius(end) - 1.0), end);
  std::vector<Vec3> directions;
  Vec3 normal = Vec3::Zero();
  for (const std::size_t child : children) {
    const AxisCurve& own = *tree.vessels.at(branches[child].vessel).axis;
    // Past the fork itself: what goes on in its parent's vessel begins in the middle of it.
    const double from =
        std::min(own.length(), std::max(stretches[child].from, stretches[child].joint + axis.radius(end)));
    directions.push_back(chord_of(own, from, std::min(own.length(), from + 2.0 * own.radius(from) + 1.0)));
    const Vec3 turn = before.cross(directions.back());
    if (turn.norm() > normal.norm()) normal = turn;
  }
  for (std::size_t i = 0; i < children.size(); ++i) {
    const double angle = std::acos(std::clamp(before.dot(directions[i]), -1.0, 1.0));
    const double side = before.cross(directions[i]).dot(normal);
    tree.network.branches[children[i]].angle_rad = side < 0.0 ? -angle : angle;
  }
}

void tell_missing(PressureTree& tree, const PressureVessel& vessel, const BranchStretch& stretch) {
  double open = 0.0;
  const auto& sections = vessel.profile.sections;
  const double step =
      sections.size() > 1 ? vessel.profile.length_mm / static_cast<double>(sections.size() - 1) : 0.0;
  for (const auto& section : sections)
    if (section.open && section.s_mm >= stretch.from && section.s_mm <= stretch.to) open += step;
  if (open >= 2.0)
    tree.warnings.push_back(core::mm_text(open, 1) + " of " +
                            (vessel.name.empty() ? "a vessel" : vessel.name) +
                            " have no closed wall; the calibre there is taken from the sections beside them");
}

}  // namespace

std::map<std::int32_t, std::int32_t> owners_of(const geometry::VesselTree& tree) {
  std::map<std::int32_t, std::int32_t> owners;
  for (const geometry::Vessel& vessel : tree.vessels)
    for (const std::int32_t segment : vessel.segments) owners.try_emplace(segment, vessel.id);
  return owners;
}

bool owns_a_segment(const std::map<std::int32_t, std::int32_t>& owners, std::int32_t vessel) {
  return std::any_of(owners.begin(), owners.end(), [&](const auto& one) { return one.second == vessel; });
}

std::size_t shared_segments(const std::map<std::int32_t, std::int32_t>& owners,
                            const geometry::Vessel& vessel) {
  std::size_t shared = 0;
  while (shared < vessel.segments.size() && owners.at(vessel.segments[shared]) != vessel.id) ++shared;
  return shared;
}

WayOnAxis way_on_axis(const geometry::VesselTree& tree, const geometry::Vessel& vessel,
                      const AxisCurve& axis) {
  WayOnAxis way{{0.0}};
  double along = 0.0;  // the points' distances: near enough to say which foot is meant
  for (std::size_t i = 0; i < vessel.segments.size(); ++i) {
    const geometry::TreeSegment& segment = geometry::segment(tree, vessel.segments[i]);
    for (std::size_t k = 1; k < segment.axis.size(); ++k)
      along += (segment.axis.points[k] - segment.axis.points[k - 1]).norm();
    const double guess = std::min(along, axis.length());
    const auto foot = axis.foot_near(segment.axis.points.back(), guess, 2.0 + 0.01 * guess);
    way.node_mm.push_back(i + 1 == vessel.segments.size() ? axis.length() : foot ? foot->s_mm : guess);
  }
  return way;
}

void make_branches(PressureTree& tree, const geometry::VesselTree& vessels,
                   const std::map<std::int32_t, std::int32_t>& owners, double bend_chord_mm) {
  std::map<std::int32_t, std::size_t> branch_ending_at;  // node -> branch
  std::map<std::int32_t, std::pair<std::int32_t, std::pair<double, double>>>
      range;  // segment -> owner, abscissas
  for (const geometry::Vessel& vessel : vessels.vessels) {
    const auto found = tree.vessels.find(vessel.id);
    if (found == tree.vessels.end()) continue;
    const WayOnAxis way = way_on_axis(vessels, vessel, *found->second.axis);
    for (std::size_t i = 0; i < vessel.segments.size(); ++i)
      if (owners.at(vessel.segments[i]) == vessel.id)
        range[vessel.segments[i]] = {vessel.id, {way.node_mm[i], way.node_mm[i + 1]}};
  }
  const std::vector<std::int32_t> ends = geometry::ends(vessels), roots = geometry::roots(vessels);
  const auto holds = [](const std::vector<std::int32_t>& nodes, std::int32_t node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  };
  std::vector<BranchStretch> stretches;
  std::vector<std::vector<std::size_t>> children;
  std::vector<const geometry::TreeSegment*> waiting;
  for (const geometry::TreeSegment& segment : vessels.segments) waiting.push_back(&segment);
  for (bool more = true; more && !waiting.empty();) {
    more = false;
    std::vector<const geometry::TreeSegment*> later;
    for (const geometry::TreeSegment* segment : waiting) {
      const auto before = branch_ending_at.find(segment->from);
      if (before == branch_ending_at.end() && !holds(roots, segment->from)) {
        later.push_back(segment);
        continue;
      }
      more = true;
      if (!range.contains(segment->id))
        throw InvalidInput("segment " + std::to_string(segment->id) + " of the tree belongs to no vessel");
      const auto& [owner, way] = range.at(segment->id);
      const PressureVessel& vessel = tree.vessels.at(owner);
      Branch branch;
      branch.segment = segment->id;
      branch.vessel = owner;
      branch.name = vessel.name;
      branch.parent = before == branch_ending_at.end() ? -1 : static_cast<int>(before->second);
      BranchStretch stretch{way.first, way.second, branch.parent < 0, holds(ends, segment->to), way.first};
      // Its part in the parent's lumen is the parent's.
      stretch.from = std::min(std::max(stretch.from, vessel.ostium_mm), stretch.to);
      branch.stations = stations_of(vessel, stretch, bend_chord_mm);
      tell_missing(tree, vessel, stretch);
      const std::size_t index = tree.network.branches.size();
      branch_ending_at[segment->to] = index;
      if (branch.parent >= 0) children[static_cast<std::size_t>(branch.parent)].push_back(index);
      tree.network.branches.push_back(std::move(branch));
      stretches.push_back(stretch);
      children.emplace_back();
    }
    waiting = std::move(later);
  }
  if (tree.network.branches.empty()) throw InvalidInput("the tree has no vessel that blood could enter");
  for (std::size_t b = 0; b < children.size(); ++b)
    if (!children[b].empty()) set_angles(tree, b, children[b], stretches);
}

std::vector<std::size_t> remake_branches(PressureTree& tree, std::int32_t vessel, double from_mm,
                                         double to_mm, double bend_chord_mm) {
  std::vector<std::size_t> changed;
  const PressureVessel& measured = tree.vessels.at(vessel);
  for (std::size_t b = 0; b < tree.network.branches.size(); ++b) {
    Branch& branch = tree.network.branches[b];
    if (branch.vessel != vessel || branch.stations.size() < 2) continue;
    BranchStretch stretch{branch.stations.front().s_mm, branch.stations.back().s_mm, false, false, 0.0};
    if (stretch.to < from_mm || stretch.from > to_mm) continue;
    std::vector<Station> anew = stations_of(measured, stretch, bend_chord_mm);
    if (anew.size() < 2) continue;
    branch.stations = std::move(anew);
    changed.push_back(b);
  }
  return changed;
}

}  // namespace ostia::session
