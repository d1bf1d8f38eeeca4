#include "editing/axis_reach.h"
#include "editing/edit_kinds.h"
#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using core::mm_text;

constexpr double bow_step_mm = 0.25;
/// A bow's legs for a turn of 90 degrees, in radii of the parent: its tightest bend is about one radius.
constexpr double bow_share = 1.5;
constexpr double widest_turn = 130.0 * std::numbers::pi / 180.0;
/// A branch begins no wider than this share of its parent, so that its end stays within the parent's lumen.
constexpr double start_share = 0.9;
constexpr double same_joint_mm = 1e-3;
constexpr double bridge_step_mm = 1.0;
constexpr double longest_bridge_mm = 100.0;

/// Where a branch leaves its parent, and the way from there to its own path.
struct Junction {
  double s_mm = 0.0;         ///< on the parent's axis
  double bow_mm = 0.0;       ///< length of the way before it is the path itself
  geometry::Centerline way;  ///< from the parent's axis to the path's end; points and radii
};

/// The branch leaves its parent's axis along it and bends into its path, as vessels do: a corner would be a
/// kink. `path` begins on the parent's axis, at its foot.
Junction junction_of(const AxisCurve& parent, double foot_mm, const geometry::Centerline& path) {
  const std::vector<double> along = geometry::abscissas(path.points);
  const double radius = parent.radius(foot_mm);
  const Vec3 corner = path.points.front();
  const Vec3 ahead = geometry::at_abscissa(path.points, std::min(along.back(), 2.0 * radius)).point - corner;
  const Vec3 tangent = parent.frame(foot_mm).tangent;
  const double turn = std::acos(std::clamp(ahead.normalized().dot(tangent), -1.0, 1.0));
  double leg = bow_share * radius * std::tan(0.5 * std::min(turn, widest_turn));
  leg = std::min({leg, foot_mm, 0.5 * along.back()});
  Junction junction;
  junction.s_mm = foot_mm - leg;
  const Vec3 start = parent.point(junction.s_mm), joined = geometry::at_abscissa(path.points, leg).point;
  const double first = std::min(path.radius.front(), start_share * parent.radius(junction.s_mm));
  const auto radius_at = [&](double s) {
    const auto upper = std::upper_bound(along.begin() + 1, along.end() - 1, s);
    const auto i = static_cast<std::size_t>(upper - along.begin());
    const double t = std::clamp((s - along[i - 1]) / (along[i] - along[i - 1]), 0.0, 1.0);
    return path.radius[i - 1] + t * (path.radius[i] - path.radius[i - 1]);
  };
  const int pieces = std::max(1, static_cast<int>(std::ceil(2.0 * leg / bow_step_mm)));
  for (int i = 0; i < pieces; ++i) {
    const double t = static_cast<double>(i) / pieces, u = 1.0 - t;
    junction.way.points.push_back(u * u * start + 2.0 * t * u * corner + t * t * joined);
    junction.way.radius.push_back(u * first + t * radius_at(leg));
    if (leg < same_joint_mm) break;
  }
  if (leg >= same_joint_mm) {
    junction.way.points.push_back(joined);
    junction.way.radius.push_back(radius_at(leg));
    junction.bow_mm = geometry::length(junction.way.points);
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (along[i] < leg + 0.5 * bow_step_mm) continue;
    junction.way.points.push_back(path.points[i]);
    junction.way.radius.push_back(path.radius[i]);
  }
  return junction;
}

/// The path from its foot on the parent's axis; points that repeat are left out.
geometry::Centerline path_from(const Vec3& foot, const BranchAdd& edit, std::vector<std::string>& notes,
                               const std::string& what) {
  geometry::Centerline path;
  path.points.push_back(foot);
  path.radius.push_back(edit.radius_mm.front());
  int merged = 0;
  for (std::size_t i = 0; i < edit.points.size(); ++i) {
    if ((edit.points[i] - path.points.back()).norm() < same_joint_mm) {
      merged += i > 0 ? 1 : 0;
      continue;
    }
    path.points.push_back(edit.points[i]);
    path.radius.push_back(edit.radius_mm[i]);
  }
  const bool one_place = std::all_of(edit.points.begin(), edit.points.end(), [&](const Vec3& p) {
    return (p - edit.points.front()).norm() < same_joint_mm;
  });
  if (one_place) throw InvalidInput(what + ": all points of the path coincide");
  if (merged > 0)
    notes.push_back(what + ": " + std::to_string(merged) +
                    " points were closer than 1e-3 mm and were merged");
  return path;
}

