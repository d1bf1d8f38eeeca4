#include "ostia/session/plugin.h"

#include "plugins/plugin_python.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using PluginJson = nlohmann::json;

constexpr std::chrono::seconds listing_limit{60};

constexpr std::array<std::pair<PluginGives, std::string_view>, 4> gives_words{
    {{PluginGives::edits, "edits"},
     {PluginGives::overlay, "overlay"},
     {PluginGives::field, "field"},
     {PluginGives::mask, "mask"}}};
constexpr std::array<std::pair<PluginType, std::string_view>, 6> type_words{{{PluginType::flag, "flag"},
                                                                             {PluginType::whole, "whole"},
                                                                             {PluginType::number, "number"},
                                                                             {PluginType::text, "text"},
                                                                             {PluginType::choice, "choice"},
                                                                             {PluginType::vessel, "vessel"}}};

template <class Words>
auto of_word(const Words& words, const std::string& word) {
  const auto found =
      std::find_if(words.begin(), words.end(), [&](const auto& one) { return one.second == word; });
  if (found == words.end()) throw InvalidInput("the list of plug-ins has the unknown word " + word);
  return found->first;
}

PluginValue plugin_value_of(const PluginJson& json, PluginType type) {
  switch (type) {
    case PluginType::flag:
      return json.get<bool>();
    case PluginType::whole:
      return json.get<std::int64_t>();
    case PluginType::number:
      return json.get<double>();
    default:
      return json.get<std::string>();
  }
}

Plugin plugin_of(const PluginJson& json) {
  Plugin plugin;
  json.at("name").get_to(plugin.name);
  json.at("title").get_to(plugin.title);
  json.at("version").get_to(plugin.version);
  json.at("text").get_to(plugin.text);
  plugin.gives = of_word(gives_words, json.at("gives").get<std::string>());
  plugin.needs_case = plugin.gives != PluginGives::mask;
  plugin.needs_image = json.at("image").get<bool>();
  plugin.script = json.at("script").get<std::string>();
  json.at("digest").get_to(plugin.digest);
  for (const PluginJson& one : json.at("parameters")) {
    PluginParameter parameter;
    one.at("name").get_to(parameter.name);
    parameter.type = of_word(type_words, one.at("type").get<std::string>());
    parameter.value = plugin_value_of(one.at("value"), parameter.type);
    one.at("choices").get_to(parameter.choices);
    plugin.parameters.push_back(std::move(parameter));
  }
  return plugin;
}

std::vector<fs::path> scripts_in(const fs::path& folder) {
  std::vector<fs::path> scripts;
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored), end; at != end; at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    // Neighbours that plug-ins share begin with an underscore.
    if (at->path().extension() == ".py" && name[0] != '_' && name[0] != '.' && at->is_regular_file(ignored))
      scripts.push_back(fs::absolute(at->path(), ignored));
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

std::string what_it_takes(const PluginParameter& parameter) {
  switch (parameter.type) {
    case PluginType::flag:
      return "true or false";
    case PluginType::whole:
      return "a whole number";
    case PluginType::number:
      return "a number";
    case PluginType::choice: {
      std::string all;
      for (const std::string& one : parameter.choices) all += (all.empty() ? "" : ", ") + one;
      return "one of " + all;
    }
    case PluginType::text:
    case PluginType::vessel:
      break;
  }
  return "a text";
}

template <class Number>
bool read_whole(const std::string& typed, Number& out) {
  const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), out);
  return error == std::errc() && end == typed.data() + typed.size();
}

}  // namespace

std::string_view word(PluginGives gives) {
  return std::find_if(gives_words.begin(), gives_words.end(),
                      [&](const auto& one) { return one.first == gives; })
      ->second;
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  const char* given = std::getenv("OSTIA_PLUGINS");
  std::istringstream more(given ? given : "");
  for (std::string folder; std::getline(more, folder, ':');)
    if (!folder.empty()) folders.emplace_back(folder);
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (config && *config)
    folders.push_back(fs::path(config) / "ostia" / "plugins");
  else if (home && *home)
    folders.push_back(fs::path(home) / ".config" / "ostia" / "plugins");
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  folders.push_back((program.parent_path() / ".." / "share" / "ostia" / "plugins").lexically_normal());
  return folders;
}

