#include "ostia/pipeline/vessel_export.h"

#include "meshes/export_parts.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/stenosis_sizing.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/report.h"
#include "ostia/pipeline/vessel_choice.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using lumen::LumenModel;
using nlohmann::json;

constexpr double moved_inside_radii = 6.0;                // of an end that cannot be cut, at most
constexpr double walls_share = 0.1, meshes_share = 0.98;  // of the progress, measured

void check_formats(const std::vector<std::string>& formats) {
  for (const std::string& one : formats)
    if (one != "vtp" && one != "stl" && one != "ply")
      throw InvalidInput("a surface cannot be written as \"" + one + "\"; choose vtp, stl or ply");
}

std::string tree_text(const RootedModel& part, std::size_t count) {
  return count == 1 ? "" : "the tree of " + part.name + ": ";
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void write_surfaces(const fs::path& folder, const FacedSurface& surface,
                    const std::vector<std::string>& formats) {
  for (const std::string& format : formats) {
    const fs::path path = folder / ("lumen." + format);
    if (format == "vtp" && !surface.faces.empty())
      io::write_surface(path, surface);
    else
      io::write_surface(path, surface.mesh);
  }
}

JobKey key_of(const std::string& command, const LumenModel& model, const json& parameters) {
  return {command, {{"model", lumen::digest(model)}}, parameters.dump()};
}

ModelOptions model_options(const MeshExportOptions& options) {
  ModelOptions how;
  how.inset_radii = options.inset_radii;
  how.clip.planes = options.planes;
  how.clip.move_inside_radii = moved_inside_radii;
  how.sizing = options.sizing;
  how.extensions = options.extensions;
  how.volume = options.volume;
  return how;
}

/// All trees' ends, as they would be cut.
std::vector<meshing::EndPlane> ends_of(const std::vector<RootedModel>& parts, double inset_radii) {
  std::vector<meshing::EndPlane> ends;
  for (const RootedModel& part : parts) {
    const auto more = meshing::end_planes(part.model.tree, inset_radii);
    ends.insert(ends.end(), more.begin(), more.end());
  }
  return ends;
}

std::vector<std::string> names_of(const std::vector<meshing::EndPlane>& ends) {
  std::vector<std::string> names;
  for (const meshing::EndPlane& end : ends) names.push_back(meshing::end_name(end));
  return names;
}

/// What is said of ends by name, of this tree's alone. `how` has each name of some tree.
ModelOptions for_tree(const RootedModel& part, ModelOptions how) {
  const std::vector<std::string> names = names_of(meshing::end_planes(part.model.tree, *how.inset_radii));
  const auto elsewhere = [&](const std::string& name) {
    return std::ranges::find(names, name) == names.end();
  };
  std::erase_if(how.clip.planes, [&](const auto& plane) { return elsewhere(plane.end); });
  if (how.volume.solver_case)
    std::visit(
        [&](auto& one) {
          std::erase_if(one.flow.inlet_flow_ml_s, [&](const auto& flow) { return elsewhere(flow.first); });
        },
        *how.volume.solver_case);
  return how;
}

/// One tree's surface as it is wanted.
FacedSurface surface_of_part(const RootedModel& part, const SurfaceExportOptions& options,
                             const core::TaskContext& task) {
  const double cell = options.sizing ? cell_for(part.model, *options.sizing) : 0.0;
  FacedSurface surface;
  if (options.ends == SurfaceEnds::rounded && !options.sizing) {
    task.set_stage("walls");
    surface.mesh = lumen::surface_of(part.model, 0.0, task);
    return surface;
  }
  const TriMesh wall = sound_wall(part, cell, task.sub(0.0, 0.5));
  meshing::ClippedSurface clipped;
  if (options.ends == SurfaceEnds::rounded) {
    surface.mesh = wall;
  } else {
    task.set_stage("ends cut");
    meshing::ClipOptions clip;
    clip.inset_radii = MeshExportOptions().inset_radii;
    clipped = meshing::clip_ends(wall, part.model.tree, clip, task.sub(0.5, 0.55));
    if (options.ends == SurfaceEnds::capped)
      surface = meshing::cap_ends(clipped, {}, task.sub(0.55, 0.6));
    else
      surface.mesh = std::move(clipped.mesh);
  }
  if (!options.sizing) return surface;
  task.set_stage("remeshing");
  const std::vector<double> lengths = meshing::target_edge_lengths(
      surface.mesh, meshing::TubeFunction(part.model.tree),
      meshing::at_throats(*options.sizing, part.model.tree, surface.mesh), task.sub(0.6, 0.65));
  if (options.ends == SurfaceEnds::capped)
    return meshing::remesh(surface, lengths, {}, task.sub(0.65, 1.0)).surface;
  surface.mesh = meshing::remesh(surface.mesh, lengths, {}, task.sub(0.65, 1.0)).mesh;
  return surface;
}

bool in_one_piece(const TriMesh& wall) {
  const geometry::SurfaceFaults faults = geometry::find_faults(wall, false);
  return faults.closed_manifold() && faults.components == 1;
}

constexpr double finest_cell_mm = 0.1, coarsest_cell_mm = 0.25;

}  // namespace

