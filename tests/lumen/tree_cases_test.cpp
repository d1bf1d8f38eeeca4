// Walls of whole coronary trees: two of the eighteen cases of tree_cases_slow_test.cpp.

#include "tree_cases.h"

namespace ostia::lumen {
namespace {

TEST(WallOfACase, OfTubesIsSoundAndStaysSo) {
  testing::expect_walls(testing::tubes_of(testing::phantom_case(0)), 0.25, 1);
}

TEST(WallOfACase, FromContoursIsSoundAndStaysSo) {
  testing::expect_walls(testing::contour_model_of(testing::phantom_case(5)), 0.25, 2);
}

}  // namespace
}  // namespace ostia::lumen
