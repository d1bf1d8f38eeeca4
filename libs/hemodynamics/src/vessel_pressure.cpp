#include "ostia/hemodynamics/vessel_pressure.h"

#include "circle.h"
#include "dual.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

constexpr double developed = 4.0 / 3.0;
/// A thin layer on the wall parts from it where the speed has fallen to this share (Howarth 1938).
constexpr double speed_kept = 0.88;

/// Friction on the wall about a jet over that of the developed flow. With what it is less where the lumen
/// widens its slope at the developed flow is that for which energy comes back whole where a lumen widens so
/// slowly that the flow stays developed (of all slow flows that one dissipates least, so that small changes
/// do not change it); far from it the dead water turns, and rubs the other way.
template <typename T>
T jet_friction(const FlowModel& model, T momentum) {
  using std::tanh;
  const double most = 1.0 + model.backflow;
  const double slope = 0.75 * (1.0 / (48.0 * model.development) - model.adverse_friction);
  return T(1.0) - T(most) * tanh((momentum - T(developed)) * T(slope / most));
}

/// What friction is less where the lumen widens; `widening`: of the area's logarithm a millimetre.
template <typename T>
T adverse_friction(const FlowModel& model, double widening, T length, T momentum) {
  using std::tanh;
  if (!(widening > 0.0)) return T(0.0);
  const double most = 1.0 + model.backflow;
  const T jet = value_of(momentum) > developed ? T(developed) / momentum : T(1.0);
  return T(most) * tanh(length * T(model.adverse_friction * widening / most)) * jet;
}

/// State of the profile: its momentum coefficient. Up to `developed` 3 (momentum - 1) =: b tells how far
/// developed it is; above it is a jet with dead water beside it.
template <typename T>
struct Marching {
  const FlowModel& model;
  T flow;  // >= 0, ml/s
  T momentum;
  T fallen = T(0.0);   // Pa
  double inertia;      // density times scale, kg/m3; pressures are in Pa with ml/s and mm2
  double least = 0.0;  // area of the last throat, mm2

  /// Between two areas without friction. While the flow is attached every stream line keeps its head, so that
  /// b goes with the area's fourth power and (1 + b) / area^2 with the pressure. Where the lumen widens until
  /// b is 1 it parts from the wall: a jet keeps its momentum and its pressure, and what comes back comes as
  /// it mixes.
  void change_area(double from, double to) {
    using std::pow;
    if (to <= from) least = to;
    if (value_of(momentum) > developed) {
      if (to >= from * developed / value_of(momentum))
        momentum = momentum * T(to / from);
      else
        attached(T(from * developed) / momentum, T(to), T(1.0));  // the jet fills the lumen, and goes on
      return;
    }
    const T b = T(3.0) * (momentum - T(1.0));
    const double thin = std::max(from, least / speed_kept);
    if (to <= from || (to <= thin && value_of(b) * pow(to / from, 4.0) <= 1.0)) {
      attached(T(from), T(to), b);
      return;
    }
    const bool thick =
        value_of(b) * pow(thin / from, 4.0) > 1.0;  // it parts since b is 1, and before a thin layer would
    const T parts_at = thick ? T(from) * pow(b, -0.25) : T(thin);
    attached(T(from), parts_at, b);
    momentum = momentum * T(to) / parts_at;
  }

  void attached(T from, T to, T b) {
    const T ratio = to / from, square = ratio * ratio;
    const T after = b * square * square;
    fallen = fallen +
             T(0.5 * inertia) * flow * flow * ((T(1.0) + after) / (to * to) - (T(1.0) + b) / (from * from));
    momentum = T(1.0) + after / T(3.0);
  }

