// The picture of docs/methods/lumen-tree.md: the wall of a drawn coronary tree, and one of its joints sharp
// and with fillets.

#include "picture.h"

#include "ostia/figure/scene.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/phantom/coronary_tree.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace ostia;
using lumen::JointShape;
using lumen::Vec3;

// A wider fillet needs constraints at a larger offset, too.
geometry::TriMesh wall_with(lumen::LumenModel model, JointShape joints, double width_mm, double cell_mm) {
  model.blend = {width_mm, joints};
  for (auto& vessel : model.vessels) {
    lumen::VesselLumen wider = *vessel;
    wider.interpolation.offset_mm = width_mm;
    vessel = std::make_shared<const lumen::VesselLumen>(std::move(wider));
  }
  return lumen::surface_of(model, cell_mm);
}

figure::Picture panel(geometry::TriMesh mesh, const figure::Camera& camera, const std::string& title) {
  figure::Scene scene;
  scene.meshes.push_back({.mesh = std::move(mesh), .crease_deg = 60.0});
  figure::RenderOptions options;
  options.width_px = 520;
  options.height_px = 520;
  options.title = title;
  return figure::scene_figure(scene, camera, options);
}

// Where a side branch leaves its parent, seen across the plane of both.
figure::Camera at_joint(const phantom::CoronaryTree& tree, const std::string& name) {
  for (const phantom::CoronaryVessel& branch : tree.vessels) {
    if (branch.name != name) continue;
    const auto& parent = tree.vessels.at(static_cast<std::size_t>(branch.parent)).axis;
    const auto direction_at = [](const geometry::Centerline& axis, double s_mm) -> Vec3 {
      const auto after = std::upper_bound(axis.abscissa.begin(), axis.abscissa.end() - 1, s_mm);
      const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - axis.abscissa.begin(), 1));
      return (axis.points[i] - axis.points[i - 1]).normalized();
    };
    const auto free =
        std::lower_bound(branch.axis.abscissa.begin(), branch.axis.abscissa.end() - 1, branch.s_free_mm);
    const Vec3 along = direction_at(parent, branch.parent_s_mm + branch.s_free_mm);
    figure::Camera camera;
    camera.direction = along.cross(direction_at(branch.axis, branch.s_free_mm + 2.0));
    camera.up = -along;
    camera.focus = branch.axis.points[static_cast<std::size_t>(free - branch.axis.abscissa.begin())];
    camera.height_mm = 9.0;
    return camera;
  }
  throw InvalidInput("the tree has no vessel " + name);
}

// The vessels that begin at the left ostium.
geometry::VesselTree left_tree(const phantom::CoronaryTree& drawn) {
  phantom::CoronaryTree left;
  std::vector<std::int32_t> number(drawn.vessels.size(), -1);
  for (std::size_t i = 0; i < drawn.vessels.size(); ++i) {
    phantom::CoronaryVessel vessel = drawn.vessels[i];
    const std::int32_t parent = vessel.parent;
    if (parent < 0 ? vessel.name != "LAD" : number[static_cast<std::size_t>(parent)] < 0) continue;
    number[i] = static_cast<std::int32_t>(left.vessels.size());
    vessel.id = number[i];
    vessel.parent = parent < 0 ? -1 : number[static_cast<std::size_t>(parent)];
    left.vessels.push_back(std::move(vessel));
  }
  return phantom::vessel_tree(left);
}

void make(const std::string& file) {
  const phantom::CoronaryTree drawn = phantom::draw_coronaries(phantom::draw_heart(1), {.seed = 1});
  const lumen::LumenModel model = lumen::model_of_tubes(left_tree(drawn));
  std::vector<Vec3> axes;
  for (const auto& vessel : model.vessels)
    for (double s_mm = 0.0; s_mm < vessel->axis->length(); s_mm += 1.0)
      axes.push_back(vessel->axis->point(s_mm));
  const figure::Camera near = at_joint(drawn, "LCX");
  std::vector<figure::Picture> panels;
  panels.push_back(panel(wall_with(model, JointShape::smooth, 0.25, 0.25), figure::cameras::broadside(axes),
                         "A left tree: cells of 0.25 mm"));
  panels.push_back(panel(wall_with(model, JointShape::sharp, 0.25, 0.15), near, "LAD and circumflex, sharp"));
  panels.push_back(
      panel(wall_with(model, JointShape::smooth, 0.25, 0.15), near, "Smooth: w = offset = 0.25 mm"));
  panels.push_back(
      panel(wall_with(model, JointShape::smooth, 0.5, 0.15), near, "Smooth: w = offset = 0.5 mm"));
  figure::grid(panels, {.columns = 2}).write_png(file);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(argc, argv, "OUTPUT.png", 1,
                                    [](const std::vector<std::string>& given) { make(given[0]); });
}
