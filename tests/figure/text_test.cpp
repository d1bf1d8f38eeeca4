#include "text.h"

#include <gtest/gtest.h>

namespace ostia::figure {
namespace {

TEST(Text, KeepsWellFormedCharactersAndReplacesTheRest) {
  EXPECT_EQ(clean_utf8("L\xC3\xA4nge \xE2\x82\xAC \xF0\x9F\xAB\x80"),
            "L\xC3\xA4nge \xE2\x82\xAC \xF0\x9F\xAB\x80");
  EXPECT_EQ(clean_utf8("a\xFFz"), "a\xEF\xBF\xBDz");
  EXPECT_EQ(clean_utf8("\xC3"), "\xEF\xBF\xBD");                                  // cut short
  EXPECT_EQ(clean_utf8("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
  EXPECT_EQ(clean_utf8("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // surrogate
  EXPECT_EQ(clean_utf8(std::string_view("a\0b\x1b\tc\n", 7)), "ab\tc\n");
}

TEST(Text, TellsColumnsOfNumbers) {
  for (const char* cell : {"1", "-2.5", "3 mm", "95%", "12, 3", "< 0.1", "1e-3"})
    EXPECT_TRUE(looks_numeric(cell)) << cell;
  for (const char* cell : {"", "LAD", "3D", "12-07"}) EXPECT_FALSE(looks_numeric(cell)) << cell;
  EXPECT_EQ(numeric_columns(3, {{"LAD", "1", ""}, {"RCA", "-", ""}, {"1", "2.0", ""}}),
            (std::vector<bool>{false, true, false}));
}

}  // namespace
}  // namespace ostia::figure
