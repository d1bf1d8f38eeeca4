// `ostia doctor`.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/core/process_cell.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A folder, called after somebody, with what a killed run leaves.
fs::path left_by_a_killed_run() {
  const fs::path folder = temporary_folder("doctor") / "SmithJohn";
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  fs::create_directory(folder);
  core::write_file(folder / (".part-" + std::to_string(child) + "-0-DOE^JANE.vtp"), "half");
  return folder;
}

TEST(DoctorCommand, TellsOfTheMachineAndTheWorker) {
  const Setting in{temporary_folder("doctor"), ""};
  const Outcome done = ostia({"doctor", "--json"}, in);
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["worker"], "runs");
  EXPECT_EQ(told["cell"]["calls"], core::possible_cell().calls);
  EXPECT_EQ(told["cell"]["files"], core::possible_cell().files);
  EXPECT_GT(told["memory_gb"], 0.1);
  EXPECT_EQ(done.code, told["well"] ? 0 : 4);
  EXPECT_THAT(ostia({"doctor"}, in).out, HasSubstr("worker      runs"));
}

TEST(DoctorCommand, ShowsStraysAndMendsThemAndNamesNobody) {
  const fs::path folder = left_by_a_killed_run();
  const Setting in{folder.parent_path(), ""};
  const Outcome seen = ostia({"doctor", "SmithJohn"}, in);
  EXPECT_EQ(seen.code, 4);
  EXPECT_THAT(seen.out, HasSubstr("1 stray of runs that were killed; --mend removes"));
  EXPECT_THAT(seen.out + seen.err, Not(::testing::AnyOf(HasSubstr("SmithJohn"), HasSubstr("DOE^JANE"))));
  EXPECT_FALSE(fs::is_empty(folder)) << "it was only looked at";
  const Json mended = Json::parse(ostia({"doctor", "SmithJohn", "--mend", "--json"}, in).out);
  EXPECT_EQ(mended["looked_at"][0]["removed"], 1);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(DoctorCommand, OpensACaseAndSaysWhatIsAmissWithAnother) {
  const fs::path folder = temporary_folder("doctor");
  const Setting in{folder, ""};
  core::write_file(folder / "tube.csv",
                   "x,y,z,radius\n0,0,0,1.5\n0,0,5,1.5\n0,0,10,1.5\n0,0,15,1.5\n0,0,20,1.5\n");
  ASSERT_EQ(ostia({"lumen", "tube.csv", "-o", "tube.stl", "--case", "tube.ostia"}, in).code, 0);
  const std::string whole = core::read_file(folder / "tube.ostia");
  core::write_file(folder / "cut.ostia", whole.substr(0, whole.size() / 2));
  const Outcome done = ostia({"doctor", "tube.ostia", "cut.ostia", "--json"}, in);
  EXPECT_EQ(done.code, 4);
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["looked_at"][0]["sound"], true);
  EXPECT_EQ(told["looked_at"][0]["steps"], 1);
  EXPECT_EQ(told["looked_at"][1]["sound"], false);
  EXPECT_EQ(core::read_file(folder / "tube.ostia"), whole);
  EXPECT_EQ(ostia({"doctor", "missing"}, in).code, 3);
}

}  // namespace
}  // namespace ostia::testing
