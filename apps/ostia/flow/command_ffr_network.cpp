// `ostia ffr CASE.json`: a case of svZeroDSolver computed by our own solver.

#include "flow/ffr.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/hemodynamics/network_export.h"
#include "ostia/hemodynamics/readings.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using NetworkJson = nlohmann::ordered_json;

/// What a tree of vessels is told, a case of a solver has in it.
void refuse_other_options(const FfrCommand& c) {
  const FfrCommand usual;
  if (!c.conditions.empty() || c.systolic_mmhg || c.diastolic_mmhg || c.heart_rate_bpm || c.lv_mass_g ||
      c.rest_flow_ml_min || !c.open.empty() || !c.narrow.empty() || !c.uncertainty.empty() ||
      !c.exports.empty() || c.behind_mm != usual.behind_mm || c.junctions != usual.junctions || c.pulse ||
      c.unusual)
    throw UsageError(
        "a case of svZeroDSolver has its own boundaries: of the options -o and --json are for it");
}

std::string result_json(const hemodynamics::SvzerodCase& problem, const hemodynamics::Solution& solution) {
  NetworkJson vessels = NetworkJson::array();
  for (std::size_t b = 0; b < problem.network.branches.size(); ++b)
    vessels.push_back({{"name", problem.network.branches[b].name},
                       {"flow", solution.flow_ml_s[b]},
                       {"pressure_in", solution.from_pa[b]},
                       {"pressure_out", solution.to_pa[b]}});
  const NetworkJson root{{"v", 1},
                         {"kind", "network-flow"},
                         {"research_use", hemodynamics::research_use},
                         {"units", "the file's own"},
                         {"inlet_pressure", solution.inlet_pa},
                         {"iterations", solution.iterations},
                         {"vessels", vessels},
                         {"notes", problem.notes}};
  return root.dump(1, ' ', false, NetworkJson::error_handler_t::replace) + "\n";
}

void write_network_result(const FfrCommand& c, const pipeline::JobKey& job) {
  const auto start = std::chrono::steady_clock::now();
  const hemodynamics::SvzerodCase problem = hemodynamics::read_svzerod(core::read_file(c.input));
  for (const std::string& note : problem.notes) core::log_info(note);
  const hemodynamics::Solution solution =
      hemodynamics::solve(hemodynamics::PreparedNetwork(problem.network, {}), problem.boundary);
  core::StagedFolder staged(c.output);
  core::write_file(staged.temporary() / "network.json", core::redacted(result_json(problem, solution)));
  core::write_file(staged.temporary() / "network.csv",
                   core::redacted(hemodynamics::svzerod_result_csv(problem, solution)));
  pipeline::ManifestRecord record;
  record.key = job;
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
}

}  // namespace

ExitCode run_ffr_network(const FfrCommand& c, const core::TaskContext& task) {
  refuse_other_options(c);
  const pipeline::JobKey job{"ffr", {{"input", core::sha256_file(c.input)}}, R"({"network":true})"};
  if (pipeline::already_done(c.output, job))
    core::log_info("done already with the same input and parameters; nothing to do");
  else
    write_network_result(c, job);
  const std::string result = core::read_file(c.output / "network.json");
  if (c.json) {
    std::fputs(result.c_str(), stdout);
  } else {
    const nlohmann::json told = nlohmann::json::parse(result);
    for (const auto& vessel : told["vessels"])
      std::printf("%s: flow %s, pressure %s to %s\n", vessel["name"].get<std::string>().c_str(),
                  core::significant_text(vessel["flow"].get<double>(), 6).c_str(),
                  core::significant_text(vessel["pressure_in"].get<double>(), 6).c_str(),
                  core::significant_text(vessel["pressure_out"].get<double>(), 6).c_str());
  }
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
