#include "private_words.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

namespace ostia::command_line {
namespace fs = std::filesystem;
namespace {

// Parts of paths that name nobody, and words that a log needs.
constexpr std::string_view common_parts[] = {
    "bin", "data",  "etc",    "home", "image",   "images", "lib",     "media", "mnt",
    "opt", "out",   "output", "root", "results", "scans",  "srv",     "test",  "tests",
    "tmp", "users", "usr",    "var",  "work",    "true",   "patients"};

bool lower_case(unsigned char c) {
  return c >= 'a' && c <= 'z';
}

/// The words of a text that consist of lower-case letters alone.
void add_words(const std::string& text, std::set<std::string>& words) {
  const auto part_of_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '^'; };
  for (std::size_t from = 0; from < text.size();) {
    std::size_t to = from;
    while (to < text.size() && part_of_word(static_cast<unsigned char>(text[to]))) ++to;
    if (to > from && std::all_of(text.begin() + static_cast<std::ptrdiff_t>(from),
                                 text.begin() + static_cast<std::ptrdiff_t>(to), lower_case))
      words.insert(text.substr(from, to - from));
    from = std::max(to, from + 1);
  }
}

void add_help(const CommandDescription& command, std::set<std::string>& words) {
  add_words(command.text, words);
  for (const OptionDescription& option : command.options) add_words(option.text, words);
  for (const CommandDescription& below : command.commands) add_help(below, words);
}

class Vocabulary {
 public:
  explicit Vocabulary(const CommandDescription& program) : known_(ordinary_words(program)) {
    known_.insert(std::begin(common_parts), std::end(common_parts));
    add(program);
  }
  bool holds(const std::string& word) const { return known_.count(word) != 0; }

 private:
  void add(const CommandDescription& command) {
    known_.insert(command.words.begin(), command.words.end());
    for (const OptionDescription& option : command.options) {
      known_.insert(option.choices.begin(), option.choices.end());
      for (const std::string& name : option.names) {
        known_.insert(name);
        known_.insert(name.substr(std::min(name.find_first_not_of('-'), name.size())));
      }
    }
    for (const CommandDescription& below : command.commands) add(below);
  }
  std::set<std::string> known_;
};

/// A number, a point, points. A DICOM UID is none: it has more parts.
bool is_number(const std::string& word) {
  const auto digits =
      std::count_if(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
  return word.find_first_not_of("0123456789.,:+-eE") == std::string::npos &&
         std::count(word.begin(), word.end(), '.') < 6 && digits < 60;
}

std::string upper(std::string name) {
  name.erase(0, name.find_first_not_of('-'));
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

const OptionDescription* option_named(const CommandDescription& command, const std::string& name) {
  for (const OptionDescription& option : command.options)
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return &option;
  return nullptr;
}

/// Follows the arguments as the parser does, as far as it needs to know which option a word belongs to.
class Collector {
 public:
  explicit Collector(const CommandDescription& program) : words_(program), path_{&program} {}

  std::vector<PrivateWord> collect(const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) take(argument);
    return std::move(found_);
  }

 private:
  void take(const std::string& argument) {
    if (argument.size() > 1 && argument.front() == '-' && !is_number(argument)) return take_option(argument);
    if (alias_.empty() && enters_command(argument)) return;
    add_value(argument, alias_.empty() ? positional() : alias_);
    alias_.clear();
  }

  void take_option(const std::string& argument) {
    const auto sign = argument.find('=');
    const std::string name = argument.substr(0, sign);
    const OptionDescription* option = find(name);
    const std::string alias = option == nullptr ? "VALUE" : upper(option->names.back());
    if (option == nullptr) add_value(name.substr(std::min(name.find_first_not_of('-'), name.size())), alias);
    if (sign != std::string::npos) add_value(argument.substr(sign + 1), alias);
    alias_ = sign == std::string::npos && option != nullptr && !option->value.empty() ? alias : "";
  }

  const OptionDescription* find(const std::string& name) const {
    for (auto command = path_.rbegin(); command != path_.rend(); ++command)
      if (const OptionDescription* option = option_named(**command, name)) return option;
    return nullptr;
  }

  bool enters_command(const std::string& word) {
    for (const CommandDescription& below : path_.back()->commands)
      if (below.words.back() == word) {
        path_.push_back(&below);
        return true;
      }
    return false;
  }

  std::string positional() {
    std::size_t at = 0;
    for (const OptionDescription& option : path_.back()->options)
      if (option.positional() && (option.repeats || at++ == positionals_)) {
        if (!option.repeats) ++positionals_;
        return upper(option.names.front());
      }
    return "VALUE";
  }

  void add_value(const std::string& value, const std::string& alias) {
    add_path(value, alias);
    for (std::size_t from = 0; from < value.size();) {
      const std::size_t to = std::min(value.find_first_of("=,:;", from), value.size());
      if (to - from < value.size()) add_path(value.substr(from, to - from), alias);
      from = to + 1;
    }
  }

  void add_path(const std::string& value, const std::string& alias) {
    add(value, alias);
    const fs::path path(value);
    if (path.has_parent_path()) add(path.parent_path().string(), "FOLDER");
    for (const fs::path& part : path) {
      add(part.string(), alias);
      add(part.stem().string(), alias);
      add(part.stem().stem().string(), alias);  // .nii.gz
    }
  }

  void add(const std::string& text, const std::string& alias) {
    if (text.find_first_not_of("./-") == std::string::npos || words_.holds(text) || is_number(text)) return;
    found_.push_back({text, alias});
  }

  const Vocabulary words_;
  std::vector<const CommandDescription*> path_;
  std::size_t positionals_ = 0;
  std::string alias_;  ///< of the option whose value comes next; empty: none
  std::vector<PrivateWord> found_;
};

bool is_path(const std::string& value, const std::function<bool(const std::string&)>& exists) {
  return value.find('/') != std::string::npos || exists(value);
}

}  // namespace

std::set<std::string> ordinary_words(const CommandDescription& program) {
  std::set<std::string> words;
  add_help(program, words);
  return words;
}

std::vector<PrivateWord> private_paths(const CommandDescription& program,
                                       const std::vector<std::string>& arguments,
                                       const std::function<bool(const std::string&)>& exists) {
  const Vocabulary known(program);
  std::vector<PrivateWord> paths;
  for (const PrivateWord& word : private_words(program, arguments)) {
    if (!is_path(word.text, exists)) continue;
    paths.push_back(word);
    const fs::path path(word.text);
    const std::string own = (path.has_filename() ? path : path.parent_path()).filename().string();
    if (own.size() > 2 && own != word.text && !known.holds(own)) paths.push_back({own, word.alias});
  }
  return paths;
}

std::vector<PrivateWord> private_words(const CommandDescription& program,
                                       const std::vector<std::string>& arguments) {
  return Collector(program).collect(arguments);
}

std::string value_of(std::string_view option, const std::vector<std::string>& arguments) {
  std::string value;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == option && i + 1 < arguments.size()) value = arguments[i + 1];
    if (arguments[i].starts_with(std::string(option) + "=")) value = arguments[i].substr(option.size() + 1);
  }
  return value;
}

}  // namespace ostia::command_line
