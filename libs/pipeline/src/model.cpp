#include "ostia/pipeline/model.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/stenosis_sizing.h"
#include "ostia/pipeline/branch_ends.h"
#include "ostia/pipeline/lumen_surface.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr double image_inset_radii = 0.4;

/// Runs stages one after another, names and times them.
class Stages {
 public:
  explicit Stages(std::vector<StageTime>& times, const core::TaskContext& task)
      : times_(times), task_(task) {}

  template <class Work>
  auto run(const std::string& name, double from, double to, const Work& work) {
    task_.throw_if_cancelled();
    task_.set_stage(name);
    const auto start = std::chrono::steady_clock::now();
    const core::TaskContext part = task_.sub(from, to);
    auto result = work(part);
    part.set_progress(1.0);
    times_.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    core::log_debug(name + " took " + std::to_string(times_.back().seconds) + " s");
    return result;
  }

 private:
  std::vector<StageTime>& times_;
  const core::TaskContext& task_;
};

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::string place(const geometry::Vec3& p) {
  const auto text = [](double v) {
    std::string out = std::to_string(v);
    return out.substr(0, out.find('.') + 2);
  };
  return "(" + text(p.x()) + "," + text(p.y()) + "," + text(p.z()) + ")";
}

struct Lumen {
  TriMesh surface;
  std::optional<geometry::Vec3> source;
  std::vector<geometry::Vec3> targets;
};

Lumen lumen_of_image(const Source& source, const ModelOptions& options, Model& model, Stages& stages) {
  const BranchEnds ends = ends_of(options.branches);
  auto segmented = stages.run("segmentation", 0.0, 0.44, [&](const core::TaskContext& task) {
    return segmentation::segment_vessels(*source.image, options.branches, options.segment, task);
  });
  append(model.warnings, segmented.warnings);
  model.branches = segmented.branches;
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

geometry::Vec3 centre_of(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  geometry::Vec3 sum = geometry::Vec3::Zero();
  for (const std::int32_t p : loop) sum += mesh.points[static_cast<std::size_t>(p)];
  return sum / static_cast<double>(loop.size());
}

/// From the cut inlet's centre to the cut outlets' centres; vessels keep their names.
centerline::CenterlineResult centerlines_between(const meshing::ClippedSurface& clipped,
                                                 const geometry::VesselTree& tree,
                                                 centerline::CenterlineOptions options,
                                                 const core::TaskContext& task) {
  std::optional<geometry::Vec3> source;
  std::vector<geometry::Vec3> targets;
  options.vessel_names.clear();
  for (const meshing::ClippedEnd& end : clipped.ends) {
    if (end.plane.kind == geometry::FaceKind::inlet) {
      if (source) throw InvalidInput("the centerlines have several roots; a lumen has one inlet");
      source = centre_of(clipped.mesh, end.loop);
    }
  }
  for (const geometry::Vessel& vessel : tree.vessels) {
    for (const meshing::ClippedEnd& end : clipped.ends) {
      if (end.plane.kind != geometry::FaceKind::outlet || end.plane.vessel != vessel.name) continue;
      targets.push_back(centre_of(clipped.mesh, end.loop));
      options.vessel_names.push_back(vessel.name);
    }
  }
  return centerline::extract_centerlines(clipped.mesh, source, targets, options, task);
}

double largest_radius(const centerline::CenterlineResult& centerlines) {
  double radius = 0.0;
  for (const geometry::Centerline& line : centerlines.lines) {
    for (const double r : line.radius) radius = std::max(radius, r);
  }
  return radius;
}

}  // namespace

void validate(const ModelOptions& options) {
  meshing::validate(options.sizing);
  meshing::validate(options.remesh);
  if (options.extensions) meshing::validate(*options.extensions);
  validate(options.volume);
  meshing::validate(options.bounds);
  meshing::validate(options.volume_bounds);
}

void require_sound_surface(const TriMesh& surface, const std::string& what) {
  geometry::SurfaceFaults faults = geometry::find_faults(surface, true);
  const std::size_t open = faults.open_edges;
  faults.open_edges = 0;  // open ends are welcome
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
  throw GeometryError(message + "; `ostia convert --repair` mends what can be mended");
}

