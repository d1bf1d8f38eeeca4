#pragma once
/// \file Flow extensions while they are being made: one by one, joined to the lumen, kept apart.

#include "flow_extension/shape.h"

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flow_extension.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::meshing {

struct Extension {
  std::size_t end = 0;  ///< in the ClippedSurface
  Section section;
  double wanted = 0.0, length = 0.0;  ///< mm
  double shortest = 0.0;              ///< mm; never below it
  double transition = 0.0;
  double bend_deg = 0.0;
  geometry::Vec3 side = geometry::Vec3::Zero();  ///< to which it bends
  std::vector<geometry::Vec3> through;           ///< its own axis, if any
  bool bent_away = false;                        ///< by keep_apart
  Rings rings;
};

/// Its axis. Throws GeometryError naming the end where it bends too tightly.
ExtensionAxis axis_of(const Extension& extension);
/// Fills `rings`; what axis_of throws.
void build(Extension& extension);

struct Joined {
  geometry::TriMesh mesh;
  std::vector<std::vector<std::int32_t>> far_loops;  ///< one an extension, along the border half-edges
};
/// The lumen with its extensions; its points keep their numbers. `loops`: one an extension.
Joined joined(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& loops,
              const std::vector<Extension>& extensions);

/// Shortens, bends or refuses extensions that would meet each other or the wall, and builds them all.
/// `loops`: one an extension; `open_loops`: those of ends without one. Appends to `warnings`. Throws
/// GeometryError naming both.
void keep_apart(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& loops,
                const std::vector<std::vector<std::int32_t>>& open_loops, std::vector<Extension>& extensions,
                const FlowExtensionOptions& options, std::vector<std::string>& warnings,
                const core::TaskContext& task);

}  // namespace ostia::meshing
