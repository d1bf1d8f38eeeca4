#include "ostia/experiments/vessel_chain.h"

#include "motion/level_set_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/experiments/smoothness.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/diffusion.h"
#include "ostia/imaging/morphology.h"
#include "ostia/pipeline/skeleton.h"
#include "ostia/reconstruction/surface.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/segment.h"
#include "ostia/segmentation/tissue_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ostia::experiments {
namespace {

using imaging::ImageVolume;
using imaging::MaskVolume;
using imaging::Region;
using segmentation::Owner;

bool owned_by(std::uint8_t voxel, Owner owner) {
  return voxel == static_cast<std::uint8_t>(owner);
}

MaskVolume owned(const MaskVolume& owners, Owner owner) {
  MaskVolume mask{owners.geometry, std::vector<std::uint8_t>(owners.voxels.size())};
  std::transform(owners.voxels.begin(), owners.voxels.end(), mask.voxels.begin(),
                 [&](std::uint8_t voxel) { return static_cast<std::uint8_t>(owned_by(voxel, owner)); });
  return mask;
}

/// The box of what the seeds own, and `margin` voxels more.
Region box_of(const MaskVolume& owners, std::int64_t margin) {
  const auto& size = owners.geometry.size;
  Region box{size, {0, 0, 0}};
  for (std::size_t i = 0; i < owners.voxels.size(); ++i) {
    if (!owned_by(owners.voxels[i], Owner::seeds)) continue;
    std::int64_t rest = static_cast<std::int64_t>(i);
    for (std::size_t a = 0; a < 3; rest /= size[a], ++a) {
      box.lower[a] = std::min(box.lower[a], rest % size[a]);
      box.upper[a] = std::max(box.upper[a], rest % size[a] + 1);
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] = std::max<std::int64_t>(0, box.lower[a] - margin);
    box.upper[a] = std::min(size[a], box.upper[a] + margin);
  }
  return box;
}

double median_where(const ImageVolume& image, const std::vector<std::uint8_t>& where) {
  std::vector<std::int16_t> values;
  for (std::size_t i = 0; i < where.size(); ++i)
    if (where[i] != 0) values.push_back(image.voxels[i]);
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What lies about the vessels wanted, clear of their blurred rims and of all others.
std::vector<std::uint8_t> surroundings(const MaskVolume& own, const MaskVolume& rivals) {
  const double voxel = own.geometry.spacing.maxCoeff();
  const MaskVolume near = imaging::dilated(own, 2.0 * voxel), far = imaging::dilated(own, 5.0 * voxel),
                   others = imaging::dilated(rivals, 2.0 * voxel);
  std::vector<std::uint8_t> out(far.voxels);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (near.voxels[i] != 0 || others.voxels[i] != 0) out[i] = 0;
  return out;
}

/// The image about the vessels, without those that are not wanted.
struct Cleared {
  ImageVolume image;
  MaskVolume own;
};

Cleared cleared(const ImageVolume& image, const MaskVolume& owners, ChainResult& out) {
  const Region box = box_of(owners, 8);
  const MaskVolume near = imaging::cropped(owners, box);
  Cleared result{imaging::cropped(image, box), owned(near, Owner::seeds)};
  const MaskVolume rivals = owned(near, Owner::rivals);
  out.vessel_hu = median_where(result.image, result.own.voxels);
  out.background_hu = median_where(result.image, surroundings(result.own, rivals));
  // The rivals' blurred rim goes with them, but not what the seeds own.
  MaskVolume gone = imaging::dilated(rivals, 1.5 * image.geometry.spacing.maxCoeff());
  for (std::size_t i = 0; i < gone.voxels.size(); ++i)
    if (result.own.voxels[i] != 0) gone.voxels[i] = 0;
  result.image = segmentation::without_tissues(result.image, gone, out.background_hu);
  return result;
}

imaging::FloatVolume wall_of(const Cleared& vessels, const ChainOptions& options, ChainResult& out,
                             const core::TaskContext& task) {
  imaging::FloatVolume start{vessels.own.geometry, std::vector<float>(vessels.own.voxels.size())};
  std::transform(vessels.own.voxels.begin(), vessels.own.voxels.end(), start.voxels.begin(),
                 [](std::uint8_t voxel) { return voxel != 0 ? -0.5F : 0.5F; });
  segmentation::EdgeFeature edge;
  edge.noise_hu_per_mm = std::max(
      1.0, 0.1 * std::abs(out.vessel_hu - out.background_hu) / vessels.own.geometry.spacing.maxCoeff());
  segmentation::LevelSetOptions how;
  how.curvature = options.curvature;
  how.curvature_term = segmentation::CurvatureTerm::minimal;
  how.iterations_max = options.iterations;
  segmentation::LevelSetResult wall = segmentation::level_set(start, vessels.image, edge, how, task);
  out.iterations = wall.iterations;
  return std::move(wall.level_set);
}

Vec3 centre_of(const imaging::Geometry& grid, std::size_t voxel) {
  const auto i = static_cast<std::int64_t>(voxel);
  return grid.world(Vec3(static_cast<double>(i % grid.size[0]),
                         static_cast<double>(i / grid.size[0] % grid.size[1]),
                         static_cast<double>(i / grid.size[0] / grid.size[1])));
}

/// What a ball of that radius reaches inside of the surface: thin twigs and their stubs go, the rest stays
/// where it is. The level set must be a signed distance that far.
void open_by(imaging::FloatVolume& level_set, double radius_mm, const core::TaskContext& task) {
  imaging::FloatVolume inner = level_set;
  for (float& phi : inner.voxels) phi += static_cast<float>(radius_mm);
  if (std::none_of(inner.voxels.begin(), inner.voxels.end(), [](float phi) { return phi < 0.0F; }))
    throw InvalidInput("vessel chain: no vessel is as wide as thinnest_mm");
  const geometry::AabbTree core_surface(isosurface_of(inner, task));
  const double reach = 3.0 * level_set.geometry.spacing.maxCoeff() + radius_mm;
  core::parallel_chunks(inner.voxels.size(), 4096, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      // Far inside and far outside nothing changes but the distance's cap.
      const auto near = inner.voxels[i] < 0.0F && level_set.voxels[i] < -2.0F * static_cast<float>(radius_mm)
                            ? std::nullopt
                            : core_surface.closest_within(centre_of(level_set.geometry, i), reach);
      const double away = near ? near->distance : reach;
      if (inner.voxels[i] >= 0.0F)
        level_set.voxels[i] = static_cast<float>(away - radius_mm);
      else if (near)
        level_set.voxels[i] = static_cast<float>(-away - radius_mm);
    }
  });
}

