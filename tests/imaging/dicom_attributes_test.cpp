#include "dicom_attributes.h"

#include <gtest/gtest.h>

#include <clocale>

namespace ostia::imaging {
namespace {

TEST(ParseDecimal, TakesDecimalStringsOnly) {
  EXPECT_EQ(parse_decimal("0.5"), 0.5);
  EXPECT_EQ(parse_decimal("  +12 "), 12.0);
  EXPECT_EQ(parse_decimal("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_decimal(std::string_view("7\0", 2)), 7.0);
  for (const char* wrong : {"", " ", "0,5", "nan", "inf", "1e999", "1.0mm", "+-1", "0x10"}) {
    EXPECT_FALSE(parse_decimal(wrong)) << wrong;
  }
}

TEST(ParseDecimal, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // does nothing where that locale is not installed
  EXPECT_EQ(parse_decimal("0.625"), 0.625);
  EXPECT_FALSE(parse_decimal("0,625"));
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(DicomAttributes, SpacingWithACommaIsRefusedWithItsText) {
  DicomAttributes attributes;
  try {
    attributes.set(dicom_tag(0x0028, 0x0030), "0,5\\0,5", false);
    FAIL() << "a decimal comma was taken";
  } catch (const DicomDamage& damage) {
    EXPECT_NE(damage.message.find("PixelSpacing"), std::string::npos) << damage.message;
    EXPECT_NE(damage.message.find("0,5\\0,5"), std::string::npos) << damage.message;
  }
}

TEST(DicomAttributes, CountsOfNumbersAreChecked) {
  DicomAttributes attributes;
  EXPECT_THROW(attributes.set(dicom_tag(0x0028, 0x0030), "0.5", false), DicomDamage);
  EXPECT_THROW(attributes.set(dicom_tag(0x0028, 0x0030), "0.5\\0.5\\0.5", false), DicomDamage);
  EXPECT_THROW(attributes.set(dicom_tag(0x0020, 0x0032), "1\\2\\", false), DicomDamage);
  EXPECT_THROW(attributes.set(dicom_tag(0x0028, 0x0008), "-3", false), DicomDamage);
  EXPECT_THROW(attributes.set(dicom_tag(0x0028, 0x0008), "99999999", false), DicomDamage);
  EXPECT_THROW(attributes.set(dicom_tag(0x0028, 0x0008), "1.5", false), DicomDamage);
}

TEST(DicomAttributes, FramesTakeWhatIsCommonUnlessTheyHaveTheirOwn) {
  DicomAttributes attributes;
  attributes.header.frame_count = 2;
  attributes.shared.slope = 2.0;
  attributes.shared.intercept = -1000.0;
  attributes.per_frame.resize(2);
  attributes.per_frame[1].slope = 3.0;
  attributes.finish();
  EXPECT_EQ(attributes.header.frames[0].slope, 2.0);
  EXPECT_EQ(attributes.header.frames[1].slope, 3.0);
  EXPECT_EQ(attributes.header.frames[1].intercept, -1000.0);
}

TEST(DicomAttributes, DescribedFramesMustBeAsManyAsThereAre) {
  DicomAttributes attributes;
  attributes.header.frame_count = 3;
  attributes.per_frame.resize(2);
  EXPECT_THROW(attributes.finish(), DicomDamage);
}

TEST(DicomAttributes, TextIsFreedOfControlCharacters) {
  DicomAttributes attributes;
  attributes.set(dicom_tag(0x0008, 0x103E), "Heart\x1B[2J \n", false);
  EXPECT_EQ(attributes.header.description, "Heart [2J");
}

}  // namespace
}  // namespace ostia::imaging
