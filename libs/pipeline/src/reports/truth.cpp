#include "ostia/pipeline/truth.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::pipeline {
namespace {

using geometry::Centerline;
using geometry::Vec3;

constexpr double surface_spacing_mm = 0.25;
constexpr double clear_of_ends_radii = 2.0;
constexpr double clear_of_bifurcation_radii = 2.5;

/// Points of the vessels that the model covers: not within two radii of where it was cut.
evaluation::Region away_from(const std::vector<meshing::EndPlane>& planes) {
  return [planes](const Vec3& p) {
    return std::none_of(planes.begin(), planes.end(), [&](const meshing::EndPlane& plane) {
      const Vec3 offset = p - plane.origin;
      const double reach = clear_of_ends_radii * plane.radius_mm;
      return offset.norm() < 3.0 * reach && offset.dot(plane.normal) > -reach;
    });
  };
}

}  // namespace

TruthErrors compare_with_truth(const phantom::BuiltinCase& truth, const Model& model,
                               const core::TaskContext& task) {
  TruthErrors out;
  const std::vector<meshing::EndPlane> planes = meshing::end_planes(model.meshed.centerlines.tree, 0.0);
  evaluation::SurfaceDistanceOptions distance_options;
  distance_options.reference_region = distance_options.result_region = away_from(planes);
  const geometry::TriMesh exact = geometry::surface_of(truth.truth, surface_spacing_mm, false);
  out.lumen = evaluation::compare_surfaces(exact, model.lumen, distance_options, task);

  const auto counts = distance_options.result_region;
  const Vec3 fork = truth.truth.tubes[1].axis.points.front();
  const double fork_radius = truth.truth.tubes[1].axis.radius.front();
  std::vector<evaluation::AxisDeviation> deviations;
  out.true_throat_radius_mm = truth.stenosis.throat_radius_mm;
  out.throat_radius_mm = std::numeric_limits<double>::infinity();
  for (std::size_t line = 0; line < std::min(model.meshed.centerlines.lines.size(), truth.truth.tubes.size());
       ++line) {
    const Centerline& found = model.meshed.centerlines.lines[line];
    const Centerline& axis = truth.truth.tubes[line].axis;
    for (const evaluation::AxisDeviation& d : evaluation::compare_axes(axis, found)) {
      const std::size_t at = static_cast<std::size_t>(
          std::lower_bound(found.abscissa.begin(), found.abscissa.end(), d.abscissa_mm) -
          found.abscissa.begin());
      const Vec3& p = found.points[std::min(at, found.size() - 1)];
      const bool own_part =
          line == 0 || d.reference_abscissa_mm > 0.0;  // the branch begins on the main vessel
      if (own_part && counts(p) && (p - fork).norm() > clear_of_bifurcation_radii * fork_radius)
        deviations.push_back(d);
      if (line == truth.stenosis.tube &&
          std::abs(d.reference_abscissa_mm - truth.stenosis.centre_mm) < 0.25 * truth.stenosis.length_mm) {
        out.throat_radius_mm = std::min(out.throat_radius_mm, d.radius_mm);
      }
    }
  }
  out.axis = evaluation::summarize(deviations);
  out.throat_relative =
      std::abs(out.throat_radius_mm - out.true_throat_radius_mm) / out.true_throat_radius_mm;
  return out;
}

Source source_of(const phantom::BuiltinCase& builtin) {
  Source source;
  source.kind = SourceKind::image;
  const auto& voxels = builtin.image.voxels;
  source.sha256 =
      core::sha256({reinterpret_cast<const char*>(voxels.data()), voxels.size() * sizeof voxels[0]});
  source.pseudonym = "builtin-" + source.sha256.substr(0, 8);
  source.image = std::make_shared<const imaging::ImageVolume>(builtin.image);
  return source;
}

std::vector<segmentation::BranchSeeds> branches_of(const phantom::BuiltinCase& builtin) {
  std::vector<segmentation::BranchSeeds> branches;
  for (const auto& [from, to] : builtin.branches) branches.push_back({from, std::nullopt, to});
  return branches;
}

}  // namespace ostia::pipeline
