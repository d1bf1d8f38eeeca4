#include "ostia/session/pressure_wall_spread.h"

#include "ostia/core/quantity_text.h"
#include "ostia/session/evaluability.h"

#include <algorithm>
#include <vector>

namespace ostia::session {
namespace {

struct VesselSpread {
  std::vector<double> s_mm, sd_mm;
  /// The end's beyond the ends.
  double at(double s) const {
    const auto next = std::lower_bound(s_mm.begin(), s_mm.end(), s);
    if (next == s_mm.begin()) return sd_mm.front();
    if (next == s_mm.end()) return sd_mm.back();
    const auto i = static_cast<std::size_t>(next - s_mm.begin());
    const double t = (s - s_mm[i - 1]) / (s_mm[i] - s_mm[i - 1]);
    return (1.0 - t) * sd_mm[i - 1] + t * sd_mm[i];
  }
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
  std::map<std::int32_t, VesselSpread> by_vessel;
  std::size_t done = 0;
  for (const auto& [id, vessel] : tree.vessels) {
    const VesselEvaluability seen = vessel_evaluability(model, surface_of, id, image, noise);
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(++done) / static_cast<double>(tree.vessels.size()));
    if (seen.evidence.empty()) continue;
    VesselSpread& one = by_vessel[id];
    one.sd_mm = analysis::radius_spreads_mm(seen.evidence, noise, spread);
    for (const analysis::WallEvidence& evidence : seen.evidence) one.s_mm.push_back(evidence.s_mm);
  }
  hemodynamics::WallSpread out = given;
  out.station_sd_mm.clear();
  for (const hemodynamics::Branch& branch : tree.network.branches) {
    std::vector<double>& stations = out.station_sd_mm.emplace_back();
    const auto found = by_vessel.find(branch.vessel);
    if (found == by_vessel.end()) continue;
    for (const hemodynamics::Station& station : branch.stations)
      stations.push_back(found->second.at(station.s_mm));
  }
  out.source = "edges in the image, noise of " + core::hu_text(noise) + " HU";
  return out;
}

}  // namespace ostia::session
