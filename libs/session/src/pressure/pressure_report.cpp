#include "ostia/session/pressure_report.h"

#include "ostia/core/error.h"
#include "ostia/session/pressure_what_if.h"

namespace ostia::session {
namespace {

using hemodynamics::State;

void check_options(const PressureReportOptions& options) {
  hemodynamics::validate(options.conditions, options.unusual);
  hemodynamics::validate(options.reading);
  if (options.uncertainty) hemodynamics::validate(*options.uncertainty);
}

void prepare_network(PressureReport& report) {
  hemodynamics::FlowModel model =
      hemodynamics::flow_model_of(report.options.conditions, report.options.model);
  model.from_rest = true;  // a patient's tree begins at the aorta
  report.network.emplace(report.tree.network, model);
}

/// All that follows from the network and the options, but for the pulse. `from`: where flows begin.
void solve_report(PressureReport& report, const PressureReport* from, const core::TaskContext& task) {
  const PressureReportOptions& options = report.options;
  report.warnings = report.tree.warnings;
  if (options.unusual)
    for (const std::string& one : hemodynamics::unusual_inputs(options.conditions))
      report.warnings.push_back(one);
  report.resting = hemodynamics::resting_flow(report.tree.network, options.conditions);
  for (const std::string& note : report.resting.notes) report.warnings.push_back(note);
  const auto& network = *report.network;
  const auto solved = [&](State state, const hemodynamics::FlowState* before) {
    return hemodynamics::flow_state(network, options.conditions, report.resting, state,
                                    before ? &before->solution : nullptr);
  };
  report.hyperaemia = solved(State::hyperaemia, from ? &from->hyperaemia : nullptr);
  task.throw_if_cancelled();
  report.rest = solved(State::rest, from ? &from->rest : nullptr);
  report.under_hyperaemia =
      hemodynamics::read_tree(network, report.hyperaemia, report.tree.lesions, options.reading);
  report.at_rest = hemodynamics::read_tree(network, report.rest, report.tree.lesions, options.reading);
  for (const auto& mark : report.under_hyperaemia.marks) report.warnings.push_back(mark.text);
  report.uncertainty.reset();
  report.after.reset();
  if (!options.what_ifs.empty()) report.after.emplace(pressure_after(report, &report.warnings));
}

void add_uncertainty(PressureReport& report, const core::TaskContext& task) {
  report.uncertainty = uncertainty_of(report, *report.options.uncertainty, task);
  if (report.uncertainty->failed > 0)
    report.warnings.push_back(std::to_string(report.uncertainty->failed) + " of " +
                              std::to_string(report.uncertainty->trees) +
                              " trees drawn for the uncertainty did not settle and are left out");
}

}  // namespace

PressureReport make_pressure_report(PressureTree tree, const PressureReportOptions& options,
                                    const core::TaskContext& task) {
  check_options(options);
  PressureReport report;
  report.options = options;
  report.tree = std::move(tree);
  task.set_stage("pressures");
  prepare_network(report);
  solve_report(report, nullptr, task);
  const auto& network = *report.network;
  constexpr double solved_share = 0.05;  // of the time, where trees are drawn
  task.set_progress(solved_share);
  if (options.pulse) {
    std::vector<hemodynamics::TreePlace> places;
    for (const auto& lesion : report.under_hyperaemia.lesions) places.push_back(lesion.read_at);
    report.pulse =
        hemodynamics::pulse(network, options.conditions, report.rest, places, options.pulse_options);
  }
  if (options.uncertainty) add_uncertainty(report, task.sub(solved_share, 1.0));
  task.set_progress(1.0);
  return report;
}

hemodynamics::PressureUncertainty uncertainty_of(const PressureReport& report,
                                                 const hemodynamics::UncertaintyOptions& options,
                                                 const core::TaskContext& task) {
  return hemodynamics::pressure_uncertainty(report.tree.network, report.options.conditions,
                                            report.tree.lesions, report.network->model(),
                                            report.options.reading, options, task);
}

PressureReport with_options(const PressureReport& before, const PressureReportOptions& options) {
  check_options(options);
  PressureReport report = before;
  report.options = options;
  report.pulse.reset();
  report.wall.reset();
  prepare_network(report);
  solve_report(report, nullptr, core::no_task());
  return report;
}

PressureReport with_uncertainty(const PressureReport& before, const hemodynamics::UncertaintyOptions& options,
                                const core::TaskContext& task) {
  PressureReport report = before;
  report.options.uncertainty = options;
  add_uncertainty(report, task);
  return report;
}

PressureReport after_walls_moved(const PressureReport& before, const lumen::LumenModel& model,
                                 const analysis::SurfaceOfVessel& surface_of,
                                 const std::vector<MovedWall>& moved, const PressureTreeOptions& options) {
  PressureReport report = before;
  report.pulse.reset();
  report.wall.reset();
  for (const MovedWall& one : moved) {
    if (!report.tree.vessels.contains(one.vessel)) continue;
    for (const std::size_t branch :
         update_pressure_tree(report.tree, model, surface_of, one.vessel, one.from_mm, one.to_mm, options))
      report.network = report.network->with_branch(branch, report.tree.network.branches[branch]);
  }
  solve_report(report, &before, core::no_task());
  return report;
}

}  // namespace ostia::session