std::vector<std::int32_t> all_or(const LumenModel& model, const std::vector<std::int32_t>& chosen) {
  if (!chosen.empty()) return chosen;
  std::vector<std::int32_t> all;
  for (const geometry::Vessel& vessel : model.tree.vessels) all.push_back(vessel.id);
  return all;
}

double cell_for(const LumenModel& model, const meshing::SizingOptions& sizing) {
  const double cell = std::clamp(2.0 * lumen::default_cell_mm(model), finest_cell_mm, coarsest_cell_mm);
  return std::min(cell, std::max(0.5 * finest_cell_mm, 0.5 * sizing.max_edge_mm));
}

TriMesh sound_wall(const RootedModel& part, double cell_mm, const core::TaskContext& task) {
  task.set_stage("walls");
  TriMesh wall = lumen::surface_of(part.model, cell_mm, task.sub(0.0, 0.9));
  const double finest = lumen::default_cell_mm(part.model);
  if (in_one_piece(wall)) return wall;
  if (finest < cell_mm) wall = lumen::surface_of(part.model, finest, task.sub(0.9, 1.0));
  const geometry::SurfaceFaults faults = geometry::find_faults(wall, false);
  if (faults.components > 1)
    throw GeometryError(
        "the wall of the tree of " + part.name + " is in " + std::to_string(faults.components) +
        " pieces, so nothing flows from one to the other: open the occluded stretch, or leave "
        "the vessel out");
  if (!faults.closed_manifold())
    throw GeometryError("the wall of the tree of " + part.name + " cannot be used: " + faults.summary());
  return wall;
}

meshing::SizingOptions edges_around(double edges) {
  if (!(edges >= 6.0 && edges <= 120.0))
    throw InvalidInput(std::to_string(edges) + " edges around a vessel; choose 6 to 120");
  meshing::SizingOptions sizing;
  sizing.edge_ratio = 2.0 * M_PI / edges;
  return sizing;
}

meshing::SizingOptions even_edges(double edge_mm) {
  if (!(edge_mm >= 0.05 && edge_mm <= 3.0))
    throw InvalidInput("edges of " + std::to_string(edge_mm) + " mm; choose 0.05 to 3 mm");
  meshing::SizingOptions sizing;
  sizing.edge_ratio = 2.0 * M_PI / 8.0;
  sizing.max_edge_mm = edge_mm;
  return sizing;
}

void validate(const SurfaceExportOptions& options) {
  if (options.formats.empty()) throw InvalidInput("no format is chosen for the surface; choose at least one");
  check_formats(options.formats);
  if (options.sizing) meshing::validate(*options.sizing);
}

void validate(const MeshExportOptions& options) {
  check_formats(options.surface_formats);
  meshing::validate(options.sizing);
  if (options.extensions) meshing::validate(*options.extensions);
  validate(options.volume);
  meshing::ClipOptions clip;
  clip.inset_radii = options.inset_radii;
  meshing::validate(clip);
}

