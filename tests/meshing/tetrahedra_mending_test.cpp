#include "tetrahedra_mending.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

namespace ostia::meshing {
namespace {

/// A regular tetrahedron cut into four by a point inside.
geometry::VolumeMesh four_tetrahedra(const geometry::Vec3& inner) {
  const auto surface = tetrahedron_surface(1.0);
  geometry::VolumeMesh mesh;
  mesh.points = surface.points;
  mesh.points.push_back(inner);
  mesh.boundary = surface.triangles;
  mesh.boundary_face_ids.assign(4, 1);
  for (const auto& t : surface.triangles) mesh.tetrahedra.push_back({t[0], t[2], t[1], 4});
  return mesh;
}

TEST(TetrahedraMending, CentresAPointThatStandsTooNearAFace) {
  auto mesh = four_tetrahedra({-0.095, -0.10, -0.09});
  ASSERT_EQ(volume_quality(mesh).inverted, 0u);
  const double before = volume_quality(mesh).min_dihedral_deg;
  ASSERT_LT(before, 15.0);
  const auto corners = tetrahedron_surface(1.0).points;
  EXPECT_EQ(mend_tetrahedra(mesh, 40.0, 20), 1u);
  EXPECT_LT(mesh.points[4].norm(), 0.02);  // by symmetry the best place is the centre
  EXPECT_GT(volume_quality(mesh).min_dihedral_deg, before + 10.0);
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), mesh.points.begin()));
}

TEST(TetrahedraMending, RightsAnInvertedTetrahedron) {
  auto mesh = four_tetrahedra({-0.15, -0.15, -0.14});
  ASSERT_GT(volume_quality(mesh).inverted, 0u);
  mend_tetrahedra(mesh, 20.0, 30);
  EXPECT_EQ(volume_quality(mesh).inverted, 0u);
}

TEST(TetrahedraMending, LeavesGoodMeshesAndObeysCancel) {
  auto mesh = four_tetrahedra({0.0, 0.0, 0.0});
  EXPECT_EQ(mend_tetrahedra(mesh, 20.0, 5), 0u);
  mesh = four_tetrahedra({-0.095, -0.10, -0.09});
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(mend_tetrahedra(mesh, 40.0, 5, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
