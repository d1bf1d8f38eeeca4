#include "ostia/view/overlay.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::view {
namespace {

TEST(ScaleBar, IsARoundLengthOfAtMostAQuarterOfTheView) {
  EXPECT_EQ(scale_bar(0.1, 400).text, "10 mm");
  EXPECT_DOUBLE_EQ(scale_bar(0.1, 400).length_px, 100.0);
  EXPECT_EQ(scale_bar(0.1, 399).text, "5 mm");
  EXPECT_EQ(scale_bar(0.5, 600).text, "50 mm");
  EXPECT_EQ(scale_bar(0.01, 100).text, "0.2 mm");
}

TEST(ScaleBar, IsLeftOutWhereThereIsNoScale) {
  EXPECT_TRUE(scale_bar(0.0, 400).text.empty());
  EXPECT_TRUE(scale_bar(0.1, 0).text.empty());
  EXPECT_TRUE(scale_bar(std::numeric_limits<double>::quiet_NaN(), 400).text.empty());
}

}  // namespace
}  // namespace ostia::view
