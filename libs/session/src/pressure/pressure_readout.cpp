#include "ostia/session/pressure_readout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::session {
namespace {

using hemodynamics::Network;
using hemodynamics::PreparedNetwork;
using hemodynamics::TreePlace;
using hemodynamics::TreeReadings;

constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

std::optional<double> ratio_at(const PreparedNetwork& network, const TreeReadings& readings,
                               std::int32_t vessel, double s_mm) {
  const std::optional<TreePlace> place = place_on_way(network.network(), vessel, s_mm);
  if (!place || network.beyond_occlusion(place->branch)) return std::nullopt;
  return hemodynamics::pressure_at(network, readings, *place) / readings.aortic_pa;
}

/// Of a station; null while it is not known.
const hemodynamics::Distribution* spread_of(const PressureReport& report, std::size_t branch,
                                            std::size_t station) {
  if (!report.uncertainty || branch >= report.uncertainty->stations.size()) return nullptr;
  const auto& stations = report.uncertainty->stations[branch];
  return station < stations.size() && stations[station].known ? &stations[station] : nullptr;
}

std::vector<hemodynamics::LesionReading> read(const PreparedNetwork& network,
                                              const hemodynamics::FlowState& state,
                                              const std::vector<hemodynamics::LesionPlace>& places,
                                              const hemodynamics::ReadingOptions& options) {
  return hemodynamics::read_tree(network, state, places, options).lesions;
}

}  // namespace

std::vector<std::size_t> branches_on_way(const Network& network, std::int32_t vessel) {
  std::vector<bool> on_way(network.branches.size(), false);
  for (std::size_t b = 0; b < network.branches.size(); ++b) {
    if (network.branches[b].vessel != vessel) continue;
    for (int up = static_cast<int>(b); up >= 0; up = network.branches[static_cast<std::size_t>(up)].parent)
      on_way[static_cast<std::size_t>(up)] = true;
  }
  std::vector<std::size_t> way;  // a parent stands before its children
  for (std::size_t b = 0; b < on_way.size(); ++b)
    if (on_way[b]) way.push_back(b);
  return way;
}

std::optional<TreePlace> place_on_way(const Network& network, std::int32_t vessel, double s_mm) {
  std::optional<TreePlace> best;
  double least = HUGE_VAL;
  for (const std::size_t b : branches_on_way(network, vessel)) {
    const auto& stations = network.branches[b].stations;
    if (stations.size() < 2) continue;
    const double s = std::clamp(s_mm, stations.front().s_mm, stations.back().s_mm);
    if (std::abs(s - s_mm) >= least) continue;
    least = std::abs(s - s_mm);
    best = TreePlace{b, s};
  }
  return best;
}

std::optional<double> ffr_at(const PressureReport& report, std::int32_t vessel, double s_mm) {
  return ratio_at(*report.network, report.under_hyperaemia, vessel, s_mm);
}

std::optional<double> ffr_after_at(const PressureReport& report, std::int32_t vessel, double s_mm) {
  if (!report.after) return std::nullopt;
  return ratio_at(report.after->network, report.after->under_hyperaemia, vessel, s_mm);
}

std::optional<FfrInterval> ffr_interval_at(const PressureReport& report, std::int32_t vessel, double s_mm) {
  const std::optional<TreePlace> place = place_on_way(report.network->network(), vessel, s_mm);
  if (!place) return std::nullopt;
  const auto& stations = report.network->network().branches[place->branch].stations;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < stations.size(); ++i)
    if (std::abs(stations[i].s_mm - place->s_mm) < std::abs(stations[nearest].s_mm - place->s_mm))
      nearest = i;
  const hemodynamics::Distribution* spread = spread_of(report, place->branch, nearest);
  return spread ? std::optional(FfrInterval{spread->low, spread->high, spread->probability}) : std::nullopt;
}

std::vector<FfrPoint> ffr_along(const PressureReport& report, std::int32_t vessel) {
  std::vector<FfrPoint> along;
  const PreparedNetwork& network = *report.network;
  for (const std::size_t b : branches_on_way(network.network(), vessel)) {
    const auto& stations = network.network().branches[b].stations;
    const bool known = !network.beyond_occlusion(b);
    const bool known_after = report.after && !report.after->network.beyond_occlusion(b);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const hemodynamics::Distribution* spread = spread_of(report, b, i);
      along.push_back({stations[i].s_mm, known ? report.under_hyperaemia.ratio(b, i) : not_told,
                       known_after ? report.after->under_hyperaemia.ratio(b, i) : not_told,
                       spread ? spread->low : not_told, spread ? spread->high : not_told});
    }
  }
  return along;
}

std::optional<double> falls_to_threshold_mm(const std::vector<FfrPoint>& along, double threshold) {
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (!(along[i].ffr <= threshold)) continue;
    if (i == 0 || !(along[i - 1].ffr > threshold)) return along[i].s_mm;
    const double t = (along[i - 1].ffr - threshold) / (along[i - 1].ffr - along[i].ffr);
    return along[i - 1].s_mm + t * (along[i].s_mm - along[i - 1].s_mm);
  }
  return std::nullopt;
}

std::vector<std::optional<LesionFfr>> ffr_of_lesions(const PressureReport& report,
                                                     const std::vector<analysis::Stenosis>& lesions) {
  std::vector<hemodynamics::LesionPlace> places;
  std::vector<std::size_t> of;
  const Network& network = report.network->network();
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    const auto on = [&](double s_mm) { return place_on_way(network, lesions[i].vessel, s_mm); };
    if (!on(lesions[i].throat_mm)) continue;
    places.push_back({"", *on(lesions[i].from_mm), *on(lesions[i].throat_mm), *on(lesions[i].to_mm)});
    of.push_back(i);
  }
  std::vector<std::optional<LesionFfr>> out(lesions.size());
  const auto now = read(*report.network, report.hyperaemia, places, report.options.reading);
  for (std::size_t k = 0; k < of.size(); ++k) out[of[k]] = LesionFfr{now[k], {}};
  if (!report.after) return out;
  const auto after = read(report.after->network, report.after->hyperaemia, places, report.options.reading);
  for (std::size_t k = 0; k < of.size(); ++k) out[of[k]]->after = after[k];
  return out;
}

}  // namespace ostia::session