ExportSummary export_surface(const fs::path& folder, const LumenModel& whole,
                             const SurfaceExportOptions& options, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  validate(options);
  require_free_folder(folder);
  const LumenModel model = part_of(whole, all_or(whole, options.vessels));
  const std::vector<RootedModel> parts = rooted_parts(model);
  FacedSurface all;
  const double share = meshes_share / static_cast<double>(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double from = share * static_cast<double>(i);
    append(all, surface_of_part(parts[i], options, task.sub(from, from + share)));
  }
  task.set_stage("quality");
  meshing::SurfaceQuality quality = meshing::surface_quality(all.mesh, false, task);
  ExportSummary summary;
  summary.trees = parts.size();
  summary.triangles = quality.triangles;
  summary.volume_mm3 = quality.volume_mm3;
  summary.min_angle_deg = quality.min_angle_deg;
  task.set_stage("writing");
  core::StagedFolder staged(folder);
  write_surfaces(staged.temporary(), all, options.formats);
  io::write_centerlines(staged.temporary() / "centerlines.vtp", model.tree);
  // Triangles of a grid are no worse for being slivers: nobody solves on them. There is no gate.
  const std::string figures = quality_json(quality, {});
  core::write_file(staged.temporary() / "quality.json", figures + "\n");
  const json parameters{{"ends", name_of(options.ends)},
                        {"sizing", options.sizing ? sizing_json(*options.sizing) : json()},
                        {"formats", options.formats}};
  write_manifest(staged.temporary(),
                 {key_of("surface", model, parameters), ExitCode::ok, seconds_since(start), {}, figures});
  task.throw_if_cancelled();
  staged.commit();
  task.set_progress(1.0);
  return summary;
}

JobKey mesh_job(const LumenModel& whole, const MeshExportOptions& options) {
  json parameters = json::parse(parameters_json(model_options(options)));
  parameters["formats"] = options.surface_formats;
  return key_of("mesh", part_of(whole, all_or(whole, options.vessels)), parameters);
}

ExportSummary export_mesh(const fs::path& folder, const LumenModel& whole, const MeshExportOptions& options,
                          const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  validate(options);
  require_free_folder(folder);
  const std::vector<RootedModel> parts = rooted_parts(part_of(whole, all_or(whole, options.vessels)));
  ModelOptions how = model_options(options);
  core::StagedFolder staged(folder);
  const std::vector<std::string> names = folder_names(parts);
  MeshQuality totals;
  ExportSummary summary;
  summary.trees = parts.size();
  const std::vector<meshing::EndPlane> ends = ends_of(parts, options.inset_radii);
  how.clip.planes = meshing::with_ends(options.planes, ends);
  if (how.volume.solver_case) require_inlets(*how.volume.solver_case, names_of(ends));
  const std::vector<double> shares = shares_of(parts, options.sizing);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const core::TaskContext part = task.sub(shares[i] * meshes_share, shares[i + 1] * meshes_share);
    const TriMesh wall =
        sound_wall(parts[i], cell_for(parts[i].model, options.sizing), part.sub(0.0, walls_share));
    const ModelOptions here = for_tree(parts[i], how);
    const MeshedLumen meshed = naming(tree_text(parts[i], parts.size()), [&] {
      return mesh_lumen_about(wall, parts[i].model.tree, here, part.sub(walls_share, 1.0));
    });
    for (const std::string& warning : meshed.warnings)
      summary.warnings.push_back(tree_text(parts[i], parts.size()) + warning);
    for (const std::string& reason : meshed.quality.verdict.reasons)
      summary.verdict.reasons.push_back(tree_text(parts[i], parts.size()) + reason);
    const fs::path place = parts.size() == 1 ? staged.temporary() : staged.temporary() / names[i];
    if (parts.size() > 1) fs::create_directory(place);
    write_surfaces(place, meshed.surface, options.surface_formats);
    for (const std::string& warning : write_volume_mesh(place, meshed.mesh, meshed.in_layers, here.volume))
      summary.warnings.push_back(tree_text(parts[i], parts.size()) + warning);
    io::write_centerlines(place / "centerlines.vtp", parts[i].model.tree);
    core::write_file(place / "quality.json", quality_json(meshed.quality) + "\n");
    add(meshed.quality, totals);
  }
  task.set_stage("writing");
  totals.verdict = summary.verdict;
  summary.triangles = totals.surface.triangles;
  summary.tetrahedra = totals.volume.tetrahedra.count;
  summary.prisms = totals.volume.prisms.count;
  if (totals.layers) summary.full_layers = totals.layers->full_share;
  summary.volume_mm3 = totals.volume.volume_mm3();
  summary.min_dihedral_deg = least_dihedral_deg(totals.volume);
  summary.min_angle_deg = totals.surface.min_angle_deg;
  const ExitCode code = summary.verdict.ok() ? ExitCode::ok : ExitCode::quality_failed;
  const std::string figures = quality_json(totals);
  core::write_file(staged.temporary() / "quality.json", figures + "\n");
  write_manifest(staged.temporary(),
                 {mesh_job(whole, options), code, seconds_since(start), summary.warnings, figures});
  task.throw_if_cancelled();
  staged.commit();
  task.set_progress(1.0);
  return summary;
}

}  // namespace ostia::pipeline
