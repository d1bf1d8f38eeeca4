#include "ostia/hemodynamics/vessel_pressure.h"

#include "circle.h"
#include "dual.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

constexpr double developed = developed_momentum;
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
  T fallen = T(0.0);  // Pa
  double inertia;     // density times scale, kg/m3; pressures are in Pa with ml/s and mm2
  T struck = T(0.0);  // of a jet's excess over `developed`, what has struck a fork: it goes on along the wall
  double least = 0.0;  // area of the last throat, mm2

  /// Between two areas without friction. While the flow is attached every stream line keeps its head, so that
  /// b goes with the area's fourth power and (1 + b) / area^2 with the pressure. Where the lumen widens until
  /// b is 1 it parts from the wall: a jet keeps its momentum and its pressure, and what comes back comes as
  /// it mixes.
  void change_area(double from, double to) {
    using std::pow;
    if (to <= from) least = to;
    if (value_of(momentum) > developed) {
      if (to >= from * developed / value_of(momentum)) {
        const T before = momentum - T(developed);
        momentum = momentum * T(to / from);
        // What a widening adds has struck nothing; a narrowing takes from both alike. So nothing jumps where
        // a jet all but fills the lumen.
        struck = to >= from ? struck * T(to / from) : struck * (momentum - T(developed)) / before;
      } else
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
    struck = T(0.0);
    const T ratio = to / from, square = ratio * ratio;
    // In a contraction a thin layer keeps its share of the flow and its deficit of u^2, so that b goes with
    // the area's square; the developed profile's vorticity is stretched, and b goes with the fourth power.
    // Between the two b / (1 + b) goes with the square.
    const T after = value_of(ratio) < 1.0 ? b * square / (T(1.0) + b - b * square) : b * square * square;
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
    const T before = momentum;
    const T bend = bend_factor(step);
    if (value_of(momentum) > developed) {
      const T excess = momentum - T(developed);
      const T slower = T(1.0) + excess / T(model.jet_spread);
      const T left = exp(T(-step.length_mm) / (length * slower));
      momentum = T(developed) + excess * left;
      struck = struck * left;
      const T beside = jet_friction(model, T(0.5) * (before + momentum));
      fallen = fallen + friction * T(step.friction_mm3) * bend * (beside + leans(step) * (T(1.0) - beside));
    } else {
      const T b0 = T(3.0) * (momentum - T(1.0));
      const T square = T(1.0) - (T(1.0) - b0 * b0) * exp(T(-step.length_mm) / length);
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

  T leans(const PreparedBranch::Step& step) const {
    const double own = model.bends ? step.lean : 0.0;
    const T excess = momentum - T(developed);
    return value_of(excess) > 0.0 ? T(own) + T(1.0 - own) * struck / excess : T(own);
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

/// What has fallen (of a flow that runs back: below 0), and the profile behind.
template <typename T>
struct Marched {
  T fallen, momentum;
};

double first_of(double slope) {
  return slope;
}
double first_of(Slopes slopes) {
  return slopes.first;
}

template <typename T, typename AtStation>
Marched<T> march(const PreparedBranch& branch, const FlowModel& model, T flow, T start_momentum, bool mixes,
                 AtStation at_station) {
  const bool forward = value_of(flow) >= 0.0;
  Marching<T> marching{model, forward ? flow : T(0.0) - flow, T(1.0), T(0.0),
                       model.inertia ? model.density_kg_m3 * model.inertia_scale : 0.0};
  marching.momentum = forward ? start_momentum : T(developed);
  if (value_of(marching.momentum) > developed) marching.struck = marching.momentum - T(developed);
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
  if (count > 0 && marching.inertia > 0.0 && (mixes || !forward))
    marching.mix(forward ? branch.last_area_mm2 : branch.first_area_mm2);
  return {forward ? marching.fallen : T(0.0) - marching.fallen, marching.momentum};
}

}  // namespace

Passage pass(const PreparedBranch& branch, const FlowModel& model, double flow_ml_s, double start_momentum,
             bool mixes, bool by_momentum) {
  if (branch.shut()) return {};
  const double turn = std::abs(flow_ml_s) * branch.lumped.quadratic_pa_s2_ml2;
  Passage passage;
  passage.pa = flow_ml_s * (branch.lumped.linear_pa_s_ml + turn);
  passage.by_flow_pa_s_ml = branch.lumped.linear_pa_s_ml + 2.0 * turn;
  if (branch.steps.empty()) return passage;
  const auto take = [&](const auto& along) {
    passage.pa += along.fallen.value;
    passage.by_flow_pa_s_ml += first_of(along.fallen.slope);
    passage.momentum = along.momentum.value;
    passage.momentum_by_flow_s_ml = first_of(along.momentum.slope);
  };
  const auto none = [](const PreparedBranch::Step&, const auto&, const auto&) {};
  if (!by_momentum) {
    using One = DualBy<double>;
    take(march(branch, model, One(flow_ml_s, 1.0), One(start_momentum), mixes, none));
    return passage;
  }
  using Two = DualBy<Slopes>;
  const Marched<Two> along =
      march(branch, model, Two(flow_ml_s, {1.0, 0.0}), Two(start_momentum, {0.0, 1.0}), mixes, none);
  take(along);
  passage.by_momentum_pa = along.fallen.slope.second;
  passage.momentum_by_momentum = along.momentum.slope.second;
  return passage;
}

Drop pressure_drop(const PreparedBranch& branch, const FlowModel& model, double flow_ml_s) {
  const Passage passage = pass(branch, model, flow_ml_s, branch.start_momentum, true, false);
  return {passage.pa, passage.by_flow_pa_s_ml};
}

std::vector<StationFlow> pressure_along(const PreparedBranch& branch, const FlowModel& model,
                                        double flow_ml_s, double inlet_pa, double behind_pa) {
  return pressure_along(branch, model, flow_ml_s, inlet_pa, behind_pa, branch.start_momentum);
}

std::vector<StationFlow> pressure_along(const PreparedBranch& branch, const FlowModel& model,
                                        double flow_ml_s, double inlet_pa, double behind_pa,
                                        double start_momentum) {
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
    const double beside = jet_friction(model, marching.momentum);
    const double form = marching.momentum > developed ? beside + marching.leans(step) * (1.0 - beside)
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
  stations[forward ? 0 : last] = {0.0, forward ? start_momentum : developed, 0.0, 0.0};
  march(branch, model, flow_ml_s, start_momentum, true, record);
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
