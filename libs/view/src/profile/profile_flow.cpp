#include "ostia/view/profile_flow.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/figure/plot.h"
#include "ostia/view/profile_view.h"
#include "ostia/view/value_scale.h"
#include "ostia/view/wall_owner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

using analysis::FlowStation;
using analysis::WallFlowSample;

constexpr double unknown_flow = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t feet_per_task = 512;
constexpr double foot_window_mm = 2.0, off_wall_mm = 1.0, off_wall_radii = 0.5;
constexpr double axis_room_px = 46.0;  // of one axis at the right, with its numbers

void check_values(const geometry::TriMesh& wall, const WallValues& values) {
  const std::size_t wanted = values.at == FieldAt::points ? wall.points.size() : wall.triangles.size();
  if (!values.values.empty() && values.values.size() != wanted)
    throw InvalidInput(std::to_string(values.values.size()) +
                       " values were given for a wall of which there are " + std::to_string(wanted) +
                       (values.at == FieldAt::points ? " points" : " triangles"));
}

/// Places of the wall, their shares of it, and what was computed there.
struct WallPlaces {
  std::vector<Vec3> places;
  std::vector<double> areas, shear, pressure;
};

double value_of(const WallValues& values, const geometry::TriMesh& wall, std::size_t triangle) {
  if (values.values.empty()) return unknown_flow;
  if (values.at == FieldAt::triangles) return values.values[triangle];
  double sum = 0.0;
  for (const std::int32_t corner : wall.triangles[triangle])
    sum += values.values[static_cast<std::size_t>(corner)] / 3.0;
  return sum;
}

WallPlaces places_of(const geometry::TriMesh& wall, const WallValues& shear, const WallValues& pressure) {
  const auto at_points = [](const WallValues& one) {
    return one.values.empty() || one.at == FieldAt::points;
  };
  const bool points = at_points(shear) && at_points(pressure);
  const std::size_t count = points ? wall.points.size() : wall.triangles.size();
  WallPlaces out{std::vector<Vec3>(count, Vec3::Zero()), std::vector<double>(count, 0.0),
                 std::vector<double>(count, unknown_flow), std::vector<double>(count, unknown_flow)};
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) {
    const auto corner = [&](std::size_t c) -> const Vec3& {
      return wall.points[static_cast<std::size_t>(wall.triangles[t][c])];
    };
    const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    if (points) {
      for (const std::int32_t c : wall.triangles[t]) out.areas[static_cast<std::size_t>(c)] += area / 3.0;
    } else {
      out.places[t] = (corner(0) + corner(1) + corner(2)) / 3.0;
      out.areas[t] = area;
      out.shear[t] = value_of(shear, wall, t);
      out.pressure[t] = value_of(pressure, wall, t);
    }
  }
  if (!points) return out;
  out.places = wall.points;
  if (!shear.values.empty()) out.shear.assign(shear.values.begin(), shear.values.end());
  if (!pressure.values.empty()) out.pressure.assign(pressure.values.begin(), pressure.values.end());
  return out;
}

/// In the vessels' own coordinates; those that are of none have no area.
std::vector<WallFlowSample> samples_of(const lumen::LumenModel& model, const WallPlaces& wall,
                                       const core::TaskContext& task) {
  const std::vector<WallPlace> owners = WallOwner(model).at(wall.places);
  std::map<std::int32_t, const lumen::VesselLumen*> vessels;
  for (const auto& vessel : model.vessels) vessels[vessel->vessel] = vessel.get();
  std::vector<WallFlowSample> samples(wall.places.size());
  core::parallel_for(samples.size(), feet_per_task, [&](std::size_t i) {
    task.throw_if_cancelled();
    const WallPlace& owner = owners[i];
    const geometry::AxisCurve& axis = *vessels.at(owner.vessel)->axis;
    const auto foot = axis.foot_near(wall.places[i], owner.s_mm, foot_window_mm);
    samples[i] = {owner.vessel, owner.s_mm, wall.areas[i], wall.shear[i], wall.pressure[i]};
    const double away = foot ? foot->rho_mm : (wall.places[i] - axis.point(owner.s_mm)).norm();
    if (foot) samples[i].s_mm = foot->s_mm;
    if ((foot && foot->past_end) ||
        std::abs(away - owner.radius_mm) > off_wall_mm + off_wall_radii * owner.radius_mm)
      samples[i].vessel = -1;
  });
  return samples;
}

/// Their 98th percentile with some room, no less than the largest mean: a spike does not take the axis.
double shear_reach(const std::vector<FlowStation>& along) {
  std::vector<double> greatest;
  double mean = 0.0;
  for (const FlowStation& one : along) {
    if (std::isnan(one.mean_shear_pa)) continue;
    greatest.push_back(one.greatest_shear_pa);
    mean = std::max(mean, one.mean_shear_pa);
  }
  return 1.1 * std::max({1e-6, mean, automatic_range(greatest).second});
}

std::string with_value(const std::string& title, const std::string& value) {
  return value.empty() ? title : title + ": " + value;
}

}  // namespace

FlowStations flow_along_vessels(const lumen::LumenModel& model, const geometry::TriMesh& wall,
                                const WallValues& shear_pa, const WallValues& pressure_pa,
                                const core::TaskContext& task) {
  check_values(wall, shear_pa);
  check_values(wall, pressure_pa);
  const std::vector<WallFlowSample> samples = samples_of(model, places_of(wall, shear_pa, pressure_pa), task);
  FlowStations out;
  for (const auto& vessel : model.vessels) {
    task.throw_if_cancelled();
    const double from = vessel->own_from_mm, to = vessel->axis->length();
    if (from < to) out[vessel->vessel] = analysis::flow_stations(samples, vessel->vessel, from, to);
  }
  return out;
}

