#include "ostia/session/new_vessel.h"

#include "ostia/core/error.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>

namespace ostia::session {

std::string unused_name(const lumen::LumenModel* model) {
  for (int number = 1;; ++number) {
    const std::string name = "V" + std::to_string(number);
    if (!model || std::none_of(model->tree.vessels.begin(), model->tree.vessels.end(),
                               [&](const geometry::Vessel& vessel) { return vessel.name == name; }))
      return name;
  }
}

lumen::BranchAdd branch_of(const segmentation::MinimalPath& way, const std::string& name) {
  if (!way.junction) throw InvalidInput("the way to the new vessel does not lead to the tree");
  return {way.junction->vessel, name, way.points, way.radius_mm};
}

lumen::LumenModel model_of_way(const segmentation::MinimalPath& way, const std::string& name,
                               const imaging::ImageVolume& image, const core::TaskContext& task) {
  if (way.points.size() < 3)
    throw InvalidInput("the two places are too near to each other for a vessel; choose them farther apart");
  geometry::Centerline axis;
  axis.points = way.points;
  axis.radius = way.radius_mm;
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, std::move(axis)}};
  tree.vessels = {{0, name, {0}}};
  return lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, task));
}

}  // namespace ostia::session
