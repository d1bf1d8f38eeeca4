#include "ostia/pipeline/image_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <utility>

namespace ostia::pipeline {
namespace {

constexpr double step_mm = 0.25;
constexpr double passage_mm = 1.5;    // from the tube to the image's wall
constexpr double look_back_mm = 2.0;  // from an end, for the vessel's own calibre
constexpr double blur_mm = 0.3;       // the scanner's, which the boundary reckons with
constexpr double shortest_mm = 2.0;   // less than this by itself: all tube

using Axis = std::shared_ptr<const geometry::AxisCurve>;

/// Mean radius of the lumen across the vessel.
double calibre(const segmentation::LumenBoundary& found, double s_mm) {
  double sum = 0.0;
  for (int a = 0; a < found.around; ++a) sum += found.at(s_mm, 2.0 * std::numbers::pi * a / found.around);
  return sum / found.around;
}

/// Round, with the axis' radii; at the take-off, where these are the parent's, as wide as behind it.
lumen::RadialWall tube_of(const Axis& axis, double free_mm) {
  return [axis, free_mm](double s_mm, double) { return axis->radius(std::max(s_mm, free_mm)); };
}

}  // namespace

double free_from_mm(const geometry::VesselTree& tree, const std::vector<Axis>& axes, std::size_t vessel) {
  const double own = lumen::own_from_mm(tree, tree.vessels[vessel].id);
  if (own <= 0.0) return 0.0;
  const std::int32_t parent = lumen::owner_at(tree, tree.vessels[vessel].id, std::max(0.0, own - 1e-3));
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& v) { return v.id == parent; });
  const geometry::AxisCurve& trunk = *axes[static_cast<std::size_t>(found - tree.vessels.begin())];
  const geometry::AxisCurve& branch = *axes[vessel];
  double s = own;
  for (; s < branch.length(); s += step_mm) {
    const geometry::AxisFoot foot = trunk.nearest_foot(branch.point(s));
    if (foot.rho_mm > trunk.radius(foot.s_mm) + branch.radius(s)) break;
  }
  return std::min(s, branch.length());
}

/// A take-off is as wide as the branch is behind it: the axis' first radius is its parent's. An end is as
/// wide as the vessel a radius and the blur before it: from there on its blunt end is seen, too, and what
/// shows is narrower than what is there.
lumen::RadialWall wall_of_boundary(const segmentation::LumenBoundary& found, double free_mm, double end_mm) {
  const auto boundary = std::make_shared<const segmentation::LumenBoundary>(found);
  const double blunt_mm = calibre(found, end_mm - look_back_mm) + blur_mm;
  const double held_mm = std::max(end_mm - blunt_mm, std::min(end_mm, free_mm + passage_mm));
  return
      [boundary, free_mm, held_mm, tube = calibre(found, free_mm + passage_mm)](double at_mm, double theta) {
        const double s_mm = std::min(at_mm, held_mm);
        if (free_mm <= 0.0) return boundary->at(s_mm, theta);
        const double t = std::clamp((s_mm - free_mm) / passage_mm, 0.0, 1.0), w = t * t * (3.0 - 2.0 * t);
        return w > 0.0 ? (1.0 - w) * tube + w * boundary->at(s_mm, theta) : tube;
      };
}

lumen::RadialWall wall_from_image(const geometry::VesselTree& tree, const std::vector<Axis>& axes,
                                  std::size_t vessel, const imaging::ImageVolume& image,
                                  std::vector<std::string>& warnings, const core::TaskContext& task) {
  const auto warn = [&](const std::string& text) {
    core::log_warning(tree.vessels[vessel].name + ": " + text);
    warnings.push_back(text);
  };
  const Axis& axis = axes[vessel];
  const double free_mm = free_from_mm(tree, axes, vessel), length = axis->length();
  const auto tube = [&](const std::string& why) {
    warn("its wall cannot be found, it is a tube as wide as its axis says: " + why);
    return tube_of(axis, free_mm);
  };
  if (length - free_mm < shortest_mm) {
    warn("too short by itself to be found in the image; a tube");
    // At its end: its first radius is its parent's.
    return [radius = axis->radius(length)](double, double) { return radius; };
  }
  try {
    const segmentation::LumenBoundary found =
        segmentation::lumen_boundary(image, *axis, free_mm, length, {}, task);
    for (const std::string& warning : found.warnings) warn(warning);
    return wall_of_boundary(found, free_mm, length);
  } catch (const GeometryError& error) {
    return tube(error.what());
  } catch (const InvalidInput& error) {  // an axis that leaves the image, among others
    return tube(error.what());
  }
}

std::vector<lumen::RadialWall> walls_from_image(const geometry::VesselTree& tree,
                                                const imaging::ImageVolume& image,
                                                const core::TaskContext& task,
                                                std::vector<std::vector<std::string>>* said) {
  std::vector<Axis> axes;
  for (const geometry::Vessel& vessel : tree.vessels)
    axes.push_back(std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(tree, vessel)));
  std::vector<lumen::RadialWall> walls;
  std::vector<std::vector<std::string>> warnings(tree.vessels.size());
  const double count = static_cast<double>(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double done = static_cast<double>(i);
    walls.push_back(
        wall_from_image(tree, axes, i, image, warnings[i], task.sub(done / count, (done + 1.0) / count)));
  }
  if (said) *said = std::move(warnings);
  return walls;
}

}  // namespace ostia::pipeline
