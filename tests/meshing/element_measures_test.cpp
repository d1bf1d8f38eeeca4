#include "ostia/meshing/element_measures.h"

#include "../io/mesh_export_meshes.h"

#include "ostia/core/error.h"
#include "ostia/meshing/mixed_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

const std::vector<double>& of(const ElementMeasures& all, ElementMeasure measure) {
  return all[static_cast<std::size_t>(measure)];
}

/// Two regular tetrahedra of edge 1 on one triangle.
MixedMesh two_regular() {
  MixedMesh mesh;
  const double height = std::sqrt(2.0 / 3.0);
  const Vec3 middle(0.5, std::sqrt(3.0) / 6.0, 0.0);
  mesh.points = {{0, 0, 0},
                 {1, 0, 0},
                 {0.5, std::sqrt(0.75), 0},
                 middle + Vec3(0, 0, height),
                 middle - Vec3(0, 0, height)};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  return mesh;
}

TEST(ElementMeasures, OfRegularTetrahedraAreKnown) {
  const ElementMeasures all = element_measures(two_regular());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(of(all, ElementMeasure::least_dihedral_deg)[i],
                std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi, 1e-9);
    EXPECT_NEAR(of(all, ElementMeasure::scaled_jacobian)[i], 1.0, 1e-12);
    EXPECT_NEAR(of(all, ElementMeasure::non_orthogonality_deg)[i], 0.0, 1e-5);
    EXPECT_NEAR(of(all, ElementMeasure::skewness)[i], 0.0, 1e-9);
    EXPECT_NEAR(of(all, ElementMeasure::mean_edge_mm)[i], 1.0, 1e-12);
  }
}

TEST(ElementMeasures, AShearedPairIsAsFarFromOrthogonalAsItIsSheared) {
  MixedMesh mesh = two_regular();
  const double shift = 0.3;
  mesh.points[4].x() += shift;  // the lower centre by a quarter of it
  const ElementMeasures all = element_measures(mesh);
  const double across = 2.0 * std::sqrt(2.0 / 3.0) / 4.0;  // between the centres, along the normal
  const double angle = std::atan2(0.25 * shift, across) * 180.0 / std::numbers::pi;
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(of(all, ElementMeasure::non_orthogonality_deg)[i], angle, 1e-6) << "both share the side";
}

TEST(ElementMeasures, TheirWorstAreThoseOfTheWholeMesh) {
  for (const MixedMesh& mesh :
       {io::column_with_prisms(), io::column_of_tetrahedra(), io::quadratic(io::column_with_prisms())}) {
    const MixedQuality whole = mixed_quality(mesh);
    const ElementMeasures all = element_measures(mesh);
    for (const auto& values : all) ASSERT_EQ(values.size(), mesh.tetrahedra.size() + mesh.prisms.size());
    const auto range = [&](ElementMeasure measure, bool tetrahedra) {
      const auto& values = of(all, measure);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(mesh.tetrahedra.size());
      const auto [least, most] = tetrahedra ? std::minmax_element(values.begin(), middle)
                                            : std::minmax_element(middle, values.end());
      return std::pair(*least, *most);
    };
    EXPECT_EQ(range(ElementMeasure::least_dihedral_deg, true).first, whole.tetrahedra.min_dihedral_deg);
    EXPECT_EQ(range(ElementMeasure::scaled_jacobian, true).first, whole.tetrahedra.min_scaled_jacobian);
    if (!mesh.prisms.empty()) {
      EXPECT_EQ(range(ElementMeasure::least_dihedral_deg, false).first, whole.prisms.min_dihedral_deg);
      EXPECT_EQ(range(ElementMeasure::scaled_jacobian, false).first, whole.prisms.min_scaled_jacobian);
    }
    const auto& bent = of(all, ElementMeasure::non_orthogonality_deg);
    EXPECT_NEAR(*std::max_element(bent.begin(), bent.end()), whole.openfoam.max_non_orthogonality_deg, 1e-9);
    const auto& skew = of(all, ElementMeasure::skewness);
    EXPECT_NEAR(*std::max_element(skew.begin(), skew.end()), whole.openfoam.max_skewness, 1e-12);
  }
}

TEST(ElementMeasures, RefuseWhatCannotBeMeasuredAndAreCancelled) {
  MixedMesh mesh = two_regular();
  mesh.tetrahedra[1][3] = 7;
  EXPECT_THROW(element_measures(mesh), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(element_measures(two_regular(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
