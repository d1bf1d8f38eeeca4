// `ostia experiment hard` and `ostia phantom --suite hard`: what they refuse and leave.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(HardCommand, NamesWhatIsWrongAndLeavesNothing) {
  const auto folder = temporary_folder("hard-command");
  const Outcome none = ostia({"experiment", "hard", "-o", "out", "--cases", "0"}, {folder, ""});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("--cases"));
  std::filesystem::create_directory(folder / "masks");
  const Outcome empty = ostia({"experiment", "hard", "-o", "out", "--masks", "masks"}, {folder, ""});
  EXPECT_EQ(empty.code, 3);
  EXPECT_THAT(empty.err, AllOf(HasSubstr("masks holds no masks"), HasSubstr("leave --masks out")));
  core::write_file(folder / "masks" / "broken.nrrd", "NRRD0004\n");
  const Outcome broken = ostia({"experiment", "hard", "-o", "out", "--masks", "masks"}, {folder, ""});
  EXPECT_EQ(broken.code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(HardCommand, ASuiteDrawsWhatIsThenNotAskedFor) {
  const auto folder = temporary_folder("hard-command");
  const std::vector<std::string> suite{"phantom", "-o",           "out",        "--suite",
                                       "hard",    "--preset",     "tiny",       "--surface-spacing",
                                       "1",       "--truth-only", "--no-report"};
  const Outcome both = ostia(suite + std::vector<std::string>{"--noise", "30"}, {folder, ""});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, AllOf(HasSubstr("--noise"), HasSubstr("--suite")));
  const Outcome made = ostia(suite + std::vector<std::string>{"--json"}, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["parameters"]["suite"], "hard");
}

}  // namespace
}  // namespace ostia::testing
