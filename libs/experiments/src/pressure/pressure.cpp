// The pressure experiment: what is to be run, is kept, and is compared.

#include "ostia/experiments/pressure.h"

#include "pressure/pressure_compare.h"
#include "pressure/pressure_keep.h"
#include "pressure/pressure_patients.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/hemodynamics/conditions.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace ostia::experiments {
namespace {

/// A case with what its wall is made of.
struct Walled {
  PressureCase planned;
  std::string wall;
  std::optional<lumen::LumenModel> found;  ///< a patient's; others are made when they are needed
  lumen::LumenModel model() const { return found ? *found : pressure_model(planned); }
};

std::string on_edges(const std::string& id, double edge_ratio) {
  std::string name = id + "-edges-" + std::to_string(std::lround(1000.0 * edge_ratio));
  return name;
}

std::vector<Walled> walled_plan(const PressureOptions& options, const core::TaskContext& task) {
  std::vector<Walled> all;
  for (const PressureCase& one : plan_pressure(options.plan)) all.push_back({one, text_of(one), {}});
  if (options.masks.empty()) return all;
  for (const std::string& name : options.patients) {
    PressurePatient patient = pressure_patient(options.masks, name, task);
    all.push_back({patient.planned, text_of(patient.planned) + text_of(patient.model), patient.model});
  }
  return all;
}

/// A concentric, an eccentric and a fork's, those of the lowest seeds that are narrow.
std::vector<std::size_t> convergence_cases(const std::vector<Walled>& plan) {
  std::vector<std::size_t> chosen;
  for (const PressureKind kind : {PressureKind::concentric, PressureKind::eccentric, PressureKind::fork}) {
    std::optional<std::size_t> lowest;
    for (std::size_t i = 0; i < plan.size(); ++i)
      if (plan[i].planned.kind == kind && plan[i].planned.stenoses.front().severity >= 0.5 &&
          (!lowest || plan[i].planned.seed < plan[*lowest].planned.seed))
        lowest = i;
    if (lowest) chosen.push_back(*lowest);
  }
  return chosen;
}

/// A computation: of a case, on a mesh.
struct Wanted {
  std::size_t of = 0;
  std::string id, digest;
  PressureMesh mesh;
};

std::vector<Wanted> wanted_runs(const std::vector<Walled>& plan, const PressureOptions& options) {
  std::vector<Wanted> all;
  const auto add = [&](std::size_t i, const std::string& id, const PressureMesh& mesh) {
    all.push_back({i, id, digest_of(plan[i].wall, plan[i].planned.flow_ml_s, mesh), mesh});
  };
  for (std::size_t i = 0; i < plan.size(); ++i) add(i, plan[i].planned.id, options.mesh);
  for (const std::size_t i : convergence_cases(plan))
    for (const double ratio : options.other_edge_ratios) {
      PressureMesh mesh = options.mesh;
      mesh.edge_ratio = ratio;
      add(i, on_edges(plan[i].planned.id, ratio), mesh);
    }
  return all;
}

bool asked_for(const PressureOptions& options, const PressureCase& one, const std::string& id) {
  if (options.only.empty()) return true;
  return std::any_of(options.only.begin(), options.only.end(), [&](const std::string& word) {
    return word == id || word == one.id || word == name_of(half_of(one)) || word == name_of(one.kind);
  });
}

void require_known(const std::vector<Walled>& plan, const std::vector<Wanted>& all,
                   const PressureOptions& options) {
  for (const std::string& word : options.only) {
    const bool known = std::any_of(all.begin(), all.end(), [&](const Wanted& one) {
      const PressureCase& planned = plan[one.of].planned;
      return word == one.id || word == name_of(half_of(planned)) || word == name_of(planned.kind);
    });
    if (!known)
      throw InvalidInput("experiment pressure: the plan has no case, kind or half \"" + word +
                         "\"; its cases are listed in plan.json of the folder that keeps runs");
  }
}

/// What a message says, without where it was.
std::string without_path(std::string message, const std::filesystem::path& folder, const std::string& id) {
  for (const std::string& path : {std::filesystem::absolute(folder).string(), folder.string()})
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path))
      message.replace(at, path.size(), id);
  return message;
}

/// One run into the folder that keeps it. What lies in the case is told there; what lies in the machine, or
/// in somebody who stops it, ends the experiment and leaves nothing of the run.
void run_one(const Walled& one, const Wanted& wanted, const PressureRunner& runner, const PressureKeep& keep,
             const core::TaskContext& task) {
  PressureRun run;
  const std::filesystem::path folder = keep.folder_of(wanted.id);
  try {
    try {
      run = runner({wanted.id, one.wall, one.model(), one.planned.flow_ml_s, wanted.mesh}, folder, task);
    } catch (const GeometryError& error) {
      run.failure = error.what();
    } catch (const NumericalError& error) {
      run.failure = error.what();
    } catch (const InvalidInput& error) {
      run.failure = error.what();
    }
    if (!run.failure.empty()) task.throw_if_cancelled();
  } catch (...) {
    keep.drop(wanted.id);
    throw;
  }
  run.failure = without_path(run.failure, folder, wanted.id);
  run.digest = wanted.digest;
  keep.put(wanted.id, run);
  core::log_info(wanted.id + ": " +
                 (!run.failure.empty()
                      ? run.failure
                      : std::to_string(run.cells) + " cells, " + std::to_string(std::lround(run.iterations)) +
                            " iterations, " + std::to_string(std::lround(run.seconds)) + " s" +
                            (run.converged ? "" : ", not converged")));
}

