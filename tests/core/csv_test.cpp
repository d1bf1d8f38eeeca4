#include "ostia/core/csv.h"

#include <gmock/gmock.h>

namespace ostia::core {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  CsvCell cell;
  do {
    cell = take_csv_cell(line);
    cells.push_back(cell.text);
  } while (!cell.last);
  EXPECT_TRUE(cell.closed);
  EXPECT_TRUE(line.empty());
  return cells;
}

TEST(Csv, PlainCellsStandAsTheyAre) {
  EXPECT_EQ(csv_line({"LAD prox", "", "1.5", "Ärzte'"}), "LAD prox,,1.5,Ärzte'\n");
}

TEST(Csv, CommasQuotesAndLineEndsArePutInQuotes) {
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("the \"old\" one"), "\"the \"\"old\"\" one\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

TEST(Csv, WhatIsWrittenIsReadBack) {
  const std::vector<std::string> cells{"", "a,b", "\"", "\"\"x", "two\r\nlines", "end\"", ""};
  EXPECT_EQ(cells_of(csv_line(cells)), cells);
}

TEST(Csv, CellsAreTakenOneAfterAnother) {
  EXPECT_THAT(cells_of("x, y ,\r\n"), ElementsAre("x", " y ", ""));
  EXPECT_THAT(cells_of(""), ElementsAre(""));
  EXPECT_THAT(cells_of("\"a\"b,c"), ElementsAre("ab", "c"));
  std::string_view two = "\"a\nb\",c\nd";
  EXPECT_EQ(take_csv_cell(two).line_ends, 1u);
  const CsvCell second = take_csv_cell(two);
  EXPECT_EQ(second.text, "c");
  EXPECT_TRUE(second.last);
  EXPECT_EQ(second.line_ends, 1u);
  EXPECT_EQ(two, "d");
}

TEST(Csv, AReturnWithinQuotesStaysAndOneBeforeTheLinesEndGoes) {
  EXPECT_THAT(cells_of("a,\"b\r\"\n"), ElementsAre("a", "b\r"));
  EXPECT_THAT(cells_of("a,\"b\r\"\r\n"), ElementsAre("a", "b\r"));
  EXPECT_THAT(cells_of("a,\"b\"\r\n"), ElementsAre("a", "b"));
  EXPECT_THAT(cells_of("a,b\r\n"), ElementsAre("a", "b"));
}

TEST(Csv, AQuotationThatDoesNotEndIsTold) {
  std::string_view open = "\"a,b\nc";
  const CsvCell cell = take_csv_cell(open);
  EXPECT_FALSE(cell.closed);
  EXPECT_TRUE(cell.last);
}

}  // namespace
}  // namespace ostia::core
