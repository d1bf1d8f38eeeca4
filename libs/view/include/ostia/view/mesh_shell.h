#pragma once
/// \file What is seen of a volume mesh: its boundary, and whole elements at a plane that cuts it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::view {

/// A mesh prepared for being looked at. Immutable.
struct ShownMesh {
  std::shared_ptr<const geometry::MixedMesh> mesh;
  /// Of each element's sides (four of each tetrahedron, then five of each prism, in the order of
  /// geometry::tetrahedron_sides and prism_sides) the element behind it; -1 at the boundary.
  std::vector<std::int32_t> across;
  std::vector<Eigen::Vector3f> centres;  ///< of the elements, tetrahedra first, mm
};
/// About a second for a million tetrahedra. Throws InvalidInput for a mesh without elements, with points
/// that are not there or not finite, or a side that three elements share. Cancelled.
std::shared_ptr<const ShownMesh> prepared(std::shared_ptr<const geometry::MixedMesh> mesh,
                                          const core::TaskContext& task = core::no_task());

/// Elements whose centre lies on the side that `normal` points to are taken away.
struct MeshCut {
  geometry::Vec3 point = geometry::Vec3::Zero(), normal = geometry::Vec3::UnitZ();
  bool operator==(const MeshCut&) const = default;
};

/// A side of an element that is seen.
struct ShellSide {
  std::array<std::int32_t, 4> corners;  ///< outward; the fourth of a triangle is -1
  std::int32_t element = 0;             ///< tetrahedra are counted first, then prisms
};
/// The sides between elements that are there and nothing, or an element that is taken away; in the order of
/// their elements, the same for any number of threads. Throws InvalidInput for a cut that is not finite or
/// has no direction.
std::vector<ShellSide> shell_of(const ShownMesh& mesh, const std::optional<MeshCut>& cut = {});

/// Corners of an element, 4 or 6.
std::vector<std::int32_t> element_corners(const geometry::MixedMesh& mesh, std::size_t element);

}  // namespace ostia::view
