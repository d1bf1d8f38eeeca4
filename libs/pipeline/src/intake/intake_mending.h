#pragma once
/// \file The steps by which a surface is mended before it is taken.

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"

#include <memory>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// The numbers of the labels on a surface that was changed: those of the nearest triangles before.
std::vector<std::int32_t> labels_on(const geometry::TriMesh& mesh, const geometry::FacedSurface& before);

/// Triangles whose points are no numbers go, with their labels; told. Throws GeometryError where none is
/// left.
void drop_what_is_nowhere(geometry::FacedSurface& surface, std::vector<std::string>& told);

struct MendedParts {
  std::vector<geometry::TriMesh> parts;
  bool rough = false;  ///< a wall was so rough that it was smoothed all over: what was flat on it is round
};

/// Each part turned, welded, taken apart, smoothed where it is rough, its folds cut out; one line for each
/// kind of step. Throws GeometryError where nothing is left, Cancelled.
MendedParts mended(const geometry::TriMesh& mesh, std::vector<std::string>& told,
                   const core::TaskContext& task);

/// A part's open ends.
struct Rims {
  std::vector<std::vector<std::int32_t>> loops;
  std::shared_ptr<const geometry::AabbTree> tree;  ///< of the part with its holes filled; null if not needed
};
Rims rims_of(const geometry::TriMesh& part, const geometry::FilledHoles& filled,
             bool tree_in_any_case = false);

/// An opening much narrower than the lumen behind it is no end. `filled` is the part with its holes filled.
/// Returns those that were closed.
std::vector<meshing::GivenEnd> close_holes_in_the_wall(geometry::TriMesh& part,
                                                       const geometry::FilledHoles& filled, const Rims& rims,
                                                       std::vector<std::string>& told);
std::vector<meshing::GivenEnd> close_holes_in_the_wall(geometry::TriMesh& part,
                                                       std::vector<std::string>& told);

}  // namespace ostia::pipeline
