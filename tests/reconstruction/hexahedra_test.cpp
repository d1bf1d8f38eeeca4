#include "ostia/reconstruction/hexahedra.h"

#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

namespace ostia::reconstruction {
namespace {

using geometry::HexMesh;
using geometry::Quad;
using geometry::Vec3;
using geometry::VesselGraph;

using std::numbers::pi;

ReconstructedSurface surface_of(const VesselGraph& graph, int level = 1, int sides = 8) {
  ReconstructionOptions options;
  options.level = level;
  options.sides = sides;
  return reconstruct_surface(graph, options);
}

/// A side whatever corner comes first, and turned the other way.
Quad from_least(const Quad& q) {
  const auto least = static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
  return {q[least], q[(least + 1) % 4], q[(least + 2) % 4], q[(least + 3) % 4]};
}
Quad turned(const Quad& q) {
  return from_least({q[3], q[2], q[1], q[0]});
}

/// Neighbours meet side to side, and what has no neighbour is the boundary, outward; no point is idle or
/// there twice.
void expect_sound(const SweptHexahedra& swept, const ReconstructedSurface& surface) {
  const HexMesh& mesh = swept.mesh;
  std::map<Quad, int> sides;
  std::set<std::int32_t> used;
  for (const geometry::Hexahedron& hexahedron : mesh.hexahedra) {
    used.insert(hexahedron.begin(), hexahedron.end());
    for (const auto& side : geometry::hexahedron_sides) {
      Quad q{};
      for (std::size_t k = 0; k < 4; ++k) q[k] = hexahedron[static_cast<std::size_t>(side[k])];
      ++sides[from_least(q)];
    }
  }
  EXPECT_EQ(used.size(), mesh.points.size());
  std::size_t open = 0;
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    open += sides.contains(turned(side)) ? 0U : 1U;
  }
  EXPECT_EQ(open, mesh.quads.size());
  for (const Quad& q : mesh.quads) {
    EXPECT_TRUE(sides.contains(from_least(q)));
    EXPECT_FALSE(sides.contains(turned(q)));
  }
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  EXPECT_EQ(std::set(mesh.points.begin(), mesh.points.end(), less).size(), mesh.points.size());
  // The wall's points are the surface's.
  const std::set<Vec3, decltype(less)> wall(surface.points.begin(), surface.points.end(), less);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (mesh.quad_face_ids[i] != surface.surface.faces.front().id) continue;
    for (const std::int32_t p : mesh.quads[i])
      EXPECT_TRUE(wall.contains(mesh.points[static_cast<std::size_t>(p)]));
  }
  const double volume = geometry::volume(surface.surface.mesh);
  EXPECT_NEAR(swept.volume_mm3, volume, 0.01 * volume);
}

TEST(HexMesh, JacobianAndVolumeOfABox) {
  HexMesh box;
  for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{
           {0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}})
    box.points.emplace_back(x, y, z);
  const geometry::Hexahedron all{0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_NEAR(geometry::volume(box, all), 24.0, 1e-12);
  EXPECT_NEAR(geometry::scaled_jacobian(box, all), 1.0, 1e-12);
  EXPECT_NEAR(geometry::volume(box, {4, 5, 6, 7, 0, 1, 2, 3}), -24.0, 1e-12);
  EXPECT_NEAR(geometry::scaled_jacobian(box, {4, 5, 6, 7, 0, 1, 2, 3}), -1.0, 1e-12);
  for (Vec3& p : box.points) p.x() += 0.5 * p.y();  // sheared
  EXPECT_NEAR(geometry::volume(box, all), 24.0, 1e-12);
  EXPECT_NEAR(geometry::scaled_jacobian(box, all), 3.0 / std::hypot(1.5, 3.0), 1e-12);
  box.points[1] = box.points[0];
  EXPECT_EQ(geometry::scaled_jacobian(box, all), -1.0);
}

TEST(Hexahedra, FillATube) {
  for (const int level : {1, 2, 3})
    for (const int sides : {4, 8}) {
      SCOPED_TRACE(std::to_string(level) + ", " + std::to_string(sides));
      const ReconstructedSurface surface = surface_of(testing::tube(20.0, 2.0), level, sides);
      const SweptHexahedra swept = sweep_hexahedra(surface);
      expect_sound(swept, surface);
      EXPECT_EQ(swept.folded, 0U);
      EXPECT_GT(swept.least_jacobian, sides == 4 ? 0.2 : 0.3);
      EXPECT_NEAR(swept.volume_mm3, 20.0 * pi * 4.0, 1e-6);
      ASSERT_EQ(swept.mesh.faces.size(), 3U);
      EXPECT_EQ(swept.mesh.faces[1].name, "inlet_0");
      for (std::size_t i = 0; i < swept.mesh.quads.size(); ++i)
        for (const std::int32_t p : swept.mesh.quads[i]) {
          const double x = swept.mesh.points[static_cast<std::size_t>(p)].x();
          const std::int32_t face = swept.mesh.quad_face_ids[i];
          if (face != 1) {
            EXPECT_NEAR(x, face == 2 ? 0.0 : 20.0, 1e-9);
          }
        }
    }
}

