#include "ostia/pipeline/lumen_surface.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

imaging::FloatVolume volume_of(const std::function<double(const Vec3&)>& f) {
  imaging::FloatVolume out;
  out.geometry.size = {40, 40, 40};
  out.geometry.spacing = Vec3::Constant(0.5);
  out.geometry.origin = Vec3::Constant(-9.75);
  out.voxels.resize(40 * 40 * 40);
  for (std::int64_t k = 0; k < 40; ++k) {
    for (std::int64_t j = 0; j < 40; ++j) {
      for (std::int64_t i = 0; i < 40; ++i) {
        const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        out(i, j, k) = static_cast<float>(f(out.geometry.world(index)));
      }
    }
  }
  return out;
}

double ball(const Vec3& p) {
  return p.norm() - 7.0;
}

TEST(LumenSurface, CountsHandles) {
  EXPECT_EQ(handles_of(geometry::surface_of(geometry::torus(6.0, 2.0), 0.5, false)), 1);
  const geometry::TriMesh tube = geometry::surface_of(geometry::straight_tube(9.0, 2.0), 0.5, false);
  EXPECT_EQ(handles_of(tube), 0);
  EXPECT_EQ(handles_of(geometry::merged(tube, tube)), 0);
}

TEST(LumenSurface, LeavesAVesselAlone) {
  const LumenSurface out = lumen_surface(volume_of(ball), {Vec3::Zero()});
  EXPECT_TRUE(out.warnings.empty());
  EXPECT_NEAR(geometry::volume(out.mesh), 4.0 / 3.0 * std::acos(-1.0) * 343.0, 15.0);
}

TEST(LumenSurface, ClosesATunnelOfAVoxelAndSaysSo) {
  const auto drilled =
      volume_of([](const Vec3& p) { return std::max(ball(p), 0.4 - std::hypot(p.x() - 3.0, p.y())); });
  const LumenSurface out = lumen_surface(drilled, {Vec3::Zero()});
  EXPECT_EQ(handles_of(out.mesh), 0);
  ASSERT_EQ(out.warnings.size(), 1u);
  EXPECT_NE(out.warnings[0].find("1 small handles"), std::string::npos) << out.warnings[0];
}

TEST(LumenSurface, KeepsARealRingAndSaysSo) {
  const auto ring =
      volume_of([](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 6.0, p.z()) - 2.0; });
  const LumenSurface out = lumen_surface(ring, {Vec3(6, 0, 0)});
  EXPECT_EQ(handles_of(out.mesh), 1);
  ASSERT_EQ(out.warnings.size(), 1u);
  EXPECT_NE(out.warnings[0].find("has 1 handles"), std::string::npos) << out.warnings[0];
}

}  // namespace
}  // namespace ostia::pipeline
