#pragma once
/// \file A scene as one camera sees it, ray by ray.

#include "ray_scene.h"

#include "ostia/core/task_context.h"

namespace ostia::figure {

/// `rays` are the scene's; `view` is one of whole pixels, fitted to the raster. The same for any number of
/// threads. Throws Cancelled.
Raster rendered(const Scene& scene, const RayScene& rays, const View& view, const RenderOptions& options,
                const core::TaskContext& task);

/// Throws InvalidInput for options and scenes that cannot be rendered.
void validate(const Scene& scene, const RenderOptions& options);
/// Of a view of a picture: as many raster pixels as its options want.
View raster_view(const Scene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace ostia::figure
