#include "ostia/session/new_vessel.h"

#include "ostia/core/error.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

constexpr double least_step_mm = 0.25;      // from the end to the first point of what goes on
constexpr double direction_mm = 3.0;        // where it is seen whither a way goes
constexpr double widest_turn = M_PI / 3.0;  // of a vessel that goes on

}  // namespace

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

std::optional<lumen::AxisExtend> extension_of(const segmentation::MinimalPath& way,
                                              const lumen::LumenModel& model) {
  if (!way.junction || way.points.size() < 2) return std::nullopt;
  const std::int32_t parent = way.junction->vessel;
  for (const geometry::Vessel& other : model.tree.vessels)  // the end is a fork already
    if (lumen::merge_parent(model.tree, other.id) == parent) return std::nullopt;
  const std::shared_ptr<const geometry::AxisCurve> axis = lumen::vessel(model, parent).axis;
  const double end = axis->length();
  if (end - way.junction->s_mm > axis->radius(end)) return std::nullopt;
  const geometry::Vec3 last = axis->point(end), ahead = axis->frame(end).tangent;
  lumen::AxisExtend extension{parent, {}};
  for (const geometry::Vec3& point : way.points)
    if ((point - last).dot(ahead) > least_step_mm || !extension.points.empty())
      extension.points.push_back(point);
  if (extension.points.empty()) return std::nullopt;
  // A way that leaves sideways or backwards is a branch, near the end though it be.
  const auto off = [&](const geometry::Vec3& point) { return (point - last).norm() > direction_mm; };
  const auto first_off = std::find_if(extension.points.begin(), extension.points.end(), off);
  const geometry::Vec3 way_on =
      (first_off == extension.points.end() ? extension.points.back() : *first_off) - last;
  if (way_on.dot(ahead) < std::cos(widest_turn) * way_on.norm()) return std::nullopt;
  return extension;
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
