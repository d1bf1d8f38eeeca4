#include "commands.h"
#include "flow/solver_case.h"
#include "input/seeds.h"
#include "mesh/ends_not_cut.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_vessels.h"
#include "mesh/refinement.h"
#include "mesh/told_mesh.h"
#include "options/model_options.h"
#include "output/kept_results.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/ends_kept.h"
#include "ostia/pipeline/model_folder.h"
#include "ostia/pipeline/report.h"
#include "ostia/pipeline/vessel_forecast.h"
#include "ostia/session/case_file.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

namespace ostia::app {
namespace {

ExitCode verdict(const meshing::QualityVerdict& verdict) {
  if (verdict.ok()) return ExitCode::ok;
  core::log_warning("quality control failed: " + verdict.summary());
  return ExitCode::quality_failed;
}

/// As it stands in the file, in the unit that is given.
geometry::FacedSurface surface_in(const std::filesystem::path& file, const InputOptions& input) {
  geometry::FacedSurface surface = io::read_surface(file).surface;
  if (const auto unit_mm = source_options(input).unit_mm)
    for (geometry::Vec3& p : surface.mesh.points) p *= *unit_mm;
  return surface;
}

ExitCode check_file(const MeshCommand& options, const core::TaskContext& task) {
  task.set_stage("reading");
  if (io::is_volume_mesh(options.check)) {
    const io::LayeredMesh read = io::read_layered_mesh(options.check);
    const pipeline::MeshQuality quality = pipeline::judged(read.mesh, read.in_layers, task);
    std::fputs((pipeline::quality_json(quality) + "\n").c_str(), stdout);
    const bool could_tell = options.check.extension() == ".vtu";
    if (!quality.verdict.ok() && read.mesh.prisms.empty() && read.in_layers.empty() && !could_tell)
      core::log_warning(
          options.check.string() +
          " does not say which tetrahedra are prisms of layers that were split, and all are "
          "judged as tetrahedra; if there are such, check the mesh.vtu that was written beside it");
    return verdict(quality.verdict);
  }
  if (!io::is_surface_file(options.check))
    throw InvalidInput(
        "cannot check " + options.check.string() + ": volume meshes are read as " +
        io::readable_volume_meshes() +
        ", surfaces as STL, PLY, OBJ, VTP and legacy VTK; export the mesh as one of these besides");
  const geometry::FacedSurface surface = surface_in(options.check, options.input);
  const meshing::MeshForecast forecast = forecast_of(surface, nullptr, {}, task.sub(0.0, 0.5));
  warn_of(forecast, true, true);
  const auto quality = meshing::surface_quality(surface.mesh, true, task.sub(0.5, 1.0));
  const meshing::QualityVerdict judged = meshing::check(quality);
  std::fputs((with_forecast(pipeline::quality_json(quality, judged), forecast) + "\n").c_str(), stdout);
  return forecast.fails() ? ExitCode::quality_failed : verdict(judged);
}

geometry::Box3 box_of(const geometry::VesselTree& tree) {
  geometry::Box3 box;
  for (const geometry::TreeSegment& segment : tree.segments)
    for (const geometry::Vec3& p : segment.axis.points) box.extend(p);
  return box;
}

/// Axes in the surface's own unit, as its file has it, become mm; axes that are in mm already stay.
void scale_to(const pipeline::Source& source, geometry::VesselTree& tree) {
  const geometry::Box3 surface = geometry::bounds(source.surface.points), lines = box_of(tree);
  if (surface.intersects(lines) && lines.sizes().norm() > 0.3 * surface.sizes().norm()) return;
  for (geometry::TreeNode& node : tree.nodes) node.position *= source.unit_mm;
  for (geometry::TreeSegment& segment : tree.segments) {
    for (geometry::Vec3& p : segment.axis.points) p *= source.unit_mm;
    for (double& r : segment.axis.radius) r *= source.unit_mm;
    for (double& s : segment.axis.abscissa) s *= source.unit_mm;
  }
}

/// Axes to all ends of the surface; `how` gets the planes where side branches are to be cut off.
geometry::VesselTree tree_for(const MeshCommand& options, const pipeline::Source& source,
                              pipeline::ModelOptions& how, const core::TaskContext& task) {
  pipeline::AxesRequest request;
  if (how.source) request.sources = {*how.source};
  request.targets = how.targets;
  request.ends = source.ends;
  request.known = source.known;
  request.side_branches = how.side_branches;
  request.centerline = how.centerline;
  task.set_stage("centerlines");
  std::optional<pipeline::LumenAxes> axes;
  if (options.centerline.empty()) {
    axes = pipeline::lumen_axes(source.surface, request, task);
  } else {
    geometry::VesselTree known = io::read_centerlines(options.centerline);
    if (source.unit_mm != 1.0) scale_to(source, known);
    axes = pipeline::with_side_branches(source.surface, known, request, task);
    if (!axes) return known;
  }
  for (const std::string& line : axes->told) core::log_warning(line);
  how.clip.planes.insert(how.clip.planes.end(), axes->stubs.begin(), axes->stubs.end());
  return std::move(axes->tree);
}

/// Reads the surface; `how` gets the points and lengths that are given with it.
pipeline::Source surface_source(const MeshCommand& options, pipeline::ModelOptions& how,
                                const core::TaskContext& task) {
  task.set_stage("reading");
  pipeline::Source source = pipeline::load(options.input.input, source_options(options.input), task);
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (source.kind != pipeline::SourceKind::surface)
    throw InvalidInput("cannot mesh " + options.input.input.string() +
                       ": it is no surface; `ostia model` goes all the way from an image, and --mask takes "
                       "a mask of any values");
  apply(options.ends, seed_frame(options.input, source, options.ends.seed_units), how);
  apply_size_array(options.mesh, options.input, source.unit_mm, how);
  how.clip.given = source.ends;
  return source;
}

/// A surface as it stands, with all its faults: what a strict run would refuse.
meshing::MeshForecast forecast_as_it_stands(const MeshCommand& options, pipeline::ModelOptions& how,
                                            const core::TaskContext& task) {
  const geometry::FacedSurface surface = surface_in(options.input.input, options.input);
  apply_size_array(options.mesh, options.input, source_options(options.input).unit_mm.value_or(1.0), how);
  std::optional<geometry::VesselTree> tree;
  if (!options.centerline.empty()) tree = io::read_centerlines(options.centerline);
  return forecast_of(surface, tree ? &*tree : nullptr, how, task);
}

/// The surface as the run itself takes it: mended, with axes to all its ends, cut and capped.
meshing::MeshForecast forecast_of_run(const MeshCommand& options, pipeline::ModelOptions& how,
                                      const core::TaskContext& task) {
  pipeline::LumenWithAxes lumen;
  lumen.model.source = surface_source(options, how, task.sub(0.0, 0.2));
  lumen.axes = tree_for(options, lumen.model.source, how, task.sub(0.2, 0.6));
  lumen.model.lumen = lumen.model.source.surface;
  return pipeline::forecast_model(lumen, how, task.sub(0.6, 1.0)).forecast;
}

/// What meshing would meet, in words or as JSON; nothing is made.
ExitCode forecast(const MeshCommand& options, const core::TaskContext& task) {
  if (options.input.input.empty() || options.input.input.extension() == ".ostia")
    throw UsageError("--forecast looks at a surface: `ostia mesh SURFACE --forecast`");
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  how.clip.planes = placed_planes(options.mesh, options.input.coords, nullptr);
  task.set_stage("reading");
  const meshing::MeshForecast found =
      options.input.strict ? forecast_as_it_stands(options, how, task) : forecast_of_run(options, how, task);
  if (options.json) {
    std::fputs((forecast_json(found) + "\n").c_str(), stdout);
  } else {
    for (const meshing::ForecastPlace& place : found.places)
      std::printf("%s: %s\n", place.fails ? "fails" : "poor", forecast_text(place).c_str());
    if (found.places.empty()) std::printf("nothing found that would fail or come out poor\n");
  }
  return found.fails() ? ExitCode::quality_failed : ExitCode::ok;
}

/// What is wrong with a surface before its run. One that has been mended has no openings but its ends, which
/// are cut, and triangles that still cross are refused with the way out.
meshing::MeshForecast forecast_of_taken(const MeshCommand& options, const geometry::FacedSurface& wall,
                                        const pipeline::ModelOptions& how, const core::TaskContext& task) {
  meshing::MeshForecast found = forecast_of(wall, nullptr, how, task);
  if (!options.input.strict)
    std::erase_if(found.places, [](const meshing::ForecastPlace& place) {
      return place.kind == meshing::TroubleKind::open_edges ||
             place.kind == meshing::TroubleKind::self_intersections;
    });
  return found;
}

void refuse_ends_of_vessels(const MeshCommand& options, const std::string& what) {
  if (!options.centerline.empty() || !options.ends.source.empty() || !options.ends.targets.empty())
    throw UsageError(what + " has its axes: --centerline, --source and --target are for surfaces");
  if (!options.mesh.size_array.empty()) throw UsageError("--size-array is for surfaces (.vtp)");
}

VesselMesh wanted_of(const MeshCommand& options) {
  return {options.mesh, options.input.coords, options.output, options.json};
}

ExitCode mesh_case(const MeshCommand& options, const core::TaskContext& task) {
  refuse_ends_of_vessels(options, "a case");
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  task.set_stage("reading");
  const auto opened = session::CaseFile::open(options.input.input, session::OpenMode::read_only);
  apply_refinement(options, box_of(opened.model()->tree), how, task);
  return mesh_vessels(*opened.model(), wanted_of(options), how, task);
}

ExitCode mesh_the_mask(const MeshCommand& options, const core::TaskContext& task) {
  refuse_ends_of_vessels(options, "a mask");
  const auto refined = [&](const lumen::LumenModel& model, pipeline::ModelOptions& how) {
    apply_refinement(options, box_of(model.tree), how, task);
  };
  return mesh_mask({options.input.input, options.of_mask.image, options.of_mask.labels, options.of_mask.mask},
                   wanted_of(options), refined, task);
}

}  // namespace

ExitCode run_mesh(const MeshCommand& options, const core::TaskContext& task) {
  check_refinement(options);
  if (!options.check.empty()) return check_file(options, task);
  if (options.forecast) return forecast(options, task);
  if (options.input.input.empty() || options.output.empty())
    throw UsageError(
        "`ostia mesh` needs a surface, a mask or a case and -o DIR, or --check FILE, or a surface and "
        "--forecast");
  if (options.input.input.extension() == ".ostia") return mesh_case(options, task);
  if (options.of_mask.mask || holds_labels(options.input.input)) return mesh_the_mask(options, task);
  pipeline::ModelOptions how;
  apply(options.mesh, how);
  how.clip.planes = placed_planes(options.mesh, options.input.coords, nullptr);
  pipeline::require_free_folder(options.output);
  const auto start = std::chrono::steady_clock::now();
  const pipeline::Source source = surface_source(options, how, task.sub(0.0, 0.1));
  apply_refinement(options, geometry::bounds(source.surface.points), how, task.sub(0.05, 0.1));
  pipeline::JobKey key{
      "mesh", {{"surface", source.sha256}}, pipeline::parameters_json(how, source_options(options.input))};
  if (how.sizing.array) key.inputs["size_array"] = core::sha256(options.mesh.size_array);
  if (!options.centerline.empty()) key.inputs["centerline"] = core::sha256_file(options.centerline);
  if (const auto code = pipeline::already_done(options.output, key)) {
    core::log_info("done already with the same input and parameters; nothing to do");
    tell_mesh(options.output, options.json);
    return *code;
  }
  const geometry::FacedSurface wall{source.surface, {}, {}};
  // What is wrong with the surface itself is told before its centerlines are sought, sizes once they are
  // known.
  warn_of(forecast_of_taken(options, wall, how, task.sub(0.1, 0.12)), true, false);
  pipeline::require_sound_surface(source.surface, options.input.input.string(), true);
  const geometry::VesselTree tree = tree_for(options, source, how, task.sub(0.12, 0.28));
  warn_of(forecast_of(wall, &tree, how, task.sub(0.28, 0.3)), false, true);
  KeptResults kept(options.keep, options.output);
  kept.add("centerlines.vtp", [&](const std::filesystem::path& file) { io::write_centerlines(file, tree); });
  EndsNotCutPicture ends(kept);
  pipeline::MeshedLumen meshed = kept.guard([&] {
    return ends.guard(source.surface, tree,
                      [&] { return pipeline::mesh_surface(source.surface, tree, how, task.sub(0.3, 0.95)); });
  });
  for (const std::string& warning : meshed.warnings) core::log_warning(warning);
  if (how.side_branches != pipeline::SideBranches::asked_only)
    for (std::string& lost : pipeline::ends_without_axis(source, tree))
      meshed.quality.verdict.reasons.push_back(std::move(lost));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_mesh_folder(options.output, meshed, how, key, seconds, task.sub(0.95, 1.0));
  tell_mesh(options.output, options.json);
  tell_case(how.volume, options.output);
  task.set_progress(1.0);
  return verdict(meshed.quality.verdict);
}

}  // namespace ostia::app