TreePlace place_on_parent(const TreeEdit& tree, std::int32_t parent, const Vec3& at) {
  const TreePlace place = tree.locate(parent, at);
  const double length = vessel(tree.before(), parent).axis->length();
  if (place.s_mm >= length - 0.5)
    throw InvalidInput(tree.what() + ": the place is the distal end of vessel " + std::to_string(parent) +
                       "; use axis.extend there");
  return place;
}

/// Joins a way to a parent: the node on its axis, and the parent's segments up to it.
std::vector<std::int32_t> join(TreeEdit& tree, std::int32_t parent, double s_mm, geometry::Centerline& way,
                               std::int32_t& node) {
  node = tree.split(parent, tree.locate(parent, s_mm));
  way.points.front() = tree.node(node).position;
  if (way.size() > 2 && (way.points[1] - way.points[0]).norm() < 0.1 * bow_step_mm) {
    way.points.erase(way.points.begin() + 1);
    way.radius.erase(way.radius.begin() + 1);
  }
  std::vector<std::int32_t> path;
  for (const std::int32_t id : tree.vessel(parent).segments) {
    if (tree.segment(id).from == node) break;
    path.push_back(id);
  }
  return path;
}

/// A vessel's own part, which begins with `path` instead of its first segment's axis, leaves the parent's
/// axis at `foot_mm`, and with it what goes through it (`moving`).
Junction lead_from(TreeEdit& tree, std::int32_t parent, double foot_mm, const geometry::Centerline& path,
                   std::int32_t first, const std::set<std::int32_t>& moving) {
  Junction junction = junction_of(*vessel(tree.before(), parent).axis, foot_mm, path);
  std::int32_t node = 0;
  const std::vector<std::int32_t> way = join(tree, parent, junction.s_mm, junction.way, node);
  geometry::TreeSegment& segment = tree.segment(first);
  const Vec3 normal = segment.axis.frames.front().normal;
  segment.axis = junction.way;
  geometry::complete(segment.axis, normal);
  segment.from = node;
  std::vector<geometry::Vessel> stay, move;
  for (geometry::Vessel v : tree.tree().vessels) {
    if (!moving.contains(v.id)) {
      stay.push_back(std::move(v));
      continue;
    }
    const auto from = std::find(v.segments.begin(), v.segments.end(), first);
    v.segments.erase(v.segments.begin(), from);
    v.segments.insert(v.segments.begin(), way.begin(), way.end());
    tree.way_changed(v.id);
    move.push_back(std::move(v));
  }
  // Owners come first: the parent before what now leaves it.
  stay.insert(stay.end(), move.begin(), move.end());
  tree.tree().vessels = std::move(stay);
  return junction;
}

/// A vessel's own part that is to be joined to a place of another vessel.
struct Joining {
  std::vector<std::int32_t> own;  ///< its segments
  std::set<std::int32_t> moving;  ///< the vessel and all that leave it
  TreePlace place;                ///< on the parent
};
Joining joining(TreeEdit& tree, std::int32_t id, std::int32_t parent, const Vec3& at) {
  check_points({at}, 1, tree.what());
  Joining join;
  join.own = tree.own_segments(id);
  join.moving = tree.through(join.own);
  static_cast<void>(vessel(tree.before(), parent));
  if (join.moving.contains(parent))
    throw InvalidInput(tree.what() + ": vessel " + std::to_string(parent) +
                       " is the vessel itself or leaves it; attached there the tree would be a loop");
  join.place = place_on_parent(tree, parent, at);
  return join;
}

/// From a place on a parent's axis in a bow to where a vessel begins, and on along its axis.
geometry::Centerline bridged(const Vec3& foot, double parent_radius_mm, const Vec3& tangent,
                             const geometry::Centerline& axis) {
  const Vec3 start = axis.points.front(), way = start - foot;
  const double first = std::min(axis.radius.front(), start_share * parent_radius_mm);
  const int pieces = std::max(2, static_cast<int>(std::ceil(way.norm() / bridge_step_mm)));
  geometry::Centerline path;
  for (int i = 0; i < pieces; ++i) {
    // The cubic of Hermite that sets out straight and arrives along the vessel.
    const double t = static_cast<double>(i) / pieces, u = 1.0 - t;
    path.points.push_back(foot + t * t * (3.0 - 2.0 * t) * way + t * u * u * way -
                          t * t * u * way.norm() * tangent);
    path.radius.push_back(u * first + t * axis.radius.front());
  }
  path.points.insert(path.points.end(), axis.points.begin(), axis.points.end());
  path.radius.insert(path.radius.end(), axis.radius.begin(), axis.radius.end());
  return path;
}

