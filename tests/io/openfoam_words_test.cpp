#include "ostia/io/openfoam_words.h"

#include "io_test_support.h"

#include <gmock/gmock.h>

namespace ostia::io {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> words_of(const std::string& text) {
  OpenfoamWords words(file_with("U", text));
  std::vector<std::string> all;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) all.emplace_back(word);
  return all;
}

TEST(OpenfoamWords, MarksStandAloneAndCommentsAreSkipped) {
  EXPECT_THAT(words_of("a{b (1 -2e3);} // c\n/* d\n*/ \"e; f\" g"),
              ElementsAre("a", "{", "b", "(", "1", "-2e3", ")", ";", "}", "\"e; f\"", "g"));
  EXPECT_THAT(words_of(" \t\r\n// nothing"), ElementsAre());
  EXPECT_THAT(words_of("a /* without an end"), ElementsAre("a"));
}

TEST(OpenfoamWords, EntriesAreSkippedWithTheirBrackets) {
  OpenfoamWords words(file_with("U", "value nonuniform 2 ((1 2 3) (4 5 6)); inner { a 1; b { c; } } last"));
  EXPECT_EQ(words.next(), "value");
  words.skip_entry();
  EXPECT_EQ(words.next(), "inner");
  words.skip_entry();
  EXPECT_EQ(words.peek(), "last");
  EXPECT_EQ(words.next(), "last");
}

TEST(OpenfoamWords, RefusalsNameFileAndLine) {
  const auto path = file_with("U", "a\nb\n(c");
  OpenfoamWords words(path);
  words.next();
  expect_refusal(path, [&] { words.expect("d"); }, {"line 2", "\"d\" is expected, not \"b\""});
  expect_refusal(path, [&] { words.skip_entry(); }, {"line 3", "ends within an entry"});
}

}  // namespace
}  // namespace ostia::io
