#pragma once
/// \file Shaded pictures of surfaces, meshes and axes, by ray casting on the CPU (Embree).

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/centerline.h"
#include "ostia/geometry/tri_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::figure {

using geometry::Vec2;
using geometry::Vec3;

enum class Shading { smooth, flat };

/// A surface to be shown.
struct MeshActor {
  geometry::TriMesh mesh{};
  Color color = colors::lumen;           ///< its `a` is the opacity: below 1 what lies behind shines through
  std::vector<Color> triangle_colors{};  ///< one a triangle, or none; opacity is `color`'s
  Shading shading = Shading::smooth;     ///< smooth keeps creases sharper than `crease_deg`
  double crease_deg = 40.0;
  bool edges = false;  ///< triangle edges drawn on top
  Color edge_color{0.06, 0.07, 0.09, 1.0};
  double edge_width_px = 0.9;
  std::string label{};  ///< named in the legend unless empty
  /// One a triangle, or none: half of a quadrilateral, whose edge from the third corner to the first is not
  /// drawn.
  std::vector<bool> half_of_quad{};
};

/// A line drawn as a round tube: an axis with its radius, or with a constant one.
struct TubeActor {
  std::vector<Vec3> points{};       ///< one is a ball
  std::vector<double> radius_mm{};  ///< one a point, or a single one for all; > 0
  Color color = colors::centerline;
  std::string label{};
};
TubeActor tube_of(const geometry::Centerline& line, double radius_mm,
                  const Color& color = colors::centerline);

/// A name written at a place.
struct SceneLabel {
  Vec3 position = Vec3::Zero();
  std::string text{};
};

struct Scene {
  std::vector<MeshActor> meshes{};
  std::vector<TubeActor> tubes{};
  std::vector<SceneLabel> labels{};
};

enum class Projection { orthographic, perspective };

/// Where the scene is seen from. Fitted to all there is unless `focus` and `height_mm` say otherwise.
struct Camera {
  Vec3 direction =
      Vec3(0.0, 1.0, 0.0);        ///< of sight, any length but 0; +y (towards P) is the view from the front
  Vec3 up = Vec3(0.0, 0.0, 1.0);  ///< not along `direction`
  Projection projection = Projection::orthographic;
  double field_of_view_deg = 30.0;    ///< vertical, for perspective, 1 to 120
  double margin = 0.06;               ///< share of the picture kept free on each side, 0 to 0.4
  std::optional<Vec3> focus{};        ///< shown in the centre
  std::optional<double> height_mm{};  ///< visible height at the focus
};
namespace cameras {
inline Camera anterior() {
  return {};
}
inline Camera left_lateral() {
  return {.direction = Vec3(-1.0, 0.0, 0.0)};
}
inline Camera superior() {
  return {.direction = Vec3(0.0, 0.0, -1.0), .up = Vec3(0.0, -1.0, 0.0)};
}
/// Angiographer's angles, degrees: positive left anterior oblique (LAO), positive cranial.
Camera angiographic(double lao_deg, double cranial_deg);
/// Looks along the direction in which the points spread least, so that as much as possible is seen; the long
/// axis upright.
Camera broadside(const std::vector<Vec3>& points);
}  // namespace cameras

struct RenderOptions {
  int width_px = 800, height_px = 640;  ///< 16 to 8,000
  double density = 1.0;                 ///< raster pixels a picture pixel, 0.25 to 4
  int samples = 3;                      ///< a pixel's side, 1 to 8: 3 means nine rays
  int occlusion_rays = 6;               ///< ambient occlusion, a sample; 0 turns it off
  double occlusion_reach = 0.08;  ///< share of the scene's diagonal within which surfaces darken each other
  Look look = Look::dark;
  std::string title{};
  bool scale_bar = true;         ///< exact at the focus; everywhere when orthographic
  bool orientation_axes = true;  ///< small L, P and S axes
  bool legend = true;
};
void validate(const RenderOptions& options);

/// A camera made definite for a scene and a picture's size.
struct View {
  Vec3 eye = Vec3::Zero();  ///< orthographic: the focus moved back out of the scene
  Vec3 right = Vec3::UnitX(), down = -Vec3::UnitZ(), forward = Vec3::UnitY();  ///< unit
  Projection projection = Projection::orthographic;
  double focus_distance_mm = 0.0;
  double mm_per_px = 1.0;  ///< at the focus
  double width_px = 0.0, height_px = 0.0;
  Vec2 project(const Vec3& point) const;  ///< picture coordinates, px
};
View fitted_view(const Scene& scene, const Camera& camera, double width_px, double height_px);

/// The scene alone; alpha is the share of the pixel that it covers. The same for any number of threads.
/// Throws InvalidInput for an empty scene, meshes that name points they do not have, or numbers that are not
/// finite.
Raster render(const Scene& scene, const Camera& camera, const RenderOptions& options = {},
              const core::TaskContext& task = core::no_task());

/// The scene on the look's background with scale bar, axes, labels, legend and title.
Picture scene_figure(const Scene& scene, const Camera& camera = {}, const RenderOptions& options = {},
                     const core::TaskContext& task = core::no_task());

struct SceneSight {
  Camera camera;
  std::string title{};  ///< of the picture, instead of the options'
};
/// The same scene from several sides, prepared once.
std::vector<Picture> scene_figures(const Scene& scene, const std::vector<SceneSight>& sights,
                                   const RenderOptions& options = {},
                                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::figure
