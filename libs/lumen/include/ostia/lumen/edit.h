#pragma once
/// \file What a person can do to a model: plain values in world coordinates, never pixels
/// (docs/methods/editing.md).

#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ostia::lumen {

enum class ReformationMode { straightened, stretched };

/// "cpr.stroke": a new stretch of the wall drawn on a curved reformation. Samples that the tangent frame
/// bundle T* finds within beta of the stroke's side are dismissed ([Wels] 2.3).
struct CprStroke {
  std::int32_t vessel = 0;
  std::vector<Vec3> points;  ///< at least two, along the wall, in either direction
  ReformationMode mode = ReformationMode::straightened;
  double theta_deg = 0.0;  ///< of the reformation's plane
  double beta_deg = 60.0;  ///< [45, 90]
};
/// "section.contour": a whole (closed) or partial contour on the cross-section at s. Samples with |s_i - s| <
/// eps / 2 are dismissed; for a partial contour those within its angles alone.
struct SectionContour {
  std::int32_t vessel = 0;
  double s_mm = 0.0;
  double eps_mm = 1.5;  ///< (0, 20]
  bool closed = true;
  std::vector<Vec3> points;  ///< at least three
};
/// "wall.drag": the wall at `from` is pulled to `to`; its neighbours follow, less with distance, and not at
/// all beyond the reach.
struct WallDrag {
  std::int32_t vessel = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double reach_mm = 3.0;  ///< (0, 20]
};
/// "wall.push": a ball moved along a path pushes the wall before it: outwards from within the lumen, inwards
/// from without.
struct WallPush {
  std::int32_t vessel = 0;
  std::vector<Vec3> path;  ///< at least one
  double radius_mm = 1.0;  ///< (0, 10]
};

/// "axis.move": one place of the axis is moved; within the reach the axis follows smoothly, and the walls
/// with it.
struct AxisMove {
  std::int32_t vessel = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double reach_mm = 5.0;
};
/// "axis.insert" / "axis.delete": a control point of the axis. The walls stay where they are.
struct AxisInsert {
  std::int32_t vessel = 0;
  Vec3 point = Vec3::Zero();
};
struct AxisDelete {
  std::int32_t vessel = 0;
  Vec3 point = Vec3::Zero();  ///< the nearest control point goes
};
/// "axis.extend": the distal end runs on through these points with the wall's last radius.
struct AxisExtend {
  std::int32_t vessel = 0;
  std::vector<Vec3> points;
};
/// "axis.trim": what lies distal of s goes, with the branches there.
struct AxisTrim {
  std::int32_t vessel = 0;
  double s_mm = 0.0;
};
/// The wall that a new vessel starts with: distances from its axis on rays; without any it is a tube of the
/// axis' radii.
struct NewWall {
  std::int32_t around = 0;  ///< rays of a ring, from theta = 0 on, [8, 128]
  std::vector<double>
      radius_mm;  ///< ring by ring, at equal steps from the own part's first place to its last
  bool empty() const { return radius_mm.empty(); }
};
/// "branch.add": a new vessel along these points; the first is joined to the nearest axis of `parent`.
struct BranchAdd {
  std::int32_t parent = 0;
  std::string name;
  std::vector<Vec3> points;
  std::vector<double> radius_mm;  ///< one a point
  NewWall wall = {};
};
/// "vessel.add": a vessel that leaves no other, from its first point on: another ostium, a graft.
struct VesselAdd {
  std::string name;
  std::vector<Vec3> points;
  std::vector<double> radius_mm;  ///< one a point
  NewWall wall = {};
};
/// "branch.delete": a vessel and all that leave it. The last vessel stays.
struct BranchDelete {
  std::int32_t vessel = 0;
};
/// "branch.attach": a vessel's own part is joined to another place of the tree.
struct BranchAttach {
  std::int32_t vessel = 0, parent = 0;
  Vec3 at = Vec3::Zero();
};
/// "branch.split": the vessel ends at s, and what lies distal of it is a vessel of its own, which goes on
/// from there along the same axis with the same abscissas. Side branches distal of s leave the new vessel.
/// The node is put on a control point of the axis within 0.3 mm.
struct BranchSplit {
  std::int32_t vessel = 0;
  double s_mm = 0.0;  ///< on the vessel's own stretch, a radius and a spacing of its samples from both ends
  std::string name;   ///< of the new vessel; empty: "<the vessel's> distal"
};
/// "branch.merge": a vessel that goes on from the end of its parent becomes part of the parent; undoes a
/// split.
struct BranchMerge {
  std::int32_t vessel = 0;  ///< the distal one: its id and name go
};
/// "branch.cut": the vessel ends at s, and what lies distal of it, side branches too, is a tree of its own
/// that begins there. The walls stay where they are.
struct BranchCut {
  std::int32_t vessel = 0;
  double s_mm = 0.0;  ///< as that of a split
  std::string name;   ///< of the vessel that begins there; empty: "<the vessel's> distal"
};
/// "branch.connect": a new piece of vessel leads from a place on another vessel to where the vessel's own
/// part begins, which stays where it is; a tree of its own becomes a part of the parent's.
struct BranchConnect {
  std::int32_t vessel = 0, parent = 0;
  Vec3 at = Vec3::Zero();  ///< near the parent's axis
};
/// "vessel.rename"
struct VesselRename {
  std::int32_t vessel = 0;
  std::string name;
};

using Edit = std::variant<CprStroke, SectionContour, WallDrag, WallPush, AxisMove, AxisInsert, AxisDelete,
                          AxisExtend, AxisTrim, BranchAdd, BranchDelete, BranchAttach, BranchSplit,
                          BranchMerge, BranchCut, BranchConnect, VesselRename, VesselAdd>;

std::string op_name(const Edit& edit);  ///< "cpr.stroke", ...

/// The vessel from whose end this one goes on, so that "branch.merge" can join both; nothing where it begins
/// at a root or leaves the side of another. Throws InvalidInput for an unknown vessel.
std::optional<std::int32_t> merge_parent(const geometry::VesselTree& tree, std::int32_t vessel);

/// Whether a vessel's way leads through what is another's own part: connected to it, that one would make a
/// loop. A vessel leads through itself. Throws InvalidInput for an unknown vessel.
bool leads_through(const geometry::VesselTree& tree, std::int32_t vessel, std::int32_t other);

/// What became of one vessel's samples.
struct VesselChange {
  std::int32_t vessel = 0;
  std::vector<std::int64_t> removed;
  std::vector<SurfaceSample> added;
  bool axis_changed = false;  ///< or the vessel is new or gone: nothing of its former solution can be kept
};
struct EditOutcome {
  LumenModel model;
  std::vector<VesselChange> changes;  ///< by vessel
  std::vector<std::string>
      notes;  ///< what the person should know ("2 points were closer than 1e-3 mm and were merged")
};

/// The model after an edit. Pure: the same model and edit give the same bits. Throws InvalidInput, naming
/// what is wrong and the way out; the given model is never changed.
EditOutcome apply(const LumenModel& model, const Edit& edit);

}  // namespace ostia::lumen
