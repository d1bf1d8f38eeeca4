#include "pressure/pressure_compare.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/hemodynamics/conditions.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::experiments {
namespace {

using hemodynamics::pa_of_mmhg;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double largest_gap_mm = 1.0;   // between known sections
constexpr double inside_inlet = 1.0;     // diameters from the root to where both begin
constexpr double before_outlet = 1.0;    // diameters before an end, where the flow is still a vessel's
constexpr std::size_t least_fitted = 5;  // readings

double aortic_pa() {
  return hemodynamics::Conditions().mean_aortic_mmhg() * pa_of_mmhg;
}

double first_compared_mm(const hemodynamics::Branch& root) {
  return root.stations.front().s_mm + inside_inlet * root.stations.front().diameter_mm();
}
double last_compared_mm(const hemodynamics::Branch& end) {
  return end.stations.back().s_mm - before_outlet * end.stations.back().diameter_mm();
}

double between(const hemodynamics::Branch& branch, const std::vector<double>& pa, double s_mm) {
  const auto& stations = branch.stations;
  std::size_t i = 1;
  while (i + 1 < stations.size() && stations[i].s_mm < s_mm) ++i;
  const double t = (s_mm - stations[i - 1].s_mm) / (stations[i].s_mm - stations[i - 1].s_mm);
  return pa[i - 1] + std::clamp(t, 0.0, 1.0) * (pa[i] - pa[i - 1]);
}

std::size_t root_of(const hemodynamics::Network& network) {
  const auto roots = hemodynamics::roots_of(network);
  if (roots.size() != 1) throw InvalidInput("a case of the pressure experiment has one root");
  return roots.front();
}

/// Where both pressures are taken to be the same.
struct Common {
  double s_mm = 0.0, pa_1d = 0.0, pa_3d = 0.0;
};
Common common_of(const PressureProblem& problem, const std::vector<std::vector<double>>& pa) {
  const std::size_t root = root_of(problem.network);
  const hemodynamics::Branch& branch = problem.network.branches[root];
  if (branch.stations.size() < 2) throw InvalidInput("the root has no sections that are measured");
  Common common;
  common.s_mm = first_compared_mm(branch);
  common.pa_1d = between(branch, pa[root], common.s_mm);
  common.pa_3d = SectionPressures(problem.run.sections, branch.vessel).at(common.s_mm);
  if (!std::isfinite(common.pa_3d))
    throw InvalidInput("the computation tells no pressure at the root's beginning");
  return common;
}

}  // namespace

SectionPressures::SectionPressures(const std::vector<SectionPressure>& sections, std::int32_t vessel) {
  for (const SectionPressure& one : sections) {
    if (one.vessel != vessel) continue;
    s_mm_.push_back(one.s_mm);
    pa_.push_back(one.pressure_pa);
  }
}

double SectionPressures::at(double s_mm) const {
  const auto above = std::lower_bound(s_mm_.begin(), s_mm_.end(), s_mm);
  if (above == s_mm_.end()) return not_known;
  const auto i = static_cast<std::size_t>(above - s_mm_.begin());
  if (*above == s_mm) return pa_[i];
  if (i == 0 || s_mm_[i] - s_mm_[i - 1] > largest_gap_mm) return not_known;
  const double t = (s_mm - s_mm_[i - 1]) / (s_mm_[i] - s_mm_[i - 1]);
  return pa_[i - 1] + t * (pa_[i] - pa_[i - 1]);
}

bool SectionPressures::known_at(double s_mm) const {
  return std::isfinite(at(s_mm));
}

hemodynamics::FlowModel compared_model() {
  hemodynamics::FlowModel model = hemodynamics::flow_model_of(hemodynamics::Conditions());
  model.root_momentum = 4.0 / 3.0;
  return model;
}

PressureProblem problem_of(const PressureCase& one, hemodynamics::Network network, const PressureRun& run) {
  PressureProblem problem{one, std::move(network), {}, run};
  for (const std::size_t outlet : hemodynamics::outlets_of(problem.network)) {
    const std::string& name = problem.network.branches[outlet].name;
    if (!run.outlets_ml_s.contains(name))
      throw InvalidInput("the computation has no outlet of the vessel " + name);
    problem.outlet_names.push_back(name);
  }
  return problem;
}

std::vector<std::vector<double>> pressures_1d(const PressureProblem& problem,
                                              const hemodynamics::FlowModel& model) {
  const hemodynamics::PreparedNetwork network(problem.network, model);
  hemodynamics::Boundary boundary;
  boundary.inlet_pa = aortic_pa();
  for (const std::string& name : problem.outlet_names) {
    hemodynamics::Outlet outlet;
    outlet.flow_ml_s = problem.run.outlets_ml_s.at(name);
    boundary.outlets.push_back(outlet);
  }
  const hemodynamics::Solution solution = hemodynamics::solve(network, boundary);
  std::vector<std::vector<double>> pa(network.size());
  for (std::size_t b = 0; b < network.size(); ++b)
    for (const hemodynamics::StationFlow& station : hemodynamics::along(network, solution, b))
      pa[b].push_back(station.pressure_pa);
  return pa;
}

