#include "ostia/core/text.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace ostia::core {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double no_number = std::numeric_limits<double>::quiet_NaN();

/// What the C library writes.
std::string printed(const char* format, int precision, double value) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, precision, value);
  return text.data();
}

/// Of all sizes, of the sizes that are measured, at halves of the last digit, and those that are not usual.
std::vector<double> numbers() {
  std::vector<double> all{0.0,     -0.0,     0.5,     1.5,     2.5,       0.125,      0.375,  -0.001, 9.9995,
                          99999.5, 999999.5, 1e5,     1e-4,    9.9e-5,    1e15,       1e22,   1e23,   1e300,
                          5e-324,  0.1,      1.0 / 3, 2.0 / 3, no_number, -no_number, 1e-300, 0.0995, 1e308,
                          1e16,    -1.0,     100.0,   -12.5,   infinity,  -infinity};
  std::mt19937_64 random(7);
  for (int i = 0; i < 5000; ++i) all.push_back(std::bit_cast<double>(random()));
  for (int i = 0; i < 5000; ++i) all.push_back(std::ldexp(static_cast<double>(random() >> 11), -53 + i % 14));
  for (int i = 0; i < 2000; ++i) all.push_back((i - 1000) / 1000.0);
  for (int i = 0; i < 2000; ++i) all.push_back((i - 1000) / 64.0);
  return all;
}

TEST(NumberText, IsWhatPrintfWrites) {
  for (const double value : numbers()) {
    for (const int n : {0, 1, 2, 3, 4, 6, 9}) {
      ASSERT_EQ(fixed_text(value, n), printed("%.*f", n, value)) << n << " decimals";
      ASSERT_EQ(signed_text(value, n), printed("%+.*f", n, value)) << n << " decimals";
    }
    for (const int n : {1, 2, 3, 4, 5, 6, 7, 9, 12, 17})
      ASSERT_EQ(significant_text(value, n), printed("%.*g", n, value)) << n << " digits";
  }
}

TEST(NumberText, KeepsDecimalsAndTheSignOfZero) {
  EXPECT_EQ(fixed_text(0.125, 2), "0.12");
  EXPECT_EQ(fixed_text(2.5, 0), "2");
  EXPECT_EQ(fixed_text(-0.001, 2), "-0.00");
  EXPECT_EQ(fixed_text(1e22, 1), "10000000000000000000000.0");
  EXPECT_EQ(fixed_text(no_number, 2), "nan");
  EXPECT_EQ(fixed_text(-infinity, 2), "-inf");
  EXPECT_EQ(signed_text(0.125, 2), "+0.12");
  EXPECT_EQ(signed_text(0.0, 1), "+0.0");
  EXPECT_EQ(signed_text(-3.0, 0), "-3");
  EXPECT_EQ(significant_text(1234.6, 4), "1235");
  EXPECT_EQ(significant_text(12345.6, 4), "1.235e+04");
  EXPECT_EQ(significant_text(-0.0, 4), "-0");
  EXPECT_EQ(mm_text(1.25), "1.25 mm");
  EXPECT_EQ(mm_text(1.25, 1), "1.2 mm");
}

TEST(NumberText, ShortestReadsBackAsTheSameBits) {
  EXPECT_EQ(shortest_text(0.1), "0.1");
  EXPECT_EQ(shortest_text(100.0), "100");
  EXPECT_EQ(shortest_text(1e5), "1e+05");
  EXPECT_EQ(shortest_text(123456.0), "123456");
  EXPECT_EQ(shortest_text(-0.0), "-0");
  EXPECT_EQ(shortest_text(no_number), "nan");
  for (const double value : numbers()) {
    if (std::isnan(value)) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(shortest_text(value).c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(value))
        << shortest_text(value);
  }
}

TEST(NumberText, TrimsZerosBehindThePointAlone) {
  EXPECT_EQ(trimmed_text(12.5, 6), "12.5");
  EXPECT_EQ(trimmed_text(1200.0, 6), "1200");
  EXPECT_EQ(trimmed_text(1200.0, 0), "1200");
  EXPECT_EQ(trimmed_text(-1e-9, 6), "-0");
  EXPECT_EQ(trimmed_text(infinity, 6), "inf");
}

TEST(NumberText, RoundsHalvesAwayFromZero) {
  EXPECT_EQ(rounded_text(2.5, 0), "3");
  EXPECT_EQ(rounded_text(-2.5, 0), "-3");
  EXPECT_EQ(rounded_text(0.125, 2), "0.13");
  EXPECT_EQ(rounded_text(0.05, 1), "0.1");
  EXPECT_EQ(rounded_text(-0.4, 0), "0");
  EXPECT_EQ(rounded_text(no_number, 0), "nan");
}

TEST(NumberText, CutsWithoutRounding) {
  EXPECT_EQ(cut_text(1.999, 2), "1.99");
  EXPECT_EQ(cut_text(1.0 - 1e-9, 2), "1.00");  // six decimals come first
  EXPECT_EQ(cut_text(-7.0, 1), "-7.0");
  EXPECT_EQ(cut_text(-infinity, 1), "-inf");
}

TEST(NumberText, TellsReadersWhatIsUnknown) {
  EXPECT_EQ(fixed_or_dash(-0.001, 2), "-0.00");
  EXPECT_EQ(fixed_or_dash(infinity, 2), "-");
  EXPECT_EQ(shown_text(-12.345, 1), "-12.3");
  EXPECT_EQ(shown_text(-0.04, 1), "0.0");
  EXPECT_EQ(shown_text(-0.0, 0), "0");
  EXPECT_EQ(shown_text(1e6, 0), "1000000");
  EXPECT_EQ(shown_text(no_number, 1), "-");
  EXPECT_EQ(shown_text(no_number, 1, "\xE2\x80\x93"), "\xE2\x80\x93");
  EXPECT_EQ(shown_text(std::optional<double>(), 1, "none"), "none");
  EXPECT_EQ(shown_text(std::optional(0.25), 1), "0.2");
}

TEST(NumberText, HasAPointWhateverTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"})
    if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
  EXPECT_EQ(fixed_text(1.5, 1), "1.5");
  EXPECT_EQ(significant_text(1234.5, 5), "1234.5");
  EXPECT_EQ(shortest_text(0.25), "0.25");
  EXPECT_EQ(trimmed_text(0.25, 6), "0.25");
  EXPECT_EQ(cut_text(0.25, 1), "0.2");
  std::setlocale(LC_NUMERIC, before.c_str());
}

}  // namespace
}  // namespace ostia::core
