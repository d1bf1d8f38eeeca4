#include "ostia/pipeline/model.h"

#include "stages.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/branch_ends.h"
#include "ostia/pipeline/ends_kept.h"
#include "ostia/pipeline/lumen_surface.h"
#include "ostia/pipeline/reached.h"

#include <algorithm>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr double image_inset_radii = 0.4;

std::string place(const geometry::Vec3& p) {
  return "(" + core::cut_text(p.x(), 1) + "," + core::cut_text(p.y(), 1) + "," + core::cut_text(p.z(), 1) +
         ")";
}

struct Lumen {
  TriMesh surface;
  std::optional<geometry::Vec3> source;
  std::vector<geometry::Vec3> targets;
};

Lumen lumen_of_image(const Source& source, const ModelOptions& options, Model& model, Stages& stages) {
  BranchEnds ends = ends_of(options.branches);
  auto segmented = stages.run("segmentation", 0.0, 0.44, [&](const core::TaskContext& task) {
    return segmentation::segment_vessels(*source.image, options.branches, options.segment, task);
  });
  append(model.warnings, segmented.warnings);
  model.branches = segmented.branches;
  model.left_out = reasons_of(segmented.left_out);
  append(model.warnings, model.left_out);
  if (!model.left_out.empty()) ends = ends_of(without(options.branches, segmented.left_out));
  std::vector<geometry::Vec3> seeds{ends.source};
  seeds.insert(seeds.end(), ends.targets.begin(), ends.targets.end());
  Lumen lumen;
  LumenSurface surface = stages.run("surface", 0.44, 0.55, [&](const core::TaskContext& task) {
    return lumen_surface(segmented.level_set, seeds, task);
  });
  append(model.warnings, surface.warnings);
  lumen.surface = std::move(surface.mesh);
  lumen.source = ends.source;
  lumen.targets = ends.targets;
  return lumen;
}

Lumen lumen_without_image(Source& source, const ModelOptions& options, Stages& stages) {
  Lumen lumen;
  if (!options.branches.empty()) {
    const BranchEnds ends = ends_of(options.branches);
    lumen.source = ends.source;
    lumen.targets = ends.targets;
  }
  if (options.source) lumen.source = options.source;
  if (!options.targets.empty()) lumen.targets = options.targets;
  if (source.kind == SourceKind::mask) {
    lumen.surface = stages.run("surface", 0.0, 0.55, [&](const core::TaskContext& task) {
      return segmentation::segment_mask(*source.mask, {}, task);
    });
  } else {
    lumen.surface = std::move(source.surface);
  }
  return lumen;
}

double largest_radius(const std::vector<geometry::Centerline>& lines) {
  double radius = 0.0;
  for (const geometry::Centerline& line : lines) {
    for (const double r : line.radius) radius = std::max(radius, r);
  }
  return radius;
}

}  // namespace

std::string cure_of_crossings(const TriMesh& surface) {
  const std::vector<std::int32_t> part = geometry::components(surface);
  const auto of = [&](std::int32_t triangle) { return part[static_cast<std::size_t>(triangle)]; };
  for (const auto& [a, b] : geometry::self_intersections(surface))
    if (of(a) != of(b))
      return "Two of its separate parts run through each other: take one of them out in the program that the "
             "surface is from, or keep the largest alone (`ostia convert IN OUT.vtp --repair "
             "--largest-part`)";
  return "Where a rough wall folds, `ostia convert IN OUT.vtp --smooth 200` of the file as it came smooths "
         "the "
         "folds away (flat caps without labels get round, so name the ends with --source and --target); else "
         "take the places out in the program that the surface is from";
}

void validate(const ModelOptions& options) {
  meshing::validate(options.sizing);
  meshing::validate(options.remesh);
  if (options.extensions) meshing::validate(*options.extensions);
  validate(options.volume);
  meshing::validate(options.bounds);
  meshing::validate(options.volume_bounds);
  meshing::validate(options.shape_bounds);
}

void require_sound_surface(const TriMesh& surface, const std::string& what, bool several_parts) {
  geometry::SurfaceFaults faults = geometry::find_faults(surface, true);
  const std::size_t open = faults.open_edges;
  faults.open_edges = 0;  // open ends are welcome
  if (several_parts) faults.components = std::min<std::size_t>(faults.components, 1);
  if (faults.closed_manifold() && faults.components <= 1) return;
  std::string message = what + " cannot be used as it is: ";
  if (!faults.closed_manifold()) message += faults.summary() + (faults.components > 1 ? "; " : "");
  if (faults.components > 1)
    message += "it has " + std::to_string(faults.components) +
               " separate parts, and a lumen is one (the largest stays when it is mended)";
  if (!faults.examples.empty()) {
    message += "; for example at";
    for (const geometry::Vec3& p : faults.examples) message += " " + place(p);
    message += " mm";
  }
  if (open > 0) message += " (its open ends are fine)";
  const bool mended_before = several_parts;  // what is left then is what repairing could not mend
  throw GeometryError(
      message + (mended_before
                     ? "; it is as far mended as `ostia convert --repair` can" +
                           (faults.self_intersections > 0 ? ". " + cure_of_crossings(surface) : std::string())
                     : "; `ostia convert IN OUT.vtp --repair` mends what can be mended"));
}

