#include "ostia/pipeline/branch_ends.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

segmentation::BranchSeeds pair(const Vec3& a, const Vec3& b) {
  return {a, std::nullopt, b};
}

TEST(BranchEnds, OnePairHasOneTarget) {
  const BranchEnds ends = ends_of({pair({0, 0, 0}, {0, 0, 10})});
  EXPECT_EQ(ends.source, Vec3(0, 0, 0));
  EXPECT_EQ(ends.targets, std::vector<Vec3>{Vec3(0, 0, 10)});
}

TEST(BranchEnds, PairsInARowShareTheirJoint) {
  const BranchEnds ends = ends_of({pair({0, 0, 0}, {0, 0, 10}), pair({0, 0, 10.4}, {0, 0, 20})});
  EXPECT_EQ(ends.targets, std::vector<Vec3>{Vec3(0, 0, 20)});
}

TEST(BranchEnds, AForkHasTwoTargets) {
  EXPECT_EQ(ends_of({pair({0, 0, 0}, {0, 0, 10}), pair({0, 0, 0}, {5, 0, 10})}).targets.size(), 2u);
}

TEST(BranchEnds, RefusesNothingAndRings) {
  EXPECT_THROW(ends_of({}), InvalidInput);
  EXPECT_THROW(ends_of({pair({0, 0, 0}, {9, 0, 0}), pair({9, 0, 0}, {0, 9, 0}), pair({0, 9, 0}, {0, 0, 0})}),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::pipeline
