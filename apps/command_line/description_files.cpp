#include "description_files.h"

#include "completion.h"
#include "man_page.h"

#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

namespace ostia::command_line {
namespace {

void write(const std::filesystem::path& path, const std::string& content) {
  std::filesystem::create_directories(path.parent_path());
  core::write_file(path, content);
}

void write_man_pages(const CommandDescription& command, const CommandDescription& program,
                     const std::filesystem::path& folder) {
  write(folder / (command.joined("-") + ".1"), man_page(command, program));
  for (const CommandDescription& below : command.commands) write_man_pages(below, program, folder);
}

nlohmann::ordered_json json_of(const CommandDescription& command) {
  nlohmann::ordered_json options = nlohmann::ordered_json::array(),
                         commands = nlohmann::ordered_json::array();
  for (const OptionDescription& option : command.options)
    options.push_back({{"names", option.names},
                       {"value", option.value},
                       {"choices", option.choices},
                       {"limits", option.limits},
                       {"text", option.text},
                       {"required", option.required},
                       {"repeats", option.repeats},
                       {"flag_or_value", option.flag_or_value}});
  for (const CommandDescription& below : command.commands) commands.push_back(json_of(below));
  return {{"words", command.words}, {"text", command.text}, {"options", options}, {"commands", commands}};
}

}  // namespace

std::optional<std::filesystem::path> described_into(const std::vector<std::string>& arguments) {
  if (arguments.size() != 2 || arguments.front() != "--describe") return std::nullopt;
  return arguments.back();
}

void write_description_files(const CommandDescription& program, const std::filesystem::path& folder) {
  const std::string& name = program.words.front();
  write_man_pages(program, program, folder / "man" / "man1");
  write(folder / "bash-completion" / "completions" / name, bash_completion(program));
  nlohmann::ordered_json json = json_of(program);
  json["v"] = 1;
  write(folder / (name + "-commands.json"), json.dump(1) + "\n");
  write(folder / "zsh" / "site-functions" / ("_" + name), zsh_completion(program));
}

}  // namespace ostia::command_line
