// Ends that flare, as a coronary does into the aorta: where a plane meets the wall in a sharp wedge.
#include "cutting/cut_rim.h"

#include "test_surfaces.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double degree = std::numbers::pi / 180.0;

/// The surface of revolution of r(z) about the z axis from 0 to `length`, closed by a cone of triangles at
/// both ends.
TriMesh revolved(const std::function<double(double)>& radius, double length) {
  constexpr std::int32_t around = 48;
  const auto rings = static_cast<std::int32_t>(std::lround(length / 0.125));
  TriMesh mesh;
  for (std::int32_t j = 0; j <= rings; ++j)
    for (std::int32_t i = 0; i < around; ++i) {
      const double z = length * j / rings, angle = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      mesh.points.emplace_back(radius(z) * std::cos(angle), radius(z) * std::sin(angle), z);
    }
  for (std::int32_t j = 0; j < rings; ++j)
    for (std::int32_t i = 0; i < around; ++i) {
      const std::int32_t next = (i + 1) % around, a = j * around + i, b = j * around + next, c = a + around,
                         d = b + around;
      if (j % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      } else {
        mesh.triangles.push_back({a, d, c});
        mesh.triangles.push_back({a, b, d});
      }
    }
  const auto bottom = static_cast<std::int32_t>(mesh.points.size()), top = bottom + 1;
  mesh.points.emplace_back(0.0, 0.0, 0.0);
  mesh.points.emplace_back(0.0, 0.0, length);
  for (std::int32_t i = 0; i < around; ++i) {
    const std::int32_t next = (i + 1) % around;
    mesh.triangles.push_back({bottom, next, i});
    mesh.triangles.push_back({top, rings * around + i, rings * around + next});
  }
  return mesh;
}

constexpr double length_mm = 16.0, calibre_mm = 1.5;

/// A tube of radius 1.5 mm that flares from z = `end` down to z = 1 by 2.5 mm, along a quarter of a sine:
/// across the axis at z = 1, along it at `end`.
double trumpet(double z, double end) {
  if (z >= end) return calibre_mm;
  const double t = std::max(0.0, (z - 1.0) / (end - 1.0));
  return calibre_mm + 2.5 * (1.0 - std::sin(0.5 * std::numbers::pi * t));
}
/// Of the cap at z with the trumpet's wall.
double trumpet_angle_deg(double z, double end) {
  const double h = 1e-5, slope = (trumpet(z + h, end) - trumpet(z - h, end)) / (2.0 * h);
  return std::atan2(1.0, -slope) / degree;
}

TriMesh trumpet_surface(double end) {
  return revolved([end](double z) { return trumpet(z, end); }, length_mm);
}

geometry::VesselTree straight_tree() {
  return tree_of(geometry::straight_tube(length_mm, calibre_mm));
}

TEST(SharpestRim, IsTheAngleOfAConeAtBothItsEnds) {
  // Wall and axis make atan(1/2): the cap meets it at less than a right angle at the wide end, at more at the
  // other.
  const double half = std::atan(0.5) / degree;
  const TriMesh cone = revolved([](double z) { return 1.0 + 0.5 * z; }, 8.0);
  const auto shape = geometry::straight_tube(8.0, 2.0);
  ClipOptions options;
  options.planes = {{"inlet_tube", Vec3(0, 0, 2.03), Vec3::UnitZ()},
                    {"outlet_tube", Vec3(0, 0, 6.03), Vec3::UnitZ()}};
  const ClippedSurface clipped = clip_ends(cone, tree_of(shape), options);
  ASSERT_EQ(clipped.ends.size(), 2u);
  const RimWedge narrow = sharpest_rim(clipped.mesh, clipped.ends[0].plane),
                 wide = sharpest_rim(clipped.mesh, clipped.ends[1].plane);
  EXPECT_NEAR(narrow.angle_deg, 90.0 + half, 1.5);
  EXPECT_NEAR(wide.angle_deg, 90.0 - half, 1.5);
  EXPECT_NEAR(wide.at.z(), 6.03, 0.01);
  EXPECT_NEAR(std::hypot(wide.at.x(), wide.at.y()), 1.0 + 0.5 * 6.03, 0.02);
}