/// The wall from a branch's new start to `to_mm`: a tube of the axis' radii that becomes the wall there.
void rebuild_start(TreeEdit& tree, const VesselLumen& lumen, double to_mm,
                   std::vector<SurfaceSample>& samples) {
  const double from = lumen.own_from_mm, to = std::min(to_mm, lumen.axis->length());
  const EvenTable radius = own_radius(tree.tree(), tree.vessel(lumen.vessel), *lumen.axis, from);
  std::erase_if(samples, [&](const SurfaceSample& s) { return s.s_mm < to; });
  const LocalWall wall = local_wall(*lumen.axis, samples, to, 1.5, radius.at(to));
  NewStretch stretch;
  stretch.from_mm = from;
  stretch.to_mm = to;
  stretch.cap_before = true;
  stretch.wall = [=](double s, double theta) {
    const double x = std::clamp((s - from) / (to - from), 0.0, 1.0), share = x * x * (3.0 - 2.0 * x);
    return radius.at(s) + share * (wall.at(theta) - radius.at(to));
  };
  grow(tree, lumen, stretch, samples);
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const BranchAdd& edit) {
  TreeEdit tree(model, "branch.add", edit.parent);
  check_name(model, edit.name, -1, tree.what());
  check_new_vessel(edit.points, edit.radius_mm, edit.wall, tree.what());
  check_points(edit.points, 2, tree.what());
  const TreePlace place = place_on_parent(tree, edit.parent, edit.points.front());
  const AxisCurve& parent = *vessel(model, edit.parent).axis;
  const geometry::Centerline path = path_from(parent.point(place.s_mm), edit, tree.notes, tree.what());
  Junction junction = junction_of(parent, place.s_mm, path);
  std::int32_t node = 0;
  std::vector<std::int32_t> way = join(tree, edit.parent, junction.s_mm, junction.way, node);
  geometry::complete(junction.way);
  geometry::TreeNode end{tree.new_tree_id(), junction.way.points.back()};
  geometry::TreeSegment segment{tree.new_tree_id(), node, end.id, std::move(junction.way)};
  way.push_back(segment.id);
  tree.tree().nodes.push_back(end);
  tree.tree().segments.push_back(std::move(segment));
  const std::int32_t id = tree.new_tree_id();
  tree.tree().vessels.push_back({id, edit.name, std::move(way)});
  if (!edit.wall.empty()) tree.start_with(id, edit.wall);
  return std::move(tree).finish(standing_samples);
}

EditOutcome apply_to(const LumenModel& model, const BranchDelete& edit) {
  TreeEdit tree(model, "branch.delete", edit.vessel);
  const std::set<std::int32_t> gone = tree.through(tree.own_segments(edit.vessel));
  if (gone.size() == model.tree.vessels.size())
    throw InvalidInput(tree.what() + ": no vessel would be left; the last one stays");
  std::set<std::int32_t> branches = gone;
  branches.erase(edit.vessel);
  if (!branches.empty())
    tree.notes.push_back(tree.what() + ": its branches go, too: " + tree.names_of(branches));
  tree.drop(gone);
  return std::move(tree).finish(standing_samples);
}

EditOutcome apply_to(const LumenModel& model, const VesselRename& edit) {
  TreeEdit tree(model, "vessel.rename", edit.vessel);
  check_name(model, edit.name, edit.vessel, tree.what());
  tree.vessel(edit.vessel).name = edit.name;
  return std::move(tree).finish(standing_samples);
}