std::vector<PressureReading> readings_of(const PressureProblem& problem,
                                         const hemodynamics::FlowModel& model) {
  const std::vector<std::vector<double>> pa = pressures_1d(problem, model);
  const Common common = common_of(problem, pa);
  std::vector<PressureReading> readings;
  const auto outlets = hemodynamics::outlets_of(problem.network);
  for (std::size_t k = 0; k < outlets.size(); ++k) {
    const hemodynamics::Branch& branch = problem.network.branches[outlets[k]];
    if (branch.stations.size() < 2) continue;
    const SectionPressures known(problem.run.sections, branch.vessel);
    PressureReading reading;
    reading.vessel = problem.outlet_names[k];
    reading.s_mm = last_compared_mm(branch);
    // Not before its own stations, nor where the mesh has been cut off already.
    while (reading.s_mm > branch.stations.front().s_mm && !known.known_at(reading.s_mm)) reading.s_mm -= 0.25;
    if (!known.known_at(reading.s_mm)) continue;
    reading.ffr_1d = 1.0 + (between(branch, pa[outlets[k]], reading.s_mm) - common.pa_1d) / aortic_pa();
    reading.ffr_3d = 1.0 + (known.at(reading.s_mm) - common.pa_3d) / aortic_pa();
    readings.push_back(reading);
  }
  if (readings.empty()) throw InvalidInput("no pressure is known at any outlet");
  return readings;
}

PressureRow row_of(const PressureProblem& problem) {
  PressureRow row;
  row.planned = problem.planned;
  row.run = problem.run;
  row.readings = readings_of(problem, compared_model());
  const std::vector<std::vector<double>> pa = pressures_1d(problem, compared_model());
  const Common common = common_of(problem, pa);
  const auto outlets = hemodynamics::outlets_of(problem.network);
  const std::size_t root = root_of(problem.network);
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t b = 0; b < problem.network.branches.size(); ++b) {
    const hemodynamics::Branch& branch = problem.network.branches[b];
    if (branch.stations.size() < 2) continue;
    const SectionPressures known(problem.run.sections, branch.vessel);
    const bool ends = std::find(outlets.begin(), outlets.end(), b) != outlets.end();
    PressureCurve curve;
    curve.vessel = branch.name;
    for (std::size_t i = 0; i < branch.stations.size(); ++i) {
      const hemodynamics::Station& station = branch.stations[i];
      if ((b == root && station.s_mm < common.s_mm) || (ends && station.s_mm > last_compared_mm(branch)) ||
          !known.known_at(station.s_mm))
        continue;
      curve.s_mm.push_back(station.s_mm);
      curve.diameter_mm.push_back(station.diameter_mm());
      curve.mmhg_1d.push_back((pa[b][i] - common.pa_1d) / pa_of_mmhg);
      curve.mmhg_3d.push_back((known.at(station.s_mm) - common.pa_3d) / pa_of_mmhg);
      squares += std::pow(curve.mmhg_1d.back() - curve.mmhg_3d.back(), 2);
      ++count;
    }
    if (!curve.s_mm.empty()) row.curves.push_back(std::move(curve));
  }
  row.rms_mmhg = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  if (const auto exact = exact_network(problem.planned))
    row.readings.front().exact =
        readings_of(problem_of(problem.planned, *exact, problem.run), compared_model()).front().ffr_1d;
  return row;
}

hemodynamics::Network measured_network(const lumen::LumenModel& model, const core::TaskContext& task) {
  const auto walls = session::solved_surfaces(model, task);
  return session::pressure_tree(model, walls, {}, task).network;
}

PressureRow compare_pressure(const PressureCase& one, const lumen::LumenModel& model, const PressureRun& run,
                             const core::TaskContext& task) {
  return row_of(problem_of(one, measured_network(model, task), run));
}

std::optional<PressureFit> fit_pressure(const std::vector<PressureProblem>& problems) {
  std::vector<const PressureProblem*> fitting;
  for (const PressureProblem& one : problems)
    if (!one.planned.judged && one.planned.kind != PressureKind::tube && one.run.converged)
      fitting.push_back(&one);
  const auto cost = [&](const hemodynamics::FlowModel& model, std::size_t& readings) {
    std::vector<std::pair<double, std::size_t>> parts(fitting.size());
    core::parallel_for(fitting.size(), 1, [&](std::size_t i) {
      for (const PressureReading& one : readings_of(*fitting[i], model)) {
        parts[i].first += one.difference() * one.difference();
        ++parts[i].second;
      }
    });
    double sum = 0.0;
    readings = 0;
    for (const auto& [squares, count] : parts) sum += squares, readings += count;
    return readings > 0 ? std::sqrt(sum / static_cast<double>(readings)) : 0.0;
  };
  PressureFit fit;
  const hemodynamics::FlowModel usual = compared_model();
  fit.development = usual.development;
  fit.layer_friction = usual.layer_friction;
  fit.rms_before = fit.rms_after = cost(usual, fit.readings);
  if (fit.readings < least_fitted) return std::nullopt;
  // From a coarse grid to a fine one about the best.
  double span_development = 2.0, span_friction = 0.5;
  for (int round = 0; round < 4; ++round) {
    const PressureFit centre = fit;
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j) {
        hemodynamics::FlowModel model = usual;
        model.development = std::clamp(centre.development * std::pow(span_development, i / 3.0), 0.001, 0.1);
        model.layer_friction = std::clamp(centre.layer_friction + span_friction * j / 3.0, 0.0, 2.0);
        std::size_t readings = 0;
        const double rms = cost(model, readings);
        if (rms >= fit.rms_after) continue;
        fit.rms_after = rms;
        fit.development = model.development;
        fit.layer_friction = model.layer_friction;
      }
    span_development = std::sqrt(span_development);
    span_friction *= 0.5;
  }
  return fit;
}

}  // namespace ostia::experiments
