#include "ostia/session/new_vessel.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/coronary/labels.h"
#include "ostia/geometry/frame.h"
#include "ostia/imaging/sampling.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace ostia::session {
namespace {

constexpr double least_step_mm = 0.25;      // from the end to the first point of what goes on
constexpr double direction_mm = 3.0;        // where it is seen whither a way goes
constexpr double widest_turn = M_PI / 3.0;  // of a vessel that goes on
constexpr double wall_ring_mm = 0.5;        // between the rings of a new wall
constexpr int wall_around = 32;
constexpr double wide_mm = 5.0;  // from the way, and still lumen nearly all about it
constexpr int wide_rays = 16, wide_least = 13;
constexpr double warned_mm = 2.0, refused_mm = 8.0;  // of a way through what is so wide
constexpr double sure_of_name = 0.5;

/// On rings along the vessel's own part.
lumen::NewWall rings_of(const lumen::RadialWall& wall, double from_mm, double to_mm) {
  lumen::NewWall out;
  out.around = wall_around;
  const int rings = std::max(2, 1 + static_cast<int>(std::ceil((to_mm - from_mm) / wall_ring_mm)));
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < wall_around; ++k)
      out.radius_mm.push_back(std::clamp(
          wall(from_mm + (to_mm - from_mm) * ring / (rings - 1), 2.0 * std::numbers::pi * k / wall_around),
          0.1, 15.0));
  return out;
}

/// What the rules call a vessel of the tree; nothing where they are not sure, or where another has the name.
std::optional<std::string> ruled_name(const geometry::VesselTree& tree, std::int32_t vessel) {
  const coronary::LabelledTree labelled = coronary::label_branches(tree);
  for (const coronary::VesselLabel& label : labelled.labels) {
    if (label.vessel != vessel || label.likeliest.empty() || label.confidence < sure_of_name) continue;
    const bool taken = std::any_of(
        tree.vessels.begin(), tree.vessels.end(),
        [&](const geometry::Vessel& one) { return one.id != vessel && one.name == label.likeliest; });
    if (!taken) return label.likeliest;
  }
  return std::nullopt;
}

template <class NewVessel>
NewVessel completed(NewVessel edit, const lumen::LumenModel& model, const imaging::ImageVolume& image,
                    const core::TaskContext& task) {
  const geometry::VesselTree tree = lumen::apply(model, edit).model.tree;
  std::vector<std::shared_ptr<const geometry::AxisCurve>> axes;
  for (const geometry::Vessel& vessel : tree.vessels)
    axes.push_back(std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(tree, vessel)));
  const geometry::Vessel& made = tree.vessels.back();
  std::vector<std::string> warnings;
  const lumen::RadialWall wall =
      pipeline::wall_from_image(tree, axes, tree.vessels.size() - 1, image, warnings, task);
  edit.wall = rings_of(wall, lumen::own_from_mm(tree, made.id), axes.back()->length());
  if (const auto name = ruled_name(tree, made.id)) edit.name = *name;
  return edit;
}

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

lumen::VesselAdd artery_of(const segmentation::MinimalPath& way, const std::string& name) {
  if (way.points.size() < 3)
    throw InvalidInput("the two places are too near to each other for a vessel; choose them farther apart");
  return {name, way.points, way.radius_mm, {}};
}

lumen::Edit with_wall_and_name(const lumen::Edit& edit, const lumen::LumenModel& model,
                               const imaging::ImageVolume& image, const core::TaskContext& task) {
  if (const auto* branch = std::get_if<lumen::BranchAdd>(&edit))
    return completed(*branch, model, image, task);
  if (const auto* artery = std::get_if<lumen::VesselAdd>(&edit))
    return completed(*artery, model, image, task);
  return edit;
}

double wide_stretch_mm(const segmentation::MinimalPath& way, const imaging::ImageVolume& image,
                       double spared_mm) {
  const double level = 0.5 * (way.lumen_hu + way.background_hu);
  double wide = 0.0, s = 0.0;
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    const geometry::Vec3 step = way.points[i] - way.points[i - 1];
    s += step.norm();
    if (s < spared_mm || !(step.norm() > 0.0)) continue;
    const geometry::Vec3 x = geometry::initial_normal(step.normalized()), y = step.normalized().cross(x);
    int bright = 0;
    for (int k = 0; k < wide_rays; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / wide_rays;
      const geometry::Vec3 place = way.points[i] + wide_mm * (std::cos(angle) * x + std::sin(angle) * y);
      bright += image.geometry.contains(place) && imaging::sample(image, place) > level ? 1 : 0;
    }
    if (bright >= wide_least) wide += step.norm();
  }
  return wide;
}

std::optional<std::string> require_artery(const segmentation::MinimalPath& way,
                                          const imaging::ImageVolume& image, double spared_mm) {
  const double wide = wide_stretch_mm(way, image, spared_mm);
  if (wide <= warned_mm) return std::nullopt;
  const std::string text = "the way runs for " + core::shown_text(wide, 0) +
                           " mm through something wider than a coronary artery, an aorta or a chamber";
  if (wide > refused_mm)
    throw GeometryError(text + "; click a place in the vessel itself that is nearer, or the ostium first");
  return text;
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
  const lumen::VesselAdd artery = artery_of(way, name);
  geometry::Centerline axis;
  axis.points = artery.points;
  axis.radius = artery.radius_mm;
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, std::move(axis)}};
  tree.vessels = {{0, name, {0}}};
  return lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, task));
}

}  // namespace ostia::session