namespace {

/// Where a stage's share of the progress ends; measured on coronary trees of 0.1 to 1 million triangles.
struct Shares {
  double cut, axes, caps, remeshing, tetrahedra;
};
constexpr Shares with_extraction{0.04, 0.2, 0.22, 0.5, 0.9};
constexpr Shares with_known_axes{0.2, 0.2, 0.21, 0.62, 0.97};

using AxesOf =
    std::function<centerline::CenterlineResult(const meshing::ClippedSurface&, const core::TaskContext&)>;

double middle_of_caps(const Shares& shares) {
  return 0.5 * (shares.axes + shares.caps);
}

std::vector<std::string> names_of(const std::vector<meshing::ClippedEnd>& ends) {
  std::vector<std::string> names;
  for (const meshing::ClippedEnd& end : ends) names.push_back(meshing::end_name(end.plane));
  return names;
}

/// The cut lumen and its axes led on beyond its ends.
void extend(const meshing::FlowExtensionOptions& options, const Shares& shares, Stages& stages,
            meshing::ClippedSurface& clipped, geometry::VesselTree& axes, MeshedLumen& out) {
  meshing::ExtendedEnds extended = stages.run(
      "flow extensions", shares.axes, middle_of_caps(shares),
      [&](const core::TaskContext& part) { return meshing::extend_ends(clipped, axes, options, part); });
  clipped = std::move(extended.surface);
  axes = std::move(extended.tree);
  append(out.warnings, extended.warnings);
  out.quality.extensions = std::move(extended.extensions);
}

/// The gate that a mesh passes before it is written.
void judge(const geometry::FacedSurface& capped, const ModelOptions& options, const core::TaskContext& task,
           MeshedLumen& out) {
  MeshQuality& quality = out.quality;
  quality.surface = meshing::surface_quality(out.surface.mesh, true, task.sub(0.0, 0.3));
  quality.volume = meshing::mixed_quality(out.mesh, task.sub(0.3, 0.7));
  if (!out.in_layers.empty())
    meshing::mark_layers(out.mesh, out.in_layers, quality.volume, task.sub(0.65, 0.7));
  quality.refinement = options.volume.refinement;
  if (quality.refinement)
    quality.refinement->elements = quality.volume.tetrahedra.count + quality.volume.prisms.count;
  quality.wall_deviation = meshing::wall_deviation(out.mesh, wall_of(capped), task.sub(0.7, 1.0));
  quality.verdict = meshing::check(quality.surface, options.bounds);
  append(quality.verdict.reasons, meshing::check(quality.volume, options.volume_bounds).reasons);
}

/// Remeshed and filled. Sizes follow `axes`.
void mesh_capped(const geometry::FacedSurface& capped, const geometry::VesselTree& axes,
                 const ModelOptions& options, const Shares& shares, Stages& stages, MeshedLumen& out) {
  meshing::RemeshedSurface remeshed =
      stages.run("remeshing", shares.caps, shares.remeshing, [&](const core::TaskContext& part) {
        const meshing::TubeFunction tube(axes);
        const std::vector<double> lengths = meshing::target_edge_lengths(
            capped.mesh, tube, meshing::at_throats(options.sizing, axes, capped.mesh), part);
        return meshing::remesh(capped, lengths, options.remesh, part);
      });
  if (remeshed.report.self_intersections > 0) {
    throw GeometryError("the surface is too rough for triangles of this size: remeshing left " +
                        std::to_string(remeshed.report.self_intersections) +
                        " self-intersections; take shorter edges (--edge-ratio), or smooth it (--smooth)");
  }
  append(out.warnings, remeshed.report.warnings);
  out.surface = std::move(remeshed.surface);
  out.remeshing = remeshed.report;
  FilledVolume filled = stages.run(
      "tetrahedra", shares.remeshing, shares.tetrahedra,
      [&](const core::TaskContext& part) { return fill_volume(out.surface, capped, options.volume, part); });
  append(out.warnings, filled.warnings);
  out.mesh = std::move(filled.mesh);
  out.in_layers = std::move(filled.in_layers);
  if (filled.new_surface) out.surface = std::move(*filled.new_surface);
  out.quality.layers = std::move(filled.layers);
  out.quality.quadratic = std::move(filled.quadratic);
  stages.run("quality", shares.tetrahedra, 1.0, [&](const core::TaskContext& part) {
    judge(capped, options, part, out);
    return 0;
  });
}

MeshedLumen mesh_with(const TriMesh& lumen, const geometry::VesselTree& tree, const ModelOptions& options,
                      const Shares& shares, const AxesOf& axes_of, const core::TaskContext& task) {
  validate(options);
  MeshedLumen out;
  Stages stages(out.stages, task);
  meshing::ClippedSurface clipped =
      stages.run("ends cut", 0.0, shares.cut, [&](const core::TaskContext& part) {
        meshing::ClipOptions clip = options.clip;
        if (options.inset_radii) clip.inset_radii = *options.inset_radii;
        return meshing::clip_ends(lumen, tree, clip, part);
      });
  append(out.warnings, clipped.warnings);
  if (options.volume.solver_case) require_inlets(*options.volume.solver_case, names_of(clipped.ends));
  out.centerlines = stages.run("centerlines of the cut lumen", shares.cut, shares.axes,
                               [&](const core::TaskContext& part) { return axes_of(clipped, part); });
  geometry::VesselTree axes = out.centerlines.tree;
  if (options.extensions) extend(*options.extensions, shares, stages, clipped, axes, out);
  const geometry::FacedSurface capped =
      stages.run("caps", options.extensions ? middle_of_caps(shares) : shares.axes, shares.caps,
                 [&](const core::TaskContext& part) { return meshing::cap_ends(clipped, {}, part); });
  mesh_capped(capped, axes, options, shares, stages, out);
  return out;
}

}  // namespace

