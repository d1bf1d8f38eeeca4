#include "ostia/hemodynamics/pulse.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::hemodynamics {
namespace {

constexpr double end_diastolic_mmhg = 8.0;
constexpr double usual_systole_s = 0.31;  // at 70 beats a minute; shortens with the square root of the beat

/// Phase at which the aortic valve closes.
double systole_of(const Conditions& conditions) {
  const double beat = 60.0 / conditions.heart_rate_bpm;
  return std::min(0.6, usual_systole_s * std::sqrt(beat / (60.0 / 70.0)) / beat);
}

/// A usual course of the aortic pressure, 0 to 1: systole in [0, 1), diastole in [1, 2].
double usual_course(double place) {
  constexpr std::array<std::array<double, 2>, 10> course = {{{0.0, 0.0},
                                                             {0.25, 0.7},
                                                             {0.5, 1.0},
                                                             {0.75, 0.92},
                                                             {1.0, 0.66},
                                                             {1.07, 0.69},
                                                             {1.25, 0.52},
                                                             {1.5, 0.31},
                                                             {1.75, 0.13},
                                                             {2.0, 0.0}}};
  const auto next = std::upper_bound(course.begin() + 1, course.end() - 1, place,
                                     [](double p, const std::array<double, 2>& one) { return p < one[0]; });
  const auto& a = *(next - 1);
  const auto& b = *next;
  const double t = std::clamp((place - a[0]) / (b[0] - a[0]), 0.0, 1.0);
  const double smooth = t * t * (3.0 - 2.0 * t);
  return a[1] + (b[1] - a[1]) * smooth;
}

double place_in_course(const Conditions& conditions, double phase) {
  const double systole = systole_of(conditions);
  return phase < systole ? phase / systole : 1.0 + (phase - systole) / (1.0 - systole);
}

/// The power to which the course is raised for its mean to be the conditions'.
double course_power(const Conditions& conditions) {
  constexpr int samples = 400;
  double low = 0.1, high = 10.0;
  for (int i = 0; i < 50; ++i) {
    const double power = std::sqrt(low * high);
    double mean = 0.0;
    for (int k = 0; k < samples; ++k)
      mean += std::pow(usual_course(place_in_course(conditions, (k + 0.5) / samples)), power) / samples;
    (mean > conditions.mean_share ? low : high) = power;
  }
  return std::sqrt(low * high);
}

double aortic_with(const Conditions& conditions, double phase, double power) {
  const double course = std::pow(usual_course(place_in_course(conditions, phase)), power);
  return pa_of_mmhg *
         (conditions.diastolic_mmhg + course * (conditions.systolic_mmhg - conditions.diastolic_mmhg));
}

/// Rises before the aortic valve opens, is the aorta's while it is open, and falls behind its closing.
double ventricular_with(const Conditions& conditions, double phase, double power) {
  constexpr double rise_s = 0.05, fall_s = 0.08;
  const double beats_s = conditions.heart_rate_bpm / 60.0, systole = systole_of(conditions);
  const double rise = rise_s * beats_s, fall = fall_s * beats_s, rest = pa_of_mmhg * end_diastolic_mmhg;
  const auto between = [&](double pressure, double part) {
    return rest + (pressure - rest) * part * part * (3.0 - 2.0 * part);
  };
  if (phase <= systole) return aortic_with(conditions, phase, power);
  if (phase < systole + fall)
    return between(aortic_with(conditions, systole, power), 1.0 - (phase - systole) / fall);
  if (phase > 1.0 - rise) return between(aortic_with(conditions, 0.0, power), 1.0 - (1.0 - phase) / rise);
  return rest;
}

/// Where between its stations a place lies.
struct Between {
  std::size_t branch = 0, before = 0;
  double t = 0.0;
};

Between between_of(const PreparedNetwork& network, const TreePlace& place) {
  if (place.branch >= network.size()) throw InvalidInput("a place names a branch that is not there");
  const auto& stations = network.network().branches[place.branch].stations;
  if (stations.size() < 2) throw InvalidInput("a place is on a branch without sections");
  Between out{place.branch, 0, 0.0};
  while (out.before + 2 < stations.size() && stations[out.before + 1].s_mm < place.s_mm) ++out.before;
  const double from = stations[out.before].s_mm, to = stations[out.before + 1].s_mm;
  out.t = std::clamp((place.s_mm - from) / (to - from), 0.0, 1.0);
  return out;
}

class Beating {
 public:
  Beating(const PreparedNetwork& network, const Conditions& conditions, const FlowState& mean,
          const std::vector<TreePlace>& places, const PulseOptions& options)
      : network_(network),
        conditions_(conditions),
        options_(options),
        solution_(mean.solution),
        power_(course_power(conditions)) {
    for (const TreePlace& place : places) {
      between_.push_back(between_of(network, place));
      pulse_.places.push_back({place, {}, 1.0, 1.0});
    }
    make_beds(mean);
  }