  /// Friction and the return to the developed profile over a step at one area.
  void develop(const PreparedBranch::Step& step, double widening) {
    using std::exp, std::log, std::sqrt;
    const double area = step.area_mm2[1];
    const T friction = T(8.0 * pi * model.viscosity_mpa_s) * flow;
    if (!(inertia > 0.0) || !(value_of(flow) > 0.0)) {
      fallen = fallen + friction * T(step.friction_mm3);
      momentum = T(developed);
      return;
    }
    const T length = T(model.development * 4.0 * inertia / (pi * model.viscosity_mpa_s)) * flow;
    const T decay = exp(T(-step.length_mm) / length);
    const T before = momentum;
    const T bend = bend_factor(step);
    if (value_of(momentum) > developed) {
      momentum = T(developed) + (momentum - T(developed)) * decay;
      fallen =
          fallen + friction * T(step.friction_mm3) * bend * jet_friction(model, T(0.5) * (before + momentum));
    } else {
      const T b0 = T(3.0) * (momentum - T(1.0));
      const T square = T(1.0) - (T(1.0) - b0 * b0) * decay;
      const T b1 = sqrt(square);
      // A layer of thickness ~ b rubs as 1 / b: the integral of 1 / b - 1 over the step is exact.
      const T excess = T(model.layer_friction * step.mean_friction_mm4) * length * T(2.0) *
                       log((T(1.0) + b1) / (T(1.0) + b0));
      fallen = fallen + friction * (T(step.friction_mm3) * bend + excess);
      momentum = T(1.0) + b1 / T(3.0);
    }
    fallen = fallen - friction * T(step.friction_mm3) * adverse_friction(model, widening, length, momentum);
    fallen = fallen + T(inertia / (area * area)) * flow * flow * (momentum - before);
  }

  /// White's law for developed flow in bent pipes.
  T bend_factor(const PreparedBranch::Step& step) const {
    using std::pow;
    constexpr double least_dean = 11.6;
    if (!model.bends || step.bend <= 0.0) return T(1.0);
    const T dean = T(4.0 * inertia * step.bend / (pi * model.viscosity_mpa_s * step.diameter_mm)) * flow;
    if (value_of(dean) <= least_dean) return T(1.0);
    return T(1.0) / (T(1.0) - pow(T(1.0) - pow(T(least_dean) / dean, 0.45), 2.2));
  }

  /// What is left of a jet at the branch's end mixes in the fork.
  void mix(double area) {
    if (value_of(momentum) <= developed) return;
    fallen = fallen + T(inertia / (area * area)) * flow * flow * (T(developed) - momentum);
    momentum = T(developed);
  }
};

template <typename T, typename AtStation>
T march(const PreparedBranch& branch, const FlowModel& model, T flow, AtStation at_station) {
  const bool forward = value_of(flow) >= 0.0;
  Marching<T> marching{model, forward ? flow : T(0.0) - flow, T(1.0), T(0.0),
                       model.inertia ? model.density_kg_m3 * model.inertia_scale : 0.0};
  marching.momentum = T(forward ? branch.start_momentum : model.fork_momentum);
  const std::size_t count = branch.steps.size();
  marching.least = forward ? branch.first_area_mm2 : branch.last_area_mm2;
  for (std::size_t i = 0; i < count; ++i) {
    const PreparedBranch::Step& step = branch.steps[forward ? i : count - 1 - i];
    const double from = step.area_mm2[forward ? 0 : 2], to = step.area_mm2[forward ? 2 : 0];
    const T before = marching.fallen;
    if (marching.inertia > 0.0) marching.change_area(from, step.area_mm2[1]);
    marching.develop(step, forward ? step.widening : -step.widening);
    if (marching.inertia > 0.0) marching.change_area(step.area_mm2[1], to);
    at_station(step, marching, before);
  }
  if (count > 0 && marching.inertia > 0.0)
    marching.mix(forward ? branch.last_area_mm2 : branch.first_area_mm2);
  return forward ? marching.fallen : T(0.0) - marching.fallen;
}

double area_between(const Station& a, const Station& b, double t) {
  const double root = (1.0 - t) * std::sqrt(a.area_mm2) + t * std::sqrt(b.area_mm2);
  return root * root;
}