PluginList list_plugins(const std::vector<fs::path>& folders, const core::TaskContext& task) {
  std::vector<std::string> scripts;
  for (const fs::path& folder : folders)
    for (const fs::path& script : scripts_in(folder))
      if (std::find(scripts.begin(), scripts.end(), script.string()) == scripts.end())
        scripts.push_back(script.string());
  PluginList list;
  if (scripts.empty()) return list;
  const PluginPython python = plugin_python();
  const core::PrivateFolder folder;
  const fs::path answer = folder.path() / "plugins.json";
  // Isolated, and not as a part of the package: its text alone is needed to read scripts.
  std::vector<std::string> words{"-I", "-B", (python.package / "ostia" / "_plugin_scripts.py").string(),
                                 answer.string()};
  words.insert(words.end(), scripts.begin(), scripts.end());
  const PythonRun run = run_python(python, words, listing_limit, folder.path(), task);
  if (!run.ended.empty())
    throw IoError("the plug-ins cannot be listed: Python " + run.ended + ": " + run.said);
  std::set<std::string> names;
  try {
    const PluginJson all = PluginJson::parse(core::read_file(answer, 64 << 20));
    all.at("refused").get_to(list.refused);
    for (const PluginJson& one : all.at("plugins")) {
      Plugin plugin = plugin_of(one);
      if (names.insert(plugin.name).second)
        list.plugins.push_back(std::move(plugin));
      else
        list.refused.push_back(plugin.script.filename().string() + ": another plug-in before it is called " +
                               plugin.name + "; give the function another name");
    }
  } catch (const PluginJson::exception& error) {
    throw IoError(std::string("the plug-ins cannot be listed: ") + error.what());
  }
  return list;
}

const Plugin& plugin_named(const PluginList& list, const std::string& name) {
  std::string all;
  for (const Plugin& one : list.plugins) {
    if (one.name == name) return one;
    all += (all.empty() ? "" : ", ") + one.name;
  }
  std::string why;
  for (const std::string& one : list.refused) why += "; " + one;
  throw InvalidInput("there is no plug-in " + name + "; " +
                     (all.empty() ? "put its script into ~/.config/ostia/plugins, or name its folder in "
                                    "OSTIA_PLUGINS"
                                  : "there are " + all) +
                     why);
}

const PluginParameter& parameter_named(const Plugin& plugin, const std::string& name) {
  std::string all;
  for (const PluginParameter& one : plugin.parameters) {
    if (one.name == name) return one;
    all += (all.empty() ? "" : ", ") + one.name;
  }
  throw InvalidInput("the plug-in " + plugin.name + " has no parameter " + name +
                     (all.empty() ? "; it has none" : "; it has " + all));
}

PluginValue plugin_value(const PluginParameter& parameter, const std::string& typed) {
  const auto refuse = [&]() -> PluginValue {
    throw InvalidInput("the plug-in's parameter " + parameter.name + " takes " + what_it_takes(parameter) +
                       ", not \"" + typed + "\"");
  };
  switch (parameter.type) {
    case PluginType::flag:
      if (typed == "true" || typed == "false") return typed == "true";
      return refuse();
    case PluginType::whole: {
      std::int64_t value = 0;
      return read_whole(typed, value) ? PluginValue(value) : refuse();
    }
    case PluginType::number: {
      double value = 0.0;
      return read_whole(typed, value) && std::isfinite(value) ? PluginValue(value) : refuse();
    }
    case PluginType::choice:
      if (std::find(parameter.choices.begin(), parameter.choices.end(), typed) == parameter.choices.end())
        return refuse();
      return typed;
    case PluginType::text:
    case PluginType::vessel:
      break;
  }
  return typed;
}

std::string plugin_value_text(const PluginValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return PluginJson(*number).dump();
  return std::get<std::string>(value);
}

}  // namespace ostia::session
