#include "ostia/lumen/start_surface.h"

#include "start/start_walls.h"
#include "wall/sampling.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::lumen {
namespace {

std::int32_t next_id(const geometry::VesselTree& tree) {
  std::int32_t next = 1;
  for (const auto& n : tree.nodes) next = std::max(next, n.id + 1);
  for (const auto& s : tree.segments) next = std::max(next, s.id + 1);
  for (const auto& v : tree.vessels) next = std::max(next, v.id + 1);
  return next;
}

void check_tree(const geometry::VesselTree& tree) {
  if (auto fault = geometry::find_fault(tree))
    throw InvalidInput("no wall can be made along this vessel tree: " + *fault);
  if (tree.vessels.empty())
    throw InvalidInput("the vessel tree names no vessel; name the paths that shall have a wall");
}

/// What a vessel's wall is made from.
using WallOf = std::function<RadialWall(const StartVessel&)>;

LumenModel model_of(const geometry::VesselTree& tree, const SamplingOptions& options, const WallOf& wall_of) {
  validate(options);
  check_tree(tree);
  LumenModel model;
  model.tree = tree;
  model.next_tree_id = next_id(tree);
  for (const geometry::Vessel& vessel : tree.vessels) {
    const StartVessel start = start_vessel(tree, vessel);
    VesselLumen lumen;
    lumen.vessel = vessel.id;
    lumen.axis = start.axis;
    lumen.own_from_mm = start.own_from_mm;
    try {
      lumen.samples = samples_of(*start.axis, wall_of(start), start.own_from_mm, start.axis->length(),
                                 model.next_sample_id, options);
    } catch (const InvalidInput& error) {
      throw InvalidInput(vessel_label(vessel) + ": " + error.what());
    }
    model.next_sample_id += static_cast<std::int64_t>(lumen.samples.size());
    lumen.interpolation.support_radius_mm = default_support_radius(lumen.samples);
    model.vessels.push_back(std::make_shared<const VesselLumen>(std::move(lumen)));
  }
  return model;
}

}  // namespace

StartVessel start_vessel(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  StartVessel start;
  start.vessel = &vessel;
  start.axis = checked_axis(tree, vessel);
  start.own_from_mm = own_from_mm(tree, vessel.id);
  start.radius = own_radius(tree, vessel, *start.axis, start.own_from_mm);
  return start;
}

RadialWall tube_of(const StartVessel& start) {
  return [radius = start.radius](double s, double) { return radius.at(s); };
}

LumenModel model_of_tubes(const geometry::VesselTree& tree, std::optional<double> radius_mm,
                          const SamplingOptions& options) {
  if (radius_mm && (!(*radius_mm > 0.0) || !std::isfinite(*radius_mm)))
    throw InvalidInput("the tubes' radius is " + std::to_string(*radius_mm) + " mm; it must be positive");
  return model_of(tree, options, [&](const StartVessel& start) -> RadialWall {
    if (radius_mm) return [r = *radius_mm](double, double) { return r; };
    return tube_of(start);
  });
}

LumenModel model_of_walls(const geometry::VesselTree& tree, const std::vector<RadialWall>& walls,
                          const SamplingOptions& options) {
  if (!walls.empty() && walls.size() != tree.vessels.size())
    throw InvalidInput("there are " + std::to_string(walls.size()) + " walls and " +
                       std::to_string(tree.vessels.size()) + " vessels; give one a vessel, empty for a tube");
  return model_of(tree, options, [&](const StartVessel& start) -> RadialWall {
    const auto i = static_cast<std::size_t>(start.vessel - tree.vessels.data());
    return i < walls.size() && walls[i] ? walls[i] : tube_of(start);
  });
}

LumenModel model_of_surface(const geometry::VesselTree& tree, const geometry::TriMesh& surface,
                            const SamplingOptions& options, const core::TaskContext& task) {
  const geometry::AabbTree shells(surface);
  return model_of(tree, options,
                  [&](const StartVessel& start) { return wall_on_surface(start, surface, shells, task); });
}

LumenModel model_of_contours(const geometry::VesselTree& tree, const geometry::ContourSet& contours,
                             const SamplingOptions& options) {
  check_contours(tree, contours);
  return model_of(tree, options,
                  [&](const StartVessel& start) { return wall_through_contours(start, contours); });
}

}  // namespace ostia::lumen
