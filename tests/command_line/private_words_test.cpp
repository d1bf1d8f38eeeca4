#include "private_words.h"

#include <gmock/gmock.h>

namespace ostia::command_line {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

CommandDescription program() {
  OptionDescription log{{"--log"}, "TEXT", {"text", "json"}, {}, {}, false, false};
  OptionDescription input{{"INPUT"}, "TEXT", {}, {}, {}, true, false};
  OptionDescription output{{"-o", "--output"}, "TEXT", {}, {}, {}, true, false};
  OptionDescription flag{{"--json"}, "", {}, {}, {}, false, false};
  CommandDescription mesh{{"ostia", "mesh"}, "", {input, output, flag}, "", {}};
  return {{"ostia"}, "", {log}, "", {mesh}};
}

std::vector<std::string> texts(const std::vector<std::string>& arguments) {
  std::vector<std::string> all;
  for (const PrivateWord& word : private_words(program(), arguments)) all.push_back(word.text);
  return all;
}

std::string alias_of(const std::string& text, const std::vector<std::string>& arguments) {
  for (const PrivateWord& word : private_words(program(), arguments))
    if (word.text == text) return word.alias;
  return "none";
}

TEST(PrivateWords, AreNoWordsOfTheProgramAndNoNumbers) {
  EXPECT_THAT(texts({"mesh", "--log", "json", "--json", "-o", "out"}), IsEmpty());
  EXPECT_THAT(texts({"mesh", "--log=json", "1.5", "-3,2.5e1,7:1,2,3", "-"}), IsEmpty());
}

TEST(PrivateWords, OfAPathAreItsFolderAndAllItsParts) {
  const std::vector<std::string> arguments{"mesh", "/data/SmithJohn/DOE^JANE.nii.gz", "-o",
                                           "Smith out/x.vtp"};
  for (const char* part : {"/data/SmithJohn/DOE^JANE.nii.gz", "/data/SmithJohn", "SmithJohn",
                           "DOE^JANE.nii.gz", "DOE^JANE.nii", "DOE^JANE", "Smith out", "x.vtp"})
    EXPECT_THAT(texts(arguments), Contains(part));
  EXPECT_THAT(texts(arguments), Not(Contains("data")));
  EXPECT_EQ(alias_of("DOE^JANE", arguments), "INPUT");
  EXPECT_EQ(alias_of("x.vtp", arguments), "OUTPUT");
  EXPECT_EQ(alias_of("/data/SmithJohn", arguments), "FOLDER");
}

TEST(PrivateWords, AreFoundInListsAndInWhatNoOptionTakes) {
  EXPECT_THAT(texts({"mesh", "--set=scan=SmithJohn/a.nrrd"}), Contains("SmithJohn"));
  EXPECT_THAT(texts({"mesh", "--no-such=DOE"}), Contains("DOE"));
  EXPECT_THAT(texts({"mesh", "--SmithJohn"}), Contains("SmithJohn"));
  EXPECT_THAT(texts({"mesh", "-oSmithJohn"}), Contains("oSmithJohn"));
  EXPECT_THAT(texts({"SmithJohn"}), Contains("SmithJohn"));
}

TEST(PrivateWords, ADicomUidIsOne) {
  EXPECT_THAT(texts({"mesh", "1.2.840.113619.2.55.3.604688119.971.1305886000.1"}),
              Contains("1.2.840.113619.2.55.3.604688119.971.1305886000.1"));
}

TEST(ValueOf, IsTheLastOneInEitherForm) {
  EXPECT_EQ(value_of("--log", {"--log", "text", "--log=json"}), "json");
  EXPECT_EQ(value_of("--log", {"--log=json", "--log", "text"}), "text");
  EXPECT_EQ(value_of("--log", {"mesh", "--log"}), "");
}

TEST(PrivateWords, AreNoneThatTheHelpIsWrittenWith) {
  CommandDescription with_help = program();
  with_help.commands[0].text = "A mesh of vessels, by Smith: left open";
  const std::set<std::string> ordinary = ordinary_words(with_help);
  for (const char* word : {"mesh", "vessels", "left", "open"}) EXPECT_TRUE(ordinary.contains(word)) << word;
  EXPECT_FALSE(ordinary.contains("Smith"));
  std::set<std::string> found;
  for (const PrivateWord& word : private_words(with_help, {"mesh", "vessels", "-o", "Smith/open"}))
    found.insert(word.text);
  EXPECT_THAT(found, ::testing::UnorderedElementsAre("Smith/open", "Smith"));
}

TEST(PrivatePaths, AreWhatHasAFolderOrLiesThere) {
  std::vector<std::string> found;
  const auto exists = [](const std::string& name) { return name == "DOE.nrrd"; };
  for (const PrivateWord& word :
       private_paths(program(), {"mesh", "DOE.nrrd", "-o", "LAD", "--set=/data/ROE/ct.nii"}, exists))
    found.push_back(word.text);
  EXPECT_THAT(found, Contains("DOE.nrrd"));
  EXPECT_THAT(found, Contains("/data/ROE/ct.nii"));
  EXPECT_THAT(found, Contains("ct.nii"));
  EXPECT_THAT(found, Not(Contains("LAD"))) << "it may as well be a vessel";
  EXPECT_THAT(found, Not(Contains("DOE")));
}

}  // namespace
}  // namespace ostia::command_line
