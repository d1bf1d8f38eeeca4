#include "ostia/session/plugin_job.h"

#include "plugins/plugin_python.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/private_folder.h"
#include "ostia/imaging/image_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using PluginJson = nlohmann::json;

constexpr std::uint64_t most_answer_bytes = 1ULL << 30;
constexpr const char* case_copy = "case.ostia";
constexpr const char* image_copy = "image.mhd";

/// Arguments: the folder that Ostia's package lies in, and the run's. The package is taken from there alone,
/// and what else is imported from the interpreter's own places: not from the present folder, and not from the
/// package's neighbours in the place of an environment's packages.
constexpr const char* python_start = R"(
import importlib.util as util, sys
place = sys.argv[1]
sys.path[0:1] = []
sys.path.append(place)
spec = util.spec_from_file_location('ostia', place + '/ostia/__init__.py', submodule_search_locations=[place + '/ostia'])
sys.modules['ostia'] = package = util.module_from_spec(spec)
spec.loader.exec_module(package)
from ostia.plugin import _run
_run(sys.argv[2])
)";

PluginJson json_of_value(const PluginValue& value) {
  return std::visit([](const auto& one) { return PluginJson(one); }, value);
}

/// Appends a surface and its fields at points to those before; what either lacks of the other's is NaN.
void append_surface(io::SurfaceWithFields more, std::size_t number, io::SurfaceWithFields& all) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const std::size_t before = all.mesh.points.size(), added = more.mesh.points.size();
  for (auto triangle : more.mesh.triangles) {
    for (auto& corner : triangle) corner += static_cast<std::int32_t>(before);
    all.mesh.triangles.push_back(triangle);
  }
  all.mesh.points.insert(all.mesh.points.end(), more.mesh.points.begin(), more.mesh.points.end());
  more.points["part"] = {1, std::vector<double>(added, static_cast<double>(number))};
  for (auto& [name, field] : more.points) {
    auto [at, fresh] = all.points.try_emplace(name, field);
    io::FieldValues& own = at->second;
    if (fresh)
      own.values.assign(before * static_cast<std::size_t>(field.components), missing);
    else if (own.components != field.components)
      throw InvalidInput("the field " + name + " has other components on the surface " +
                         std::to_string(number));
    own.values.insert(own.values.end(), field.values.begin(), field.values.end());
  }
  for (auto& [name, field] : all.points)
    field.values.resize((before + added) * static_cast<std::size_t>(field.components), missing);
}

io::SurfaceWithFields surfaces_answered(const PluginJson& files, const fs::path& folder) {
  io::SurfaceWithFields all;
  std::size_t number = 0;
  bool fields = false;
  for (const PluginJson& name : files) {
    io::SurfaceWithFields one = io::read_surface_with_fields(folder / name.get<std::string>());
    fields = fields || !one.points.empty();
    append_surface(std::move(one), number++, all);
  }
  if (all.mesh.triangles.empty()) throw InvalidInput("it gave no surface");
  if (fields && number == 1) all.points.erase("part");
  return all;
}

PluginEdits edits_answered(const PluginJson& lines, const Plugin& plugin) {
  PluginEdits step{plugin.title, plugin.version, {}};
  for (const PluginJson& line : lines) {
    try {
      step.edits.push_back(edit_of_json(line.get<std::string>()));
    } catch (const InvalidInput& error) {
      throw InvalidInput("edit " + std::to_string(step.edits.size() + 1) + " of " +
                         std::to_string(lines.size()) + ": " + error.what());
    }
  }
  return step;
}

PluginAnswer answer_of(const PluginJson& answer, const Plugin& plugin, const fs::path& folder) {
  PluginAnswer made;
  switch (plugin.gives) {
    case PluginGives::edits:
      made.edits = edits_answered(answer.at("edits"), plugin);
      break;
    case PluginGives::overlay:
    case PluginGives::field:
      made.surface = surfaces_answered(answer.at("surfaces"), folder);
      break;
    case PluginGives::mask:
      made.mask = imaging::read_labels(folder / answer.at("mask").get<std::string>()).volume;
      break;
  }
  return made;
}

/// "widen.py, line 12: ValueError: no such place"
std::string failure_of(const PluginJson& error) {
  std::string text;
  if (error.contains("file"))
    text =
        error.at("file").get<std::string>() + ", line " + std::to_string(error.at("line").get<int>()) + ": ";
  return text + error.at("message").get<std::string>();
}

std::string last_line_said(const std::string& said) {
  std::string last;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

void log_what_it_said(const std::string& name, const std::string& said) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) core::log_info(name + ": " + line);
}

}  // namespace

PluginJob::PluginJob(Plugin plugin, PluginValues values)
    : plugin_(std::move(plugin)), folder_(std::make_unique<core::PrivateFolder>()) {
  for (const PluginParameter& one : plugin_.parameters) values_[one.name] = one.value;
  for (auto& [name, value] : values) values_[parameter_named(plugin_, name).name] = std::move(value);
}
PluginJob::~PluginJob() = default;
PluginJob::PluginJob(PluginJob&&) noexcept = default;

void PluginJob::take_case(const CaseFile& file) {
  file.copy_to(folder_->path() / case_copy);
  has_case_ = true;
}

void PluginJob::take_image(std::shared_ptr<const imaging::ImageVolume> image) {
  image_ = std::move(image);
}

PluginAnswer PluginJob::run(std::chrono::seconds limit, const core::TaskContext& task) const {
  const fs::path& folder = folder_->path();
  const std::string name = "the plug-in " + plugin_.name;
  if (plugin_.needs_case && !has_case_) throw InvalidInput(name + " needs a case");
  if (plugin_.needs_image && !image_) throw InvalidInput(name + " needs an image");
  const PluginPython python = plugin_python();
  PluginJson request{{"script", plugin_.script.string()},
                     {"digest", plugin_.digest},
                     {"name", plugin_.name},
                     {"gives", std::string(word(plugin_.gives))},
                     {"vessels", PluginJson::array()},
                     {"values", PluginJson::object()}};
  for (const auto& [parameter, value] : values_) request["values"][parameter] = json_of_value(value);
  for (const PluginParameter& one : plugin_.parameters)
    if (one.type == PluginType::vessel) request["vessels"].push_back(one.name);
  if (has_case_) request["case"] = case_copy;
  if (image_) {
    imaging::write_image(folder / image_copy, *image_);
    request["image"] = image_copy;
  }
  core::write_file(folder / "request.json", request.dump());
  PythonRun run;
  try {
    run = run_python(python, {"-B", "-c", python_start, python.package.string(), folder.string()}, limit,
                     folder, task);
  } catch (const ResourceError& error) {
    throw ResourceError(name + ": " + error.what());
  }
  log_what_it_said(plugin_.name, run.said);
  const bool answered = fs::exists(folder / "answer.json");
  if (!answered || !run.ended.empty())
    throw InvalidInput(name + " ended without a result: Python " + (run.ended.empty() ? "ended" : run.ended) +
                       (run.said.empty() ? "" : ": " + last_line_said(run.said)));
  try {
    const PluginJson answer = PluginJson::parse(core::read_file(folder / "answer.json", most_answer_bytes));
    if (answer.contains("error")) throw InvalidInput("it failed: " + failure_of(answer.at("error")));
    return answer_of(answer, plugin_, folder);
  } catch (const PluginJson::exception& error) {
    throw InvalidInput(name + " gave a result that cannot be read: " + error.what());
  } catch (const Error& error) {
    throw InvalidInput(name + ": " + error.what());
  }
}

}  // namespace ostia::session
