#include "ostia/hemodynamics/readings.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/along.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

std::string at_text(const Branch& branch, double s_mm) {
  return (branch.name.empty() ? std::string("a vessel") : branch.name) + " at " + core::mm_text(s_mm, 1);
}

void add_pullback(const PreparedNetwork& network, const TreeReadings& readings, std::size_t outlet,
                  std::vector<Pullback>& all) {
  std::vector<std::size_t> way;
  for (int b = static_cast<int>(outlet); b >= 0;
       b = network.network().branches[static_cast<std::size_t>(b)].parent)
    way.insert(way.begin(), static_cast<std::size_t>(b));
  Pullback pullback;
  pullback.outlet = outlet;
  double gone = 0.0;
  for (const std::size_t b : way) {
    const auto& stations = network.network().branches[b].stations;
    for (std::size_t i = 0; i < stations.size(); ++i)
      pullback.points.push_back(
          {{b, stations[i].s_mm}, gone + stations[i].s_mm - stations.front().s_mm, readings.ratio(b, i)});
    if (!stations.empty()) gone += stations.back().s_mm - stations.front().s_mm;
  }
  all.push_back(std::move(pullback));
}

double ratio_at(const std::vector<PullbackPoint>& points, double s) {
  return geometry::value_along(points, s, &PullbackPoint::from_aorta_mm, &PullbackPoint::ratio);
}

/// (greatest fall over 20 mm / whole fall + 1 - share of the length with a fall of 0.0015 a mm or more) / 2.
void grade(Pullback& pullback) {
  constexpr double window_mm = 20.0, step_mm = 1.0, least_fall = 0.05, diseased_per_mm = 0.0015;
  if (pullback.points.size() < 2) return;
  const double length = pullback.points.back().from_aorta_mm;
  const double whole = pullback.points.front().ratio - pullback.points.back().ratio;
  double diseased = 0.0, steps = 0.0;
  for (double s = 0.0; s + step_mm <= length + 1e-9; s += step_mm) {
    const double here = ratio_at(pullback.points, s);
    pullback.greatest_fall_20mm = std::max(pullback.greatest_fall_20mm,
                                           here - ratio_at(pullback.points, std::min(length, s + window_mm)));
    diseased += here - ratio_at(pullback.points, s + step_mm) >= diseased_per_mm * step_mm ? 1.0 : 0.0;
    steps += 1.0;
  }
  if (whole < least_fall || steps == 0.0) return;
  pullback.ppg_index = std::clamp(
      0.5 * (std::min(1.0, pullback.greatest_fall_20mm / whole) + 1.0 - diseased / steps), 0.0, 1.0);
}

/// The station of a branch for which `value` is greatest, if it is above `limit`.
template <typename Value>
void mark_greatest(const Branch& branch, std::size_t index, double limit, FlowMark::Kind kind, Value value,
                   const std::string& what, std::vector<FlowMark>& marks) {
  std::size_t greatest = 0;
  for (std::size_t i = 1; i < branch.stations.size(); ++i)
    if (value(i) > value(greatest)) greatest = i;
  if (branch.stations.empty() || !(value(greatest) > limit)) return;
  const double s = branch.stations[greatest].s_mm;
  marks.push_back({kind, {index, s}, at_text(branch, s) + ": " + what});
}

bool is_graft(const std::string& name) {
  std::string lower = name;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view word : {"graft", "bypass", "lima", "rima", "svg"})
    if (lower.find(word) != std::string::npos) return true;
  return false;
}

void add_marks(const PreparedNetwork& network, const TreeReadings& readings, const ReadingOptions& options,
               std::size_t b, std::vector<FlowMark>& marks) {
  using Kind = FlowMark::Kind;
  const Branch& branch = network.network().branches[b];
  const auto& flows = readings.stations[b];
  const auto& stations = branch.stations;
  if (stations.empty()) return;
  const PreparedBranch& prepared = network.branch(b);
  if (prepared.shut()) {
    const double s = stations[prepared.open_stations].s_mm;
    marks.push_back({Kind::occlusion,
                     {b, s},
                     at_text(branch, s) + ": occluded; nothing flows, and collateral flow "
                                          "is not modelled"});
    return;
  }
  if (is_graft(branch.name))
    marks.push_back({Kind::graft,
                     {b, stations.front().s_mm},
                     at_text(branch, stations.front().s_mm) +
                         ": a graft; the flow that it competes with is not modelled"});
  mark_greatest(
      branch, b, trusted_reynolds, Kind::reynolds, [&](std::size_t i) { return flows[i].reynolds; },
      "the flow is too fast for the laminar model (Reynolds' number above " +
          core::fixed_text(trusted_reynolds, 0) + ")",
      marks);
  std::vector<double> diameters;
  for (const Station& station : stations) diameters.push_back(station.diameter_mm());
  std::nth_element(diameters.begin(), diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 2),
                   diameters.end());
  const double median = diameters[diameters.size() / 2];
  mark_greatest(
      branch, b, options.ectasia * median, Kind::ectasia,
      [&](std::size_t i) { return stations[i].diameter_mm(); },
      "an ectasia or aneurysm; flow that turns in it is not modelled", marks);
  mark_greatest(
      branch, b, -options.least_seen_mm, Kind::narrow,
      [&](std::size_t i) { return -stations[i].diameter_mm(); },
      "narrower than CT can tell (" + core::mm_text(options.least_seen_mm, 1) + ")", marks);
  const auto& outlets = network.outlets();
  if (flows.back().separated() && std::binary_search(outlets.begin(), outlets.end(), b))
    marks.push_back({Kind::jet_at_end,
                     {b, stations.back().s_mm},
                     at_text(branch, stations.back().s_mm) +
                         ": the tree ends before the jet has mixed; the pressure "
                         "behind is higher than the last that is shown"});
}

