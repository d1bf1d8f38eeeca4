#include "editing/axis_reach.h"
#include "editing/edit_kinds.h"
#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::lumen {
namespace {

using core::mm_text;

constexpr double longest_reach_mm = 50.0;
/// Moved farther than this share of its reach, an axis would fold.
constexpr double longest_move = 0.75;
/// The axis bends to a new control point over so many times its distance, at least so many mm on each side.
constexpr double insert_share = 4.0, insert_least_mm = 1.0;
/// Two control points nearer than this are one.
constexpr double same_point_mm = 1e-3;
constexpr double nearest_trim_mm = 1e-6;

double distance_along(const geometry::Centerline& axis, std::size_t i, double along_mm) {
  return std::abs(axis.abscissa[i] - along_mm);
}

void erase_point(geometry::Centerline& axis, std::size_t i) {
  axis.points.erase(axis.points.begin() + static_cast<std::ptrdiff_t>(i));
  axis.radius.erase(axis.radius.begin() + static_cast<std::ptrdiff_t>(i));
}

/// A control point of a vessel's way.
struct ControlPoint {
  std::int32_t segment = 0;
  std::size_t index = 0;
  double distance_mm = 0.0;
};

ControlPoint nearest_control_point(TreeEdit& edit, std::int32_t vessel, const Vec3& place) {
  ControlPoint best;
  best.distance_mm = std::numeric_limits<double>::infinity();
  for (const std::int32_t id : edit.vessel(vessel).segments) {
    const std::vector<Vec3>& points = edit.segment(id).axis.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = (points[i] - place).norm();
      if (distance < best.distance_mm) best = {id, i, distance};
    }
  }
  return best;
}

/// The samples that stay when a vessel's end at `end_mm` (before) becomes another: what closed it goes, and
/// what lies beyond `keep_to_mm`.
std::vector<SurfaceSample> without_end(const VesselLumen& before, double end_mm, double keep_to_mm) {
  std::vector<SurfaceSample> kept;
  const geometry::Frame frame = before.axis->frame(end_mm);
  const Vec3 end = before.axis->point(end_mm);
  for (const SurfaceSample& sample : before.samples) {
    const bool beyond = sample.s_mm > end_mm - 1e-6 && (sample.position - end).dot(frame.tangent) > 1e-6;
    if (beyond || sample.s_mm > keep_to_mm) continue;
    kept.push_back(sample);
  }
  return kept;
}

/// The wall from a vessel's former end on: as it was there, rounder with distance, and closed by a cap.
NewStretch to_new_end(const VesselLumen& lumen, const LocalWall& wall, double joint_mm) {
  constexpr double evened_over_mm = 4.0;
  NewStretch stretch;
  stretch.wall = [wall, joint_mm](double s, double theta) {
    const double x = std::clamp((s - joint_mm) / evened_over_mm, 0.0, 1.0);
    const double share = 1.0 - x * x * (3.0 - 2.0 * x);
    return wall.mean_mm + share * (wall.at(theta) - wall.mean_mm);
  };
  stretch.to_mm = lumen.axis->length();
  stretch.from_mm = std::max(0.0, std::min(joint_mm, stretch.to_mm - 0.5 * wall.mean_mm));
  stretch.cap_beyond = true;
  return stretch;
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const AxisMove& edit) {
  TreeEdit tree(model, "axis.move", edit.vessel);
  check_points({edit.from, edit.to}, 2, tree.what());
  if (!(edit.reach_mm > 0.0) || edit.reach_mm > longest_reach_mm)
    throw InvalidInput(tree.what() + ": the reach is " + mm_text(edit.reach_mm) +
                       "; choose more than 0 and up to " + mm_text(longest_reach_mm));
  const Vec3 shift = edit.to - edit.from;
  if (shift.norm() > longest_move * edit.reach_mm)
    throw InvalidInput(tree.what() + ": the axis would move by " + mm_text(shift.norm()) +
                       " within a reach of " + mm_text(edit.reach_mm) + " and fold; choose a longer reach");
  const TreePlace first = tree.locate(edit.vessel, edit.from);
  const auto centre = [&](const TreePlace& place) {
    return tree.vessel(edit.vessel).segments[place.segment];
  };
  const AxisReach coarse(tree.tree(), centre(first), first.along_mm, edit.reach_mm * 1.5);
  for (const geometry::TreeSegment& s : coarse.tree().segments) {
    const double middle = 0.5 * s.axis.abscissa.back();
    const bool near = coarse.weight_at_node(s.from) > 0.0 || coarse.weight_at_node(s.to) > 0.0 ||
                      coarse.weight(s.id, middle) > 0.0 || s.id == centre(first);
    if (near && !tree.through({s.id}).empty()) make_dense(tree, s.id, edit.reach_mm / 6.0);
  }
  const TreePlace place = tree.locate(edit.vessel, edit.from);
  const AxisReach reach(tree.tree(), centre(place), place.along_mm, edit.reach_mm);
  move_axes(tree, reach, shift);
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    const geometry::Vessel* path = nullptr;
    for (const geometry::Vessel& v : reach.tree().vessels) {
      if (v.id == before.vessel) path = &v;
    }
    const auto weight = [&](double s) { return reach.weight(*path, before.axis->length(), s); };
    const AbscissaMap map(
        *before.axis, *after.axis,
        [&](double s) -> Vec3 { return before.axis->point(s) + weight(s) * shift; }, 0.0, 0.0);
    return moved_samples(before, after, weight, shift, map);
  });
}