  Pulse run() {
    do {
      beat();
    } while (pulse_.change_pa > 1.0 && pulse_.beats < options_.most_beats);
    finish();
    return std::move(pulse_);
  }

 private:
  void make_beds(const FlowState& mean) {
    const auto& outlets = network_.outlets();
    for (std::size_t k = 0; k < outlets.size(); ++k) {
      const double flow = mean.solution.flow_ml_s[outlets[k]];
      const double venous = conditions_.venous_mmhg * pa_of_mmhg;
      const double resistance = flow > 0.0 ? (mean.solution.to_pa[outlets[k]] - venous) / flow : 1e9;
      const double compliance = std::max(flow, 1e-6) * options_.compliance_s_mmhg / pa_of_mmhg;
      beds_.push_back(coronary_bed(resistance, compliance, venous));
      states_.push_back(steady_state(beds_.back(), flow));
      muscle_.push_back(is_right(outlets[k]) ? options_.right_muscle_share : options_.left_muscle_share);
    }
  }

  bool is_right(std::size_t branch) const {
    const auto& branches = network_.network().branches;
    while (branches[branch].parent >= 0) branch = static_cast<std::size_t>(branches[branch].parent);
    return branches[branch].name.starts_with("RCA");
  }

  void beat() {
    const std::vector<BedState> before = states_;
    const double beat_s = 60.0 / conditions_.heart_rate_bpm, step_s = beat_s / options_.steps;
    start_record();
    for (int i = 1; i <= options_.steps; ++i) {
      const double phase = static_cast<double>(i % options_.steps) / options_.steps;
      const double rise = ventricular_with(conditions_, phase, power_) -
                          ventricular_with(conditions_, static_cast<double>(i - 1) / options_.steps, power_);
      Boundary boundary;
      boundary.inlet_pa = aortic_with(conditions_, phase, power_);
      for (std::size_t k = 0; k < beds_.size(); ++k)
        boundary.outlets.push_back(step_outlet(beds_[k], states_[k], step_s, muscle_[k] * rise));
      solution_ = solve(network_, boundary, &solution_);
      for (std::size_t k = 0; k < beds_.size(); ++k)
        states_[k] = after_step(beds_[k], states_[k], step_s, muscle_[k] * rise,
                                solution_.flow_ml_s[network_.outlets()[k]]);
      record(i * step_s, boundary.inlet_pa);
    }
    ++pulse_.beats;
    pulse_.change_pa = 0.0;
    for (std::size_t k = 0; k < states_.size(); ++k)
      pulse_.change_pa = std::max({pulse_.change_pa, std::abs(states_[k].artery_pa - before[k].artery_pa),
                                   std::abs(states_[k].muscle_pa - before[k].muscle_pa)});
  }

