#include "chain.h"
#include "cli.h"
#include "input_digest.h"
#include "run.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

/// A step's refusal with the step's name, and the exit code that it has of itself.
class StepError : public Error {
 public:
  StepError(const std::string& message, ExitCode code) : Error(message), code_(code) {}
  ExitCode exit_code() const noexcept override { return code_; }

 private:
  ExitCode code_;
};

Variables variables_of(const std::vector<std::string>& given) {
  Variables out;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set takes name=value, not \"" + one + "\"");
    out[one.substr(0, equals)] = one.substr(equals + 1);
  }
  return out;
}

/// Inputs count by content, and what is done with them by its words; how either is called does not matter.
pipeline::JobKey key_of(const Chain& chain) {
  pipeline::JobKey key{"run", {}, {}};
  for (std::size_t i = 0; i < chain.inputs.size(); ++i)
    key.inputs["input " + std::to_string(i + 1)] = digest_of(chain.inputs[i]);
  nlohmann::json steps = nlohmann::json::array();
  for (const ChainStep& step : chain.steps) steps.push_back(step.meaning);
  key.parameters = nlohmann::json{{"steps", steps}}.dump();
  return key;
}

std::vector<std::string> as_told(const CommonOptions& common) {
  std::vector<std::string> out{"--threads", std::to_string(common.threads), "--log", common.log, "--progress",
                               "none"};
  if (common.quiet) out.emplace_back("--quiet");
  return out;
}

ExitCode run_step(const ChainStep& step, const std::string& where, const CommonOptions& common,
                  const core::TaskContext& task) {
  std::vector<std::string> words = step.words;
  const std::vector<std::string> told = as_told(common);
  words.insert(words.end(), told.begin(), told.end());
  try {
    const auto code = static_cast<ExitCode>(run(words, task));
    if (code != ExitCode::ok && code != ExitCode::quality_failed) throw StepError(where + "refused", code);
    return code;
  } catch (const Cancelled&) {
    throw;
  } catch (const StepError&) {
    throw;
  } catch (const Error& error) {
    throw StepError(where + error.what(), error.exit_code());
  }
}

}  // namespace

ExitCode run_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task) {
  const auto start = Clock::now();
  pipeline::require_free_folder(options.output);
  const Variables given = variables_of(options.variables);
  const pipeline::JobKey key = key_of(read_chain(options.chain, given, options.output));
  if (const auto code = pipeline::already_done(options.output, key)) {
    core::log_info("done already with the same inputs and variables; nothing to do");
    return *code;
  }
  core::StagedFolder folder(options.output);
  const Chain chain = read_chain(options.chain, given, folder.temporary());
  ExitCode worst = ExitCode::ok;
  std::vector<std::string> warnings;
  const double share = 1.0 / static_cast<double>(chain.steps.size());
  for (std::size_t i = 0; i < chain.steps.size(); ++i) {
    task.throw_if_cancelled();
    const std::string name = "step " + std::to_string(i + 1) + " (" + chain.steps[i].title + ")";
    core::log_info(name);
    const ExitCode code =
        run_step(chain.steps[i], name + ": ", common,
                 task.sub(share * static_cast<double>(i), share * static_cast<double>(i + 1)));
    if (code == ExitCode::ok) continue;
    worst = code;
    warnings.push_back(name + ": quality control failed");
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  pipeline::write_manifest(folder.temporary(), {key, worst, seconds, warnings, {}});
  folder.commit();
  task.set_progress(1.0);
  return worst;
}

}  // namespace ostia::app
