#include "chain/plugin.h"
#include "input/case_image.h"
#include "input/edit_script.h"
#include "output/outputs.h"
#include "output/told.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/session/found_model.h"
#include "ostia/session/plugin_job.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <optional>

namespace ostia::app {
namespace {

using session::Plugin;
using session::PluginGives;

bool is_case_file(const std::filesystem::path& path) {
  return path.extension() == ".ostia";
}

/// "by_mm=0.2", "side=left (left, right)".
std::string shown_parameter(const session::PluginParameter& parameter) {
  std::string text = parameter.name + "=" + session::plugin_value_text(parameter.value);
  std::string choices;
  for (const std::string& one : parameter.choices) choices += (choices.empty() ? "" : ", ") + one;
  return choices.empty() ? text : text + " (" + choices + ")";
}

ToldJson plugin_json(const Plugin& plugin) {
  ToldJson parameters = ToldJson::array();
  for (const session::PluginParameter& one : plugin.parameters) {
    ToldJson parameter{{"name", one.name}};
    std::visit([&](const auto& value) { parameter["value"] = value; }, one.value);
    if (!one.choices.empty()) parameter["choices"] = one.choices;
    parameters.push_back(std::move(parameter));
  }
  return {{"name", plugin.name},
          {"title", plugin.title},
          {"version", plugin.version},
          {"gives", std::string(session::word(plugin.gives))},
          {"needs_image", plugin.needs_image},
          {"text", plugin.text},
          {"parameters", std::move(parameters)},
          {"script", plugin.script.filename().string()},
          {"sha256", plugin.digest}};
}

void print_plugin(const Plugin& plugin) {
  std::printf("%s: %s%s\n", plugin.name.c_str(), plugin.title.c_str(),
              plugin.version.empty() ? "" : (" " + plugin.version).c_str());
  std::printf("  gives %s%s\n", std::string(session::word(plugin.gives)).c_str(),
              plugin.needs_image ? ", needs an image" : "");
  if (!plugin.text.empty()) std::printf("  %s\n", plugin.text.c_str());
  for (const session::PluginParameter& one : plugin.parameters)
    std::printf("  --set %s\n", shown_parameter(one).c_str());
}

const session::PluginParameter& told_parameter(const Plugin& plugin, const std::string& name) {
  try {
    return session::parameter_named(plugin, name);
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
}

session::PluginValues typed_values(const Plugin& plugin, const std::vector<std::string>& given) {
  session::PluginValues values;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set takes name=value, not \"" + one + "\"");
    const std::string name = one.substr(0, equals);
    values[name] = session::plugin_value(told_parameter(plugin, name), one.substr(equals + 1));
  }
  return values;
}

const std::vector<std::string_view>& outputs_of(PluginGives gives) {
  static const std::vector<std::string_view> cases{".ostia"};
  static const std::vector<std::string_view> masks{".ostia", ".nrrd", ".mhd", ".mha", ".nii", ".nii.gz"};
  if (gives == PluginGives::edits) return cases;
  return gives == PluginGives::mask ? masks : surface_outputs;
}

/// What the plug-in works on, as it was read.
struct PluginInput {
  std::optional<session::CaseFile> file;
  pipeline::Source image;
};

PluginInput plugin_input(const PluginCommand& o, const Plugin& plugin, const core::TaskContext& task) {
  PluginInput in;
  if (is_case_file(o.input)) {
    in.file.emplace(session::CaseFile::open(o.input, session::OpenMode::read_only));
    if (!o.image.empty()) in.image = case_image(o.image, *in.file, task);
    if (plugin.needs_image && !in.image.image)
      throw UsageError("the plug-in " + plugin.name + " needs an image: give --image");
    return in;
  }
  if (plugin.needs_case) throw UsageError("the plug-in " + plugin.name + " works on a case, .ostia");
  if (!o.image.empty()) throw UsageError("--image is for a case; INPUT is the image");
  in.image = pipeline::load_ct(o.input, {}, task);
  for (const std::string& warning : in.image.warnings) core::log_warning(warning);
  return in;
}

ToldJson write_case_of_mask(const PluginCommand& o, const PluginInput& in,
                            const session::PluginAnswer& answer, const core::TaskContext& task) {
  NewCase made(o.output);
  const session::MaskModel model = session::model_of_mask(*answer.mask, in.image.image.get(), {}, task);
  for (const std::string& warning : model.found.found.warnings) core::log_warning(warning);
  const auto own = in.file ? in.file->image() : std::nullopt;
  made.make(model.found,
            session::ImageReference{in.image.sha256, in.image.pseudonym, own ? own->axes : std::string()});
  made.commit();
  return {{"vessels", model.found.model.tree.vessels.size()}};
}

ToldJson write_surface_of(const PluginCommand& o, const session::PluginAnswer& answer) {
  const geometry::FacedSurface surface{answer.surface.mesh, {}, {}};
  if (has_extension(o.output, {".vtp"})) {
    io::write_vtp_with_fields(o.output, surface, answer.surface.points);
  } else {
    io::write_surface(o.output, answer.surface.mesh);
    core::log_warning("the surface is without its fields, which .vtp alone keeps");
  }
  ToldJson fields = ToldJson::array();
  for (const auto& [name, field] : answer.surface.points) fields.push_back(name);
  return {{"triangles", answer.surface.mesh.triangles.size()}, {"fields", fields}};
}

ToldJson write_edits(const PluginCommand& o, const PluginInput& in, const session::PluginAnswer& answer) {
  if (answer.edits.edits.empty()) core::log_warning("the plug-in gave no edits; the case is a copy");
  NewCase made(o.output);
  for (const std::string& note : made.go_on(*in.file, answer.edits).notes) core::log_info(note);
  made.commit();
  return {{"edits", answer.edits.edits.size()}};
}

ToldJson write_answer(const PluginCommand& o, const PluginInput& in, const Plugin& plugin,
                      const session::PluginAnswer& answer, const core::TaskContext& task) {
  switch (plugin.gives) {
    case PluginGives::edits:
      return write_edits(o, in, answer);
    case PluginGives::overlay:
    case PluginGives::field:
      return write_surface_of(o, answer);
    case PluginGives::mask:
      break;
  }
  if (is_case_file(o.output)) return write_case_of_mask(o, in, answer, task);
  imaging::write_image(o.output, *answer.mask);
  return ToldJson::object();
}

}  // namespace

