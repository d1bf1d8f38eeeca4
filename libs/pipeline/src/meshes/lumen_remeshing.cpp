#include "meshes/lumen_remeshing.h"

#include "mask/lumen_fill.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/stenosis_sizing.h"
#include "ostia/meshing/volume_keeping.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr int smoothing_attempts = 4;
constexpr double smoothing_pass_band = 0.05;

/// Where triangles of the wanted size lose more of the shape than may be, as in sharp crotches, they get
/// smaller, round by round, and nowhere else.
meshing::RemeshedSurface remeshed_in_shape(const geometry::FacedSurface& capped,
                                           const meshing::TubeFunction& tube, std::vector<double> lengths,
                                           const ModelOptions& options, const core::TaskContext& task) {
  constexpr int most_rounds = 4;
  constexpr double aimed_share = 0.8;
  std::optional<std::vector<double>> radii;
  std::optional<meshing::RemeshedSurface> before;
  for (int round = 1;; ++round) {
    const core::TaskContext part = task.sub(round == 1 ? 0.0 : 0.7, 1.0);
    meshing::RemeshedSurface made = meshing::remesh(capped, lengths, options.remesh, part);
    if (made.report.self_intersections > 0) return before ? std::move(*before) : std::move(made);
    // Of the second order the wall's nodes follow the surface, and points belong on it.
    if (options.volume.order == 1) meshing::keep_volume(made.surface, capped, task);
    if (round == most_rounds) return made;
    if (!radii) radii = vessel_widths(capped.mesh, tube, task);
    const std::size_t shortened =
        meshing::shorten_where_off(capped, made.surface, *radii, aimed_share, lengths, task);
    if (shortened == 0) return made;
    before = std::move(made);
    for (double& length : lengths) length = std::max(length, options.sizing.min_edge_mm);
    meshing::limit_gradation(capped.mesh, options.sizing.gradation, lengths);
    core::log_debug("remeshing again with shorter edges at " + std::to_string(shortened) + " points");
  }
}

bool gate_takes(const meshing::RemeshedSurface& made, const meshing::QualityBounds& bounds) {
  if (made.report.self_intersections > 0) return false;
  const meshing::SurfaceQuality quality = meshing::surface_quality(made.surface.mesh, false);
  return quality.min_angle_deg >= bounds.min_angle_deg &&
         quality.max_frobenius_aspect <= bounds.max_frobenius_aspect;
}

/// Which triangles come out flat is chance where the wall bends sharply: somewhat shorter edges put points
/// elsewhere. The first that the gate takes; else `made` as it is.
meshing::RemeshedSurface with_other_points(meshing::RemeshedSurface made,
                                           const geometry::FacedSurface& capped,
                                           const meshing::TubeFunction& tube,
                                           const std::vector<double>& lengths, const ModelOptions& options,
                                           const core::TaskContext& task) {
  for (const double factor : {0.94, 0.88}) {
    std::vector<double> shorter = lengths;
    for (double& length : shorter) length = std::max(factor * length, options.sizing.min_edge_mm);
    meshing::RemeshedSurface other = remeshed_in_shape(capped, tube, std::move(shorter), options, task);
    if (!gate_takes(other, options.bounds)) continue;
    core::log_debug("remeshed with edges of " + core::fixed_text(factor, 2) +
                    " of their length, for triangles that are not flat");
    return other;
  }
  return made;
}

/// Edge lengths by the distance to the axes, whatever the lumen's width is there.
std::shared_ptr<const meshing::SizeArray> by_distance_alone(const TriMesh& surface,
                                                            const meshing::TubeFunction& tube,
                                                            const meshing::SizingOptions& sizing) {
  auto array = std::make_shared<meshing::SizeArray>();
  array->surface = surface;
  for (const geometry::Vec3& p : surface.points) {
    const meshing::TubeSize size = tube(p);
    array->edge_mm.push_back(sizing.edge_ratio * std::clamp(size.distance_mm, 0.05 * size.radius_mm,
                                                            sizing.most_distance_radii * size.radius_mm));
  }
  return array;
}

