#pragma once
/// \file Axes of all that a surface holds: of each of its parts, to each of its ends, those that nobody named
/// among them. See docs/methods/foreign-surfaces.md.

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/clip.h"
#include "ostia/meshing/flat_caps.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// What becomes of ends that nobody asked for, where others were asked for or are open.
enum class SideBranches {
  asked_only,  ///< axes to what was asked for alone
  closed,      ///< open ends get axes and outlets; blind branches and sacs stay closed, and are told
  axes,        ///< each blind branch gets an axis and an outlet at its end, too
  stubs,       ///< each gets an axis, and is cut off a diameter from its mouth, with an outlet
};

struct AxesRequest {
  std::vector<geometry::Vec3>
      sources;  ///< where the axes begin, one a part at most; left out: see lumen_axes
  std::vector<geometry::Vec3> targets;  ///< where they end
  std::vector<std::string>
      target_names;  ///< of the vessels that end there; empty: as extract_centerlines has them
  std::vector<meshing::GivenEnd> ends;  ///< of caps that were taken off: names, and which is the inlet
  std::shared_ptr<const centerline::KnownSurface> known;  ///< of the surface (TakenSurface::known), or null
  SideBranches side_branches = SideBranches::closed;
  centerline::CenterlineOptions centerline;
};

struct LumenAxes {
  geometry::VesselTree tree;                      ///< a root for each part
  std::vector<geometry::Centerline> lines;        ///< one a target, part by part
  centerline::CenterlineDiagnostics diagnostics;  ///< summed over parts; its warnings too
  std::vector<meshing::PlacedPlane> stubs;        ///< where side branches are to be cut off
  /// Ends that were found, branches that nobody had asked for, with place and length.
  std::vector<std::string> told;
};

/// Each connected part is a system of vessels with one inlet: the source where it lies there, else the end
/// that is called an inlet, else the widest open end, else the widest blind one (centerline::find_tips; a
/// trunk of three radii is one where no longer branch is as wide). Its
/// targets are those that were asked for and all other open ends; blind ends of branches that no target lies
/// on, too, where side_branches says so or there is nothing else to go to. Names: those of caps; `side_<n>`
/// where targets were given and this is none of them; else as extract_centerlines has them. Throws what
/// extract_centerlines throws.
LumenAxes lumen_axes(const geometry::TriMesh& lumen, const AxesRequest& request,
                     const core::TaskContext& task = core::no_task());

/// The same where axes are known: nothing where they come to all ends of the surface, else axes to their ends
/// and to the others. Their vessels keep their names.
std::optional<LumenAxes> with_side_branches(const geometry::TriMesh& lumen, const geometry::VesselTree& known,
                                            AxesRequest request,
                                            const core::TaskContext& task = core::no_task());

/// The triangles' parts, each as a mesh of its own, in the order of geometry::components.
std::vector<geometry::TriMesh> parts_of(const geometry::TriMesh& mesh);

}  // namespace ostia::pipeline
