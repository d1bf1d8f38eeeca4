#include "input/edit_script.h"
#include "output/outputs.h"
#include "vessel/lumen.h"

#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/pipeline/source.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <set>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;
using lumen::LumenModel;

const std::vector<std::string_view> case_outputs{".ostia"};
constexpr double axis_step_mm = 0.5;  // a reference has a point every 0.03 mm

bool is_case(const std::filesystem::path& path) {
  return path.extension() == ".ostia";
}

/// Throws UsageError for options that contradict each other, before anything is read.
std::string start_of(const LumenModelCommand& o) {
  if (is_case(o.input)) {
    if (!o.start.empty() || o.radius_mm || o.spacing_mm || !o.kernel.empty() || !o.surface.empty() ||
        !o.contours.empty() || !o.vessel.empty())
      throw UsageError(
          "a case has its model: --start, --radius, --spacing, --kernel, --surface, --contours and --vessel "
          "are for centerlines");
    return "case";
  }
  const std::vector<std::pair<std::string, bool>> given{
      {"image", !o.image.empty()}, {"surface", !o.surface.empty()}, {"contours", !o.contours.empty()}};
  std::string start = o.start;
  if (start.empty()) {
    for (const auto& [name, there] : given) {
      if (!there) continue;
      if (!start.empty())
        throw UsageError("--" + start + " and --" + name + " are given: say with --start which is meant");
      start = name;
    }
    if (start.empty()) start = "tube";
  }
  if (!o.observer.empty() && start != "contours") throw UsageError("--observer is for --contours");
  if (!o.vessel.empty() && o.input.extension() != ".txt")
    throw UsageError("--vessel is for a Rotterdam line (.txt); the vessels of other files have their names");
  for (const auto& [name, there] : given)
    if (start == name && !there) throw UsageError("--start " + name + " needs --" + name);
  if (o.radius_mm && start != "tube") throw UsageError("--radius is for --start tube");
  return start;
}

geometry::VesselTree tree_of(const LumenModelCommand& o) {
  const std::filesystem::path& path = o.input;
  if (path.extension() != ".txt") return io::read_centerlines(path);
  const io::RotterdamReference reference = io::without_repeated(io::read_rotterdam_reference(path));
  geometry::Centerline dense;
  dense.points = reference.points;
  dense.radius = reference.radius;
  geometry::complete(dense);
  geometry::Centerline axis = geometry::resample(dense, axis_step_mm);
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, std::move(axis)}};
  // Never the folder's name, which may be the patient's.
  tree.vessels = {{0, o.vessel.empty() ? "vessel" : o.vessel, {0}}};
  return tree;
}

/// One observer's contours of the vessels that the tree has.
geometry::ContourSet contours_for(const LumenModelCommand& o, const geometry::VesselTree& tree) {
  geometry::ContourSet all = io::read_contours(o.contours);
  std::set<std::string> observers, vessels;
  for (const auto& section : all.sections) {
    observers.insert(section.observer);
    vessels.insert(section.vessel);
  }
  const auto listed = [](const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  };
  if (o.observer.empty() ? observers.size() > 1 : !observers.contains(o.observer))
    throw InvalidInput(o.contours.string() + " has contours of " + listed(observers) +
                       ": name one of them with --observer");
  const auto has = [&](const std::string& name) {
    return std::any_of(tree.vessels.begin(), tree.vessels.end(),
                       [&](const geometry::Vessel& v) { return v.name == name; });
  };
  std::erase_if(all.sections, [&](const auto& section) {
    return !has(section.vessel) || (!o.observer.empty() && section.observer != o.observer);
  });
  if (all.sections.empty())
    throw InvalidInput(o.contours.string() + " has contours of " + listed(vessels) +
                       ", and the centerlines have no vessel of such a name (--vessel names a single line)");
  return all;
}

pipeline::Source image_from(const std::filesystem::path& path, const core::TaskContext& task) {
  pipeline::Source source = pipeline::load_ct(path, {}, task);
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  return source;
}

/// What a library says of values, with the first of these files that they stand in, unless it names one.
template <class Call>
auto naming_one_of(const std::vector<std::filesystem::path>& files, const Call& call) {
  try {
    return call();
  } catch (const InvalidInput& error) {
    const std::string what = error.what();
    const bool named = std::any_of(files.begin(), files.end(), [&](const auto& file) {
      return !file.empty() && what.find(file.string()) != std::string::npos;
    });
    throw InvalidInput(named ? what : files.front().string() + ": " + what);
  }
}

LumenModel model_about(const geometry::VesselTree& tree, const LumenModelCommand& o, const std::string& start,
                       const pipeline::Source& image, const lumen::SamplingOptions& sampling,
                       const core::TaskContext& task) {
  if (start == "image")
    return lumen::model_of_walls(tree, pipeline::walls_from_image(tree, *image.image, task), sampling);
  if (start == "surface") {
    const io::LoadedSurface loaded = io::read_surface(o.surface);
    for (const std::string& warning : loaded.warnings) core::log_warning(warning);
    return lumen::model_of_surface(tree, loaded.surface.mesh, sampling, task);
  }
  if (start == "contours") return lumen::model_of_contours(tree, contours_for(o, tree), sampling);
  return lumen::model_of_tubes(tree, o.radius_mm, sampling);
}