TEST(SharpestRim, OfOneFinIsThatFin) {
  // A tube whose wall runs out to one side only, at 20 degrees to the plane z = 2: the rest of the rim is
  // square.
  TriMesh tube = revolved([](double) { return calibre_mm; }, length_mm);
  for (Vec3& p : tube.points) {
    const double out = std::max(0.0, 3.0 - p.z()) / std::tan(20.0 * degree);
    if (p.x() > 0.9 * std::hypot(p.x(), p.y()) && p.z() > 0.5 && p.z() < 3.0) p.x() += std::min(out, 2.0);
  }
  ClipOptions options;
  options.planes = {{"inlet_tube", Vec3(0, 0, 2.53), Vec3::UnitZ()}};
  const ClippedSurface clipped = clip_ends(tube, straight_tree(), options);
  const RimWedge fin = sharpest_rim(clipped.mesh, clipped.ends[0].plane);
  EXPECT_LT(fin.angle_deg, 40.0);
  EXPECT_GT(fin.at.x(), calibre_mm);
  ASSERT_EQ(clipped.warnings.size(), 1u);  // a person's plane stays where it is
  EXPECT_NE(clipped.warnings[0].find("degrees near"), std::string::npos);
  EXPECT_NEAR(clipped.ends[0].plane.origin.z(), 2.53, 0.01);
}

TEST(ClipEnds, GoFartherInsideWhereTheWallFlaresIntoThePlane) {
  // The plane would stand at z = 1.5, where the wall is 24 degrees from it.
  const double end = 2.5;
  ASSERT_LT(trumpet_angle_deg(1.5, end), 25.0);
  const ClippedSurface clipped = clip_ends(trumpet_surface(end), straight_tree());
  const double z = clipped.ends[0].plane.origin.z();
  EXPECT_GT(z, 1.8);
  EXPECT_LT(z, 3.01);
  EXPECT_GT(trumpet_angle_deg(z, end), 32.0);
  EXPECT_GE(sharpest_rim(clipped.mesh, clipped.ends[0].plane).angle_deg, 40.0);
  EXPECT_NEAR(clipped.ends[1].plane.origin.z(), length_mm - calibre_mm, 0.01);  // the other end is square
  ASSERT_EQ(clipped.warnings.size(), 1u);
  EXPECT_NE(clipped.warnings[0].find("the inlet of vessel tube: the plane was moved inside"),
            std::string::npos);
}

TEST(ClipEnds, TellTheWedgeThatNoPlaneAvoids) {
  // The wall flares for five radii: the best plane is the innermost, and the warning says how sharp it is.
  const auto cone = [](double z) { return z < 9.0 ? calibre_mm + 1.6 * (9.0 - z) : calibre_mm; };
  ClipOptions options;
  options.reach_radii = 30.0;
  const ClippedSurface clipped = clip_ends(revolved(cone, length_mm), straight_tree(), options);
  const RimWedge rim = sharpest_rim(clipped.mesh, clipped.ends[0].plane);
  EXPECT_NEAR(rim.angle_deg, std::atan(1.0 / 1.6) / degree, 1.5);
  ASSERT_FALSE(clipped.warnings.empty());
  EXPECT_NE(clipped.warnings.back().find("the plane meets the wall at 32 degrees"), std::string::npos)
      << clipped.warnings.back();
}

TEST(ClipEnds, MakeAFlaringEndFitForTetrahedra) {
  const ClippedSurface clipped = clip_ends(trumpet_surface(2.5), straight_tree());
  const geometry::FacedSurface closed = cap_ends(clipped);
  const auto sizes = target_edge_lengths(closed.mesh, TubeFunction(straight_tree()));
  const geometry::FacedSurface surface = remesh(closed, sizes).surface;
  const auto volume = tetrahedralize(surface);
  EXPECT_GE(volume.report.quality.min_dihedral_deg, 15.0);
  EXPECT_EQ(volume.report.below_12_deg, 0u);
}

}  // namespace
}  // namespace ostia::meshing
