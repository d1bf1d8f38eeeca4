// Tetrahedra of layers are judged as what they are.
#include "mixed_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/meshing/mixed_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

struct SplitTube {
  MixedMesh mesh;
  std::vector<bool> in_layers;
  std::size_t inside = 0;
};

/// A tube whose three layers are split, and which tetrahedra they are.
SplitTube split_tube(double thickness) {
  const MixedMesh prisms = filled_tube(16, 3, thickness);
  SplitTube tube{geometry::split_prisms(prisms), {}, prisms.tetrahedra.size()};
  tube.in_layers.assign(tube.mesh.tetrahedra.size(), true);
  std::fill_n(tube.in_layers.begin(), tube.inside, false);
  return tube;
}

MixedQuality marked(const SplitTube& tube) {
  MixedQuality quality = mixed_quality(tube.mesh);
  mark_layers(tube.mesh, tube.in_layers, quality);
  return quality;
}

TEST(LayerTetrahedra, ThreeOfAThinRightPrismHaveSmallAnglesAndNoLargeOnes) {
  // A right prism of height h on an equilateral triangle of edge 1: its tetrahedra have angles down to
  // atan(h / sqrt(3/4)), and none above 120 degrees, however thin it is.
  constexpr double h = 0.01;
  MixedMesh prism;
  for (const double z : {0.0, h})
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(0.75), 0)})
      prism.points.emplace_back(p.x(), p.y(), z);
  prism.prisms = {{0, 1, 2, 3, 4, 5}};
  const MixedMesh mesh = geometry::split_prisms(prism);
  MixedQuality quality = mixed_quality(mesh);
  mark_layers(mesh, {true, true, true}, quality);
  ASSERT_TRUE(quality.layers);
  EXPECT_EQ(quality.layers->count, 3u);
  EXPECT_LT(quality.tetrahedra.min_dihedral_deg,
            1.01 * 180.0 / std::numbers::pi * std::atan(h / std::sqrt(0.75)));
  EXPECT_LT(quality.layers->max_dihedral_deg, 120.0 + 1e-9);
  EXPECT_TRUE(std::isinf(quality.layers->others_min_dihedral_deg)) << "there are no others";
}

TEST(LayerTetrahedra, AMeshWithSplitLayersPasses) {
  for (const double thickness : {0.1, 0.25, 0.6}) {
    const MixedQuality quality = marked(split_tube(thickness));
    EXPECT_TRUE(check(quality).ok()) << thickness << ": " << check(quality).summary();
    EXPECT_GT(quality.layers->others_min_dihedral_deg, 10.0);
  }
  EXPECT_FALSE(check(mixed_quality(split_tube(0.1).mesh)).ok()) << "where nothing is known of layers";
}

TEST(LayerTetrahedra, TheOthersAreJudgedAsEver) {
  const SplitTube tube = split_tube(0.25);
  const MixedMesh inside = filled_tube(16, 3, 0.25);
  const MixedQuality quality = marked(tube), of_prisms = mixed_quality(inside);
  EXPECT_EQ(quality.layers->count, 3 * inside.prisms.size());
  EXPECT_DOUBLE_EQ(quality.layers->others_min_dihedral_deg, of_prisms.tetrahedra.min_dihedral_deg);
  EXPECT_DOUBLE_EQ(quality.layers->others_min_scaled_jacobian, of_prisms.tetrahedra.min_scaled_jacobian);
  EXPECT_LE(quality.layers->others_max_non_orthogonality_deg, of_prisms.openfoam.max_non_orthogonality_deg);
  MixedBounds bounds;
  bounds.min_dihedral_deg = 60.0;
  bounds.min_tetrahedron_scaled_jacobian = 0.9;
  bounds.max_non_orthogonality_deg = 1.0;
  const std::string summary = check(quality, bounds).summary();
  for (const char* part :
       {"dihedral angle of the tetrahedra inside the layers", "Jacobian of the tetrahedra inside the layers",
        "non-orthogonality inside the layers"})
    EXPECT_THAT(summary, ::testing::HasSubstr(part));
}

/// A point of a layer's tetrahedron that is on no boundary, moved until that one is nearly flat: into the
/// plane of the three others, out of the wall's direction.
void flatten_one(SplitTube& tube) {
  std::vector<bool> on_boundary(tube.mesh.points.size(), false);
  for (const auto& t : tube.mesh.triangles)
    for (const std::int32_t p : t) on_boundary[static_cast<std::size_t>(p)] = true;
  for (std::size_t i = tube.inside; i < tube.mesh.tetrahedra.size(); ++i) {
    const geometry::Tetrahedron& t = tube.mesh.tetrahedra[i];
    for (std::size_t k = 0; k < 4; ++k) {
      if (on_boundary[static_cast<std::size_t>(t[k])]) continue;
      Vec3 centre = Vec3::Zero();
      for (std::size_t j = 0; j < 4; ++j)
        if (j != k) centre += tube.mesh.points[static_cast<std::size_t>(t[j])] / 3.0;
      Vec3& p = tube.mesh.points[static_cast<std::size_t>(t[k])];
      p = centre + 1e-3 * (p - centre);
      return;
    }
  }
}

TEST(LayerTetrahedra, ABadMeshFailsAllTheSame) {
  SplitTube flat = split_tube(0.6);
  flatten_one(flat);
  EXPECT_FALSE(check(marked(flat)).ok());
  SplitTube blunt = split_tube(0.6);
  MixedQuality quality = marked(blunt);
  MixedBounds bounds;
  bounds.max_layer_dihedral_deg = 95.0;
  EXPECT_THAT(check(quality, bounds).summary(), ::testing::HasSubstr("of the layers' tetrahedra"));
  bounds.max_layer_dihedral_deg = 180.0;
  EXPECT_THROW(check(quality, bounds), InvalidInput);
}

TEST(LayerTetrahedra, NeedOneMarkEach) {
  SplitTube tube = split_tube(0.25);
  tube.in_layers.pop_back();
  EXPECT_THROW(marked(tube), InvalidInput);
  tube.in_layers.assign(tube.mesh.tetrahedra.size(), false);
  EXPECT_FALSE(marked(tube).layers) << "none of them is a layer's";
}

}  // namespace
}  // namespace ostia::meshing
