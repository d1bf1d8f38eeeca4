#pragma once
/// \file The wall of each branch with coordinates along and around it, and patches of it. See
/// docs/methods/bifurcations.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/branch_groups.h"
#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// Where a point of a cut wall comes from: corners of one triangle of the wall before.
struct WallPoint {
  std::array<std::int32_t, 3> points{};
  std::array<double, 3> weights{};  ///< sum 1
};

/// The wall of one branch. All arrays have one value a point.
struct MappedBranch {
  std::int32_t group = 0;
  geometry::TriMesh mesh;  ///< cut where two branches' tubes are equally deep
  std::vector<WallPoint> sources;
  std::vector<double> abscissa_mm;  ///< of the axis' nearest place (AbscissaMetric)
  std::vector<double> angle_rad;    ///< about the axis from its parallel-transport normal (AngularMetric)
  std::vector<double> distance_mm;  ///< from the axis (DistanceToCenterlines)
  std::vector<double> harmonic;     ///< 0 to 1 from end to end (HarmonicMapping); empty where it is no tube
  std::vector<double>
      stretched_mm;  ///< its mean abscissa (StretchedMapping); the abscissa where it is no tube
};

struct MappedWall {
  std::vector<MappedBranch> branches;  ///< by group
  std::vector<std::string> warnings;   ///< branches that are no tubes
};

/// What vmtkbranchclipper, vmtkbranchmetrics and vmtkbranchmapping do, on every branch of the wall. Throws
/// InvalidInput where there are no lines or triangles; Cancelled.
MappedWall map_branches(const geometry::TriMesh& wall, const geometry::BranchedLines& lines,
                        const core::TaskContext& task = core::no_task());

/// What is known at the wall's points, at those of a mapped branch; `components` values a point.
std::vector<double> mapped_values(const MappedBranch& branch, const std::vector<double>& values,
                                  std::size_t components);

struct PatchOptions {
  double length_mm = 1.0;    ///< along the branch, > 0
  std::int32_t sectors = 1;  ///< around it, >= 1
};
/// Throws InvalidInput that names the option.
void validate(const PatchOptions& options);

/// A rectangle of a branch's wall, unrolled.
struct WallPatch {
  std::int32_t group = 0;
  std::int32_t along = 0;   ///< stretched mapping from along * length_mm (LongitudinalPatchNumber)
  std::int32_t around = 0;  ///< angle from around * 2 pi / sectors (CircularPatchNumber)
  double area_mm2 = 0.0;
  std::vector<double> means;  ///< of the values, weighted by area
};

/// A triangle of a patched wall.
struct PatchTriangle {
  std::size_t patch = 0;
  std::array<Vec3, 3> corners;
};

struct PatchedWall {
  std::vector<WallPatch> patches;  ///< by group, along, around; those with any area
  std::vector<PatchTriangle> triangles;
};

/// As vmtkbranchpatching does it: `values` are arrays with one value a point of each branch,
/// values[branch][array]. Triangles are cut at the borders of patches; means are those of the linear values.
/// Throws InvalidInput for options or arrays of another length; Cancelled.
PatchedWall patch_branches(const MappedWall& wall,
                           const std::vector<std::vector<std::vector<double>>>& values,
                           const PatchOptions& options, const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
