#include "ostia/pipeline/volume_mesh.h"

#include "ostia/core/error.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/io/volume_mesh_file.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

void append_notes(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// With the points that its triangles use, alone.
geometry::TriMesh compacted(const geometry::TriMesh& mesh) {
  return geometry::subset(mesh, std::vector<bool>(mesh.triangles.size(), true));
}

template <class Figure>
double least(const meshing::MixedQuality& quality, const Figure& figure) {
  if (quality.tetrahedra.count == 0) return figure(quality.prisms);
  if (quality.prisms.count == 0) return figure(quality.tetrahedra);
  return std::min(figure(quality.tetrahedra), figure(quality.prisms));
}

}  // namespace

void validate(const VolumeOptions& options) {
  meshing::validate(options.tetrahedralize);
  if (options.layers) meshing::validate(*options.layers);
  if (options.split_prisms && !options.layers)
    throw InvalidInput("there are no prisms to split: a mesh has them where it has layers");
  if (options.order != 1 && options.order != 2)
    throw InvalidInput("elements of order " + std::to_string(options.order) + "; choose 1 or 2");
  const bool prisms = options.layers && !options.split_prisms;
  for (const io::MeshFormat format : options.formats) io::require_holds(format, prisms, options.order == 2);
  if (!options.solver_case) return;
  validate(*options.solver_case);
  require_takes(*options.solver_case, prisms, options.order == 2);
}

double least_dihedral_deg(const meshing::MixedQuality& quality) {
  return least(quality, [](const meshing::ElementQuality& q) { return q.min_dihedral_deg; });
}

double least_scaled_jacobian(const meshing::MixedQuality& quality) {
  return least(quality, [](const meshing::ElementQuality& q) { return q.min_scaled_jacobian; });
}

FilledVolume fill_volume(const geometry::FacedSurface& surface, const geometry::FacedSurface& reference,
                         const VolumeOptions& options, const core::TaskContext& task) {
  validate(options);
  const double filled_share = options.order == 2 ? 0.7 : 1.0;
  const core::TaskContext filling = task.sub(0.0, filled_share);
  FilledVolume out;
  if (options.layers) {
    meshing::TetrahedralizeOptions inside = options.tetrahedralize;
    inside.mesher = meshing::Mesher::tetgen;  // another one would not keep the layers' inner surface
    auto filled = meshing::fill_with_layers(surface, *options.layers, inside, filling);
    out.mesh = std::move(filled.mesh);
    append_notes(out.warnings, filled.layers.warnings);
    append_notes(out.warnings, filled.tetrahedra.warnings);
    out.layers = std::move(filled.layers);
  } else {
    auto filled = meshing::tetrahedralize(surface, options.tetrahedralize, filling);
    out.mesh = geometry::mixed(filled.mesh);
    append_notes(out.warnings, filled.report.warnings);
    if (filled.report.surface_meshed_anew)
      out.new_surface = {compacted({filled.mesh.points, filled.mesh.boundary}), filled.mesh.boundary_face_ids,
                         filled.mesh.faces};
  }
  if (options.split_prisms) {
    const std::size_t inside = out.mesh.tetrahedra.size();
    out.mesh = geometry::split_prisms(out.mesh);  // which puts those of the prisms behind the others
    out.in_layers.assign(out.mesh.tetrahedra.size(), true);
    std::fill_n(out.in_layers.begin(), inside, false);
  }
  if (options.order == 2) {
    task.set_stage("quadratic elements");
    auto quadratic = meshing::make_quadratic(out.mesh, wall_of(reference), {}, task.sub(filled_share, 1.0));
    out.mesh = std::move(quadratic.mesh);
    append_notes(out.warnings, quadratic.report.warnings);
    out.quadratic = std::move(quadratic.report);
  }
  return out;
}

