#include "ostia/figure/color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

double luminance(const Color& color) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

double contrast(const Color& a, const Color& b) {
  const double la = luminance(a) + 0.05;
  const double lb = luminance(b) + 0.05;
  return la > lb ? la / lb : lb / la;
}

TEST(Color, HexRoundsAndClamps) {
  EXPECT_EQ(hex({0.0, 1.0, 0.5}), "#00ff80");
  EXPECT_EQ(hex({-1.0, 2.0, 0.2}), "#00ff33");
}

TEST(Color, PaletteRepeatsAndItsEightColoursDiffer) {
  EXPECT_EQ(palette(3), palette(11));
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Color a = palette(i);
      const Color b = palette(j);
      EXPECT_GT(std::hypot(a.r - b.r, a.g - b.g, a.b - b.b), 0.2) << i << " and " << j;
    }
  }
}

TEST(Color, MixesLinearlyAndStaysBetween) {
  EXPECT_EQ(mixed({0, 0, 0}, {1, 0.5, 0}, 0.5), (Color{0.5, 0.25, 0}));
  EXPECT_EQ(mixed({0, 0, 0}, {1, 1, 1}, 7.0), (Color{1, 1, 1}));
}

TEST(Color, TextOfBothLooksMeetsTheContrastThatReadersNeed) {
  for (const Look look : {Look::dark, Look::light}) {
    const Theme t = theme(look);
    EXPECT_GE(contrast(t.foreground, t.background), 7.0);  // WCAG 2.1, AAA
    EXPECT_GE(contrast(t.muted, t.background), 4.5);       // and AA
  }
}

}  // namespace
}  // namespace ostia::figure
