#include "ostia/analysis/wall_flow.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::analysis {
namespace {

constexpr double flow_nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double flow_slack_mm = 1e-9;
// Of the window's square, by which samples have to be spread for a slope to be told.
constexpr double least_spread = 1e-4;

using FlowSamples = std::vector<WallFlowSample>;

void require_flow(double value, double low, double high, const char* what) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("flow along a vessel: ") + what + " is " + core::mm_text(value, 3) +
                       "; choose " + core::mm_text(low, 2) + " to " + core::mm_text(high, 1));
}

/// Of one vessel's stretch, by abscissa.
FlowSamples of_stretch(std::span<const WallFlowSample> samples, std::int32_t vessel, double from_mm,
                       double to_mm) {
  FlowSamples own;
  for (const WallFlowSample& one : samples) {
    if (!std::isfinite(one.s_mm) || !(one.area_mm2 >= 0.0) || !std::isfinite(one.area_mm2))
      throw InvalidInput("flow along a vessel: a piece of wall has no place or no area");
    if (one.vessel == vessel && one.s_mm >= from_mm && one.s_mm <= to_mm) own.push_back(one);
  }
  std::stable_sort(own.begin(), own.end(),
                   [](const WallFlowSample& a, const WallFlowSample& b) { return a.s_mm < b.s_mm; });
  return own;
}

void add_shear(std::span<const WallFlowSample> near, FlowStation& station) {
  double area = 0.0, sum = 0.0;
  for (const WallFlowSample& one : near) {
    if (!std::isfinite(one.shear_pa)) continue;
    const bool first = std::isnan(station.least_shear_pa);
    station.least_shear_pa = first ? one.shear_pa : std::min(station.least_shear_pa, one.shear_pa);
    station.greatest_shear_pa = first ? one.shear_pa : std::max(station.greatest_shear_pa, one.shear_pa);
    area += one.area_mm2;
    sum += one.area_mm2 * one.shear_pa;
  }
  if (area > 0.0)  // no rounding may carry it beyond the extremes
    station.mean_shear_pa = std::clamp(sum / area, station.least_shear_pa, station.greatest_shear_pa);
}

/// The samples' middle is not the station's where the wall ends or its triangles are few: pressure falls
/// along the vessel, so that a plain mean would be off by its slope.
double pressure_of(std::span<const WallFlowSample> near, double at_mm, double window_mm) {
  double area = 0.0, s = 0.0, p = 0.0;
  for (const WallFlowSample& one : near) {
    if (!std::isfinite(one.pressure_pa)) continue;
    area += one.area_mm2;
    s += one.area_mm2 * (one.s_mm - at_mm);
    p += one.area_mm2 * one.pressure_pa;
  }
  if (!(area > 0.0)) return flow_nothing;
  s /= area, p /= area;
  double squares = 0.0, products = 0.0;
  for (const WallFlowSample& one : near) {
    if (!std::isfinite(one.pressure_pa)) continue;
    const double off = one.s_mm - at_mm - s;
    squares += one.area_mm2 * off * off;
    products += one.area_mm2 * off * (one.pressure_pa - p);
  }
  return squares > least_spread * area * window_mm * window_mm ? p - s * products / squares : p;
}

FlowStation station_of(std::span<const WallFlowSample> near, double at_mm, double window_mm) {
  FlowStation station{at_mm, 0.0, flow_nothing, flow_nothing, flow_nothing, flow_nothing};
  for (const WallFlowSample& one : near) station.area_mm2 += one.area_mm2;
  add_shear(near, station);
  station.pressure_pa = pressure_of(near, at_mm, window_mm);
  return station;
}

}  // namespace

void validate(const FlowStationOptions& options) {
  require_flow(options.step_mm, 0.05, 10.0, "the step");
  require_flow(options.window_mm, options.step_mm, 20.0, "the window");
}

std::vector<FlowStation> flow_stations(std::span<const WallFlowSample> samples, std::int32_t vessel,
                                       double from_mm, double to_mm, const FlowStationOptions& options) {
  validate(options);
  if (!std::isfinite(from_mm) || !std::isfinite(to_mm) || !(from_mm < to_mm))
    throw InvalidInput("flow along a vessel: there is no stretch from " + core::mm_text(from_mm, 3) + " to " +
                       core::mm_text(to_mm, 3));
  const double half = 0.5 * options.window_mm;
  const FlowSamples own = of_stretch(samples, vessel, from_mm, to_mm);
  std::vector<FlowStation> stations;
  auto first = own.begin(), last = own.begin();
  const auto steps = static_cast<std::size_t>(std::floor((to_mm - from_mm) / options.step_mm + 1e-9));
  for (std::size_t i = 0; i <= steps + 1; ++i) {
    const double at = std::min(to_mm, from_mm + options.step_mm * static_cast<double>(i));
    if (i == steps + 1 && to_mm - stations.back().s_mm < flow_slack_mm) break;
    while (first != own.end() && first->s_mm < at - half - flow_slack_mm) ++first;
    last = std::max(first, last);
    while (last != own.end() && last->s_mm <= at + half + flow_slack_mm) ++last;
    stations.push_back(station_of({first, last}, at, options.window_mm));
  }
  return stations;
}

FlowStation station_at(const std::vector<FlowStation>& stations, double s_mm) {
  const FlowStation none{s_mm, 0.0, flow_nothing, flow_nothing, flow_nothing, flow_nothing};
  if (stations.empty() || s_mm < stations.front().s_mm - flow_slack_mm ||
      s_mm > stations.back().s_mm + flow_slack_mm)
    return none;
  const auto next = std::lower_bound(stations.begin(), stations.end(), s_mm,
                                     [](const FlowStation& one, double s) { return one.s_mm < s; });
  if (next == stations.end()) return stations.back();
  if (next == stations.begin() || next->s_mm == s_mm) return *next;
  const FlowStation &a = *(next - 1), &b = *next;
  const double t = (s_mm - a.s_mm) / (b.s_mm - a.s_mm);
  const auto mix = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  return {s_mm,
          mix(a.area_mm2, b.area_mm2),
          mix(a.mean_shear_pa, b.mean_shear_pa),
          mix(a.least_shear_pa, b.least_shear_pa),
          mix(a.greatest_shear_pa, b.greatest_shear_pa),
          mix(a.pressure_pa, b.pressure_pa)};
}

}  // namespace ostia::analysis