/// How far points are from where they were, in the mean and at most, in words.
std::string moves_in_words(const TriMesh& before, const TriMesh& after) {
  double sum = 0.0, most = 0.0;
  for (std::size_t p = 0; p < before.points.size(); ++p) {
    const double mm = (after.points[p] - before.points[p]).norm();
    sum += mm;
    most = std::max(most, mm);
  }
  return core::fixed_text(sum / static_cast<double>(before.points.size()), 2) + " mm in the mean, " +
         core::fixed_text(most, 2) + " mm at most";
}

/// Smoothed more and more, at last with shorter edges too; nothing where triangles cross even then.
std::optional<meshing::RemeshedSurface> remeshed_smoothed(const geometry::FacedSurface& capped,
                                                          const meshing::TubeFunction& tube,
                                                          const meshing::SizingOptions& sizing,
                                                          const ModelOptions& options,
                                                          std::vector<std::string>& warnings,
                                                          const core::TaskContext& task) {
  geometry::VolumeSmoothingOptions how;
  how.free = geometry::points_of_wall_alone(capped);
  for (int attempt = 1; attempt <= smoothing_attempts; ++attempt) {
    const bool shorter = attempt == smoothing_attempts;
    how.filter = {.iterations = 20 << attempt, .pass_band = smoothing_pass_band};
    geometry::FacedSurface smooth = capped;
    smooth.mesh = geometry::smoothed_in_volume(capped.mesh, how, task);
    std::vector<double> lengths = meshing::target_edge_lengths(smooth.mesh, tube, sizing, task);
    if (shorter)
      for (double& length : lengths) length *= 0.5;
    meshing::RemeshedSurface made = remeshed_in_shape(smooth, tube, std::move(lengths), options, task);
    if (made.report.self_intersections > 0) continue;
    warnings.push_back(
        "the wall is too rough for triangles of this size: it was smoothed in its volume, by " +
        moves_in_words(capped.mesh, smooth.mesh) + (shorter ? ", and has edges half as long" : ""));
    return made;
  }
  return std::nullopt;
}

}  // namespace

meshing::RemeshedSurface remeshed_lumen(const geometry::FacedSurface& capped,
                                        const meshing::TubeFunction& tube, const geometry::VesselTree& axes,
                                        const ModelOptions& options, std::vector<std::string>& warnings,
                                        const core::TaskContext& task) {
  meshing::SizingOptions sizing = meshing::at_throats(options.sizing, axes, capped.mesh);
  const auto lengths = [&] { return meshing::target_edge_lengths(capped.mesh, tube, sizing, task); };
  const auto made_with = [&] { return remeshed_in_shape(capped, tube, lengths(), options, task); };
  meshing::RemeshedSurface made = made_with();
  if (gate_takes(made, options.bounds)) return made;
  if (made.report.self_intersections == 0)
    return with_other_points(std::move(made), capped, tube, lengths(), options, task);
  const bool by_distance = !sizing.array && sizing.measure == meshing::SizeMeasure::distance;
  if (by_distance) {
    // What lies far from all axes is too rough for triangles of its own size: noise, or a leak. Larger ones
    // may pass over it; what is lost by that the gate tells.
    meshing::SizingOptions far = sizing;
    far.array = by_distance_alone(capped.mesh, tube, sizing);
    std::swap(far, sizing);
    made = made_with();
    if (made.report.self_intersections == 0) {
      warnings.emplace_back(
          "the wall far from the axes is too rough for triangles of its own size; larger ones follow the "
          "distance from the axes there, and may lose some of it");
      return made;
    }
    std::swap(far, sizing);
  }
  if (auto smooth = remeshed_smoothed(capped, tube, sizing, options, warnings, task))
    return std::move(*smooth);
  throw GeometryError(
      "the surface is too rough for triangles of this size: remeshing left " +
      std::to_string(made.report.self_intersections) +
      " self-intersections, and smoothing the wall did not help; take shorter edges (--edge-ratio 0.1)");
}

}  // namespace ostia::pipeline