EditOutcome apply_to(const LumenModel& model, const AxisInsert& edit) {
  TreeEdit tree(model, "axis.insert", edit.vessel);
  check_points({edit.point}, 1, tree.what());
  const TreePlace place = tree.locate(edit.vessel, edit.point);
  if (place.past_end)
    throw InvalidInput(tree.what() + ": the point lies beyond the axis' end; use axis.extend there");
  const std::int32_t id = tree.vessel(edit.vessel).segments[place.segment];
  const ControlPoint nearest = nearest_control_point(tree, edit.vessel, edit.point);
  if (nearest.distance_mm < same_point_mm) {
    EditOutcome outcome{model, {}, {tree.what() + ": the point is a control point already"}};
    return outcome;
  }
  geometry::Centerline& axis = tree.segment(id).axis;
  // The axis comes to the point in a bow: control points too near would make a spike of it.
  const double bow =
      place.off_mm < same_point_mm ? 0.0 : std::max(insert_least_mm, insert_share * place.off_mm);
  const double radius = vessel(model, edit.vessel).axis->radius(place.s_mm);
  std::size_t at = 1;
  for (std::size_t i = axis.size(); i-- > 0;) {
    const bool end = i == 0 || i + 1 == axis.size();
    if (!end && distance_along(axis, i, place.along_mm) < bow) {
      erase_point(axis, i);
      axis.abscissa.erase(axis.abscissa.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  while (at + 1 < axis.points.size() && axis.abscissa[at] < place.along_mm) ++at;
  axis.points.insert(axis.points.begin() + static_cast<std::ptrdiff_t>(at), edit.point);
  axis.radius.insert(axis.radius.begin() + static_cast<std::ptrdiff_t>(at), radius);
  tree.axis_changed(id);
  return std::move(tree).finish(standing_samples);
}

EditOutcome apply_to(const LumenModel& model, const AxisDelete& edit) {
  TreeEdit tree(model, "axis.delete", edit.vessel);
  check_points({edit.point}, 1, tree.what());
  const ControlPoint nearest = nearest_control_point(tree, edit.vessel, edit.point);
  if (nearest.distance_mm > farthest_from_axis_mm)
    throw InvalidInput(tree.what() + ": the nearest control point is " + mm_text(nearest.distance_mm) +
                       " away; choose a place within " + mm_text(farthest_from_axis_mm));
  geometry::Centerline& axis = tree.segment(nearest.segment).axis;
  if (nearest.index == 0 || nearest.index + 1 == axis.size())
    throw InvalidInput(tree.what() +
                       ": the nearest control point is where axes begin, end or join; use axis.trim, "
                       "axis.extend or branch.delete there");
  erase_point(axis, nearest.index);
  tree.axis_changed(nearest.segment);
  return std::move(tree).finish(standing_samples);
}

EditOutcome apply_to(const LumenModel& model, const AxisExtend& edit) {
  TreeEdit tree(model, "axis.extend", edit.vessel);
  check_points(edit.points, 1, tree.what());
  const VesselLumen& lumen = vessel(model, edit.vessel);
  const double end = lumen.axis->length();
  const LocalWall wall = local_wall(*lumen.axis, lumen.samples, end, 1.5, lumen.axis->radius(end));
  geometry::TreeSegment& last = tree.segment(tree.vessel(edit.vessel).segments.back());
  for (const geometry::Vessel& other : model.tree.vessels) {
    if (merge_parent(model.tree, other.id) == edit.vessel)
      throw InvalidInput(tree.what() + ": " + vessel_label(other) +
                         " goes on from its end; extend that one, or join both first");
  }
  const double off = (edit.points.front() - last.axis.points.back()).norm();
  if (off > 3.0 * farthest_from_axis_mm)
    throw InvalidInput(tree.what() + ": the first point is " + mm_text(off) +
                       " from the vessel's end; choose one within " + mm_text(3.0 * farthest_from_axis_mm));
  int merged = 0;
  for (const Vec3& point : edit.points) {
    if ((point - last.axis.points.back()).norm() < same_point_mm) {
      ++merged;
      continue;
    }
    last.axis.points.push_back(point);
    last.axis.radius.push_back(wall.mean_mm);
  }
  if (merged == static_cast<int>(edit.points.size()))
    throw InvalidInput(tree.what() + ": all points lie on the vessel's end; choose some beyond it");
  if (merged > 0) tree.notes.push_back(tree.what() + ": points closer than 1e-3 mm were merged");
  tree.node(last.to).position = last.axis.points.back();
  tree.axis_changed(last.id);
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    VesselLumen open = before;
    open.samples = without_end(before, end, end);
    std::vector<SurfaceSample> samples = standing_samples(open, after);
    grow(tree, after, to_new_end(after, wall, end), samples);
    return samples;
  });
}

EditOutcome apply_to(const LumenModel& model, const AxisTrim& edit) {
  TreeEdit tree(model, "axis.trim", edit.vessel);
  const VesselLumen& lumen = vessel(model, edit.vessel);
  if (!(edit.s_mm > lumen.own_from_mm) || !(edit.s_mm < lumen.axis->length() - nearest_trim_mm))
    throw InvalidInput(tree.what() + ": the cut at " + mm_text(edit.s_mm) +
                       " is not on the vessel's own stretch, " + mm_text(lumen.own_from_mm) + " to " +
                       mm_text(lumen.axis->length()) +
                       "; trim the vessel that owns the place, or delete the branch");
  const LocalWall wall =
      local_wall(*lumen.axis, lumen.samples, edit.s_mm, 1.5, lumen.axis->radius(edit.s_mm));
  const TreePlace place = tree.locate(edit.vessel, edit.s_mm);
  const std::int32_t end = tree.split(edit.vessel, place);
  std::vector<std::int32_t>& path = tree.vessel(edit.vessel).segments;
  std::size_t keep = 0;
  while (keep < path.size() && tree.segment(path[keep]).to != end) ++keep;
  if (keep == path.size())
    throw InvalidInput(tree.what() + ": nothing of the vessel would be left; use branch.delete");
  std::set<std::int32_t> gone = tree.through({path[keep]});
  gone.erase(edit.vessel);
  if (!gone.empty())
    tree.notes.push_back(tree.what() + ": what leaves it beyond the cut goes, too: " + tree.names_of(gone));
  path.resize(keep + 1);
  tree.drop(gone);
  tree.way_changed(edit.vessel);
  return std::move(tree).finish([&](const VesselLumen& before, const VesselLumen& after) {
    if (before.vessel != edit.vessel) return standing_samples(before, after);
    const double cut = std::min(after.axis->length(), before.axis->length());
    VesselLumen open = before;
    open.samples = without_end(before, before.axis->length(), cut);
    std::vector<SurfaceSample> samples = standing_samples(open, after);
    grow(tree, after, to_new_end(after, wall, cut), samples);
    return samples;
  });
}

}  // namespace ostia::lumen