/// Of 1 / area^2, over a stretch on which the radius is linear: exact for a cone.
double cone_integral(double length, double area_a, double area_b) {
  const double a = std::sqrt(area_a), b = std::sqrt(area_b);
  return length * (a * a + a * b + b * b) / (3.0 * a * a * a * b * b * b);
}

PreparedBranch::Step step_between(const Station& a, const Station& b, double from, double to) {
  PreparedBranch::Step step;
  const double middle = 0.5 * (from + to);
  const auto mix = [middle](double x, double y) { return (1.0 - middle) * x + middle * y; };
  step.length_mm = (to - from) * (b.s_mm - a.s_mm);
  step.area_mm2[0] = area_between(a, b, from);
  step.area_mm2[1] = area_between(a, b, middle);
  step.area_mm2[2] = area_between(a, b, to);
  const double shape = mix(a.shape.viscous, b.shape.viscous);
  step.friction_mm3 = shape * cone_integral(step.length_mm, step.area_mm2[0], step.area_mm2[2]);
  step.mean_friction_mm4 = step.friction_mm3 / step.length_mm;
  step.diameter_mm = 2.0 * std::sqrt(step.area_mm2[1] / pi);
  step.perimeter_mm = pi * step.diameter_mm * mix(a.shape.perimeter, b.shape.perimeter);
  step.bend = std::sqrt(std::max(0.0, 0.5 * step.diameter_mm * mix(a.curvature_per_mm, b.curvature_per_mm)));
  return step;
}

/// Over a diameter, half on either side: a rough wall is none that widens.
void set_widening(std::vector<PreparedBranch::Step>& steps) {
  std::vector<double> s = {0.0}, log_area = {std::log(steps.front().area_mm2[0])};
  for (const PreparedBranch::Step& step : steps) {
    s.push_back(s.back() + step.length_mm);
    log_area.push_back(std::log(step.area_mm2[2]));
  }
  std::size_t before = 0, behind = 0;
  const auto at = [&](double place, std::size_t& i) {
    while (i + 2 < s.size() && s[i + 1] <= place) ++i;
    while (i > 0 && s[i] > place) --i;
    const double t = (place - s[i]) / (s[i + 1] - s[i]);
    return log_area[i] + t * (log_area[i + 1] - log_area[i]);
  };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double middle = 0.5 * (s[k] + s[k + 1]), half = 0.5 * steps[k].diameter_mm;
    const double from = std::max(0.0, middle - half), to = std::min(s.back(), middle + half);
    steps[k].widening = (at(to, behind) - at(from, before)) / (to - from);
  }
}

}  // namespace

PreparedBranch prepare(const Branch& branch, const FlowModel& model) {
  validate(branch);
  validate(model);
  PreparedBranch out;
  out.lumped = branch.lumped;
  out.start_momentum = branch.parent < 0 ? model.root_momentum : model.fork_momentum;
  out.stations = branch.stations.size();
  while (out.open_stations < out.stations && branch.stations[out.open_stations].area_mm2 > shut_mm2)
    ++out.open_stations;
  if (branch.stations.empty()) return out;
  out.first_area_mm2 = branch.stations.front().area_mm2;
  out.last_area_mm2 = branch.stations.back().area_mm2;
  if (out.shut()) return out;
  for (std::size_t i = 1; i < branch.stations.size(); ++i) {
    const Station &a = branch.stations[i - 1], &b = branch.stations[i];
    const double length = b.s_mm - a.s_mm;
    // Also where the area changes fast: half of it or twice as much within a step at most.
    const double turns = std::abs(std::log(b.area_mm2 / a.area_mm2)) / std::numbers::ln2;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(std::max(length / model.step_mm - 1e-9, turns))), 1, 10000);
    for (int k = 0; k < steps; ++k)
      out.steps.push_back(
          step_between(a, b, static_cast<double>(k) / steps, static_cast<double>(k + 1) / steps));
    out.steps.back().station = true;
  }
  set_widening(out.steps);
  return out;
}

