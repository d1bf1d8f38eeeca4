#include "test_graphs.h"

#include "ostia/reconstruction/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;

TEST(Sections, LieEvenlyOnAStraightVessel) {
  const auto x = section_abscissas({0.0, 12.0}, {1.0, 1.0}, {0.0, 0.0}, 1.5, 4.0);
  ASSERT_EQ(x.size(), 5u);  // 12 mm in pieces of 2 * 1.5 mm
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], 3.0 * static_cast<double>(i), 1e-9);
}

TEST(Sections, SatisfyTheEquationWhereTheRadiusChanges) {
  // r = 2 - 0.1 x, so that eq. 2 holds for w = r with one spacing throughout.
  const auto x = section_abscissas({0.0, 15.0}, {2.0, 0.5}, {0.0, 0.0}, 1.0, 4.0);
  ASSERT_GT(x.size(), 3u);
  const auto spacing = [&](std::size_t i) {
    return (x[i + 1] - x[i]) / ((2.0 - 0.1 * x[i]) + (2.0 - 0.1 * x[i + 1]));
  };
  for (std::size_t i = 1; i + 1 < x.size(); ++i) EXPECT_NEAR(spacing(i), spacing(0), 1e-6);
  EXPECT_LT(x[x.size() - 1] - x[x.size() - 2], 0.5 * (x[1] - x[0]));
}

TEST(Sections, AreCloserInABend) {
  const auto x =
      section_abscissas({0.0, 10.0, 10.001, 20.0}, {1.0, 1.0, 1.0, 1.0}, {0.0, 0.0, 0.25, 0.25}, 1.0, 4.0);
  EXPECT_NEAR((x[1] - x[0]) / (x[x.size() - 1] - x[x.size() - 2]), 2.0, 1e-3);  // 1 + 4 * 1 * 0.25
}

TEST(Trunk, IsTheLikerBranchOfTwoAtLikeAngles) {
  const std::vector<ostia::geometry::Vec3> directions{reconstruction::testing::direction(30.0),
                                                      reconstruction::testing::direction(-35.0)};
  EXPECT_EQ(trunk_of(ostia::geometry::Vec3::UnitX(), 1.0, directions, {0.3, 0.95}, 0.5), 1);
  EXPECT_EQ(trunk_of(ostia::geometry::Vec3::UnitX(), 1.0, directions, {0.3, 0.95}, 1.0), 0);
  EXPECT_EQ(trunk_of(ostia::geometry::Vec3::UnitX(), 1.0, {}, {}, 0.5), -1);
}

}  // namespace
