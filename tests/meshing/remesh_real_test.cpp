// Remeshing of real lumen surfaces, without centerlines: the size is a multiple of the surface's own mean
// edge.
#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace ostia::meshing {
namespace {

/// Binary STL as it stands, points that are equal merged.
geometry::TriMesh read_stl(const std::filesystem::path& path) {
  const std::string bytes = core::read_file(path);
  geometry::TriMesh soup;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      float p[3];
      std::memcpy(p, bytes.data() + at + 12 + 12 * k, sizeof p);
      soup.points.emplace_back(p[0], p[1], p[2]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return geometry::oriented(geometry::welded(soup));
}

void remesh_and_judge(const std::filesystem::path& path, double factor) {
  const geometry::TriMesh input = read_stl(path);
  const SurfaceQuality before = surface_quality(input);
  const auto result = remesh(input, std::vector<double>(input.points.size(), factor * before.mean_edge_mm));
  const SurfaceQuality after = surface_quality(result.mesh);
  ::testing::Test::RecordProperty("triangles_before", static_cast<int>(before.triangles));
  ::testing::Test::RecordProperty("triangles_after", static_cast<int>(after.triangles));
  ::testing::Test::RecordProperty("min_angle_before", std::to_string(before.min_angle_deg));
  ::testing::Test::RecordProperty("min_angle_after", std::to_string(after.min_angle_deg));
  EXPECT_EQ(geometry::boundary_loops(result.mesh).size(), geometry::boundary_loops(input).size());
  EXPECT_EQ(after.non_manifold_edges + after.inconsistent_edges, 0u);
  EXPECT_LE(after.self_intersections, before.self_intersections);
  EXPECT_GE(after.min_angle_deg, 20.0) << before.min_angle_deg;
  EXPECT_GT(after.mean_min_angle_deg, 48.0);
  EXPECT_NEAR(after.area_mm2, before.area_mm2, 0.02 * before.area_mm2);
  const geometry::AabbTree original(input), remeshed(result.mesh);
  double there = 0.0;
  for (const auto& p : result.mesh.points) there = std::max(there, original.closest(p).distance);
  EXPECT_LT(there, 1e-6);
  // Folds of the input, where it intersects itself, may be smoothed away: 99 % of its points.
  std::vector<double> back;
  for (const auto& p : input.points) back.push_back(remeshed.closest(p).distance);
  std::sort(back.begin(), back.end());
  EXPECT_LT(back[back.size() * 99 / 100], 0.2 * factor * before.mean_edge_mm);
}

// Coarse and faceted, with branches thinner than its mean edge: the size must be a fraction of it.
TEST(RemeshReal, CoronaryPhantom) {
  OSTIA_REQUIRE_SHARED(path, "coronary/xra-phantom/phantom-tri3-coarse.stl");
  remesh_and_judge(path, 0.5);
}

TEST(RemeshReal, VesselWithAneurysm) {
  OSTIA_REQUIRE_SHARED(path, "vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
  remesh_and_judge(path, 1.3);
}

}  // namespace
}  // namespace ostia::meshing