TEST(Hexahedra, LayersGrowAwayFromTheWall) {
  const ReconstructedSurface surface = surface_of(testing::tube(20.0, 2.0), 1);
  HexahedraOptions options;
  options.layers = 4;
  options.growth = 1.5;
  options.shell = 0.5;
  const SweptHexahedra swept = sweep_hexahedra(surface, options);
  expect_sound(swept, surface);
  const SweptHexahedra plain = sweep_hexahedra(surface);
  const std::size_t around = 16, rings = plain.mesh.hexahedra.size() / (around + 8);
  EXPECT_EQ(swept.mesh.hexahedra.size(), rings * (4 * around + 8));
  // At the inlet's first corner: about half of the radius, in steps of 1, 1.5, 2.25, 3.375.
  std::vector<double> depth;
  const double radius = Vec3(0, swept.mesh.points[0].y(), swept.mesh.points[0].z()).norm();
  for (std::size_t i = 0; i < 5; ++i)
    depth.push_back(1.0 - Vec3(0, swept.mesh.points[i].y(), swept.mesh.points[i].z()).norm() / radius);
  EXPECT_NEAR(depth[1], depth[4] * 1.0 / 8.125, 1e-9);
  EXPECT_NEAR(depth[2], depth[4] * 2.5 / 8.125, 1e-9);
  EXPECT_NEAR(depth[4], 0.5, 0.05);
}

TEST(Hexahedra, FollowABendAndARing) {
  const ReconstructedSurface ring = surface_of(testing::torus(8.0, 1.5, 24), 2);
  const SweptHexahedra swept = sweep_hexahedra(ring);
  expect_sound(swept, ring);
  EXPECT_EQ(swept.folded, 0U);
  EXPECT_NEAR(swept.volume_mm3, 2.0 * pi * 8.0 * pi * 1.5 * 1.5, 1.5);
  for (const geometry::Face& face : swept.mesh.faces) EXPECT_EQ(face.name, "wall");
}

TEST(Hexahedra, MeetFaceToFaceAtForks) {
  for (const int sides : {4, 8})
    for (const int level : {1, 2})
      for (const double degrees : {40.0, 90.0, 140.0})
        for (const double ratio : {0.4, 0.7, 1.0}) {
          SCOPED_TRACE(std::to_string(sides) + ", " + std::to_string(level) + ": " + std::to_string(degrees) +
                       ", " + std::to_string(ratio));
          for (const VesselGraph& graph :
               {testing::y_fork(degrees, ratio), testing::side_branch(degrees, ratio)}) {
            const ReconstructedSurface surface = surface_of(graph, level, sides);
            const SweptHexahedra swept = sweep_hexahedra(surface);
            expect_sound(swept, surface);
            EXPECT_EQ(swept.mesh.faces.size(), 4U);
            // Eight sides of a thin branch beside a thick one make quadrilaterals that fold with the wall.
            if (sides == 4 || ratio >= 0.7) {
              EXPECT_EQ(swept.folded, 0U) << swept.least_jacobian;
            }
            if (ratio >= 0.7) {
              EXPECT_GT(swept.least_jacobian, 0.2);
            }
          }
        }
}

TEST(Hexahedra, FillForksOfThree) {
  const VesselGraph graph = testing::fork(1.0, 10.0,
                                          {{testing::direction(50.0, 0.0), 0.8, 10.0},
                                           {testing::direction(50.0, 120.0), 0.8, 10.0},
                                           {testing::direction(50.0, 240.0), 0.8, 10.0}});
  const ReconstructedSurface surface = surface_of(graph, 2);
  const SweptHexahedra swept = sweep_hexahedra(surface);
  expect_sound(swept, surface);
  EXPECT_EQ(swept.folded, 0U) << swept.least_jacobian;
}

TEST(Hexahedra, RefuseWhatTheyCannotFill) {
  const ReconstructedSurface coarse = surface_of(testing::tube(20.0, 2.0), 0);
  EXPECT_THROW(sweep_hexahedra(coarse), InvalidInput);
  ReconstructedSurface surface = surface_of(testing::tube(20.0, 2.0), 1);
  EXPECT_THROW(sweep_hexahedra(surface, {.shell = 1.0}), InvalidInput);
  EXPECT_THROW(sweep_hexahedra(surface, {.layers = 33}), InvalidInput);
  EXPECT_THROW(sweep_hexahedra(surface, {.growth = 0.5}), InvalidInput);
  std::swap(surface.quads[20], surface.quads[60]);
  EXPECT_THROW(sweep_hexahedra(surface), GeometryError);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(sweep_hexahedra(surface_of(testing::tube(20.0, 2.0)), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::reconstruction