LumenModel started(const LumenModelCommand& o, const std::string& start, const pipeline::Source& image,
                   const core::TaskContext& task) {
  lumen::SamplingOptions sampling;
  if (o.spacing_mm) {
    sampling.spacing_mm = *o.spacing_mm;
    sampling.least_spacing_mm = std::min(sampling.least_spacing_mm, *o.spacing_mm);
  }
  LumenModel model = naming_one_of({o.input, o.surface, o.contours},
                                   [&] { return model_about(tree_of(o), o, start, image, sampling, task); });
  if (!o.kernel.empty()) {
    for (auto& vessel : model.vessels) {
      lumen::VesselLumen changed = *vessel;
      changed.interpolation.kernel = lumen::kernel_named(o.kernel);
      vessel = std::make_shared<const lumen::VesselLumen>(std::move(changed));
    }
  }
  return model;
}

Json vessels_json(const LumenModel& model) {
  Json vessels = Json::array();
  for (std::size_t i = 0; i < model.vessels.size(); ++i) {
    const lumen::VesselLumen& vessel = *model.vessels[i];
    std::size_t edited = 0;
    for (const lumen::SurfaceSample& sample : vessel.samples)
      edited += sample.origin == lumen::SampleOrigin::edit ? 1U : 0U;
    vessels.push_back({{"id", vessel.vessel},
                       {"name", model.tree.vessels[i].name},
                       {"length_mm", vessel.axis->length()},
                       {"samples", vessel.samples.size()},
                       {"edited_samples", edited},
                       {"kernel", lumen::name(vessel.interpolation.kernel)},
                       {"support_radius_mm", vessel.interpolation.support_radius_mm}});
  }
  return vessels;
}

void print(const Json& out, bool as_json) {
  if (as_json) {
    std::printf("%s\n", out.dump(2).c_str());
    return;
  }
  for (const Json& vessel : out["vessels"])
    std::printf("vessel %d %-12s %7.1f mm, %zu samples, %zu of them edited\n", vessel["id"].get<int>(),
                vessel["name"].get<std::string>().c_str(), vessel["length_mm"].get<double>(),
                vessel["samples"].get<std::size_t>(), vessel["edited_samples"].get<std::size_t>());
  std::printf("%zu edits applied; %zu triangles, %.1f mm2, %.1f mm3\nmodel %s\n",
              out["edits"].get<std::size_t>(), out["triangles"].get<std::size_t>(),
              out["area_mm2"].get<double>(), out["volume_mm3"].get<double>(),
              out["digest"].get<std::string>().c_str());
}

using Notes = std::vector<std::string>;
using Image = std::optional<session::ImageReference>;

/// A case with the script's edits after its own; its new copy keeps its journal.
LumenModel case_edited(const LumenModelCommand& o, const Image& image, const EditScript& script,
                       std::optional<NewCase>& made, Notes& notes, const core::TaskContext& task) {
  const session::CaseFile opened = session::CaseFile::open(o.input, session::OpenMode::read_only);
  if (image) naming_one_of({o.image}, [&] { return opened.check_image(*image); });
  task.set_stage("edits");
  return made ? made->go_on(opened, script, notes, task) : edited(*opened.model(), script, notes, task);
}

LumenModel start_edited(const LumenModelCommand& o, const std::string& start, const pipeline::Source& source,
                        const Image& image, const EditScript& script, std::optional<NewCase>& made,
                        Notes& notes, const core::TaskContext& task) {
  task.set_stage("start");
  LumenModel model = started(o, start, source, task.sub(0.2, 0.5));
  task.set_stage("edits");
  const core::TaskContext editing = task.sub(0.5, 0.6);
  return made ? made->make(model, script, image, notes, editing)
              : edited(std::move(model), script, notes, editing);
}

}  // namespace

ExitCode run_lumen(const LumenModelCommand& o, const core::TaskContext& task) {
  const std::string start = start_of(o);
  require_output(o.output, surface_outputs);
  require_output(o.case_output, case_outputs);
  require_output(o.lines_output, line_outputs);
  task.set_stage("reading");
  std::optional<NewCase> made;
  if (!o.case_output.empty()) made.emplace(o.case_output);
  const EditScript script = read_edit_script(o.edits);
  pipeline::Source image;
  if (!o.image.empty()) image = image_from(o.image, task.sub(0.0, 0.2));
  Image reference;
  if (image.image) reference = session::ImageReference{image.sha256, image.pseudonym};

  Notes notes;
  const LumenModel model = start == "case"
                               ? case_edited(o, reference, script, made, notes, task.sub(0.2, 0.6))
                               : start_edited(o, start, image, reference, script, made, notes, task);
  task.set_stage("surface");
  const geometry::TriMesh wall = lumen::surface_of(model, o.cell_mm, task.sub(0.6, 0.95));
  const geometry::SurfaceFaults faults = geometry::find_faults(wall, false);
  const bool sound = faults.open_edges == 0 && faults.non_manifold_edges == 0;
  if (!sound) core::log_warning("the surface is not closed, or edges have more than two triangles");
  task.throw_if_cancelled();
  io::write_surface(o.output, wall);
  if (!o.lines_output.empty()) io::write_centerlines(o.lines_output, model.tree);
  if (made) made->commit();
  print({{"v", 1},
         {"kind", "lumen"},
         {"start", start},
         {"vessels", vessels_json(model)},
         {"edits", script.edits.size()},
         {"digest", lumen::digest(model)},
         {"triangles", wall.triangles.size()},
         {"area_mm2", geometry::area(wall)},
         {"volume_mm3", geometry::volume(wall)},
         {"open_edges", faults.open_edges},
         {"non_manifold_edges", faults.non_manifold_edges},
         {"warnings", notes}},
        o.json);
  task.set_progress(1.0);
  return sound ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
