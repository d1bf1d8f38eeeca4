#include "chain/chain_steps.h"

#include "ostia/core/files.h"
#include "ostia/core/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::app {
namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> keys_of(const Chain& chain, const std::vector<std::string>& digests) {
  std::vector<std::string> keys;
  for (const ChainStep& step : chain.steps) {
    json key{{"version", core::version()},
             {"words", step.meaning},
             {"reads", json::array()},
             {"uses", json::array()}};
    for (const std::size_t input : step.reads) key["reads"].push_back(digests[input]);
    for (const std::size_t earlier : step.uses) key["uses"].push_back(keys[earlier]);
    keys.push_back(core::sha256(key.dump()));
  }
  return keys;
}

std::string text_of(const std::vector<DoneStep>& steps) {
  json all = json::array();
  for (const DoneStep& step : steps)
    all.push_back({{"key", step.key},
                   {"title", step.title},
                   {"exit_code", static_cast<int>(step.code)},
                   {"seconds", step.seconds},
                   {"peak_mb", step.peak_mb},
                   {"outputs", step.outputs}});
  return json{{"v", 1}, {"kind", "run"}, {"steps", all}}.dump(2) + "\n";
}

std::vector<DoneStep> done_steps(const std::string& text) {
  std::vector<DoneStep> steps;
  try {
    const json all = json::parse(text);
    if (all.at("kind") != "run") return {};
    for (const json& one : all.at("steps")) {
      DoneStep step;
      one.at("key").get_to(step.key);
      one.at("title").get_to(step.title);
      step.code = static_cast<ExitCode>(one.at("exit_code").get<int>());
      one.at("seconds").get_to(step.seconds);
      one.at("peak_mb").get_to(step.peak_mb);
      one.at("outputs").get_to(step.outputs);
      steps.push_back(std::move(step));
    }
  } catch (const json::exception&) {
    return {};
  }
  return steps;
}

std::map<std::string, std::string> digests_of_results(const fs::path& folder,
                                                      const std::vector<std::string>& results) {
  std::map<std::string, std::string> digests;
  const auto add = [&](const fs::path& file) {
    digests[fs::relative(file, folder).generic_string()] = core::sha256_file(file);
  };
  for (const std::string& name : results) {
    if (fs::is_regular_file(folder / name)) add(folder / name);
    if (!fs::is_directory(folder / name)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder / name))
      if (entry.is_regular_file()) add(entry.path());
  }
  return digests;
}

bool whole(const DoneStep& step, const fs::path& folder) {
  return !step.outputs.empty() &&
         std::all_of(step.outputs.begin(), step.outputs.end(), [&](const auto& file) {
           return fs::is_regular_file(folder / file.first) &&
                  core::sha256_file(folder / file.first) == file.second;
         });
}

}  // namespace ostia::app