std::vector<FlowStation> stations_along(const FlowStations& stations,
                                        const std::vector<analysis::WayStretch>& way) {
  std::vector<FlowStation> along;
  bool any = false;
  for (const analysis::WayStretch& stretch : way) {
    const auto found = stations.find(stretch.vessel);
    if (found == stations.end()) continue;
    for (const FlowStation& one : found->second) {
      if (one.s_mm < stretch.from_mm - 1e-9 || one.s_mm > stretch.to_mm + 1e-9) continue;
      along.push_back(one);
      any = any || one.area_mm2 > 0.0;
    }
  }
  return any ? along : std::vector<FlowStation>();
}

void ProfileView::set_flow(std::shared_ptr<const ProfileFlow> flow) {
  flow_ = std::move(flow);
  forget_flow_along();
  touch();
}

const std::vector<FlowStation>& ProfileView::flow_along() const {
  static const std::vector<FlowStation> none;
  const std::int32_t vessel = bench_.vessel.get();
  if (!flow_ || vessel == session::Workbench::no_vessel) return none;
  if (!flow_along_ || flow_along_->vessel != vessel)
    flow_along_ = FlowAlong{vessel, stations_along(flow_->stations, bench_.way(vessel))};
  return flow_along_->stations;
}

double ProfileView::flow_room_px() const {
  if (!flow_ || flow_along().empty()) return 0.0;
  return axis_room_px * ((flow_->shear_title.empty() ? 0 : 1) + (flow_->pressure_title.empty() ? 0 : 1));
}

/// A line through what is known of the stations; it breaks where something is not.
void ProfileView::add_flow_line(const Frame& f, const std::vector<FlowStation>& along, Role role,
                                const std::function<double(const FlowStation&)>& share) {
  OverlayLine line{{}, role};
  const auto end = [&] {
    if (line.px.size() > 1) overlay_.lines.push_back(line);
    line.px.clear();
  };
  for (const FlowStation& one : along) {
    const double y = share(one);
    if (std::isfinite(y))
      line.px.emplace_back(f.x(one.s_mm), f.y(y));
    else
      end();
  }
  end();
}

void ProfileView::add_shear(const Frame& f, const std::vector<FlowStation>& along, double cursor_mm) {
  const double most = shear_reach(along);
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const FlowStation &a = along[i], &b = along[i + 1];
    if (std::isnan(a.least_shear_pa) || std::isnan(b.least_shear_pa)) continue;
    overlay_.bands.push_back(
        {Vec2(f.x(a.s_mm), f.y(0.5 * (a.greatest_shear_pa + b.greatest_shear_pa) / most)),
         Vec2(f.x(b.s_mm), f.y(0.5 * (a.least_shear_pa + b.least_shear_pa) / most)), Role::shear, 0.3});
  }
  add_flow_line(f, along, Role::shear, [&](const FlowStation& one) { return one.mean_shear_pa / most; });
  add_rows(f, most, false, Role::shear);
  const FlowStation here = analysis::station_at(along, cursor_mm);
  const std::string value = std::isnan(here.mean_shear_pa)
                                ? std::string()
                                : three_digits(here.mean_shear_pa) + " (" +
                                      three_digits(here.least_shear_pa) + "\xE2\x80\x93" +
                                      three_digits(here.greatest_shear_pa) + ")";
  add_text(Vec2(f.right, 17.0 * density_), with_value(flow_->shear_title, value), Role::shear,
           Anchor::top_right);
}

void ProfileView::add_pressure(const Frame& f, const std::vector<FlowStation>& along, double cursor_mm) {
  std::vector<double> all;
  for (const FlowStation& one : along) all.push_back(one.pressure_pa);
  const auto [low, high] = rounded_range(automatic_range(all));
  const double reach = 1.1 * (high - low);
  add_flow_line(f, along, Role::pressure,
                [&, low = low](const FlowStation& one) { return (one.pressure_pa - low) / reach; });
  const double left = f.right + (flow_->shear_title.empty() ? 0.0 : axis_room_px * density_);
  overlay_.lines.push_back({{Vec2(left, f.top), Vec2(left, f.bottom)}, Role::pressure, 0.6});
  const int rows = std::max(2, static_cast<int>((f.bottom - f.top) / (28.0 * density_)));
  const std::vector<double> ticks = figure::nice_ticks(low, low + reach, rows);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  for (const double value : ticks)
    add_tick(Vec2(left + 4.0 * density_, f.y((value - low) / reach)), figure::tick_text(value, step),
             Role::pressure, Anchor::left);
  const double here = analysis::station_at(along, cursor_mm).pressure_pa;
  add_text(Vec2(width_ - 4.0 * density_, 3.0 * density_),
           with_value(flow_->pressure_title, std::isnan(here) ? std::string() : three_digits(here)),
           Role::pressure, Anchor::top_right);
}

void ProfileView::add_flow(const Frame& f) {
  const std::vector<FlowStation>& along = flow_along();
  if (along.empty()) return;
  const double cursor = bench_.own_mm(bench_.cursor_mm.get());
  if (!flow_->shear_title.empty()) add_shear(f, along, cursor);
  if (!flow_->pressure_title.empty()) add_pressure(f, along, cursor);
}

}  // namespace ostia::view
