#include "ostia/analysis/myocardial_territories.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::analysis {
namespace {

using geometry::Vec3;
using std::numbers::pi;

constexpr double inner_mm = 20.0, outer_mm = 30.0, high_mm = 60.0;

/// A cup's wall: between two cylinders about z.
imaging::MaskVolume ring_wall() {
  imaging::MaskVolume mask;
  mask.geometry.size = {64, 64, 60};
  mask.geometry.origin = {-31.5, -31.5, 0.5};
  for (std::int64_t k = 0; k < 60; ++k)
    for (std::int64_t j = 0; j < 64; ++j)
      for (std::int64_t i = 0; i < 64; ++i) {
        const Vec3 at =
            mask.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const double rho = std::hypot(at.x(), at.y());
        mask.voxels.push_back(rho > inner_mm && rho < outer_mm ? 1 : 0);
      }
  return mask;
}
const double ring_g = pi * (outer_mm * outer_mm - inner_mm * inner_mm) * high_mm / 1000.0 * 1.05;

geometry::TreeSegment straight_segment(std::int32_t id, std::int32_t from, std::int32_t to, const Vec3& a,
                                       const Vec3& b) {
  geometry::TreeSegment segment{id, from, to, {}};
  for (int i = 0; i <= 20; ++i) {
    segment.axis.points.push_back(a + i / 20.0 * (b - a));
    segment.axis.radius.push_back(1.5);
  }
  geometry::complete(segment.axis);
  return segment;
}

Vec3 on_wall(double angle_deg, double z) {
  return {31.0 * std::cos(angle_deg * pi / 180.0), 31.0 * std::sin(angle_deg * pi / 180.0), z};
}

/// One stem above the wall that parts into vessels which run straight down at 0, 90 and 180 degrees.
geometry::VesselTree three_arteries() {
  geometry::VesselTree tree;
  const Vec3 root(0.0, 0.0, 140.0), fork(0.0, 0.0, 120.0);
  tree.nodes = {{0, root}, {1, fork}};
  tree.segments = {straight_segment(0, 0, 1, root, fork)};
  const double angles[] = {0.0, 90.0, 180.0};
  const char* names[] = {"LAD", "LCX", "RCA"};
  for (std::int32_t n = 0; n < 3; ++n) {
    const Vec3 top = on_wall(angles[n], high_mm), bottom = on_wall(angles[n], 0.0);
    tree.nodes.push_back({2 + 2 * n, top});
    tree.nodes.push_back({3 + 2 * n, bottom});
    tree.segments.push_back(straight_segment(1 + 2 * n, 1, 2 + 2 * n, fork, top));
    tree.segments.push_back(straight_segment(2 + 2 * n, 2 + 2 * n, 3 + 2 * n, top, bottom));
    tree.vessels.push_back({n, names[n], {0, 1 + 2 * n, 2 + 2 * n}});
  }
  return tree;
}

TEST(MyocardialTerritories, SectorsOfARing) {
  const geometry::VesselTree tree = three_arteries();
  const MyocardialTerritories found = myocardial_territories(tree, ring_wall());
  EXPECT_NEAR(found.mass_g, ring_g, 0.01 * ring_g);
  // At 0, 90 and 180 degrees: the middle one has 90 degrees, the others 135.
  ASSERT_EQ(found.vessels.size(), 3U);
  EXPECT_NEAR(found.vessels[0].share, 135.0 / 360.0, 0.01);
  EXPECT_NEAR(found.vessels[1].share, 90.0 / 360.0, 0.01);
  EXPECT_NEAR(found.vessels[2].share, 135.0 / 360.0, 0.01);
}

TEST(MyocardialTerritories, WhatLiesBehindAPlace) {
  const geometry::VesselTree tree = three_arteries();
  const MyocardialTerritories found = myocardial_territories(tree, ring_wall());
  const double to_top = 20.0 + std::hypot(31.0, 60.0);
  // Half-way down the LCX: half of its quarter. At its top, all of it; at the root, everything.
  EXPECT_NEAR(mass_behind_g(found, tree, 1, to_top + 30.0), 0.125 * ring_g, 0.01 * ring_g);
  EXPECT_NEAR(mass_behind_g(found, tree, 1, to_top), 0.25 * ring_g, 0.01 * ring_g);
  EXPECT_NEAR(mass_behind_g(found, tree, 1, 0.0), found.mass_g, 1e-9 * ring_g);
  EXPECT_THROW(mass_behind_g(found, tree, 1, 500.0), InvalidInput);
  EXPECT_THROW(mass_behind_g(found, tree, 9, 1.0), InvalidInput);
}

TEST(MyocardialTerritories, LumenOverMass) {
  const geometry::VesselTree tree = three_arteries();
  const MyocardialTerritories found = myocardial_territories(tree, ring_wall());
  const double length = 20.0 + 3.0 * (std::hypot(31.0, 60.0) + 60.0);
  EXPECT_NEAR(found.lumen_mm3, pi * 1.5 * 1.5 * length, 1e-6 * found.lumen_mm3);
  EXPECT_NEAR(found.lumen_mm3_per_g(), found.lumen_mm3 / found.mass_g, 1e-12);
}

TEST(MyocardialTerritories, LabelsAreTheVesselsPlaces) {
  const MyocardialTerritories found = myocardial_territories(three_arteries(), ring_wall());
  const auto label_at = [&](double angle_deg) {
    const Vec3 at = found.labels.geometry.index(on_wall(angle_deg, 30.0) * (25.0 / 31.0) +
                                                Vec3(0.0, 0.0, 30.0 - 30.0 * 25.0 / 31.0));
    return found.labels(std::lround(at.x()), std::lround(at.y()), std::lround(at.z()));
  };
  EXPECT_EQ(label_at(10.0), 1);
  EXPECT_EQ(label_at(80.0), 2);
  EXPECT_EQ(label_at(170.0), 3);
  EXPECT_EQ(found.labels(32, 32, 30), 0);
}

TEST(MyocardialTerritories, TheSameForAnyNumberOfThreads) {
  core::set_max_threads(1);
  const MyocardialTerritories one = myocardial_territories(three_arteries(), ring_wall());
  core::set_max_threads(4);
  const MyocardialTerritories four = myocardial_territories(three_arteries(), ring_wall());
  core::set_max_threads(0);
  EXPECT_EQ(one.labels.voxels, four.labels.voxels);
  EXPECT_EQ(one.vessels[1].mass_g, four.vessels[1].mass_g);
}

TEST(MyocardialTerritories, WhatCannotBeDividedIsRefused) {
  imaging::MaskVolume empty = ring_wall();
  std::fill(empty.voxels.begin(), empty.voxels.end(), std::uint8_t{0});
  EXPECT_THROW(myocardial_territories(three_arteries(), empty), InvalidInput);
  EXPECT_THROW(myocardial_territories({}, ring_wall()), InvalidInput);
  imaging::MaskVolume elsewhere = ring_wall();
  elsewhere.geometry.origin.x() += 500.0;
  EXPECT_THROW(myocardial_territories(three_arteries(), elsewhere), InvalidInput);
  TerritoryOptions bad;
  bad.density_g_ml = 10.0;
  EXPECT_THROW(myocardial_territories(three_arteries(), ring_wall(), bad), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
