#include "ostia/solver/flow_figures.h"

#include "mid_cut.h"

#include "ostia/figure/scene.h"
#include "ostia/figure/value_colors.h"
#include "ostia/solver/flow_report.h"

#include <cmath>
#include <utility>

namespace ostia::solver {
namespace {

using figure::Camera;
using figure::MeshActor;
using figure::Picture;

constexpr int width_px = 560, height_px = 680;
constexpr double shown_share = 0.99;
constexpr figure::Color wall_color{0.80, 0.79, 0.77, 1.0};

figure::RenderOptions render_options(const std::string& title) {
  figure::RenderOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.look = figure::Look::light;
  options.title = title;
  options.legend = false;
  options.occlusion_rays = 0;  // darker places would be read as other values
  return options;
}

Picture bar(const std::string& title, double high, bool root) {
  figure::ValueBar bar;
  bar.title = title;
  bar.high = high;
  bar.more_above = true;
  bar.root = root;
  bar.height_px = height_px;
  return figure::value_bar(bar);
}

Picture beside(const std::vector<Picture>& panels) {
  figure::GridOptions options;
  options.columns = static_cast<int>(panels.size());
  options.look = figure::Look::light;
  return figure::grid(panels, options);
}

double top_of(const std::vector<double>& values, const std::vector<double>& weights) {
  return figure::round_above(weighted_percentile(values, weights, shown_share));
}

/// Of the mesh's points, m/s.
std::vector<double> speeds_at_points(const FlowResult& result) {
  const FlowState& state = result.mean ? *result.mean : result.last;
  return magnitudes(velocity_at_points(result, state));
}

}  // namespace

Picture wall_shear_picture(const FlowResult& result, const core::TaskContext& task) {
  const bool pulsatile = result.mean.has_value();
  const std::vector<double> shear = pulsatile ? result.mean_shear_pa : magnitudes(result.last.wall_shear_pa);
  const double top = top_of(shear, result.wall.areas_mm2);
  MeshActor wall;
  wall.mesh = result.wall.surface.mesh;
  for (const std::int32_t facet : result.wall.facet_of)
    wall.triangle_colors.push_back(figure::viridis(std::sqrt(shear[static_cast<std::size_t>(facet)] / top)));
  figure::Scene scene;
  scene.meshes.push_back(std::move(wall));
  const Camera front = figure::cameras::broadside(result.mesh.points);
  Camera back = front;
  back.direction = -front.direction;
  const std::string title = pulsatile ? "Time-averaged wall shear stress" : "Wall shear stress";
  const Picture first = figure::scene_figure(scene, front, render_options(title), task.sub(0.0, 0.5));
  const Picture second = figure::scene_figure(scene, back, render_options("From behind"), task.sub(0.5, 1.0));
  return beside({first, second, bar("shear stress, Pa", top, true)});
}

Picture speed_picture(const FlowResult& result, const core::TaskContext& task) {
  const std::vector<double> speeds = speeds_at_points(result);
  const FlowState& state = result.mean ? *result.mean : result.last;
  const double top = top_of(magnitudes(state.velocity_m_s), element_volumes(result.mesh));
  const Camera camera = figure::cameras::broadside(result.mesh.points);
  const MidCut cut = mid_cut(result.mesh, result.wall.surface.mesh, result.wall.mesh_points, speeds,
                             camera.direction, task.sub(0.0, 0.3));
  MeshActor blood, wall;
  for (const double speed : cut.values) blood.triangle_colors.push_back(figure::viridis(speed / top));
  blood.mesh = cut.surface;
  blood.crease_deg = 90.0;
  wall.mesh = cut.behind;
  wall.color = wall_color;
  figure::Scene scene;
  for (MeshActor* actor : {&blood, &wall})
    if (!actor->mesh.triangles.empty()) scene.meshes.push_back(std::move(*actor));
  const std::string title = result.mean ? "Mean speed in the lumen cut open" : "Speed in the lumen cut open";
  const Picture cut_open = figure::scene_figure(scene, camera, render_options(title), task.sub(0.3, 1.0));
  return beside({cut_open, bar("speed, m/s", top, false)});
}

}  // namespace ostia::solver