EditOutcome apply_to(const LumenModel& model, const BranchAttach& edit) {
  TreeEdit tree(model, "branch.attach", edit.vessel);
  const auto [own, moving, place] = joining(tree, edit.vessel, edit.parent, edit.at);
  const VesselLumen& lumen = vessel(model, edit.vessel);
  const AxisCurve& parent = *vessel(model, edit.parent).axis;

  // The start goes to its new place and the rest follows, less with distance.
  const std::int32_t first = own.front();
  const Vec3 foot = parent.point(place.s_mm);
  const Vec3 shift = foot - tree.segment(first).axis.points.front();
  const double own_length = lumen.axis->length() - lumen.own_from_mm;
  const double reach_mm = std::max(5.0, 3.0 * shift.norm());
  if (reach_mm > std::max(own_length, 5.0))
    throw InvalidInput(tree.what() + ": its start would move by " + mm_text(shift.norm()) +
                       ", too far for a vessel of " + mm_text(own_length) +
                       "; attach it nearer or draw it anew");
  // Its own part alone, with what leaves it: the tree that it leaves stays.
  std::set<std::int32_t> part;
  for (const geometry::TreeSegment& s : tree.tree().segments) {
    const std::set<std::int32_t> users = tree.through({s.id});
    if (!users.empty() && std::includes(moving.begin(), moving.end(), users.begin(), users.end()))
      part.insert(s.id);
  }
  const AxisReach reach(tree.tree(), first, 0.0, reach_mm, part);
  const std::int32_t old_node = tree.segment(first).from;
  const Vec3 old_start = tree.node(old_node).position;
  move_axes(tree, reach, shift);
  tree.node(old_node).position = old_start;  // other vessels may pass it

  const Junction junction = lead_from(tree, edit.parent, place.s_mm, tree.segment(first).axis, first, moving);

  const double old_from = lumen.own_from_mm, bow_mm = junction.bow_mm;
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    if (!moving.contains(before.vessel)) return standing_samples(before, after);
    double from = after.own_from_mm;
    if (before.vessel != edit.vessel) from = own_from_mm(tree.tree(), edit.vessel);
    const geometry::Vessel* old_way = nullptr;
    for (const geometry::Vessel& v : model.tree.vessels) {
      if (v.id == before.vessel) old_way = &v;
    }
    const auto weight = [&](double s) {
      return s <= old_from ? 1.0 : reach.weight(*old_way, before.axis->length(), s);
    };
    const AbscissaMap map(
        *before.axis, *after.axis,
        [&](double s) -> Vec3 { return before.axis->point(s) + weight(s) * shift; }, old_from, from);
    if (before.vessel != edit.vessel) return moved_samples(before, after, weight, shift, map);
    // What closed the former start, or stood where the bow now is, has no place on the new one.
    const double to = from + std::max(bow_mm, after.axis->radius(from));
    VesselLumen rest = before;
    std::erase_if(rest.samples, [&](const SurfaceSample& s) { return map(s.s_mm) < to; });
    std::vector<SurfaceSample> samples = moved_samples(rest, after, weight, shift, map);
    rebuild_start(tree, after, to, samples);
    return samples;
  });
}

EditOutcome apply_to(const LumenModel& model, const BranchConnect& edit) {
  TreeEdit tree(model, "branch.connect", edit.vessel);
  const Joining join = joining(tree, edit.vessel, edit.parent, edit.at);
  const VesselLumen& lumen = vessel(model, edit.vessel);
  const AxisCurve& parent = *vessel(model, edit.parent).axis;
  const std::int32_t first = join.own.front();
  const Vec3 foot = parent.point(join.place.s_mm);
  const double gap = (tree.segment(first).axis.points.front() - foot).norm();
  if (gap < same_joint_mm)
    throw InvalidInput(tree.what() + ": it begins at that place of vessel " + std::to_string(edit.parent) +
                       " already");
  if (gap > longest_bridge_mm)
    throw InvalidInput(tree.what() + ": it begins " + mm_text(gap) + " from the place; choose one within " +
                       mm_text(longest_bridge_mm));
  const double old_from = lumen.own_from_mm;
  lead_from(tree, edit.parent, join.place.s_mm,
            bridged(foot, parent.radius(join.place.s_mm), lumen.axis->frame(old_from).tangent,
                    tree.segment(first).axis),
            first, join.moving);
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    if (!join.moving.contains(before.vessel)) return standing_samples(before, after);
    // The own part stays where it is, behind another way.
    const double start = old_from + after.axis->length() - before.axis->length();
    const AbscissaMap map(
        *before.axis, *after.axis, [&](double s) { return before.axis->point(s); }, old_from, start);
    const auto stays = [](double) { return 0.0; };
    if (before.vessel != edit.vessel) return moved_samples(before, after, stays, Vec3::Zero(), map);
    const double to = start + after.axis->radius(start);
    VesselLumen rest = before;
    std::erase_if(rest.samples, [&](const SurfaceSample& s) { return map(s.s_mm) < to; });
    std::vector<SurfaceSample> samples = moved_samples(rest, after, stays, Vec3::Zero(), map);
    rebuild_start(tree, after, to, samples);
    return samples;
  });
}

}  // namespace ostia::lumen