geometry::TriMesh wall_of(const geometry::FacedSurface& surface) {
  geometry::TriMesh wall{surface.mesh.points, {}};
  const geometry::FacesByKind faces(surface.faces);
  for (std::size_t i = 0; i < surface.mesh.triangles.size(); ++i)
    if (faces.wall(surface.face_ids[i])) wall.triangles.push_back(surface.mesh.triangles[i]);
  return wall;
}

MeshQuality judged(const geometry::MixedMesh& mesh, const core::TaskContext& task) {
  return judged(mesh, {}, task);
}

MeshQuality judged(const geometry::MixedMesh& mesh, const std::vector<bool>& in_layers,
                   const core::TaskContext& task) {
  MeshQuality out;
  task.set_stage("quality");
  out.volume = meshing::mixed_quality(mesh, task.sub(0.0, 0.5));
  if (in_layers.size() >= mesh.tetrahedra.size() && !in_layers.empty()) {
    const auto tetrahedra = static_cast<std::ptrdiff_t>(mesh.tetrahedra.size());
    meshing::mark_layers(mesh, {in_layers.begin(), in_layers.begin() + tetrahedra}, out.volume);
  }
  const geometry::FacedSurface facets{{mesh.points, mesh.triangles}, mesh.triangle_face_ids, mesh.faces};
  out.surface =
      meshing::surface_quality(compacted(geometry::boundary_triangles(mesh)), true, task.sub(0.5, 1.0));
  const meshing::SurfaceQuality wall = meshing::surface_quality(wall_of(facets), false);
  meshing::QualityBounds bounds;
  if (wall.triangles == 0 &&
      !mesh.quads.empty()) {  // a wall of quadrilaterals: what halves of them are like says nothing
    bounds.min_angle_deg = 0.0;
    bounds.max_frobenius_aspect = std::numeric_limits<double>::infinity();
  } else if (wall.triangles > 0) {
    out.surface.min_angle_deg = wall.min_angle_deg;
    out.surface.mean_min_angle_deg = wall.mean_min_angle_deg;
    out.surface.max_frobenius_aspect = wall.max_frobenius_aspect;
    out.surface.mean_frobenius_aspect = wall.mean_frobenius_aspect;
  }
  out.verdict = meshing::check(out.surface, bounds);
  append_notes(out.verdict.reasons, meshing::check(out.volume).reasons);
  return out;
}

std::string name_in_folder(io::MeshFormat format) {
  const std::string name(io::name_of(format)), extension(io::extension_of(format));
  if (extension.empty()) return name;
  return (io::shares_extension(format) ? "mesh-" + name : "mesh") + extension;
}

std::vector<std::string> write_volume_mesh(const fs::path& folder, const geometry::MixedMesh& mesh,
                                           const std::vector<bool>& in_layers, const VolumeOptions& options,
                                           const core::TaskContext& task) {
  std::vector<io::MeshFormat> all{io::MeshFormat::vtu};
  for (const io::MeshFormat format : options.formats)
    if (std::ranges::find(all, format) == all.end()) all.push_back(format);
  const double parts = static_cast<double>(all.size()) + (options.solver_case ? 1.0 : 0.0);
  std::vector<std::string> warnings;
  const auto warn = [&](const std::vector<std::string>& more) {
    for (const std::string& warning : more)
      if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
  };
  io::MeshExportOptions how;
  how.layer_tetrahedra = static_cast<std::size_t>(std::ranges::count(in_layers, true));
  for (std::size_t i = 0; i < all.size(); ++i) {
    task.throw_if_cancelled();
    warn(io::export_mesh(mesh, all[i], folder / name_in_folder(all[i]), how).warnings);
    task.set_progress(static_cast<double>(i + 1) / parts);
  }
  if (options.solver_case)
    warn(write_solver_case(mesh, *options.solver_case, folder / name_in_folder(*options.solver_case),
                           task.sub(1.0 - 1.0 / parts, 1.0))
             .warnings);
  return warnings;
}

}  // namespace ostia::pipeline
