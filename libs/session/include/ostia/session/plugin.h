#pragma once
/// \file Plug-ins: functions in scripts of Python that a person adds (docs/reference/plugins.md). What there
/// are is read from the scripts' text; nothing of them is run for it.

#include "ostia/core/task_context.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ostia::session {

/// What becomes of a plug-in's result.
enum class PluginGives {
  edits,    ///< a step of the case
  overlay,  ///< surfaces to be looked at, with fields or without
  field,    ///< values on the case's wall
  mask,     ///< labels of voxels, of which a tree is made
};
std::string_view word(PluginGives gives);  ///< "edits", "overlay", "field", "mask"

enum class PluginType { flag, whole, number, text, choice, vessel };
/// A vessel is a text: its name or id; empty: the first one.
using PluginValue = std::variant<bool, std::int64_t, double, std::string>;

struct PluginParameter {
  std::string name;
  PluginType type = PluginType::number;
  PluginValue value;                 ///< when none is given
  std::vector<std::string> choices;  ///< of PluginType::choice
};

struct Plugin {
  std::string name;   ///< of its function: "widen_wall"
  std::string title;  ///< "Widen the wall"
  std::string version;
  std::string text;  ///< what it does, from the function's own words; may be empty
  PluginGives gives = PluginGives::edits;
  bool needs_case = true, needs_image = false;
  std::vector<PluginParameter> parameters;
  std::filesystem::path script;
  std::string digest;  ///< SHA-256 of the script
};

struct PluginList {
  std::vector<Plugin> plugins;       ///< by folder, script and place in it
  std::vector<std::string> refused;  ///< scripts that are none, and names that are there twice: a line each
};

/// Those of $OSTIA_PLUGINS (between colons), the user's ($XDG_CONFIG_HOME/ostia/plugins), and
/// share/ostia/plugins of the tree that the program belongs to, in this order. They need not be there.
std::vector<std::filesystem::path> plugin_folders();

/// The scripts (`*.py`) of the folders; of two plug-ins of one name the first counts. No script, no process.
/// Throws IoError where there are scripts and no Python or no package of Ostia's for it, with the way to get
/// them.
PluginList list_plugins(const std::vector<std::filesystem::path>& folders,
                        const core::TaskContext& task = core::no_task());

/// Throws InvalidInput for a name that is not there, with those that are.
const Plugin& plugin_named(const PluginList& list, const std::string& name);

/// Throws InvalidInput for a name that is no parameter, with those that are.
const PluginParameter& parameter_named(const Plugin& plugin, const std::string& name);

/// The value that a person typed. Throws InvalidInput naming the parameter and what it takes.
PluginValue plugin_value(const PluginParameter& parameter, const std::string& typed);
std::string plugin_value_text(const PluginValue& value);

}  // namespace ostia::session
