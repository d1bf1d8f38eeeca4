#include "tree_input.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ostia::live {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Options written(const std::string& name, const std::string& text) {
  Options options;
  options.motion = std::filesystem::path(::testing::TempDir()) / name;
  options.tree = true;
  std::ofstream(options.motion) << text;
  return options;
}

TEST(LiveTreeInput, HasWhatIsAskedOfIt) {
  const TreeInput input = read_tree(
      written("y.swc", "1 0 0 0 0 2 -1\n2 0 0 0 10 2 1\n3 0 3 0 14 1 2\n4 0 -3 0 14 1 2\n"), core::no_task());
  EXPECT_EQ(input.blocks->size(), 3U);
  EXPECT_THAT(input.warnings, IsEmpty());
  EXPECT_EQ(input.reference_name, "line");
  EXPECT_EQ(input.ruler->facts(0).behind.segments, 3);
  const auto hit = input.rays->first({{-20.0, 0.0, 5.0}, {1.0, 0.0, 0.0}, 0.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->place.edge, 0);
}

TEST(LiveTreeInput, SaysWhatIsWrongAndShowsWhatCanBeShown) {
  const TreeInput input =
      read_tree(written("faults.swc", "1 0 0 0 0 2 -1\n2 0 0 0 10 nan 1\n3 0 0 0 10 1 2\n"), core::no_task());
  EXPECT_EQ(input.blocks->size(), 2U);
  ASSERT_FALSE(input.warnings.empty());
  EXPECT_THAT(input.warnings.front(), HasSubstr("ostia tree --repair"));
}

TEST(LiveTreeInput, RefusesWhatCannotBeShown) {
  for (const char* text : {"", "1 0 0 0 0 2 -1\n", "1 0 0 0 0 2 -1\n2 0 nan nan nan 1 1\n"}) {
    const Options options = written("none.swc", text);
    try {
      read_tree(options, core::no_task());
      ADD_FAILURE() << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("none.swc"));
    }
  }
  EXPECT_THROW(read_tree(written("out.swc", "1 0 0 0 0 2 -1\n2 0 0 0 1 1 77\n"), core::no_task()),
               InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(read_tree(written("y2.swc", "1 0 0 0 0 2 -1\n2 0 0 0 10 2 1\n"), task), Cancelled);
}

}  // namespace
}  // namespace ostia::live
