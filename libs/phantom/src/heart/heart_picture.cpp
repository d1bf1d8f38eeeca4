#include "body/body_organs.h"
#include "cases/report_views.h"

#include "ostia/figure/scene.h"
#include "ostia/geometry/isosurface.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace ostia::phantom {
namespace {

/// An axis from an abscissa to another as a tube of its radius, a point each half millimetre.
figure::TubeActor tube_between(const geometry::Centerline& axis, double from_mm, double to_mm) {
  figure::TubeActor tube;
  for (std::size_t i = 0; i < axis.size(); i += 5) {
    if (axis.abscissa[i] < from_mm || axis.abscissa[i] > to_mm) continue;
    tube.points.push_back(axis.points[i]);
    tube.radius_mm.push_back(axis.radius[i]);
  }
  return tube;
}

}  // namespace

figure::Picture heart_picture(const CasePlan& plan, const core::TaskContext& task) {
  constexpr double spacing_mm = 1.6;
  const Distance outline = heart_outline(plan.heart);
  geometry::Box3 box;
  for (const Vec3& corner : {Vec3(-100, -100, -110), Vec3(110, 90, 75)}) box.extend(plan.heart.base + corner);
  figure::Scene scene;
  figure::MeshActor muscle;
  muscle.mesh =
      geometry::isosurface([&](const Vec3& p) { return outline(plan.warp ? plan.warp->to_own(p) : p); }, box,
                           spacing_mm, task.sub(0.0, 0.3));
  muscle.color = figure::Color{0.62, 0.42, 0.38, 1.0};
  muscle.label = "heart";
  scene.meshes.push_back(std::move(muscle));
  const figure::Color own = figure::colors::contour, grown = figure::colors::cut;
  bool first_own = true, first_grown = true;
  for (std::size_t v = 0; v < plan.tree.vessels.size(); ++v) {
    const geometry::Centerline& axis = plan.tree.vessels[v].axis;
    const double length = axis.abscissa.back();
    const double measured =
        plan.patient && v < plan.patient->parts.size() ? plan.patient->parts[v].measured_mm : length;
    for (auto [tube, color, first, label] :
         {std::tuple(tube_between(axis, 0.0, measured), own, &first_own, "the patient's"),
          std::tuple(tube_between(axis, measured, length), grown, &first_grown, "grown and drawn")}) {
      if (tube.points.size() < 2) continue;
      tube.color = color;
      if (std::exchange(*first, false)) tube.label = label;
      scene.tubes.push_back(std::move(tube));
    }
    const std::size_t at = std::min(axis.size() - 1, axis.size() * 6 / 10);
    scene.labels.push_back({axis.points[at], plan.tree.vessels[v].name});
  }
  figure::RenderOptions options;
  options.width_px = 460;
  options.height_px = 460;
  options.samples = 2;
  std::vector<figure::SceneSight> sights{
      {figure::cameras::anterior(), "from the front"},
      {figure::cameras::angiographic(55.0, 15.0), "LAO 55, cranial 15"},
      {figure::cameras::left_lateral(), "from the left"},
      {{.direction = Vec3(-0.25, -0.55, 0.8), .up = Vec3(0.0, -0.6, -0.5)}, "from behind and below"}};
  return figure::grid(figure::scene_figures(scene, sights, options, task.sub(0.3, 1.0)), {.columns = 2});
}

}  // namespace ostia::phantom