MeshedLumen mesh_lumen(const TriMesh& lumen, const geometry::VesselTree& tree, const ModelOptions& options,
                       const core::TaskContext& task) {
  const auto extracted = [&](const meshing::ClippedSurface& clipped, const core::TaskContext& part) {
    return centerlines_between(clipped, tree, options.centerline, part);
  };
  return mesh_with(lumen, tree, options, with_extraction, extracted, task);
}

MeshedLumen mesh_lumen_about(const TriMesh& lumen, const geometry::VesselTree& axes,
                             const ModelOptions& options, const core::TaskContext& task) {
  const auto known = [&](const meshing::ClippedSurface&, const core::TaskContext&) {
    centerline::CenterlineResult result;
    result.tree = axes;
    return result;
  };
  return mesh_with(lumen, axes, options, with_known_axes, known, task);
}

meshing::ClipOptions clip_of(const Source& source, const ModelOptions& options) {
  meshing::ClipOptions clip = options.clip;
  if (options.inset_radii)
    clip.inset_radii = *options.inset_radii;
  else if (source.image)
    clip.inset_radii = image_inset_radii;
  return clip;
}

LumenWithAxes build_lumen(Source source, const ModelOptions& options, const core::TaskContext& task) {
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
  stages.run("surface check", 0.6, 0.67, [&](const core::TaskContext&) {
    require_sound_surface(lumen.surface,
                          source.kind == SourceKind::surface ? "the surface" : "the lumen's surface");
    return 0;
  });
  centerline::CenterlineResult centerlines =
      stages.run("centerlines", 0.67, 1.0, [&](const core::TaskContext& part) {
        return centerline::extract_centerlines(lumen.surface, lumen.source, lumen.targets, options.centerline,
                                               part);
      });
  append(model.warnings, centerlines.diagnostics.warnings);
  if (source.kind == SourceKind::surface && !source.unit_given)
    check_vessel_size(2.0 * largest_radius(centerlines), "the surface");
  model.lumen = std::move(lumen.surface);
  model.source = std::move(source);
  made.axes = std::move(centerlines.tree);
  return made;
}

Model mesh_model(LumenWithAxes lumen, const ModelOptions& options, const core::TaskContext& task) {
  Model model = std::move(lumen.model);
  ModelOptions meshing_options = options;
  meshing_options.clip = clip_of(model.source, options);
  meshing_options.inset_radii.reset();
  model.meshed = mesh_lumen(model.lumen, lumen.axes, meshing_options, task);
  append(model.warnings, model.meshed.warnings);
  model.stages.insert(model.stages.end(), model.meshed.stages.begin(), model.meshed.stages.end());
  return model;
}

Model build_model(Source source, const ModelOptions& options, const core::TaskContext& task) {
  constexpr double lumen_share = 0.45;
  return mesh_model(build_lumen(std::move(source), options, task.sub(0.0, lumen_share)), options,
                    task.sub(lumen_share, 1.0));
}

}  // namespace ostia::pipeline
