#include "quality/mixed_sides.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/meshing/element_measures.h"
#include "ostia/meshing/mixed_quality.h"

#include <algorithm>
#include <limits>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

/// Elements that share a point with no element of a layer, and prisms.
std::vector<bool> away_from_layers(const MixedMesh& mesh, const std::vector<bool>& in_layers) {
  std::vector<bool> touched(mesh.points.size(), false);
  for (std::size_t i = 0; i < in_layers.size(); ++i) {
    if (!in_layers[i]) continue;
    for (const std::int32_t p : mesh.tetrahedra[i]) touched[static_cast<std::size_t>(p)] = true;
  }
  std::vector<bool> away(mesh.tetrahedra.size() + mesh.prisms.size(), true);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
    away[i] = std::ranges::count_if(mesh.tetrahedra[i],
                                    [&](std::int32_t p) { return touched[static_cast<std::size_t>(p)]; }) < 3;
  return away;
}

}  // namespace

void mark_layers(const MixedMesh& mesh, const std::vector<bool>& in_layers, MixedQuality& quality,
                 const core::TaskContext& task) {
  if (in_layers.size() != mesh.tetrahedra.size())
    throw InvalidInput("mesh quality: " + std::to_string(in_layers.size()) + " marks of layers for " +
                       std::to_string(mesh.tetrahedra.size()) + " tetrahedra");
  const ElementMeasures all = element_measures(mesh, task);
  const auto of = [&](ElementMeasure measure) -> const std::vector<double>& {
    return all[static_cast<std::size_t>(measure)];
  };
  const std::vector<bool> away = away_from_layers(mesh, in_layers);
  LayerTetrahedra layers;
  layers.others_min_dihedral_deg = layers.others_min_scaled_jacobian =
      std::numeric_limits<double>::infinity();
  const auto lower = [](double value, double& least, Vec3& at, const Vec3& here) {
    if (value < least) least = value, at = here;
  };
  const auto raise = [](double value, double& most, Vec3& at, const Vec3& here) {
    if (value > most) most = value, at = here;
  };
  for (std::size_t i = 0; i < away.size(); ++i) {
    const Vec3 here = geometry::element_centre(mesh, i);
    const bool tetrahedron = i < in_layers.size();
    if (tetrahedron && in_layers[i]) {
      ++layers.count;
      const geometry::Tetrahedron& t = mesh.tetrahedra[i];
      const auto p = [&](std::size_t k) -> const Vec3& {
        return mesh.points[static_cast<std::size_t>(t[k])];
      };
      raise(dihedral_range_deg(p(0), p(1), p(2), p(3))[1], layers.max_dihedral_deg, layers.bluntest_at, here);
    } else if (tetrahedron) {
      lower(of(ElementMeasure::least_dihedral_deg)[i], layers.others_min_dihedral_deg,
            layers.others_sharpest_at, here);
      lower(of(ElementMeasure::scaled_jacobian)[i], layers.others_min_scaled_jacobian, layers.others_worst_at,
            here);
    }
    if (away[i])
      raise(of(ElementMeasure::non_orthogonality_deg)[i], layers.others_max_non_orthogonality_deg,
            layers.others_least_orthogonal_at, here);
  }
  if (layers.count > 0) quality.layers = layers;
}

}  // namespace ostia::meshing
