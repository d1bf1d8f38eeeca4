#include "ostia/view/mesh_shell.h"

#include "grid_mesh.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

std::shared_ptr<const ShownMesh> grid(std::int32_t nx, std::int32_t ny, std::int32_t nz) {
  return prepared(testing::grid_of_cubes(nx, ny, nz));
}

/// What the sides enclose, by the divergence theorem; each side looks outward.
double volume_within(const ShownMesh& shown, const std::vector<ShellSide>& shell) {
  double volume = 0.0;
  for (const ShellSide& side : shell) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return shown.mesh->points[static_cast<std::size_t>(side.corners[k])];
    };
    volume += at(0).cross(at(1)).dot(at(2)) / 6.0;
    if (side.corners[3] >= 0) volume += at(0).cross(at(2)).dot(at(3)) / 6.0;
  }
  return volume;
}

TEST(MeshShell, OfAWholeMeshIsItsBoundary) {
  const auto shown = grid(3, 4, 5);
  const auto shell = shell_of(*shown);
  EXPECT_EQ(shell.size(), 2u * 2u * (3 * 4 + 4 * 5 + 3 * 5));
  EXPECT_NEAR(volume_within(*shown, shell), 60.0, 1e-9);
}

TEST(MeshShell, ACutShowsWholeElementsOnOneSideAlone) {
  const auto shown = grid(3, 4, 5);
  for (int k = 1; k < 5; ++k) {
    const auto below = shell_of(*shown, MeshCut{{0, 0, double(k)}, {0, 0, 2}});
    EXPECT_EQ(below.size(), 2u * 2u * static_cast<unsigned>(12 + 4 * k + 3 * k)) << k;
    EXPECT_NEAR(volume_within(*shown, below), 12.0 * k, 1e-9);
    const auto above = shell_of(*shown, MeshCut{{0, 0, double(k)}, {0, 0, -2}});
    EXPECT_NEAR(volume_within(*shown, above), 12.0 * (5 - k), 1e-9);
  }
  // An oblique one through the middle: what is left and what is taken away are the whole.
  const MeshCut cut{{1.513, 2.0, 2.5}, {1.0, 0.7, -0.4}};  // through no element's centre
  const double one = volume_within(*shown, shell_of(*shown, cut)),
               other = volume_within(*shown, shell_of(*shown, MeshCut{cut.point, -cut.normal}));
  EXPECT_NEAR(one + other, 60.0, 1e-9);
  EXPECT_NEAR(one, 30.0, 4.0);
  EXPECT_TRUE(shell_of(*shown, MeshCut{{0, 0, -1}, {0, 0, 1}}).empty());
  EXPECT_EQ(shell_of(*shown, MeshCut{{0, 0, 9}, {0, 0, 1}}).size(), shell_of(*shown).size());
}

TEST(MeshShell, PrismsAndTetrahedraHaveTheirSidesTogether) {
  MixedMesh mesh;  // a prism with a tetrahedron on its top
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.3, 0.3, 2}};
  mesh.prisms = {{0, 1, 2, 3, 4, 5}};
  mesh.tetrahedra = {{3, 4, 5, 6}};
  const auto shown = prepared(std::make_shared<const MixedMesh>(mesh));
  const auto shell = shell_of(*shown);
  EXPECT_EQ(shell.size(), 3u + 4u);
  EXPECT_NEAR(volume_within(*shown, shell), 0.5 + 0.5 / 3.0, 1e-12);
  const auto prism = shell_of(*shown, MeshCut{{0, 0, 1.1}, {0, 0, 1}});
  EXPECT_EQ(prism.size(), 5u);
  for (const ShellSide& side : prism) EXPECT_EQ(side.element, 1) << "tetrahedra are counted first";
  EXPECT_EQ(element_corners(mesh, 0).size(), 4u);
  EXPECT_EQ(element_corners(mesh, 1).size(), 6u);
}

TEST(MeshShell, IsTheSameForAnyNumberOfThreads) {
  const auto mesh = testing::grid_of_cubes(24, 24, 12);  // more than one chunk
  const MeshCut cut{{12, 12, 6}, {0.3, 0.5, 0.8}};
  const int threads = core::max_threads();
  core::set_max_threads(1);
  const auto alone = shell_of(*prepared(mesh), cut);
  core::set_max_threads(2);
  const auto both = shell_of(*prepared(mesh), cut);
  core::set_max_threads(threads);
  ASSERT_EQ(alone.size(), both.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_EQ(alone[i].corners, both[i].corners);
    ASSERT_EQ(alone[i].element, both[i].element);
  }
}

TEST(MeshShell, RefusesWhatCannotBeShown) {
  EXPECT_THROW(prepared(std::make_shared<const MixedMesh>()), InvalidInput);
  MixedMesh mesh = *testing::grid_of_cubes(1, 1, 1);
  mesh.tetrahedra[2][1] = 8;
  EXPECT_THROW(prepared(std::make_shared<const MixedMesh>(mesh)), InvalidInput);
  mesh = *testing::grid_of_cubes(1, 1, 1);
  mesh.points[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(prepared(std::make_shared<const MixedMesh>(mesh)), InvalidInput);
  mesh = *testing::grid_of_cubes(1, 1, 1);
  mesh.tetrahedra.push_back(mesh.tetrahedra[0]);
  mesh.tetrahedra.push_back(mesh.tetrahedra[0]);
  EXPECT_THROW(prepared(std::make_shared<const MixedMesh>(mesh)), InvalidInput);
  const auto shown = grid(1, 1, 1);
  EXPECT_THROW(shell_of(*shown, MeshCut{{0, 0, 0}, {0, 0, 0}}), InvalidInput);
  EXPECT_THROW(shell_of(*shown, MeshCut{{NAN, 0, 0}, {0, 0, 1}}), InvalidInput);
}

TEST(MeshShell, PreparingIsCancelled) {
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(prepared(testing::grid_of_cubes(2, 2, 2), task), Cancelled);
}

}  // namespace
}  // namespace ostia::view
