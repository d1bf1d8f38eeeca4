#include "flow/systems.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/solver_case.h"
#include "ostia/solver/flow_files.h"
#include "ostia/solver/flow_result.h"
#include "ostia/solver/openfoam_continue.h"
#include "ostia/solver/openfoam_launch.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

QString flow_text(const char* english) {
  return QCoreApplication::translate("ostia::workstation::FlowCases", english);
}

/// What is refused, with the tree in front.
template <class Call>
auto naming_tree(const std::string& name, const Call& call) {
  if (name.empty()) return call();
  try {
    return call();
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what());
  } catch (const NumericalError& error) {
    throw NumericalError(name + ": " + error.what());
  } catch (const GeometryError& error) {
    throw GeometryError(name + ": " + error.what());
  }
}

/// Runs each as its own script does, with the same number of processes.
void write_script(const fs::path& folder, const std::vector<FlowMesh>& meshes, const std::string& script) {
  std::string text =
      "#!/bin/sh\n# Runs the case of each tree, one after the other.\ncd \"${0%/*}\" || exit 1\n";
  for (const FlowMesh& one : meshes) text += "(cd '" + one.name + "' && ./" + script + " \"$@\") || exit 1\n";
  core::write_file(folder / script, text);
  fs::permissions(folder / script, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

std::vector<std::pair<std::string, fs::path>> cases_in(const fs::path& folder) {
  if (solver::is_openfoam_case(folder)) return {{{}, folder}};
  std::vector<std::pair<std::string, fs::path>> cases;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (solver::is_openfoam_case(at->path())) cases.emplace_back(at->path().filename().string(), at->path());
  std::sort(cases.begin(), cases.end());
  if (cases.empty()) cases.emplace_back(std::string(), folder);  // whose reader says what is wrong
  return cases;
}

FlowRun run_case(const std::string& name, const fs::path& folder, const core::TaskContext& task) {
  const solver::OpenfoamRunPlan plan = solver::openfoam_run_plan(folder);
  const solver::OpenfoamProgress done = solver::run_openfoam_case(folder, task.sub(0.0, 0.9));
  task.set_stage("reading the result");
  const solver::FlowResult result = solver::read_flow_result(folder, {}, task.sub(0.9, 0.95));
  FlowRun run{name,
              folder / "result" / "wall.vtp",
              solver::flow_report(result),
              result.run.converged,
              done.time,
              plan.steady()};
  core::StagedFolder staged(folder / "result");
  solver::write_flow_files(result, run.report, staged.temporary(), task.sub(0.95, 1.0));
  staged.commit();
  return run;
}

}  // namespace

std::vector<std::string> write_cases(const FlowChoice& choice, const solver::BoundaryFlowOptions& flow,
                                     const std::vector<FlowMesh>& meshes, const core::TaskContext& task) {
  const pipeline::SolverCase asked = pipeline::solver_case(choice.solver, flow);
  if (meshes.size() == 1)
    return pipeline::write_solver_case(*meshes.front().mesh, asked, choice.folder, task).warnings;
  std::vector<std::string> warnings;
  core::StagedFolder staged(choice.folder);
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, meshes.size()));
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const FlowMesh& one = meshes[i];
    const double from = share * static_cast<double>(i);
    const auto made = naming_tree(one.name, [&] {
      return pipeline::write_solver_case(*one.mesh, asked, staged.temporary() / one.name,
                                         task.sub(from, from + share));
    });
    for (const std::string& warning : made.warnings) warnings.push_back(one.name + ": " + warning);
  }
  const std::string script(pipeline::traits_of(choice.solver).script);
  if (!script.empty()) write_script(staged.temporary(), meshes, script);
  task.throw_if_cancelled();
  staged.commit();
  return warnings;
}

std::vector<FlowRun> run_cases(const fs::path& folder, const core::TaskContext& task) {
  std::vector<FlowRun> runs;
  const auto cases = cases_in(folder);
  const double share = 1.0 / static_cast<double>(cases.size());
  for (const auto& [name, path] : cases) {
    const double from = share * static_cast<double>(runs.size());
    runs.push_back(naming_tree(
        name, [&, name = name, path = path] { return run_case(name, path, task.sub(from, from + share)); }));
  }
  return runs;
}

std::vector<fs::path> walls_of(const std::vector<FlowRun>& runs) {
  std::vector<fs::path> walls;
  for (const FlowRun& one : runs) walls.push_back(one.wall);
  return walls;
}

QString outcome_of(const QString& name, const std::vector<FlowRun>& runs) {
  QStringList ends;
  bool converged = true;
  for (const FlowRun& one : runs) {
    const QString last = QString::number(one.last);
    ends << (one.name.empty() ? last : QString::fromStdString(one.name) + ' ' + last);
    converged = converged && one.converged;
  }
  const bool steady = runs.empty() || runs.front().steady;
  const QString end = (steady ? flow_text(QT_TRANSLATE_NOOP("ostia::workstation::FlowCases", "%1 iterations"))
                              : flow_text(QT_TRANSLATE_NOOP("ostia::workstation::FlowCases", "%1 s")))
                          .arg(ends.join(", "));
  return (converged ? flow_text(QT_TRANSLATE_NOOP("ostia::workstation::FlowCases", "%1: converged, %2"))
                    : flow_text(QT_TRANSLATE_NOOP("ostia::workstation::FlowCases", "%1: not converged, %2")))
      .arg(name, end);
}

QString reasons_of(const std::vector<FlowRun>& runs) {
  QStringList reasons;
  for (const FlowRun& one : runs)
    for (const std::string& reason : one.report.reasons)
      reasons << QString::fromStdString(one.name.empty() ? reason : one.name + ": " + reason);
  return reasons.join('\n');
}

}  // namespace ostia::workstation
