#include "renderer.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::figure {
namespace {

void validate_actor(const MeshActor& actor) {
  const std::string name = "the scene's surface \"" + actor.label + "\"";
  const auto count = static_cast<std::int32_t>(actor.mesh.points.size());
  for (const Vec3& p : actor.mesh.points) {
    if (!p.allFinite()) throw InvalidInput(name + " has a point that is not finite");
  }
  for (const geometry::Triangle& triangle : actor.mesh.triangles) {
    for (const std::int32_t corner : triangle) {
      if (corner < 0 || corner >= count) {
        throw InvalidInput(name + " has a triangle that names point " + std::to_string(corner) + " of " +
                           std::to_string(count));
      }
    }
  }
  if (!actor.half_of_quad.empty() && actor.half_of_quad.size() != actor.mesh.triangles.size())
    throw InvalidInput(name + " says of " + std::to_string(actor.half_of_quad.size()) + " triangles of " +
                       std::to_string(actor.mesh.triangles.size()) +
                       " whether they are halves of quadrilaterals");
  if (!actor.triangle_colors.empty() && actor.triangle_colors.size() != actor.mesh.triangles.size()) {
    throw InvalidInput(name + " has " + std::to_string(actor.triangle_colors.size()) + " colours for " +
                       std::to_string(actor.mesh.triangles.size()) + " triangles");
  }
  if (!(actor.color.a >= 0.0 && actor.color.a <= 1.0)) {
    throw InvalidInput(name + " has an opacity of " + std::to_string(actor.color.a) +
                       "; it must lie between 0 and 1");
  }
}

void validate_actor(const TubeActor& tube) {
  const std::string name = "the scene's line \"" + tube.label + "\"";
  if (tube.points.empty()) throw InvalidInput(name + " has no points");
  if (tube.radius_mm.size() != 1 && tube.radius_mm.size() != tube.points.size()) {
    throw InvalidInput(name + " has " + std::to_string(tube.radius_mm.size()) + " radii for " +
                       std::to_string(tube.points.size()) + " points");
  }
  for (const Vec3& p : tube.points) {
    if (!p.allFinite()) throw InvalidInput(name + " has a point that is not finite");
  }
  for (const double radius : tube.radius_mm) {
    if (!(radius > 0.0) || !std::isfinite(radius)) {
      throw InvalidInput(name + " has a radius of " + std::to_string(radius) + " mm; it must be positive");
    }
  }
}

}  // namespace

void validate(const RenderOptions& options) {
  const auto fits = [](int length) { return length >= 16 && length <= 8000; };
  if (!fits(options.width_px) || !fits(options.height_px)) {
    throw InvalidInput("a picture of " + std::to_string(options.width_px) + " x " +
                       std::to_string(options.height_px) +
                       " pixels cannot be rendered; both must lie between 16 and 8000");
  }
  if (!(options.density >= 0.25 && options.density <= 4.0)) {
    throw InvalidInput("a rendering's density must lie between 0.25 and 4, not " +
                       std::to_string(options.density));
  }
  if (options.samples < 1 || options.samples > 8) {
    throw InvalidInput("a rendering takes 1 to 8 samples a side, not " + std::to_string(options.samples));
  }
  if (options.occlusion_rays < 0 || options.occlusion_rays > 256 || !(options.occlusion_reach >= 0.0) ||
      !(options.occlusion_reach <= 1.0)) {
    throw InvalidInput(
        "a rendering's ambient occlusion takes 0 to 256 rays that reach 0 to 1 of the scene's diagonal");
  }
}

TubeActor tube_of(const geometry::Centerline& line, double radius_mm, const Color& color) {
  return {line.points, {radius_mm}, color, {}};
}

void validate(const Scene& scene, const RenderOptions& options) {
  validate(options);
  for (const MeshActor& actor : scene.meshes) validate_actor(actor);
  for (const TubeActor& tube : scene.tubes) validate_actor(tube);
}

View raster_view(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  const auto pixels = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(length * options.density)));
  };
  return fitted_view(scene, camera, pixels(options.width_px), pixels(options.height_px));
}

Raster render(const Scene& scene, const Camera& camera, const RenderOptions& options,
              const core::TaskContext& task) {
  validate(scene, options);
  const View view = raster_view(scene, camera, options);
  task.throw_if_cancelled();
  const RayScene rays(scene, view.eye + view.focus_distance_mm * view.forward);
  return rendered(scene, rays, view, options, task);
}

}  // namespace ostia::figure