Drop pressure_drop(const PreparedBranch& branch, const FlowModel& model, double flow_ml_s) {
  if (branch.shut()) return {};
  const double turn = std::abs(flow_ml_s) * branch.lumped.quadratic_pa_s2_ml2;
  Drop drop{flow_ml_s * (branch.lumped.linear_pa_s_ml + turn), branch.lumped.linear_pa_s_ml + 2.0 * turn};
  if (branch.steps.empty()) return drop;
  const auto none = [](const PreparedBranch::Step&, const Marching<Dual>&, Dual) {};
  const Dual along = march(branch, model, Dual(flow_ml_s, 1.0), none);
  drop.pa += along.value;
  drop.pa_s_ml += along.slope;
  return drop;
}

std::vector<StationFlow> pressure_along(const PreparedBranch& branch, const FlowModel& model,
                                        double flow_ml_s, double inlet_pa, double behind_pa) {
  std::vector<StationFlow> stations(branch.stations);
  if (stations.empty()) return stations;
  if (branch.shut()) {
    for (std::size_t i = 0; i < stations.size(); ++i)
      stations[i] = {i < branch.open_stations ? inlet_pa : behind_pa, 1.0, 0.0, 0.0};
    return stations;
  }
  const bool forward = flow_ml_s >= 0.0;
  const std::size_t last = stations.size() - 1;
  const auto record = [&, at = forward ? std::size_t{0} : last](const PreparedBranch::Step& step,
                                                                const Marching<double>& marching,
                                                                double) mutable {
    // Friction alone, at the profile that the step ends with.
    const double b = std::max(0.05, 3.0 * (marching.momentum - 1.0));
    const double form = marching.momentum > developed ? jet_friction(model, marching.momentum)
                                                      : 1.0 + model.layer_friction * (1.0 / b - 1.0);
    const double length =
        model.development * 4.0 * marching.inertia / (pi * model.viscosity_mpa_s) * marching.flow;
    const double less =
        adverse_friction(model, (forward ? 1.0 : -1.0) * step.widening, length, marching.momentum);
    const double gradient = 8.0 * pi * model.viscosity_mpa_s * marching.flow * step.mean_friction_mm4 *
                            (marching.inertia > 0.0 ? form * marching.bend_factor(step) - less : 1.0);
    StationFlow now;
    now.pressure_pa = marching.fallen;
    now.momentum = marching.momentum;
    now.wall_shear_pa = gradient * step.area_mm2[1] / step.perimeter_mm;
    now.reynolds = reynolds(model, marching.flow, 2.0 * std::sqrt(step.area_mm2[forward ? 2 : 0] / pi));
    if (!(forward ? step.station : &step == &branch.steps.front() || (&step - 1)->station)) return;
    stations[forward ? ++at : --at] = now;
  };
  stations[forward ? 0 : last] = {0.0, forward ? branch.start_momentum : model.fork_momentum, 0.0, 0.0};
  march(branch, model, flow_ml_s, record);
  StationFlow& first = stations[forward ? 0 : last];
  first.wall_shear_pa = stations[forward ? std::min<std::size_t>(1, last) : last - 1].wall_shear_pa;
  first.reynolds = reynolds(model, std::abs(flow_ml_s),
                            2.0 * std::sqrt((forward ? branch.first_area_mm2 : branch.last_area_mm2) / pi));
  if (forward) {
    for (StationFlow& station : stations) station.pressure_pa = inlet_pa - station.pressure_pa;
  } else {
    const double whole = stations.front().pressure_pa;
    for (StationFlow& station : stations) station.pressure_pa = inlet_pa + whole - station.pressure_pa;
  }
  return stations;
}

}  // namespace ostia::hemodynamics
