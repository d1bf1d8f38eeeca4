#pragma once
/// \file A faulty surface made fit for centerlines and meshing, as far as that needs no guess.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// Which connected parts stay.
enum class KeptParts {
  vessels,  ///< all but specks and closed parts within others
  all,
  largest,  ///< by area
};

struct RepairOptions {
  /// Holes whose rim is no wider than this are closed, mm; 0: none, for an open end is a hole, too. A hole's
  /// width is its rim's length over pi. >= 0.
  double fill_holes_up_to_mm = 0.0;
  KeptParts parts = KeptParts::vessels;
};
void validate(const RepairOptions& options);

/// One kind of thing that was done.
struct RepairStep {
  std::string what;       ///< key for machines: `degenerate_triangles_dropped`
  std::size_t count = 0;  ///< > 0
  std::string text;       ///< for a person: "triangles that were degenerate dropped: 3"
};

struct Repaired {
  geometry::TriMesh mesh;
  std::vector<RepairStep> steps;  ///< in the order of work; empty when nothing was wrong
  std::vector<std::string> done;  ///< the steps' texts
  std::string rough;              ///< of a wall that was smoothed all over: how far; empty: it was not
  std::string left;               ///< faults that remain, "none" when there are none; open ends are no fault
  bool meshable = true;           ///< none of those that remain keeps it from being meshed
};

/// Drops triangles with points that are not finite, degenerate and duplicate ones; joins equal points; takes
/// the surface apart where sheets only touch, at points and along edges; drops flaps on edges where three
/// sheets join, and parts that are not to stay; turns triangles the same way and each part outward; pulls
/// single points in that stand far out of the surface or stab through it; smooths places that cross
/// themselves because they are rough, in their volume; cuts other self-intersecting places out, with the
/// triangles around them, and closes the holes that this leaves; closes small holes where asked to. Open ends
/// stay open. Throws InvalidInput (options), GeometryError when nothing is left, Cancelled.
Repaired repaired(const geometry::TriMesh& mesh, const RepairOptions& options,
                  const core::TaskContext& task = core::no_task());
Repaired repaired(const geometry::TriMesh& mesh, const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
