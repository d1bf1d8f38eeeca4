#include "level_set/initialization.h"

#include <gmock/gmock.h>

namespace ostia::segmentation::detail {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Trunk 0, from it 1 and 2, from 2 on 3; 4 stands by itself.
const std::vector<BranchSeeds> tree{{{0, 0, 0}, std::nullopt, {10, 0, 0}},
                                    {{10, 0, 0}, std::nullopt, {20, 5, 0}},
                                    {{10, 0.5, 0}, std::nullopt, {20, -5, 0}},
                                    {{20, -5, 0}, std::nullopt, {30, -5, 0}},
                                    {{0, 90, 0}, std::nullopt, {10, 90, 0}}};

TEST(CutOff, WhatHangsOnALeftOutBranchGoesWithIt) {
  EXPECT_THAT(cut_off(tree, {0, 1, 2, 3, 4}), IsEmpty());
  EXPECT_THAT(cut_off(tree, {0, 1, 3, 4}), ElementsAre(3));  // without 2
  EXPECT_THAT(cut_off(tree, {0, 2, 3, 4}), IsEmpty());       // an end alone is missing
  EXPECT_THAT(cut_off(tree, {1, 2, 3, 4}), IsEmpty());       // the others still meet where the trunk ended
  EXPECT_THAT(cut_off(tree, {0, 3}), ElementsAre(3));        // of two as large the first stays
  EXPECT_THAT(cut_off(tree, {4}), IsEmpty());
}

}  // namespace
}  // namespace ostia::segmentation::detail
