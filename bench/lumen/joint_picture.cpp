// The picture of docs/lumen-tree.md: the wall of a coronary-like tree, and one of its joints sharp and with
// fillets.

#include "vessel_trees.h"

#include "ostia/figure/scene.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <cstdio>
#include <exception>
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
  scene.meshes.push_back({.mesh = std::move(mesh), .crease_deg = 30.0});
  figure::RenderOptions options;
  options.width_px = 520;
  options.height_px = 520;
  options.title = title;
  return figure::scene_figure(scene, camera, options);
}

void make(const std::string& file) {
  const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  const lumen::LumenModel model = lumen::model_of_tubes(lumen::testing::tree_of(shape));
  const figure::Camera whole = figure::cameras::broadside(shape.tubes.front().axis.points);
  // The first side branch where it leaves the trunk.
  const auto& side = shape.tubes[1].axis;
  figure::Camera near = whole;
  near.direction = Eigen::AngleAxisd(0.6, whole.up.normalized()) * whole.direction;
  near.focus = side.points[side.size() / 6];
  near.height_mm = 8.0;
  std::vector<figure::Picture> panels;
  panels.push_back(
      panel(wall_with(model, JointShape::smooth, 0.25, 0.25), whole, "The tree: cells of 0.25 mm"));
  panels.push_back(panel(wall_with(model, JointShape::sharp, 0.25, 0.1), near, "First joint, sharp"));
  panels.push_back(
      panel(wall_with(model, JointShape::smooth, 0.25, 0.1), near, "Smooth: w = offset = 0.25 mm"));
  panels.push_back(
      panel(wall_with(model, JointShape::smooth, 0.5, 0.1), near, "Smooth: w = offset = 0.5 mm"));
  figure::grid(panels, {.columns = 2}).write_png(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: joint_picture OUTPUT.png\n");
    return 2;
  }
  try {
    make(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "joint_picture: %s\n", error.what());
    return 3;
  }
}