ExitCode run_plugin_list(const PluginCommand& o, const core::TaskContext& task) {
  const session::PluginList list = session::list_plugins(session::plugin_folders(), task);
  for (const std::string& refused : list.refused) core::log_warning(refused);
  if (o.json) {
    ToldJson plugins = ToldJson::array();
    for (const Plugin& one : list.plugins) plugins.push_back(plugin_json(one));
    tell("plugins", {{"plugins", std::move(plugins)}}, "", true);
    return ExitCode::ok;
  }
  for (const Plugin& one : list.plugins) print_plugin(one);
  if (list.plugins.empty())
    std::puts(
        "no plug-ins; their scripts go into ~/.config/ostia/plugins, or a folder that OSTIA_PLUGINS names");
  return ExitCode::ok;
}

ExitCode run_plugin(const PluginCommand& o, const core::TaskContext& task) {
  const session::PluginList list = session::list_plugins(session::plugin_folders(), task);
  const Plugin plugin = session::plugin_named(list, o.name);
  session::PluginJob job(plugin, typed_values(plugin, o.values));
  require_output(o.output, outputs_of(plugin.gives));
  const PluginInput in = plugin_input(o, plugin, task.sub(0.0, 0.1));
  if (in.file) job.take_case(*in.file);
  if (plugin.needs_image) job.take_image(in.image.image);
  const session::PluginAnswer answer = job.run(std::chrono::seconds(o.time_limit_s), task.sub(0.1, 0.6));
  task.set_stage("writing");
  ToldJson facts{{"plugin", plugin.name}, {"version", plugin.version}};
  facts.update(write_answer(o, in, plugin, answer, task.sub(0.6, 1.0)));
  task.set_progress(1.0);
  tell("plugin", facts, plugin.title + ": done", o.json);
  return ExitCode::ok;
}

void define_plugin(CLI::App& app, PluginCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* plugin =
      app.add_subcommand("plugin", "Functions of your own, in Python, that work on a copy of a case");
  plugin->require_subcommand(1);
  plugin->fallthrough();

  CLI::App* list = plugin->add_subcommand("list", "The plug-ins that there are, with their parameters");
  list->footer("Example:\n  ostia plugin list");
  list->fallthrough();
  list->add_flag("--json", c.json, "One JSON object on standard output");
  list->callback([&] { run = [&](const core::TaskContext& task) { return run_plugin_list(c, task); }; });

  CLI::App* one = plugin->add_subcommand("run", "One of them, on a case or an image");
  one->footer("Example:\n  ostia plugin run widen_wall heart.ostia -o wider.ostia --set by_mm=0.2");
  one->fallthrough();
  one->add_option("NAME", c.name, "The plug-in, of those that `ostia plugin list` names")->required();
  one->add_option("INPUT", c.input, "Case (.ostia); of a plug-in that gives a mask also an image")
      ->required();
  one->add_option("--image", c.image, "Beside a case: the CT that it was made with, DICOM folder or image");
  one->add_option(
         "-o,--output", c.output,
         "By what the plug-in gives: edits: a new case, .ostia; overlay, field: a surface, .vtp, .stl "
         "or .ply; mask: .ostia, a case of the tree in it, or the mask itself, .nrrd, .mha, .nii.gz")
      ->required();
  one->add_option("--set", c.values, "name=value of a parameter; repeat")->allow_extra_args(false);
  one->add_option("--time-limit", c.time_limit_s, "Seconds after which it is ended")
      ->check(CLI::Range(1, 1000000));
  one->add_flag("--json", c.json, "One JSON object on standard output");
  one->callback([&] { run = [&](const core::TaskContext& task) { return run_plugin(c, task); }; });
}

}  // namespace ostia::app
