#include "chain/chain.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/session/plugin.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

class Reader {
 public:
  Reader(fs::path file, Variables variables, fs::path folder)
      : file_(std::move(file)), folder_(std::move(folder)), variables_(std::move(variables)) {}
  Chain read();

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void check_members(const json& object, const std::set<std::string>& known) const;
  void take_variables(const json& own);
  void take_step(const json& step);
  std::string text_of(const json& value, const std::string& member);
  std::string filled(const std::string& text);
  std::vector<std::string> texts(const json& step, const std::string& member);
  /// A file's name as it is in the command's words, and what it means.
  struct Name {
    std::string path, meaning;
  };
  std::string variable_of(const std::string& name) const;
  std::string as_written(const std::string& name) const;
  std::string way_out(const std::string& name) const;
  Name input(const std::string& name, ChainStep& step);
  Name output(const std::string& name, ChainStep& step);
  std::optional<std::size_t> maker_of(const std::string& name) const;
  void read_plugin(ChainStep& step);
  std::size_t read(const fs::path& path, ChainStep& step);
  void options(const json& step, const std::string& member, ChainStep& made);

  fs::path file_, folder_;
  std::string where_;  ///< "step 2 (segment): "
  Variables variables_;
  std::set<std::string> used_;
  std::map<std::string, std::size_t> made_;  ///< result -> the step that makes it
  Chain chain_;
};

void Reader::refuse(const std::string& what) const {
  throw InvalidInput("cannot run " + file_.filename().string() + ": " + where_ + what);
}

void Reader::check_members(const json& object, const std::set<std::string>& known) const {
  for (const auto& [name, value] : object.items()) {
    if (known.count(name) != 0) continue;
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    refuse("unknown member \"" + name + "\"; there are " + all);
  }
}

/// {name} by the variable's value; {{ and }} are braces.
std::string Reader::filled(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool doubled = i + 1 < text.size() && text[i + 1] == text[i];
    if ((text[i] == '{' || text[i] == '}') && doubled) {
      out += text[i++];
      continue;
    }
    if (text[i] != '{') {
      out += text[i];
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (end == std::string::npos) refuse("\"" + text + "\" has a { without its }");
    const std::string name = text.substr(i + 1, end - i - 1);
    const auto variable = variables_.find(name);
    if (variable == variables_.end())
      refuse("the variable {" + name + "} has no value; give --set " + name + "=VALUE");
    used_.insert(name);
    out += variable->second;
    i = end;
  }
  return out;
}

std::string Reader::text_of(const json& value, const std::string& member) {
  if (value.is_string()) return filled(value.get<std::string>());
  if (value.is_number()) return value.dump();
  refuse("\"" + member + "\" must be a text, a number, true, false or an array of them");
}

std::vector<std::string> Reader::texts(const json& step, const std::string& member) {
  std::vector<std::string> out;
  if (!step.contains(member)) return out;
  const json& value = step[member];
  for (const json& one : value.is_array() ? value : json::array({value})) out.push_back(text_of(one, member));
  return out;
}

/// The earlier step that makes the file, or the folder that it lies in.
std::optional<std::size_t> Reader::maker_of(const std::string& name) const {
  for (fs::path part = fs::path(name).lexically_normal(); !part.empty(); part = part.parent_path()) {
    const auto made = made_.find(part.string());
    if (made != made_.end()) return made->second;
    if (part == part.parent_path()) break;
  }
  return std::nullopt;
}

/// The variable that most of a name was given by: messages do not repeat its value, which may be a path.
std::string Reader::variable_of(const std::string& name) const {
  std::string found;
  std::size_t longest = 0;
  for (const auto& [variable, value] : variables_) {
    if (value.size() <= longest || name.find(value) == std::string::npos) continue;
    longest = value.size();
    found = variable;
  }
  return found;
}

std::string Reader::as_written(const std::string& name) const {
  const std::string variable = variable_of(name);
  return variable.empty() ? "\"" + name + "\"" : "{" + variable + "}";
}

std::string Reader::way_out(const std::string& name) const {
  const std::string variable = variable_of(name), from = "the folder of " + file_.filename().string();
  if (variable.empty())
    return "\"input\" and \"inputs\" name files, as seen from " + from + ", or outputs of steps before";
  return "give --set " + variable + "=FILE with a file that is there, as seen from " + from;
}

Reader::Name Reader::input(const std::string& name, ChainStep& step) {
  if (const std::optional<std::size_t> maker = maker_of(name)) {
    step.uses.push_back(*maker);
    return {(folder_ / name).string(), name};
  }
  const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : file_.parent_path() / name;
  if (!fs::exists(path))
    refuse("its input " + as_written(name) + " is no file, and no earlier step makes it; " + way_out(name));
  return {path.string(), "input " + std::to_string(read(path, step) + 1)};
}

