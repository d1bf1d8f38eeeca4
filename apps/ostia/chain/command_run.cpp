#include "chain/chain.h"
#include "chain/chain_steps.h"
#include "chain/run.h"
#include "cli.h"
#include "input/input_digest.h"
#include "output/output_aside.h"
#include "output/told.h"

#include "ostia/core/files.h"
#include "ostia/core/kept_folder.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>

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

std::vector<std::string> digests_of_inputs(const Chain& chain) {
  std::vector<std::string> digests;
  for (const fs::path& input : chain.inputs) digests.push_back(digest_of(input));
  return digests;
}

/// Inputs count by content, and what is done with them by its words; how either is called does not matter.
pipeline::JobKey key_of(const Chain& chain, const std::vector<std::string>& digests) {
  pipeline::JobKey key{"run", {}, {}};
  for (std::size_t i = 0; i < digests.size(); ++i) key.inputs["input " + std::to_string(i + 1)] = digests[i];
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
    const auto code = static_cast<ExitCode>(run_within(words, task));
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

/// The steps of a chain one after the other, in a folder where an earlier run may have done some of them.
class ChainRun {
 public:
  ChainRun(const fs::path& target, const CommonOptions& common)
      : target_(target), common_(common), folder_(target) {}
  const fs::path& folder() const { return folder_.result(); }
  ExitCode run(const Chain& chain, const std::vector<std::string>& keys, const core::TaskContext& task);
  void commit(const pipeline::JobKey& key, ExitCode worst);

 private:
  void take_over(const Chain& chain, const std::vector<std::string>& keys);
  void remove_all_but_taken(const Chain& chain);
  DoneStep do_step(const ChainStep& step, const std::string& key, const std::string& name,
                   const core::TaskContext& task);

  const fs::path target_;
  const CommonOptions& common_;
  core::KeptFolder folder_;
  std::vector<std::optional<DoneStep>> taken_;  ///< of earlier runs, by the chain's steps
  std::vector<DoneStep> done_;
  std::vector<std::string> warnings_;
};

/// What the run before this one has left, and what the target has of another chain or other values.
void ChainRun::take_over(const Chain& chain, const std::vector<std::string>& keys) {
  const auto of = [](const std::vector<DoneStep>& steps, const std::string& key, const fs::path& folder) {
    const auto found = std::find_if(steps.begin(), steps.end(), [&](const DoneStep& one) {
      return one.key == key && whole(one, folder);
    });
    return found == steps.end() ? std::nullopt : std::optional(*found);
  };
  const std::vector<DoneStep> left = done_steps(folder_.record());
  const auto manifest = nlohmann::json::parse(pipeline::manifest_of(target_), nullptr, false);
  const std::vector<DoneStep> before =
      done_steps(manifest.is_object() ? manifest.value("quality", nlohmann::json()).dump() : "");
  for (const std::string& key : keys) taken_.push_back(of(left, key, folder()));
  remove_all_but_taken(chain);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (taken_[i]) continue;
    taken_[i] = of(before, keys[i], target_);
    if (!taken_[i]) continue;
    for (const auto& [name, digest] : taken_[i]->outputs) {
      fs::create_directories((folder() / name).parent_path());
      fs::copy_file(target_ / name, folder() / name, fs::copy_options::overwrite_existing);
    }
  }
}

void ChainRun::remove_all_but_taken(const Chain& chain) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < chain.steps.size(); ++i)
    for (const std::string& name : chain.steps[i].makes)
      if (taken_[i]) taken.insert(fs::path(name).begin()->string());
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder()))
    if (taken.count(entry.path().filename().string()) == 0) others.push_back(entry.path());
  for (const fs::path& path : others) fs::remove_all(path);
}

DoneStep ChainRun::do_step(const ChainStep& step, const std::string& key, const std::string& name,
                           const core::TaskContext& task) {
  const auto start = Clock::now();
  DoneStep done{key, step.title, ExitCode::ok, 0.0, 0.0, {}};
  core::log_info(name);
  try {
    done.code = run_step(step, name + ": ", common_, task);
  } catch (...) {
    if (!done_.empty())
      core::log_info("the steps before it are kept in a hidden folder; run again to go on with " + name);
    throw;
  }
  done.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  done.peak_mb = pipeline::peak_memory_mb();
  done.outputs = digests_of_results(folder(), step.makes);
  return done;
}

ExitCode ChainRun::run(const Chain& chain, const std::vector<std::string>& keys,
                       const core::TaskContext& task) {
  take_over(chain, keys);
  ExitCode worst = ExitCode::ok;
  const double share = 1.0 / static_cast<double>(chain.steps.size());
  for (std::size_t i = 0; i < chain.steps.size(); ++i) {
    task.throw_if_cancelled();
    const std::string name = "step " + std::to_string(i + 1) + " (" + chain.steps[i].title + ")";
    if (taken_[i]) core::log_info(name + ": done by an earlier run, kept");
    done_.push_back(
        taken_[i] ? *taken_[i]
                  : do_step(chain.steps[i], keys[i], name,
                            task.sub(share * static_cast<double>(i), share * static_cast<double>(i + 1))));
    folder_.set_record(text_of(done_));
    if (done_.back().code == ExitCode::ok) continue;
    worst = done_.back().code;
    warnings_.push_back(name + ": quality control failed");
  }
  return worst;
}

void ChainRun::commit(const pipeline::JobKey& key, ExitCode worst) {
  pipeline::ManifestRecord record{key, worst, 0.0, warnings_, text_of(done_)};
  for (const DoneStep& step : done_) {
    record.seconds += step.seconds;
    record.peak_mb = std::max(record.peak_mb, step.peak_mb);
  }
  pipeline::write_manifest(folder(), record);
  folder_.commit();
}

}  // namespace

namespace {

/// From the folder's manifest, so that a run that found all done already says the same.
void tell_chain(const fs::path& folder) {
  const auto manifest = nlohmann::ordered_json::parse(pipeline::manifest_of(folder));
  ToldJson steps = ToldJson::array();
  for (const DoneStep& step : done_steps(manifest.value("quality", ToldJson()).dump()))
    steps.push_back(
        {{"command", step.title}, {"exit_code", static_cast<int>(step.code)}, {"seconds", step.seconds}});
  tell("run", {{"exit_code", manifest.value("exit_code", 0)}, {"steps", std::move(steps)}}, "", true);
}

ExitCode done_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task);

}  // namespace

ExitCode run_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task) {
  std::optional<OutputAside> aside(options.json);
  const ExitCode code = done_chain(options, common, task);
  aside.reset();
  if (options.json) tell_chain(options.output);
  return code;
}

namespace {

ExitCode done_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task) {
  pipeline::require_free_folder(options.output);
  const Variables given = variables_of(options.variables);
  const Chain asked = read_chain(options.chain, given, options.output);
  const std::vector<std::string> digests = digests_of_inputs(asked);
  const pipeline::JobKey key = key_of(asked, digests);
  if (const auto code = pipeline::already_done(options.output, key)) {
    core::log_info("done already with the same inputs and variables; nothing to do");
    return *code;
  }
  ChainRun run(options.output, common);
  const Chain chain = read_chain(options.chain, given, run.folder());
  const ExitCode worst = run.run(chain, keys_of(chain, digests), task);
  run.commit(key, worst);
  task.set_progress(1.0);
  return worst;
}

}  // namespace

}  // namespace ostia::app