/// Without the parts of the inside that come no nearer to a seed than `reach_mm`.
void keep_parts_at(imaging::FloatVolume& level_set, const std::vector<Vec3>& seeds, double reach_mm) {
  const imaging::Components parts = imaging::components(mask_inside(level_set));
  std::vector<bool> kept(parts.voxels.size(), false);
  for (std::size_t i = 0; i < level_set.voxels.size(); ++i) {
    if (parts.label[i] == 0 || kept[parts.label[i]]) continue;
    const Vec3 at = centre_of(level_set.geometry, i);
    kept[parts.label[i]] = std::any_of(seeds.begin(), seeds.end(),
                                       [&](const Vec3& seed) { return (seed - at).norm() <= reach_mm; });
  }
  if (std::none_of(kept.begin(), kept.end(), [](bool one) { return one; }))
    throw InvalidInput("vessel chain: no vessel at a seed is as wide as thinnest_mm");
  for (std::size_t i = 0; i < level_set.voxels.size(); ++i)
    if (parts.label[i] != 0 && !kept[parts.label[i]]) level_set.voxels[i] = -level_set.voxels[i];
}

pipeline::SkeletonOptions skeleton_options(const ChainOptions& options) {
  pipeline::SkeletonOptions how;
  how.open_loops = true;  // arteries make none: what does are branches that touch
  how.prune.length_mm = options.prune_mm;
  how.gaps.distance_mm = options.gap_mm;
  how.sections.sigma_mm = options.sigma_mm;
  how.smooth->knot_spacing_mm = options.knots_mm;
  return how;
}

geometry::VesselGraph network_in(const imaging::FloatVolume& level_set, const ChainOptions& options,
                                 ChainResult& out, const core::TaskContext& task) {
  const pipeline::SkeletonOptions how = skeleton_options(options);
  const pipeline::SkeletonResult lines =
      pipeline::skeleton_of(mask_inside(level_set), nullptr, how, task.sub(0.0, 0.8));
  out.lines = static_cast<std::int64_t>(lines.skeleton.graph.edges.size());
  out.components = lines.components;
  out.loops = lines.loops;
  out.length_mm = lines.length_mm;
  centerline::SectionOptions sections = how.sections;
  sections.move_points = false;  // the lines were smoothed
  return network_of(
      centerline::measured(lines.skeleton.graph, share_inside(level_set), sections, task.sub(0.8, 1.0)).graph,
      0.5 * options.knots_mm);
}