void run_all(const std::vector<Walled>& plan, const std::vector<Wanted>& runs, const PressureRunner& runner,
             const PressureKeep& keep, int jobs, const core::TaskContext& task) {
  std::atomic<std::size_t> next = 0, done = 0;
  std::mutex mutex;
  std::exception_ptr fault;
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size(); i = next++) {
      try {
        task.throw_if_cancelled();
        task.set_stage(runs[i].id);
        const double from = static_cast<double>(done) / static_cast<double>(runs.size());
        run_one(plan[runs[i].of], runs[i], runner, keep,
                task.sub(from, std::min(1.0, from + 1.0 / static_cast<double>(runs.size()))));
        ++done;
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!fault) fault = std::current_exception();
        next = runs.size();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < jobs && i < static_cast<int>(runs.size()); ++i) others.emplace_back(work);
    work();
  }
  if (!fault) return;
  task.throw_if_cancelled();  // whatever else went wrong with it
  std::rethrow_exception(fault);
}

/// Pressure from the root to the first place of reading.
double drop_mmhg(const PressureProblem& problem) {
  return (1.0 - readings_of(problem, compared_model()).front().ffr_3d) *
         hemodynamics::Conditions().mean_aortic_mmhg();
}

std::optional<ConvergenceRow> convergence_of(const PressureProblem& middle, const std::vector<Wanted>& all,
                                             std::size_t of, const PressureKeep& keep) {
  std::vector<std::pair<double, PressureProblem>> meshes;
  for (const Wanted& one : all) {
    if (one.of != of) continue;
    const auto run = keep.find(one.id, one.digest);
    if (!run || !run->failure.empty() || !run->converged) return std::nullopt;
    meshes.emplace_back(one.mesh.edge_ratio, middle);
    meshes.back().second.run = *run;
  }
  if (meshes.size() < 2) return std::nullopt;
  std::sort(meshes.begin(), meshes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ConvergenceRow row;
  row.id = middle.planned.id;
  for (const auto& [ratio, problem] : meshes) {
    row.edge_ratios.push_back(ratio);
    row.cells.push_back(problem.run.cells);
    row.drops_mmhg.push_back(drop_mmhg(problem));
  }
  extrapolate(row);
  return row;
}

PressureResults compared(const std::vector<Walled>& plan, const std::vector<Wanted>& all,
                         const PressureKeep& keep, const core::TaskContext& task) {
  PressureResults results;
  results.planned = plan.size();
  results.aortic_mmhg = hemodynamics::Conditions().mean_aortic_mmhg();
  const std::vector<std::size_t> shown = convergence_cases(plan);
  std::vector<PressureProblem> problems;
  std::vector<std::size_t> row_of_problem;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / static_cast<double>(plan.size()));
    const auto run = keep.find(all[i].id, all[i].digest);
    if (!run) continue;
    PressureRow row;
    row.planned = plan[i].planned;
    row.run = *run;
    row.failure = run->failure;
    if (row.failure.empty()) {
      try {
        const PressureProblem problem =
            problem_of(plan[i].planned, measured_network(plan[i].model(), task), *run);
        row = row_of(problem);
        if (std::find(shown.begin(), shown.end(), i) != shown.end())
          if (auto meshes = convergence_of(problem, all, i, keep)) results.convergence.push_back(*meshes);
        row_of_problem.push_back(results.rows.size());
        problems.push_back(problem);
      } catch (const InvalidInput& error) {
        row.failure = error.what();
      } catch (const GeometryError& error) {
        row.failure = error.what();
      } catch (const NumericalError& error) {
        row.failure = error.what();
      }
    }
    results.rows.push_back(std::move(row));
  }
  results.fit = fit_pressure(problems);
  hemodynamics::FlowModel model = compared_model();
  if (results.fit) {
    model.development = results.fit->development;
    model.layer_friction = results.fit->layer_friction;
  }
  for (std::size_t k = 0; k < problems.size(); ++k) {
    const std::vector<PressureReading> fitted = readings_of(problems[k], model);
    std::vector<PressureReading>& own = results.rows[row_of_problem[k]].readings;
    for (std::size_t j = 0; j < own.size(); ++j) own[j].fitted = fitted[j].ffr_1d;
  }
  return results;
}

}  // namespace

void validate(const PressureOptions& options) {
  validate(options.plan);
  validate(options.mesh);
  for (const double ratio : options.other_edge_ratios) {
    PressureMesh other = options.mesh;
    other.edge_ratio = ratio;
    validate(other);
  }
  if (options.keep.empty()) throw InvalidInput("experiment pressure: name a folder that keeps its runs");
  if (options.jobs < 1 || options.jobs > 256)
    throw InvalidInput("experiment pressure: 1 to 256 runs at once");
  if (options.most < 0) throw InvalidInput("experiment pressure: no fewer than 0 runs");
}

PressureResults run_pressure(const PressureOptions& options, const PressureRunner& runner,
                             const core::TaskContext& task) {
  validate(options);
  const PressureKeep keep(options);
  task.set_stage("walls");
  const std::vector<Walled> plan = walled_plan(options, task.sub(0.0, 0.02));
  const std::vector<Wanted> all = wanted_runs(plan, options);
  require_known(plan, all, options);
  std::vector<Wanted> missing;
  for (const Wanted& one : all) {
    if (options.judge || !asked_for(options, plan[one.of].planned, one.id)) continue;
    if (options.most > 0 && static_cast<int>(missing.size()) == options.most) break;
    const auto kept = keep.find(one.id, one.digest);
    if (!kept || (options.again && !kept->failure.empty())) missing.push_back(one);
  }
  run_all(plan, missing, runner, keep, options.jobs, task.sub(0.02, 0.95));
  task.set_stage("comparing");
  return compared(plan, all, keep, task.sub(0.95, 1.0));
}

}  // namespace ostia::experiments
