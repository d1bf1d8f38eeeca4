#include "ostia/experiments/vessel_chain.h"

#include "ostia/core/error.h"
#include "ostia/experiments/orientation_phantom.h"
#include "ostia/experiments/smoothness.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::experiments {
namespace {

/// An artery that forks, without its twig and the vein that touches it.
std::vector<PhantomTube> artery() {
  return {{"trunk", Vec3(-20.0, 0.0, 0.0), Vec3::Zero(), 2.5},
          {"one", Vec3::Zero(), Vec3(15.0, 10.0, 0.0), 1.8},
          {"other", Vec3::Zero(), Vec3(15.0, -10.0, 0.0), 1.8}};
}

std::vector<PhantomTube> all_tubes() {
  std::vector<PhantomTube> tubes = artery();
  tubes.push_back({"twig", Vec3(-6.0, -2.0, 0.0), Vec3(-6.0, -12.0, 0.0), 0.6});
  tubes.push_back({"vein", Vec3(-12.0, 4.4, -15.0), Vec3(-12.0, 4.4, 15.0), 2.0});
  return tubes;
}

imaging::ImageVolume scan() {
  TubeScanOptions how;
  how.spacing_mm = Vec3::Constant(0.6);
  how.psf_fwhm_z_mm = 0.7;
  return scan_of(all_tubes(), {"as drawn"}, how);
}

ChainOptions options() {
  ChainOptions how;
  how.growth.least_hu = 700.0;
  how.meshes = {{4, 2.4, 0}, {8, 1.2, 1}};
  return how;
}

const Vec3 in_trunk(-15.0, 0.0, 0.0), in_vein(-12.0, 4.4, 10.0);

double distance_to(const PhantomTube& tube, const Vec3& p) {
  return distance_to_phantom({tube}, p);
}

TEST(VesselChain, OneVesselOfManyWithFewTriangles) {
  const ChainResult found = run_vessel_chain(scan(), {in_trunk}, {in_vein}, options());
  EXPECT_EQ(found.lines, 3);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.loops, 0);
  EXPECT_NEAR(found.length_mm, 20.0 + 2.0 * std::hypot(15.0, 10.0), 3.0);
  EXPECT_GT(found.rival_voxels, 500);
  EXPECT_NEAR(found.vessel_hu, 1276.0, 60.0);  // blurred rims count
  EXPECT_NEAR(found.background_hu, 150.0, 30.0);
  double squares = 0.0;
  for (const Vec3& p : found.isosurface.points) {
    EXPECT_GT(distance_to(all_tubes().back(), p), -0.6) << "runs into the vein";
    EXPECT_LT(std::abs(p.y()), 12.0);
    squares += std::pow(distance_to_phantom(artery(), p), 2);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(found.isosurface.points.size())), 0.2);
  ASSERT_EQ(found.surfaces.size(), 2U);
  for (const ChainSurface& s : found.surfaces) {
    EXPECT_TRUE(s.closed);
    EXPECT_EQ(s.self_intersections, 0U);
    EXPECT_EQ(s.triangles, 2 * s.made.quads.size());
    EXPECT_NEAR(s.share * static_cast<double>(found.isosurface.triangles.size()),
                static_cast<double>(s.triangles), 1e-6);
  }
  EXPECT_LT(found.surfaces[0].apart.rms_sd_mm, 0.4);
  EXPECT_LT(found.surfaces[1].apart.rms_sd_mm, 0.2);
  EXPECT_EQ(nearest_within(found, 1.0), &found.surfaces[1]);
  EXPECT_EQ(nearest_within(found, 0.05), &found.surfaces[0]);
  EXPECT_EQ(nearest_within(found, 0.001), nullptr);
}

TEST(VesselChain, TheTwigIsThereWhereItIsNotTooThin) {
  ChainOptions how = options();
  how.meshes.resize(1);
  how.thinnest_mm = 0.0;
  const ChainResult found = run_vessel_chain(scan(), {in_trunk}, {in_vein}, how);
  EXPECT_EQ(found.lines, 5);
}

TEST(VesselChain, WithoutARivalTheVeinIsTakenToo) {
  ChainOptions how = options();
  how.meshes.resize(1);
  const ChainResult found = run_vessel_chain(scan(), {in_trunk}, {}, how);
  EXPECT_EQ(found.rival_voxels, 0);
  EXPECT_GT(found.length_mm, 80.0);
}

TEST(VesselChain, RefusesOptionsAndVesselsThatAreTooThin) {
  ChainOptions none = options();
  none.meshes.clear();
  EXPECT_THROW(run_vessel_chain(scan(), {in_trunk}, {}, none), InvalidInput);
  ChainOptions odd = options();
  odd.meshes[0].sides = 5;
  EXPECT_THROW(run_vessel_chain(scan(), {in_trunk}, {}, odd), InvalidInput);
  ChainOptions wide = options();
  wide.thinnest_mm = 12.0;
  EXPECT_THROW(run_vessel_chain(scan(), {in_trunk}, {in_vein}, wide), InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
