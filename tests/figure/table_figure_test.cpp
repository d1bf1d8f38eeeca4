#include "ostia/core/error.h"
#include "ostia/figure/plot.h"

#include <gtest/gtest.h>

namespace ostia::figure {
namespace {

TEST(TableFigure, GrowsWithItsRowsAndItsLongestCells) {
  const Picture small = table_figure({"Vessel", "mm"}, {{"LAD", "1.0"}});
  const Picture high = table_figure({"Vessel", "mm"}, {{"LAD", "1.0"}, {"LCX", "2.0"}, {"RCA", "3.0"}});
  const Picture wide = table_figure({"Vessel", "mm"}, {{"a vessel with a very long name", "1.0"}});
  EXPECT_EQ(high.width(), small.width());
  EXPECT_NEAR(high.height() - small.height(), 2 * 26, 1);
  EXPECT_GT(wide.width(), small.width() + 100);
}

TEST(TableFigure, RefusesRaggedRowsAndNoColumns) {
  EXPECT_THROW(table_figure({}, {}), InvalidInput);
  EXPECT_THROW(table_figure({"a", "b"}, {{"1"}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
