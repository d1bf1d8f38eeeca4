#pragma once
/// \file Sections of a lumen's surface across its branches and beside its bifurcations, as VMTK has them. See
/// docs/methods/bifurcations.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/branch_groups.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// Where a plane across a branch cuts the wall.
struct BranchSection {
  std::int32_t group = 0;
  std::int32_t spheres = 0;     ///< inscribed spheres from the branch's beginning, or from the bifurcation
  Vec3 point = Vec3::Zero();    ///< on the axis, mm
  Vec3 normal = Vec3::UnitZ();  ///< downstream
  std::vector<Vec3> outline;    ///< mm; its last point joins the first
  bool closed = false;          ///< the outline is all of this branch, and has no gap
  double area_mm2 = 0.0;        ///< of the polygon
  double perimeter_mm = 0.0;    ///< without the side that closes what is open
  double min_mm = 0.0;          ///< from the nearest place of the outline through the point to the other side
  double max_mm = 0.0;          ///< the same from the farthest
  double shape() const { return max_mm > 0.0 ? min_mm / max_mm : 0.0; }
};

struct BifurcationSection {
  BranchSection section;
  std::int32_t bifurcation = 0;
  bool downstream = false;  ///< the branch leaves the bifurcation
};

struct SurfaceSections {
  std::vector<BranchSection> branches;           ///< by group, from its beginning
  std::vector<BifurcationSection> bifurcations;  ///< by bifurcation, the branch before it first
  std::vector<std::string> warnings;             ///< how many planes met no wall of their branch
};

struct SectionOptions {
  std::int32_t spheres_apart = 1;        ///< of branch sections, >= 1
  std::int32_t bifurcation_spheres = 1;  ///< of bifurcation sections from their bifurcation, >= 1
};
/// Throws InvalidInput that names the option.
void validate(const SectionOptions& options);

/// Sections stand across the mean of the branch's lines (weighted by their radii's squares). A place of the
/// wall belongs to the branch in whose tube it lies deepest; of an outline that runs over several branches
/// the part of the own one that is nearest to the axis is kept, cut where two tubes are equally deep, and the
/// section is not closed. Throws InvalidInput for options, no lines, or a surface without triangles;
/// Cancelled.
SurfaceSections branch_sections(const geometry::TriMesh& wall, const geometry::BranchedLines& lines,
                                const SectionOptions& options = {},
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
