#include "ostia/session/pressure_report.h"

#include "ostia/core/error.h"

namespace ostia::session {

PressureReport make_pressure_report(PressureTree tree, const PressureReportOptions& options,
                                    const core::TaskContext& task) {
  using hemodynamics::State;
  hemodynamics::validate(options.conditions, options.unusual);
  hemodynamics::validate(options.reading);
  PressureReport report;
  report.options = options;
  report.tree = std::move(tree);
  report.warnings = report.tree.warnings;
  if (options.unusual)
    for (const std::string& one : hemodynamics::unusual_inputs(options.conditions))
      report.warnings.push_back(one);
  task.set_stage("pressures");
  report.resting = hemodynamics::resting_flow(report.tree.network, options.conditions);
  for (const std::string& note : report.resting.notes) report.warnings.push_back(note);
  hemodynamics::FlowModel model = hemodynamics::flow_model_of(options.conditions, options.model);
  model.from_rest = true;  // a patient's tree begins at the aorta
  report.network.emplace(report.tree.network, model);
  const auto& network = *report.network;
  report.hyperaemia =
      hemodynamics::flow_state(network, options.conditions, report.resting, State::hyperaemia);
  task.throw_if_cancelled();
  report.rest = hemodynamics::flow_state(network, options.conditions, report.resting, State::rest);
  report.under_hyperaemia =
      hemodynamics::read_tree(network, report.hyperaemia, report.tree.lesions, options.reading);
  report.at_rest = hemodynamics::read_tree(network, report.rest, report.tree.lesions, options.reading);
  for (const auto& mark : report.under_hyperaemia.marks) report.warnings.push_back(mark.text);
  task.set_progress(0.5);
  if (options.pulse) {
    std::vector<hemodynamics::TreePlace> places;
    for (const auto& lesion : report.under_hyperaemia.lesions) places.push_back(lesion.read_at);
    report.pulse =
        hemodynamics::pulse(network, options.conditions, report.rest, places, options.pulse_options);
  }
  task.set_progress(1.0);
  return report;
}

}  // namespace ostia::session