/// The index among what is read from outside.
std::size_t Reader::read(const fs::path& path, ChainStep& step) {
  auto known = std::find(chain_.inputs.begin(), chain_.inputs.end(), path);
  if (known == chain_.inputs.end()) known = chain_.inputs.insert(known, path);
  step.reads.push_back(static_cast<std::size_t>(known - chain_.inputs.begin()));
  return step.reads.back();
}

/// A plug-in's script decides what its step makes, as an input does.
void Reader::read_plugin(ChainStep& step) {
  if (step.words.size() != 3 || step.words[1] != "run") refuse("a plug-in's step is \"plugin run NAME\"");
  try {
    read(session::plugin_named(session::list_plugins(session::plugin_folders()), step.words[2]).script, step);
  } catch (const InvalidInput& error) {
    refuse(error.what());
  }
}

Reader::Name Reader::output(const std::string& name, ChainStep& step) {
  fs::path path = fs::path(name).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "mesh/"
  if (path.empty() || path == "." || path.is_absolute() || *path.begin() == "..")
    refuse("its output \"" + name + "\" must be a name within the folder of results");
  if (!made_.emplace(path.string(), chain_.steps.size()).second)
    refuse("its output " + name + " is made by an earlier step");
  step.makes.push_back(path.string());
  return {(folder_ / name).string(), name};
}

void Reader::options(const json& step, const std::string& member, ChainStep& made) {
  if (!step.contains(member)) return;
  if (!step[member].is_object()) refuse("\"" + member + "\" must be an object");
  for (const auto& [name, value] : step[member].items()) {
    const std::string option = "--" + name;
    if (value.is_boolean()) {
      if (value.get<bool>()) made.add(option, option);
      continue;
    }
    for (const json& one : value.is_array() ? value : json::array({value})) {
      const std::string text = text_of(one, member + "/" + name);
      const Name file = member == "options"  ? Name{text, text}
                        : member == "inputs" ? input(text, made)
                                             : output(text, made);
      made.add(option + "=" + file.path, option + "=" + file.meaning);
    }
  }
}

void Reader::take_step(const json& step) {
  where_ = "step " + std::to_string(chain_.steps.size() + 1) + ": ";
  if (!step.is_object() || !step.contains("command") || !step["command"].is_string())
    refuse("it must be an object with a \"command\"");
  ChainStep made;
  made.title = step["command"].get<std::string>();
  where_ = "step " + std::to_string(chain_.steps.size() + 1) + " (" + made.title + "): ";
  check_members(step, {"command", "input", "inputs", "options", "output", "outputs"});
  std::istringstream words(made.title);
  for (std::string word; words >> word;) made.add(word, word);
  if (made.words.empty()) refuse("its \"command\" is empty");
  if (made.words[0] == "run" || made.words[0] == "batch") refuse("a chain cannot start another one");
  if (made.words[0] == "plugin") read_plugin(made);
  for (const std::string& name : texts(step, "input")) {
    const Name file = input(name, made);
    made.add(file.path, file.meaning);
  }
  options(step, "options", made);
  options(step, "inputs", made);
  const std::vector<std::string> outputs = texts(step, "output");
  if (outputs.size() > 1) refuse("\"output\" must be one name");
  if (!outputs.empty()) {
    // `convert` alone has its result's name without an option.
    if (made.words[0] != "convert") made.add("-o", "-o");
    const Name file = output(outputs[0], made);
    made.add(file.path, file.meaning);
  }
  options(step, "outputs", made);
  chain_.steps.push_back(std::move(made));
}

void Reader::take_variables(const json& own) {
  if (!own.is_object()) refuse("\"variables\" must be an object");
  for (const auto& [name, value] : own.items()) {
    if (!value.is_string() && !value.is_number())
      refuse("the variable " + name + " must be text or a number");
    variables_.try_emplace(name, value.is_string() ? value.get<std::string>() : value.dump());
    used_.insert(name);  // a default need not be used
  }
}

Chain Reader::read() {
  const json file = json::parse(core::read_file(file_, 16 << 20), nullptr, false);
  if (file.is_discarded() || !file.is_object()) refuse("it holds no JSON object");
  check_members(file, {"v", "title", "variables", "steps"});
  if (file.value("v", json(1)) != 1) refuse("its \"v\" must be 1");
  if (!file.contains("steps") || !file["steps"].is_array() || file["steps"].empty())
    refuse("it has no \"steps\"");
  if (file.contains("variables")) take_variables(file["variables"]);
  for (const json& step : file["steps"]) take_step(step);
  where_.clear();
  for (const auto& [name, value] : variables_)
    if (used_.count(name) == 0) refuse("it has no variable {" + name + "} that a value could be given to");
  return std::move(chain_);
}

}  // namespace

Chain read_chain(const fs::path& file, const Variables& given, const fs::path& folder) {
  return Reader(fs::absolute(file), given, folder).read();
}

}  // namespace ostia::app