ChainSurface reconstructed(const reconstruction::FittedSections& fit, const ChainMesh& mesh, bool elliptic,
                           const geometry::TriMesh& isosurface, const core::TaskContext& task) {
  reconstruction::ReconstructionOptions how;
  how.sides = mesh.sides;
  how.spacing = mesh.spacing;
  how.level = mesh.level;
  ChainSurface out;
  out.how = mesh;
  const core::TaskContext part = task.sub(0.0, 0.5);
  out.made = elliptic ? reconstruction::reconstruct_surface(fit.graph, fit.sections, how, part)
                      : reconstruction::reconstruct_surface(fit.graph, how, part);
  const geometry::TriMesh& surface = out.made.surface.mesh;
  out.triangles = surface.triangles.size();
  out.share = static_cast<double>(out.triangles) / static_cast<double>(isosurface.triangles.size());
  out.apart = evaluation::compare_surfaces(isosurface, surface, {}, task.sub(0.5, 1.0));
  out.closed = geometry::find_faults(surface, false).closed_manifold();
  out.self_intersections = geometry::self_intersections(surface).size();
  return out;
}

}  // namespace

void validate(const ChainOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("vessel chain: ") + what);
  };
  segmentation::validate(o.growth);
  require(o.diffusion_iterations >= 0 && o.diffusion_iterations <= 1000,
          "diffusion_iterations must lie in [0, 1000]");
  require(o.thinnest_mm >= 0.0 && o.thinnest_mm <= 20.0, "thinnest_mm must lie in [0, 20]");
  require(std::isfinite(o.curvature) && o.curvature >= 0.0, "curvature must not be negative");
  require(o.iterations >= 0, "iterations must not be negative");
  require(o.knots_mm > 0.0, "knots_mm must be positive");
  require(!o.meshes.empty(), "meshes must not be empty");
  for (const ChainMesh& mesh : o.meshes) {
    reconstruction::ReconstructionOptions how;
    how.sides = mesh.sides;
    how.spacing = mesh.spacing;
    how.level = mesh.level;
    reconstruction::validate(how);
  }
}

ChainResult run_vessel_chain(const ImageVolume& scan, const std::vector<Vec3>& seeds,
                             const std::vector<Vec3>& rivals, const ChainOptions& options,
                             const core::TaskContext& task) {
  validate(options);
  ChainResult out;
  task.set_stage("denoising");
  ImageVolume smooth;
  if (options.diffusion_iterations > 0) {
    imaging::DiffusionOptions how;
    how.iterations = options.diffusion_iterations;
    smooth = imaging::diffused(scan, how, task.sub(0.0, 0.3));
  }
  const ImageVolume& image = smooth.voxels.empty() ? scan : smooth;
  task.set_stage("segmenting");
  const MaskVolume owners =
      segmentation::grown_against(image, seeds, rivals, options.growth, task.sub(0.3, 0.35));
  for (const std::uint8_t owner : owners.voxels) {
    out.own_voxels += owned_by(owner, Owner::seeds) ? 1 : 0;
    out.rival_voxels += owned_by(owner, Owner::rivals) ? 1 : 0;
  }
  const Cleared vessels = cleared(image, owners, out);
  imaging::FloatVolume level_set = wall_of(vessels, options, out, task.sub(0.35, 0.58));
  if (options.thinnest_mm > 0.0) open_by(level_set, 0.5 * options.thinnest_mm, task.sub(0.58, 0.6));
  keep_parts_at(level_set, seeds, std::max(options.thinnest_mm, options.growth.snap_mm));
  out.isosurface = isosurface_of(level_set, task.sub(0.6, 0.62));
  task.set_stage("skeleton");
  const geometry::VesselGraph network = network_in(level_set, options, out, task.sub(0.62, 0.7));
  task.set_stage("reconstructing");
  const reconstruction::FittedSections fit =
      reconstruction::fit_elliptic_sections(network, out.isosurface, {}, task.sub(0.7, 0.75));
  out.network = fit.graph;
  const double share = 0.25 / static_cast<double>(options.meshes.size());
  for (std::size_t i = 0; i < options.meshes.size(); ++i) {
    const double at = 0.75 + share * static_cast<double>(i);
    out.surfaces.push_back(
        reconstructed(fit, options.meshes[i], options.elliptic, out.isosurface, task.sub(at, at + share)));
  }
  return out;
}

const ChainSurface* nearest_within(const ChainResult& result, double share) {
  const ChainSurface* best = nullptr;
  for (const ChainSurface& surface : result.surfaces)
    if (surface.share <= share && (best == nullptr || surface.apart.rms_sd_mm < best->apart.rms_sd_mm))
      best = &surface;
  return best;
}

}  // namespace ostia::experiments
