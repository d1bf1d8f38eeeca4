#include "ostia/core/quantity_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::core {
namespace {

constexpr double nan_quantity = std::numeric_limits<double>::quiet_NaN();

TEST(QuantityText, HasTheDigitsOfItsQuantityAndNoMore) {
  EXPECT_EQ(calibre_text(2.7149), "2.71");
  EXPECT_EQ(calibre_text(9.996), "10.0");
  EXPECT_EQ(calibre_text(23.44), "23.4");
  EXPECT_EQ(length_text(12.46), "12.5");
  EXPECT_EQ(length_text(-212.04), "-212.0");
  EXPECT_EQ(area_text(4.2149), "4.21");
  EXPECT_EQ(area_text(12.566), "12.6");
  EXPECT_EQ(area_text(511.6), "512");
  EXPECT_EQ(volume_text(3.449), "3.4");
  EXPECT_EQ(volume_text(511.6), "512");
  EXPECT_EQ(percent_text(56.6), "57");
  EXPECT_EQ(hu_text(344.7), "345");
  EXPECT_EQ(measured_angle_text(31.44), "31.4");
  EXPECT_EQ(set_angle_text(29.9), "30");
  EXPECT_EQ(ratio_text(1.119), "1.12");
}

TEST(QuantityText, AnOpenLumenIsNeverShut) {
  EXPECT_EQ(stenosis_text(99.4), "99");
  EXPECT_EQ(stenosis_text(99.6), "99");
  EXPECT_EQ(stenosis_text(99.999), "99");
  EXPECT_EQ(stenosis_text(100.0), "100");
  EXPECT_EQ(stenosis_text(100.0 - 1e-12), "100");
  EXPECT_EQ(stenosis_text(49.5001), "50");
}

TEST(QuantityText, ZeroHasNoSignAndWhatIsUnknownIsADash) {
  for (const auto text : {calibre_text, length_text, area_text, volume_text, percent_text, stenosis_text,
                          hu_text, measured_angle_text, set_angle_text, ratio_text}) {
    EXPECT_EQ(text(-0.001).find('-'), std::string::npos) << text(-0.001);
    EXPECT_EQ(text(nan_quantity), "-");
    EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "-");
  }
}

}  // namespace
}  // namespace ostia::core
