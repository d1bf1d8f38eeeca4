#include "ostia/session/tool.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

namespace ostia::session {
namespace {

TEST(Tools, EachHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const Tool tool : all_tools) {
    EXPECT_EQ(traits_of(tool).tool, tool);
    EXPECT_TRUE(names.insert(traits_of(tool).name).second) << traits_of(tool).name;
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("browse", "drag", "draw", "brush", "axis", "add_vessel",
                                                     "add_artery", "distance", "angle", "area", "diameter",
                                                     "stenosis", "volume", "ring_hu", "arrow", "note"))
      << "recordings have these";
  EXPECT_THROW(traits_of(static_cast<Tool>(99)), InvalidInput);
}

TEST(Tools, EachMeasurementIsPlacedByOneThatIsCalledAlike) {
  std::vector<analysis::MeasureKind> placed;
  for (const Tool tool : all_tools) {
    const auto kind = measure_kind(tool);
    if (!kind) continue;
    EXPECT_EQ(traits_of(tool).name, analysis::traits_of(*kind).name);
    placed.push_back(*kind);
  }
  EXPECT_THAT(placed, ::testing::UnorderedElementsAreArray(analysis::measure_kinds));
}

}  // namespace
}  // namespace ostia::session
