// The bar of the tree's wall: closed, manifold, without self-intersections and on its level for 18 cases,
// from tubes and from contours, as they are and after edits.

#include "tree_cases.h"

namespace ostia::lumen {
namespace {

class WallOfEachCase : public ::testing::TestWithParam<int> {
 protected:
  phantom::CasePlan plan = testing::phantom_case(GetParam());
  unsigned seed = 100 + static_cast<unsigned>(GetParam());
};

TEST_P(WallOfEachCase, OfTubes) {
  testing::expect_walls(testing::tubes_of(plan), 0.0, seed);
}
TEST_P(WallOfEachCase, FromContours) {
  testing::expect_walls(testing::contour_model_of(plan), 0.0, seed);
}

INSTANTIATE_TEST_SUITE_P(Suite, WallOfEachCase, ::testing::Range(0, 18));

}  // namespace
}  // namespace ostia::lumen
