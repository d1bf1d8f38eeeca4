#include "ostia/core/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace ostia::core {
namespace {

/// As RFC 3629 writes a code, in so many bytes.
std::string encoded_in(std::uint32_t code, std::size_t bytes) {
  if (bytes == 1) return {static_cast<char>(code)};
  std::string text;
  for (std::size_t n = 1; n < bytes; ++n, code >>= 6)
    text.insert(text.begin(), static_cast<char>(0x80 | (code & 0x3F)));
  return static_cast<char>((0xF00 >> bytes & 0xFF) | code) + text;
}

std::size_t bytes_of(std::uint32_t code) {
  return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

TEST(Utf8, EachCodeIsWellFormedInItsShortestFormAlone) {
  for (std::uint32_t code = 0; code < 0x110400; ++code) {
    const std::size_t bytes = bytes_of(code);
    const bool sound = code < 0x110000 && (code < 0xD800 || code > 0xDFFF);
    ASSERT_EQ(utf8_length(encoded_in(code, bytes) + "x"), sound ? bytes : 0) << std::hex << code;
    if (bytes > 1) {
      ASSERT_EQ(utf8_length(encoded_in(code, bytes).substr(0, bytes - 1)), 0U) << std::hex << code;
    }
    if (code < 0x10000) {
      ASSERT_EQ(utf8_length(encoded_in(code, bytes + 1)), 0U) << std::hex << code;
    }
  }
}

TEST(Utf8, BytesThatBeginNothingAreNone) {
  EXPECT_EQ(utf8_length(""), 0U);
  for (int first = 0x80; first < 0x100; ++first)
    EXPECT_EQ(utf8_length(std::string(1, static_cast<char>(first))), 0U) << first;
  EXPECT_EQ(utf8_length("\xC3x"), 0U);
  EXPECT_EQ(utf8_length("\xE2\x82x"), 0U);
}

TEST(Utf8, OfATextAllCounts) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("Gef\xC3\xA4\xC3\x9F \xE2\x82\xAC \xF0\x9F\xAB\x80"));
  EXPECT_FALSE(is_utf8("Gef\xE4\xDF"));
  EXPECT_FALSE(is_utf8("cut \xE2\x82"));
}

}  // namespace
}  // namespace ostia::core