  void start_record() {
    pulse_.time_s.clear();
    pulse_.aortic_pa.clear();
    pulse_.mean_flow_ml_s.assign(network_.size(), 0.0);
    pulse_.outlet_flow_ml_s.assign(beds_.size(), {});
    for (PulsePlace& place : pulse_.places) place.pressure_pa.clear();
  }

  void record(double time_s, double aortic_pa) {
    pulse_.time_s.push_back(time_s);
    pulse_.aortic_pa.push_back(aortic_pa);
    for (std::size_t b = 0; b < network_.size(); ++b)
      pulse_.mean_flow_ml_s[b] += solution_.flow_ml_s[b] / options_.steps;
    for (std::size_t k = 0; k < beds_.size(); ++k)
      pulse_.outlet_flow_ml_s[k].push_back(solution_.flow_ml_s[network_.outlets()[k]]);
    for (std::size_t i = 0; i < between_.size(); ++i) {
      const auto stations = along(network_, solution_, between_[i].branch);
      const double a = stations[between_[i].before].pressure_pa,
                   b = stations[between_[i].before + 1].pressure_pa;
      pulse_.places[i].pressure_pa.push_back(a + between_[i].t * (b - a));
    }
  }

  void finish() {
    const Phases window = wave_free_period(conditions_);
    for (PulsePlace& place : pulse_.places) {
      double aortic = 0.0, own = 0.0, aortic_free = 0.0, own_free = 0.0;
      for (std::size_t i = 0; i < place.pressure_pa.size(); ++i) {
        const double phase = static_cast<double>(i + 1) / options_.steps;
        aortic += pulse_.aortic_pa[i];
        own += place.pressure_pa[i];
        if (phase < window.from || phase > window.to) continue;
        aortic_free += pulse_.aortic_pa[i];
        own_free += place.pressure_pa[i];
      }
      place.mean_ratio = own / aortic;
      place.wave_free_ratio = aortic_free > 0.0 ? own_free / aortic_free : place.mean_ratio;
    }
  }

  const PreparedNetwork& network_;
  const Conditions& conditions_;
  const PulseOptions& options_;
  Solution solution_;
  double power_;
  std::vector<Between> between_;
  std::vector<CoronaryBed> beds_;
  std::vector<BedState> states_;
  std::vector<double> muscle_;
  Pulse pulse_;
};

}  // namespace

void validate(const PulseOptions& options) {
  if (options.steps < 50 || options.steps > 5000)
    throw InvalidInput("a beat has " + std::to_string(options.steps) + " steps; choose 50 to 5000");
  if (options.most_beats < 1 || options.most_beats > 1000)
    throw InvalidInput("a pulse has " + std::to_string(options.most_beats) + " beats; choose 1 to 1000");
  if (!(options.compliance_s_mmhg > 0.0 && options.compliance_s_mmhg <= 10.0) ||
      !(options.right_muscle_share >= 0.0 && options.right_muscle_share <= 2.0) ||
      !(options.left_muscle_share >= 0.0 && options.left_muscle_share <= 2.0))
    throw InvalidInput(
        "the beds' compliance is above 0 and up to 10 s/mmHg, the muscle's share of the pressure 0 to 2");
}

double aortic_pressure_pa(const Conditions& conditions, double phase) {
  return aortic_with(conditions, phase, course_power(conditions));
}

double ventricular_pressure_pa(const Conditions& conditions, double phase) {
  return ventricular_with(conditions, phase, course_power(conditions));
}

Phases wave_free_period(const Conditions& conditions) {
  const double systole = systole_of(conditions);
  return {systole + 0.25 * (1.0 - systole), 1.0 - 0.005 * conditions.heart_rate_bpm / 60.0};
}

Pulse pulse(const PreparedNetwork& network, const Conditions& conditions, const FlowState& mean,
            const std::vector<TreePlace>& places, const PulseOptions& options) {
  validate(options);
  validate(conditions, true);
  return Beating(network, conditions, mean, places, options).run();
}

}  // namespace ostia::hemodynamics
