#include "ostia/session/pressure_wall.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/along.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/session/pressure_report.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

constexpr double least_cell_mm = 0.15;
constexpr std::size_t points_at_once = 256;

/// A point's vessel and abscissa.
struct WallFoot {
  std::int32_t vessel = 0;
  double s_mm = 0.0;
};

/// Those that have sections.
std::vector<const PressureVessel*> measured_vessels(const PressureTree& tree) {
  std::vector<const PressureVessel*> measured;
  for (const auto& [id, vessel] : tree.vessels)
    for (const hemodynamics::Branch& branch : tree.network.branches)
      if (branch.vessel == id && branch.stations.size() > 1) {
        measured.push_back(&vessel);
        break;
      }
  return measured;
}

WallFoot wall_foot(const std::vector<const PressureVessel*>& vessels, const geometry::Vec3& point) {
  WallFoot best;
  double least = HUGE_VAL;
  for (const PressureVessel* vessel : vessels) {
    const geometry::AxisFoot foot = vessel->axis->nearest_foot(point);
    const double radius = std::max(0.1, vessel->axis->radius(foot.s_mm));
    // Its part within its parent's lumen is the parent's.
    const double away = foot.rho_mm / radius + (foot.s_mm < vessel->own_from_mm ? 100.0 : 0.0);
    if (away >= least) continue;
    least = away;
    best = {vessel->vessel, std::max(foot.s_mm, vessel->own_from_mm)};
  }
  return best;
}

}  // namespace

WallPressures pressures_on(const PressureReport& report, std::span<const geometry::Vec3> points,
                           const core::TaskContext& task) {
  WallPressures out;
  for (auto* values : {&out.ffr, &out.resting_ratio, &out.pressure_mmhg, &out.wall_shear_pa, &out.s_mm})
    values->resize(points.size());
  for (auto* values : {&out.vessel, &out.branch, &out.occluded}) values->resize(points.size());
  const auto& network = report.network->network();
  const std::vector<const PressureVessel*> vessels = measured_vessels(report.tree);
  core::parallel_for(points.size(), points_at_once, [&](std::size_t p) {
    if (p % points_at_once == 0) task.throw_if_cancelled();
    const WallFoot foot = wall_foot(vessels, points[p]);
    const hemodynamics::TreePlace place = place_on(network, foot.vessel, foot.s_mm);
    const geometry::PlaceAlong at = geometry::place_along(network.branches[place.branch].stations, place.s_mm,
                                                          &hemodynamics::Station::s_mm);
    const auto between = [&](const hemodynamics::TreeReadings& readings, auto value) {
      const auto& stations = readings.stations[place.branch];
      return at.between(stations[at.index].*value, stations[at.index + 1].*value);
    };
    const double pa = between(report.under_hyperaemia, &hemodynamics::StationFlow::pressure_pa);
    out.ffr[p] = pa / report.under_hyperaemia.aortic_pa;
    out.resting_ratio[p] =
        between(report.at_rest, &hemodynamics::StationFlow::pressure_pa) / report.at_rest.aortic_pa;
    out.pressure_mmhg[p] = pa / hemodynamics::pa_of_mmhg;
    out.wall_shear_pa[p] = between(report.under_hyperaemia, &hemodynamics::StationFlow::wall_shear_pa);
    out.s_mm[p] = foot.s_mm;
    out.vessel[p] = foot.vessel;
    out.branch[p] = static_cast<std::int32_t>(place.branch);
    out.occluded[p] = report.network->beyond_occlusion(place.branch) ? 1 : 0;
  });
  return out;
}

PressureWall pressure_wall(const PressureReport& report, const lumen::LumenModel& model,
                           const core::TaskContext& task) {
  PressureWall wall;
  wall.wall =
      lumen::surface_of(model, std::max(least_cell_mm, lumen::default_cell_mm(model)), task.sub(0.0, 0.8));
  wall.at_points = pressures_on(report, wall.wall.points, task);
  task.set_progress(1.0);
  return wall;
}

}  // namespace ostia::session
