#include "mask/lumen_fill.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/meshing/fold_opening.h"
#include "ostia/pipeline/volume_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <utility>

namespace ostia::pipeline {
namespace {

/// Opened from here on: as far as layers need it, then what they would rather have.
constexpr std::array<double, 3> opened_below{0.11, 0.3, 0.5};
constexpr double opened_about_mm = 4.0;  // from where the gate found fault

/// A lumen filled, on its way to a MeshedLumen.
struct FilledLumen {
  geometry::FacedSurface surface;
  geometry::MixedMesh mesh;
  std::vector<bool> in_layers;
  MeshQuality quality;
  std::vector<std::string> warnings;
};

/// The gate that a mesh passes before it is written.
void judge(const geometry::FacedSurface& capped, const meshing::TubeFunction& tube,
           const ModelOptions& options, const core::TaskContext& task, FilledLumen& out) {
  MeshQuality& quality = out.quality;
  quality.surface = meshing::surface_quality(out.surface.mesh, true, task.sub(0.0, 0.3));
  quality.volume = meshing::mixed_quality(out.mesh, task.sub(0.3, 0.7));
  if (!out.in_layers.empty())
    meshing::mark_layers(out.mesh, out.in_layers, quality.volume, task.sub(0.65, 0.7));
  quality.refinement = options.volume.refinement;
  if (quality.refinement)
    quality.refinement->elements = quality.volume.tetrahedra.count + quality.volume.prisms.count;
  quality.wall_deviation = meshing::wall_deviation(out.mesh, wall_of(capped), task.sub(0.7, 0.85));
  quality.shape =
      meshing::shape_kept(out.mesh, capped, vessel_widths(capped.mesh, tube, task), task.sub(0.85, 1.0));
  quality.shape->volume_mm3 = quality.volume.volume_mm3();
  quality.verdict = meshing::check(quality.surface, options.bounds);
  append(quality.verdict.reasons, meshing::check(quality.volume, options.volume_bounds).reasons);
  append(quality.verdict.reasons, meshing::check(*quality.shape, options.shape_bounds).reasons);
}

/// Where a mesh is worst, whatever of it the gate refuses.
std::vector<geometry::Vec3> worst_places(const meshing::MixedQuality& quality) {
  return {quality.prisms.worst_at, quality.tetrahedra.worst_at, quality.tetrahedra.sharpest_at,
          quality.openfoam.most_skewed_at, quality.openfoam.least_orthogonal_at};
}

class Filling {
 public:
  Filling(const geometry::FacedSurface& capped, const std::optional<Extended>& extended,
          const meshing::TubeFunction& tube, const ModelOptions& options, const Shares& shares,
          Stages& stages)
      : capped_(capped),
        extended_(extended),
        tube_(tube),
        options_(options),
        shares_(shares),
        stages_(stages) {}

  FilledLumen filled(FilledLumen out) {
    FilledVolume filled =
        stages_.run("tetrahedra", shares_.remeshing, shares_.tetrahedra, [&](const core::TaskContext& part) {
          return fill_volume(out.surface, capped_, options_.volume, part);
        });
    append(out.warnings, filled.warnings);
    out.mesh = std::move(filled.mesh);
    out.in_layers = std::move(filled.in_layers);
    if (filled.new_surface) out.surface = std::move(*filled.new_surface);
    if (extended_) meshing::mark_extension_walls(extended_->before, extended_->after, out.surface, out.mesh);
    out.quality.layers = std::move(filled.layers);
    out.quality.quadratic = std::move(filled.quadratic);
    stages_.run("quality", shares_.tetrahedra, 1.0, [&](const core::TaskContext& part) {
      judge(capped_, tube_, options_, part, out);
      return 0;
    });
    return out;
  }

  /// Of the second order the wall's nodes follow the surface, and points belong on it.
  bool opens_folds() const { return options_.volume.layers && options_.volume.order == 1; }

  /// Opens folds wider about the places where the best attempt so far is worst, or everywhere where there is
  /// none. Returns whether any point moved.
  bool open(FilledLumen& lumen, double below, const std::optional<FilledLumen>& best) const {
    meshing::FoldOptions how;
    how.open_below = below;
    if (best) {
      how.about = worst_places(best->quality.volume);
      how.about_mm = opened_about_mm;
    }
    const meshing::OpenedFolds opened = meshing::open_folds(lumen.surface, how);
    append(lumen.warnings, opened.warnings);
    return opened.moved > 0;
  }

 private:
  const geometry::FacedSurface& capped_;
  const std::optional<Extended>& extended_;
  const meshing::TubeFunction& tube_;
  const ModelOptions& options_;
  const Shares& shares_;
  Stages& stages_;
};

}  // namespace

std::vector<double> vessel_widths(const geometry::TriMesh& surface, const meshing::TubeFunction& tube,
                                  const core::TaskContext& task) {
  constexpr double least_share = 1.0 / 3.0;
  std::vector<double> radii = meshing::local_radii(surface, tube, task);
  for (std::size_t i = 0; i < radii.size(); ++i)
    radii[i] = std::max(radii[i], least_share * tube(surface.points[i]).radius_mm);
  return radii;
}

void fill_and_judge(const geometry::FacedSurface& capped, const std::optional<Extended>& extended,
                    const meshing::TubeFunction& tube, const ModelOptions& options, const Shares& shares,
                    Stages& stages, MeshedLumen& out) {
  Filling filling(capped, extended, tube, options, shares, stages);
  FilledLumen lumen{std::move(out.surface), {}, {}, out.quality, {}};
  std::optional<FilledLumen> best;
  if (!filling.opens_folds()) {
    best = filling.filled(std::move(lumen));
  } else {
    std::exception_ptr fault;
    for (const double below : opened_below) {
      const bool moved = filling.open(lumen, below, best);
      if (below > opened_below.front() && !moved) continue;
      try {
        FilledLumen made = filling.filled(lumen);
        const bool passes = made.quality.verdict.ok();
        if (passes || !best || made.quality.verdict.reasons.size() < best->quality.verdict.reasons.size())
          best = std::move(made);
        if (passes) break;
      } catch (const GeometryError& error) {
        core::log_debug(std::string("filling: ") + error.what());
        fault = std::current_exception();
      }
    }
    if (!best) std::rethrow_exception(fault);
  }
  out.surface = std::move(best->surface);
  out.mesh = std::move(best->mesh);
  out.in_layers = std::move(best->in_layers);
  out.quality = std::move(best->quality);
  append(out.warnings, best->warnings);
}

}  // namespace ostia::pipeline
