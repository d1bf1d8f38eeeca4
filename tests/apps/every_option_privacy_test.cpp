// A name that is given to any option of any command comes up in no log that is kept.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <mutex>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const std::string planted = "SmithJohn";
const std::string planted_file = "DOE^JANE";

struct Tried {
  std::vector<std::string> arguments;
  std::string what;  ///< command and option
};

std::string long_name(const Json& option) {
  return option["names"].back();
}

bool is_positional(const Json& option) {
  return long_name(option).front() != '-';
}

/// Files that hold nothing of use and folders, called after somebody; and those that are not there.
std::vector<std::string> values(const std::filesystem::path& folder) {
  return {(folder / planted / (planted_file + ".vtp")).string(), (folder / planted / "missing.nrrd").string(),
          (folder / planted).string(), planted};
}

/// One value for the option, and one for each that the command cannot do without.
std::vector<std::string> with_value(const Json& command, const Json& option, const std::string& value) {
  std::vector<std::string> arguments(std::next(command["words"].begin()), command["words"].end());
  const auto give = [&](const Json& one) {
    if (!is_positional(one)) arguments.push_back(long_name(one));
    if (is_positional(one) || !one["value"].get<std::string>().empty()) arguments.push_back(value);
  };
  for (const Json& other : command["options"])
    if (other["required"].get<bool>() && other != option) give(other);
  give(option);
  return arguments;
}

void collect(const Json& command, const std::vector<std::string>& given, std::vector<Tried>& all) {
  for (const Json& option : command["options"]) {
    if (option["value"].get<std::string>().empty() || long_name(option) == "--log") continue;
    const std::string& value = given[all.size() % given.size()];
    all.push_back({with_value(command, option, value) + std::vector<std::string>{"--log", "json"},
                   command["words"].back().get<std::string>() + " " + long_name(option)});
  }
  for (const Json& below : command["commands"]) collect(below, given, all);
}

Json described() {
  const auto folder = temporary_folder("described");
  EXPECT_EQ(ostia({"--describe", folder.string()}).code, 0);
  return Json::parse(core::read_file(folder / "ostia-commands.json"));
}

TEST(EveryOption, NamesNobodyInALogThatIsKept) {
  const auto folder = temporary_folder("every-option");
  std::filesystem::create_directory(folder / planted);
  core::write_file(folder / planted / (planted_file + ".vtp"), "nothing of use");
  std::vector<Tried> all;
  collect(described(), values(folder), all);
  ASSERT_GT(all.size(), 300u) << "the tree of commands is not walked";
  std::mutex mutex;
  std::size_t refused = 0;
  core::parallel_chunks(all.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      // Some go on to long work with what they were given; what they say before is enough.
      const Outcome done = ostia(all[i].arguments, {folder, "timeout -k 1 -s INT 1"});
      const std::lock_guard lock(mutex);
      if (done.code != 0) ++refused;
      EXPECT_TRUE(done.code != 126 && done.code != 127) << "the program was not started: " << done.err;
      EXPECT_THAT(done.out + done.err, Not(HasSubstr(planted))) << all[i].what;
      EXPECT_THAT(done.out + done.err, Not(HasSubstr(planted_file))) << all[i].what;
    }
  });
  EXPECT_GT(refused, all.size() / 2);
}

TEST(EveryOption, IsSaidInFullToAPerson) {
  const auto folder = temporary_folder("every-option-text");
  const Outcome done = ostia({"info", (folder / (planted + ".vtp")).string()});
  EXPECT_THAT(done.err, HasSubstr(planted));
}

}  // namespace
}  // namespace ostia::testing
