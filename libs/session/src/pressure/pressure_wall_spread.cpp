#include "ostia/session/pressure_wall_spread.h"

#include "ostia/core/quantity_text.h"
#include "ostia/geometry/along.h"
#include "ostia/session/evaluability.h"

#include <map>
#include <vector>

namespace ostia::session {
namespace {

struct SpreadAt {
  double s_mm = 0.0, sd_mm = 0.0;
};

}  // namespace

hemodynamics::WallSpread wall_spread_of_image(const PressureTree& tree, const lumen::LumenModel& model,
                                              const analysis::SurfaceOfVessel& surface_of,
                                              const imaging::ImageVolume& image,
                                              const hemodynamics::WallSpread& given,
                                              const analysis::WallSpreadModel& spread,
                                              const core::TaskContext& task) {
  analysis::validate(spread);
  task.set_stage("edges");
  const double noise = noise_about(model, image);
  std::map<std::int32_t, std::vector<SpreadAt>> by_vessel;
  std::size_t done = 0;
  for (const auto& [id, vessel] : tree.vessels) {
    const VesselEvaluability seen = vessel_evaluability(model, surface_of, id, image, noise);
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(++done) / static_cast<double>(tree.vessels.size()));
    if (seen.evidence.empty()) continue;
    const std::vector<double> sd_mm = analysis::radius_spreads_mm(seen.evidence, noise, spread);
    std::vector<SpreadAt>& along = by_vessel[id];
    for (std::size_t i = 0; i < sd_mm.size(); ++i) along.push_back({seen.evidence[i].s_mm, sd_mm[i]});
  }
  hemodynamics::WallSpread out = given;
  out.station_sd_mm.clear();
  for (const hemodynamics::Branch& branch : tree.network.branches) {
    std::vector<double>& stations = out.station_sd_mm.emplace_back();
    const auto found = by_vessel.find(branch.vessel);
    if (found == by_vessel.end()) continue;
    for (const hemodynamics::Station& station : branch.stations)
      stations.push_back(
          geometry::value_along(found->second, station.s_mm, &SpreadAt::s_mm, &SpreadAt::sd_mm));
  }
  out.source = "edges in the image, noise of " + core::hu_text(noise) + " HU";
  return out;
}

}  // namespace ostia::session
