// Numbers of scales and ranges, as they are read.

#include "ostia/view/value_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

TEST(ValueScale, ThreeDigitsCount) {
  EXPECT_EQ(three_digits(0.0), "0");
  EXPECT_EQ(three_digits(1.23456), "1.23");
  EXPECT_EQ(three_digits(-12.3456), "-12.3");
  EXPECT_EQ(three_digits(123.456), "123");
  EXPECT_EQ(three_digits(12345.6), "12300");
  EXPECT_EQ(three_digits(9.996), "10.0");
  EXPECT_EQ(three_digits(999.6), "1000");
  EXPECT_EQ(three_digits(0.00123456), "0.00123");
  EXPECT_EQ(three_digits(1.2345e-7), "1.23e-07");
  EXPECT_EQ(three_digits(1.2345e9), "1.23e+09");
  EXPECT_EQ(three_digits(std::nan("")), "-");
  EXPECT_EQ(three_digits(std::numeric_limits<double>::infinity()), "-");
}

TEST(ValueScale, RangesAreRoundedOutwardsToThreeDigits) {
  const auto texts = [](double low, double high) {
    const auto range = rounded_range({low, high});
    EXPECT_LE(range.first, low + 1e-6 * std::abs(low));
    EXPECT_GE(range.second, high - 1e-6 * std::abs(high));
    EXPECT_LT(range.first, range.second);
    return range_text(range.first, range) + " " + range_text(range.second, range);
  };
  EXPECT_EQ(texts(1.12567, 10.87543), "1.1 10.9");
  EXPECT_EQ(texts(0.123456, 5.43219), "0.12 5.44");
  EXPECT_EQ(texts(-3.21987, 0.5), "-3.22 0.5");
  EXPECT_EQ(texts(2.0, 98.0), "2 98");
  EXPECT_EQ(texts(0.0, 1.0), "0 1");
  EXPECT_EQ(texts(11873.0, 45678.9), "11800 45700");
  // Where three digits would hardly tell them apart there are more.
  EXPECT_EQ(texts(11912.0, 12187.0), "11910 12190");
  EXPECT_EQ(texts(13332.03, 13333.97), "13332.03 13333.97");
  EXPECT_EQ(texts(1.2e-5, 3.4567e-5), "0.000012 0.0000346");
  EXPECT_EQ(rounded_range({5.0, 5.0}), std::pair(5.0, 5.0));
  EXPECT_EQ(rounded_range({1.0, INFINITY}).first, 1.0);
}

}  // namespace
}  // namespace ostia::view
