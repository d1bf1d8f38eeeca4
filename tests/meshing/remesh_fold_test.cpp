// Folds and fins of the wall that are narrower than the triangles wanted: none may stay as a sharp wedge.
#include "test_surfaces.h"

#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::FacedSurface;
using geometry::Vec3;

/// The least and largest angle inside the lumen between two triangles of the wall, degrees.
std::pair<double, double> wall_angles(const FacedSurface& surface) {
  const auto corner = [&](std::size_t t, std::size_t i) -> const Vec3& {
    return surface.mesh.points[static_cast<std::size_t>(surface.mesh.triangles[t][i])];
  };
  const auto normal = [&](std::size_t t) {
    return Vec3((corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).normalized());
  };
  const auto centre = [&](std::size_t t) { return Vec3((corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0); };
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> seen;
  std::pair<double, double> range{180.0, 180.0};
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto key = std::minmax(surface.mesh.triangles[t][i], surface.mesh.triangles[t][(i + 1) % 3]);
      const auto [other, fresh] = seen.try_emplace({key.first, key.second}, t);
      if (fresh || surface.face_ids[t] != 1 || surface.face_ids[other->second] != 1) continue;
      const Vec3 m = normal(other->second), n = normal(t);
      const double bend = std::atan2(m.cross(n).norm(), m.dot(n)) * 180.0 / std::numbers::pi;
      const bool convex = m.dot(centre(t) - centre(other->second)) < 0.0;
      range.first = std::min(range.first, convex ? 180.0 - bend : 180.0 + bend);
      range.second = std::max(range.second, convex ? 180.0 - bend : 180.0 + bend);
    }
  return range;
}

/// A tube of radius 1.5 mm with a V along its middle, `height` mm high (negative: a fold into the lumen) and
/// 0.24 mm wide, which is 40 % of an edge.
FacedSurface pinched(double height) {
  const auto shape = geometry::straight_tube(16.0, 1.5);
  geometry::TriMesh mesh = geometry::surface_of(shape, 0.12, true);
  for (Vec3& p : mesh.points) {
    const double across = std::max(0.0, 1.0 - std::abs(std::atan2(p.y(), p.x())) / 0.08),
                 along = std::exp(-std::pow((p.z() - 8.0) / 2.0, 2));
    const double factor = 1.0 + height / 1.5 * across * along;
    p.x() *= factor;
    p.y() *= factor;
  }
  return cap_ends(clip_ends(mesh, tree_of(shape)));
}

TEST(RemeshFolds, LeaveNoSharpWedgeOfTheWall) {
  for (const double height : {-1.05, 1.05}) {
    const FacedSurface input = pinched(height);
    const auto before = wall_angles(input);
    ASSERT_TRUE(before.first < 60.0 || before.second > 300.0) << height;
    const auto tree = tree_of(geometry::straight_tube(16.0, 1.5));
    const RemeshedSurface result = remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree)));
    EXPECT_EQ(result.report.self_intersections, 0u);
    EXPECT_GE(result.report.min_angle_deg, 28.0) << height;
    const auto after = wall_angles(result.surface);
    EXPECT_GT(after.first, 80.0) << height;
    EXPECT_LT(after.second, 260.0) << height;
    const auto filled = fill_with_layers(result.surface);
    const MixedQuality quality = mixed_quality(filled.mesh);
    EXPECT_EQ(quality.inverted(), 0u);
    EXPECT_GE(quality.prisms.min_scaled_jacobian, 0.1);
    EXPECT_GE(quality.tetrahedra.min_dihedral_deg, 10.0);
    EXPECT_LT(quality.openfoam.max_non_orthogonality_deg, 65.0);
    EXPECT_LT(quality.openfoam.max_skewness, 4.0);
  }
}

TEST(RemeshFolds, OfTwoTubesThatPartAt15DegreesPassTheGate) {
  const auto shape = geometry::y_junction(8.0, 24.0, 2.0, 1.4, 15.0);
  const FacedSurface input = capped(shape, 0.3, true);  // as marching cubes leave the crotch
  const RemeshedSurface result = remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape))));
  EXPECT_GE(result.report.min_angle_deg, 28.0);
  const auto angles = wall_angles(result.surface);
  EXPECT_GT(angles.first, 80.0);
  EXPECT_LT(angles.second, 320.0);  // the flow divider itself is sharp
  const auto plain = tetrahedralize(result.surface);
  EXPECT_LT(mixed_quality(geometry::mixed(plain.mesh)).openfoam.max_non_orthogonality_deg, 65.0);
  const auto filled = fill_with_layers(result.surface);
  const MixedQuality quality = mixed_quality(filled.mesh);
  EXPECT_GE(filled.layers.full_share, 0.95);
  EXPECT_GE(quality.prisms.min_scaled_jacobian, 0.1);
  EXPECT_LT(quality.openfoam.max_non_orthogonality_deg, 65.0);
  EXPECT_LT(quality.openfoam.max_skewness, 4.0);
}

}  // namespace
}  // namespace ostia::meshing
