#include "ostia/meshing/caps.h"

#include "cutting/cap_filling.h"

#include "ostia/core/error.h"

#include <string>

namespace ostia::meshing {

void validate(const CapOptions& options) {
  if (!(options.edge_factor >= 0.3 && options.edge_factor <= 10.0))
    throw InvalidInput("caps: edge_factor " + std::to_string(options.edge_factor) + " must lie in [0.3, 10]");
}

geometry::FacedSurface cap_ends(const ClippedSurface& clipped, const CapOptions& options,
                                const core::TaskContext& task) {
  validate(options);
  geometry::FacedSurface surface;
  surface.mesh = clipped.mesh;
  surface.face_ids.assign(clipped.mesh.triangles.size(), 1);
  surface.faces.push_back({1, "wall", geometry::FaceKind::wall});
  for (std::size_t i = 0; i < clipped.ends.size(); ++i) {
    task.throw_if_cancelled();
    const ClippedEnd& end = clipped.ends[i];
    const geometry::Face face{static_cast<std::int32_t>(i) + 2, end_name(end.plane), end.plane.kind};
    surface.faces.push_back(face);
    fill_cap(surface, end.loop, options.edge_factor, face);
  }
  return surface;
}

}  // namespace ostia::meshing