/// What lies before an ostial lesion is the aorta.
bool begins_at_aorta(const PreparedNetwork& network, const TreePlace& place) {
  if (place.branch >= network.size()) return false;
  const Branch& branch = network.network().branches[place.branch];
  return branch.parent < 0 && !branch.stations.empty() && place.s_mm <= branch.stations.front().s_mm + 1e-6;
}

}  // namespace

std::string_view name_of(FlowMark::Kind kind) {
  constexpr std::array<std::string_view, 6> names = {"reynolds", "ectasia",    "occlusion",
                                                     "narrow",   "jet_at_end", "graft"};
  return names[static_cast<std::size_t>(kind)];
}

void validate(const ReadingOptions& options) {
  if (!(options.behind_mm >= 0.0 && options.behind_mm <= 60.0))
    throw InvalidInput("a lesion is read " + core::mm_text(options.behind_mm, 6) +
                       " behind its end; choose 0 to 60 mm");
  if (!(options.least_seen_mm >= 0.0 && options.least_seen_mm <= 2.0) ||
      !(options.ectasia >= 1.1 && options.ectasia <= 5.0) ||
      !(options.threshold > 0.0 && options.threshold < 1.0))
    throw InvalidInput(
        "the least throat that is seen is 0 to 2 mm, an ectasia 1.1 to 5 of the median, a threshold "
        "between 0 and 1");
}

std::optional<double> outlet_ratio(const PreparedNetwork& network, const TreeReadings& readings,
                                   std::size_t outlet) {
  const auto& points = readings.pullbacks[outlet].points;
  if (network.beyond_occlusion(network.outlets()[outlet]) || points.empty()) return std::nullopt;
  return points.back().ratio;
}

double pressure_at(const PreparedNetwork& network, const TreeReadings& readings, const TreePlace& place) {
  if (place.branch >= network.size() || network.network().branches[place.branch].stations.size() < 2)
    throw InvalidInput("a place names a branch that is not there, or has no sections");
  const auto& stations = network.network().branches[place.branch].stations;
  const geometry::PlaceAlong at = geometry::place_along(stations, place.s_mm, &Station::s_mm);
  const auto& flows = readings.stations[place.branch];
  return at.between(flows[at.index].pressure_pa, flows[at.index + 1].pressure_pa);
}

TreePlace downstream(const PreparedNetwork& network, const Solution& solution, TreePlace from,
                     double distance_mm, double& gone_mm) {
  const auto& branches = network.network().branches;
  gone_mm = 0.0;
  for (;;) {
    const auto& stations = branches[from.branch].stations;
    const double left = stations.empty() ? 0.0 : std::max(0.0, stations.back().s_mm - from.s_mm);
    if (gone_mm + left >= distance_mm) {
      from.s_mm += distance_mm - gone_mm;
      gone_mm = distance_mm;
      return from;
    }
    std::size_t next = branches.size();
    for (std::size_t b = from.branch + 1; b < branches.size(); ++b)
      if (branches[b].parent == static_cast<int>(from.branch) && branches[b].stations.size() > 1 &&
          (next == branches.size() || solution.flow_ml_s[b] > solution.flow_ml_s[next]))
        next = b;
    gone_mm += left;
    if (next == branches.size()) return {from.branch, from.s_mm + left};
    from = {next, branches[next].stations.front().s_mm};
  }
}

TreeReadings read_tree(const PreparedNetwork& network, const FlowState& state,
                       const std::vector<LesionPlace>& lesions, const ReadingOptions& options) {
  validate(options);
  TreeReadings readings;
  readings.aortic_pa = state.solution.inlet_pa;
  for (std::size_t b = 0; b < network.size(); ++b)
    readings.stations.push_back(along(network, state.solution, b));
  for (const LesionPlace& lesion : lesions) {
    LesionReading reading;
    reading.lesion = lesion;
    reading.ostial = begins_at_aorta(network, lesion.from);
    reading.before = reading.ostial ? 1.0 : pressure_at(network, readings, lesion.from) / readings.aortic_pa;
    reading.read_at = downstream(network, state.solution, lesion.to, options.behind_mm, reading.distance_mm);
    reading.behind = pressure_at(network, readings, reading.read_at) / readings.aortic_pa;
    reading.occluded = network.beyond_occlusion(reading.read_at.branch) ||
                       state.solution.flow_ml_s[reading.lesion.throat.branch] == 0.0;
    readings.lesions.push_back(std::move(reading));
  }
  for (const std::size_t outlet : network.outlets()) {
    add_pullback(network, readings, outlet, readings.pullbacks);
    grade(readings.pullbacks.back());
  }
  for (std::size_t b = 0; b < network.size(); ++b) add_marks(network, readings, options, b, readings.marks);
  return readings;
}

}  // namespace ostia::hemodynamics