meshing::ClipOptions clip_of(const Source& source, const ModelOptions& options) {
  meshing::ClipOptions clip = options.clip;
  if (options.inset_radii)
    clip.inset_radii = *options.inset_radii;
  else if (source.image)
    clip.inset_radii = image_inset_radii;
  clip.given = source.ends;
  return clip;
}

LumenWithAxes build_lumen(Source source, const ModelOptions& options, const core::TaskContext& task,
                          TriMesh* found) {
  validate(options);
  LumenWithAxes made;
  Model& model = made.model;
  Stages stages(model.stages, task);
  model.warnings = source.warnings;
  if (source.image && options.branches.empty()) {
    throw InvalidInput(
        "an image needs the branches to model: --branch x,y,z:x,y,z for each (`ostia info INPUT --preview "
        "DIR` draws slices to read points off)");
  }
  Lumen lumen = source.image ? lumen_of_image(source, options, model, stages)
                             : lumen_without_image(source, options, stages);
  if (options.smoothing) {
    lumen.surface = stages.run("smoothing", 0.55, 0.6, [&](const core::TaskContext& part) {
      return geometry::taubin_smoothed(lumen.surface, *options.smoothing, part);
    });
  }
  if (found) *found = lumen.surface;
  stages.run("surface check", 0.6, 0.67, [&](const core::TaskContext&) {
    require_sound_surface(lumen.surface,
                          source.kind == SourceKind::surface ? "the surface" : "the lumen's surface",
                          !source.image);
    return 0;
  });
  LumenAxes axes = stages.run("centerlines", 0.67, 1.0, [&](const core::TaskContext& part) {
    AxesRequest request;
    if (lumen.source) request.sources = {*lumen.source};
    request.targets = lumen.targets;
    request.ends = source.ends;
    request.known = source.known;
    // Seeds say which vessels an image's lumen has.
    request.side_branches = source.image ? SideBranches::asked_only : options.side_branches;
    request.centerline = options.centerline;
    return lumen_axes(lumen.surface, request, part);
  });
  const std::vector<std::string> unreached_targets = texts_of(unreached(axes.tree, lumen.targets));
  append(model.left_out, unreached_targets);
  append(model.warnings, unreached_targets);
  append(model.warnings, axes.told);
  if (source.kind == SourceKind::surface && options.side_branches != SideBranches::asked_only) {
    const std::vector<std::string> lost = ends_without_axis(source, axes.tree);
    append(model.left_out, lost);
    append(model.warnings, lost);
  }
  append(model.warnings, axes.diagnostics.warnings);
  if (source.kind == SourceKind::surface && !source.unit_given)
    check_vessel_size(2.0 * largest_radius(axes.lines), "the surface");
  model.lumen = std::move(lumen.surface);
  model.source = std::move(source);
  made.axes = std::move(axes.tree);
  made.stubs = std::move(axes.stubs);
  return made;
}

MeshedLumen mesh_surface(const TriMesh& surface, const geometry::VesselTree& tree,
                         const ModelOptions& options, const core::TaskContext& task) {
  const std::string cure =
      "where the wall is rough, smooth the file first: `ostia convert IN OUT.vtp "
      "--repair --smooth 200`";
  try {
    MeshedLumen made = mesh_lumen(surface, tree, options, task);
    if (made.quality.surface.min_angle_deg < options.bounds.min_angle_deg)
      made.warnings.push_back("the mesh has flat triangles; " + cure);
    return made;
  } catch (const meshing::EndsNotCut&) {
    throw;
  } catch (const GeometryError& error) {
    throw GeometryError(error.what() + ("; " + cure));
  }
}

Model mesh_model(LumenWithAxes lumen, const ModelOptions& options, const core::TaskContext& task) {
  Model model = std::move(lumen.model);
  ModelOptions meshing_options = options;
  meshing_options.clip = clip_of(model.source, options);
  meshing_options.clip.planes.insert(meshing_options.clip.planes.end(), lumen.stubs.begin(),
                                     lumen.stubs.end());
  const auto mesh = model.source.kind == SourceKind::surface ? mesh_surface : mesh_lumen;
  model.meshed = mesh(model.lumen, lumen.axes, meshing_options, task);
  append(model.warnings, model.meshed.warnings);
  append(model.meshed.quality.verdict.reasons, model.left_out);
  model.stages.insert(model.stages.end(), model.meshed.stages.begin(), model.meshed.stages.end());
  return model;
}

Model build_model(Source source, const ModelOptions& options, const core::TaskContext& task) {
  constexpr double lumen_share = 0.45;
  return mesh_model(build_lumen(std::move(source), options, task.sub(0.0, lumen_share)), options,
                    task.sub(lumen_share, 1.0));
}

}  // namespace ostia::pipeline
