#include "ostia/phantom/presets.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

/// A tree of straight vessels of the given names between two points each.
CoronaryVessel straight(std::int32_t id, const char* name, std::int32_t parent, const Vec3& from,
                        const Vec3& to) {
  CoronaryVessel vessel;
  vessel.id = id;
  vessel.name = name;
  vessel.parent = parent;
  for (int n = 0; n <= 100; ++n) {
    vessel.axis.points.push_back(from + (to - from) * (0.01 * n));
    vessel.axis.radius.push_back(1.5);
  }
  geometry::complete(vessel.axis);
  return vessel;
}

CoronaryTree simple_tree(const HeartShape& heart) {
  const Vec3 left = heart.root.annulus + 12.0 * heart.root.axis + 17.0 * heart.root.left_sinus;
  const Vec3 right = heart.root.annulus + 12.0 * heart.root.axis + 17.0 * heart.root.right_sinus;
  CoronaryTree tree;
  tree.vessels = {straight(0, "LAD", -1, left, heart.epicardium(1.3, 0.95)),
                  straight(1, "RCA", -1, right, heart.epicardium(-1.75, 0.8))};
  tree.vessels[0].segments = {{5, "left main", 0.0, 10.0}, {6, "proximal LAD", 10.0, 30.0}};
  const Vec3 fork = tree.vessels[0].axis.points[10];
  tree.vessels.push_back(straight(2, "LCX", 0, fork, fork + Vec3(20, 20, -10)));
  tree.vessels.back().parent_s_mm = tree.vessels[0].axis.abscissa[10];
  return tree;
}

bool holds(const imaging::Geometry& grid, const Vec3& point, double clear_mm) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 aside((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    if (!grid.contains(point + clear_mm * aside)) return false;
  }
  return true;
}

TEST(Presets, HaveTheSizesAndSpacingsTheyAreNamedFor) {
  const HeartShape heart;
  const imaging::Geometry full = grid_of(Preset::full, heart), small = grid_of(Preset::small, heart),
                          tiny = grid_of(Preset::tiny, heart);
  EXPECT_EQ(full.size, (std::array<std::int64_t, 3>{512, 512, 300}));
  EXPECT_EQ(full.spacing, Vec3(0.35, 0.35, 0.45));
  EXPECT_EQ(small.size, (std::array<std::int64_t, 3>{256, 256, 150}));
  EXPECT_NEAR((full.spacing.x() * 512), small.spacing.x() * 256, 1e-9);
  EXPECT_NEAR((full.spacing.z() * 300), small.spacing.z() * 150, 1e-9);
  EXPECT_EQ(tiny.size, (std::array<std::int64_t, 3>{96, 96, 80}));
}

TEST(Presets, TheWholeTreeAndTheRootAreInTheField) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const CoronaryTree tree = simple_tree(heart);
    for (const Preset preset : {Preset::small, Preset::full}) {
      const imaging::Geometry grid = grid_of(preset, heart, &tree);
      for (const CoronaryVessel& vessel : tree.vessels)
        for (const Vec3& p : vessel.axis.points) ASSERT_TRUE(holds(grid, p, 4.9)) << seed;
      ASSERT_TRUE(holds(grid, heart.root.annulus, heart.root.sinus_radius_mm)) << seed;
    }
  }
}

TEST(Presets, TinyHoldsBothOstiaAndTheFirstCentimetres) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const CoronaryTree tree = draw_coronaries(heart, {.seed = seed});
    const imaging::Geometry grid = grid_of(Preset::tiny, heart, &tree);
    for (const CoronaryVessel& vessel : tree.vessels) {
      if (vessel.parent >= 0) continue;
      for (std::size_t i = 0; i < vessel.axis.size() && vessel.axis.abscissa[i] < 10.0; ++i)
        ASSERT_TRUE(holds(grid, vessel.axis.points[i], 3.0)) << seed << " " << vessel.name;
    }
  }
}

TEST(Presets, DrawnTreesFitTheField) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const HeartShape heart = draw_heart(seed);
    const CoronaryTree tree = draw_coronaries(heart, {.seed = seed});
    const imaging::Geometry grid = grid_of(Preset::full, heart, &tree);
    for (const CoronaryVessel& vessel : tree.vessels)
      for (std::size_t i = 0; i < vessel.axis.size(); i += 10)
        ASSERT_TRUE(holds(grid, vessel.axis.points[i], 4.9)) << seed << " " << vessel.name;
  }
}

TEST(Presets, OriginsAreWholeHundredths) {
  const imaging::Geometry grid = grid_of(Preset::full, draw_heart(5));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(grid.origin[axis] * 100.0, std::round(grid.origin[axis] * 100.0), 1e-6);
}

TEST(Presets, RefuseATreeThatTheFieldCannotHold) {
  const HeartShape heart;
  CoronaryTree tree = simple_tree(heart);
  tree.vessels.push_back(straight(3, "D1", 0, Vec3(0, 0, 0), Vec3(0, 0, 400)));
  EXPECT_THROW(grid_of(Preset::full, heart, &tree), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
