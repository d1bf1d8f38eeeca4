// Texts of known sizes: none over another, none outside, none over the line that it labels; what makes room,
// what stays, what is shortened.

#include "ostia/view/text_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ostia::view {
namespace {

constexpr double letter = 7.0, line = 14.0;

/// A font of one width: eight bytes of "\u00e4" are four letters.
TextMeasure fixed_font() {
  return {[](const std::string& text, double scale) {
            const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
              return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
            });
            return letter * scale * static_cast<double>(letters);
          },
          line};
}

OverlayText text_at(const Vec2& px, const std::string& text, Anchor anchor) {
  return {px, text, Role::information, anchor};
}

std::vector<PlacedText> laid_out(const std::vector<OverlayText>& texts, const Vec2& size = {400.0, 300.0},
                                 const std::vector<OverlayLine>& lines = {}) {
  return lay_out_texts(texts, lines, fixed_font(), {size, 1.0, {}});
}

void expect_apart(const std::vector<PlacedText>& placed, const Vec2& size) {
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].shown) continue;
    EXPECT_TRUE((placed[i].rect.low.array() >= 0.0).all()) << placed[i].text;
    EXPECT_TRUE(((placed[i].rect.low + placed[i].rect.size).array() <= size.array()).all()) << placed[i].text;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(placed[j].shown && placed[i].rect.meets(placed[j].rect))
          << placed[i].text << " over " << placed[j].text;
  }
}

TEST(TextLayout, AnAnchorIsThePointOfTheTextThatStandsAtItsPlace) {
  const Vec2 at(200.0, 150.0);
  const std::vector<std::pair<Anchor, Vec2>> wanted{
      {Anchor::top_left, {0.0, 0.0}},        {Anchor::top, {-14.0, 0.0}},
      {Anchor::top_right, {-28.0, 0.0}},     {Anchor::left, {0.0, -7.0}},
      {Anchor::middle, {-14.0, -7.0}},       {Anchor::right, {-28.0, -7.0}},
      {Anchor::bottom_left, {0.0, -14.0}},   {Anchor::bottom, {-14.0, -14.0}},
      {Anchor::bottom_right, {-28.0, -14.0}}};
  for (const auto& [anchor, offset] : wanted) {
    const auto placed = laid_out({text_at(at, "abcd", anchor)});
    EXPECT_EQ(placed[0].rect.low, at + offset);
    EXPECT_EQ(placed[0].rect.size, Vec2(28.0, 14.0));
    EXPECT_TRUE(placed[0].shown && placed[0].whole);
  }
}

TEST(TextLayout, OneThatComesLaterMakesRoom) {
  const auto down = laid_out({text_at({6.0, 6.0}, "a long title of a view", Anchor::top_left),
                              text_at({150.0, 6.0}, "W 900  L 250", Anchor::top_right)});
  EXPECT_EQ(down[0].rect.low, Vec2(6.0, 6.0));
  EXPECT_GE(down[1].rect.low.y(), 20.0);
  EXPECT_LE(down[1].rect.low.y(), 24.0);
  const auto up = laid_out({text_at({394.0, 290.0}, "10 mm", Anchor::bottom_right),
                            text_at({6.0, 294.0}, std::string(55, 'x'), Anchor::bottom_left)});
  EXPECT_LE(up[1].rect.low.y() + line, 276.0);
  EXPECT_EQ(up[1].rect.low.x(), 6.0);
}

TEST(TextLayout, WhatStaysIsPlacedFirstOrNotAtAll) {
  OverlayText tick = text_at({100.0, 280.0}, "20", Anchor::left), next = tick;
  tick.stays = next.stays = true;
  next.px.x() += 4.0;
  const auto placed = laid_out({text_at({90.0, 280.0}, "a name", Anchor::bottom_left), tick, next});
  EXPECT_EQ(placed[1].rect.low, Vec2(100.0, 273.0));
  EXPECT_FALSE(placed[2].shown);
  EXPECT_TRUE(placed[0].shown);
  EXPECT_LE(placed[0].rect.low.y() + line, 273.0);
  expect_apart(placed, {400.0, 300.0});
}

TEST(TextLayout, WhatIsWiderThanTheViewIsSmallerThenShorter) {
  const auto smaller =
      laid_out({text_at({6.0, 6.0}, std::string(16, 'x'), Anchor::top_left)}, {100.0, 100.0});
  EXPECT_TRUE(smaller[0].whole);
  EXPECT_LT(smaller[0].scale, 1.0);
  EXPECT_LE(smaller[0].rect.size.x(), 98.01);
  const std::string umlauts =
      "\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6"
      "\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc";
  const auto shorter = laid_out({text_at({6.0, 6.0}, umlauts, Anchor::top_left)}, {80.0, 100.0});
  EXPECT_FALSE(shorter[0].whole);
  EXPECT_THAT(shorter[0].text, ::testing::EndsWith("\u2026"));
  EXPECT_EQ(shorter[0].text.rfind("\u00e4\u00f6\u00fc", 0), 0U) << "whole letters are left";
  expect_apart(shorter, {80.0, 100.0});
}

TEST(TextLayout, WhatHasNoRoomOrNoPlaceIsNotShown) {
  const auto low = laid_out({text_at({6.0, 6.0}, "text", Anchor::top_left)}, {100.0, 10.0});
  EXPECT_FALSE(low[0].shown);
  const auto nowhere =
      laid_out({text_at({NAN, 6.0}, "text", Anchor::top_left), text_at({5.0, 5.0}, "", Anchor::left)});
  EXPECT_FALSE(nowhere[0].shown || nowhere[1].shown);
  EXPECT_TRUE(laid_out({}).empty());
}

TEST(TextLayout, ALabelKeepsOffItsOwnLineAndOffAllTexts) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(20.0, 380.0), y(20.0, 280.0);
  int labels = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<OverlayText> texts{text_at({6.0, 6.0}, "LAD  straightened 0", Anchor::top_left),
                                   text_at({394.0, 294.0}, "10 mm", Anchor::bottom_right)};
    std::vector<OverlayLine> lines;
    for (std::int32_t id = 1; id <= 4; ++id) {
      OverlayLine drawn;
      drawn.px = {Vec2(x(random), y(random)), Vec2(x(random), y(random)), Vec2(x(random), y(random))};
      drawn.of = id;
      texts.push_back({drawn.px.back(), "Distance " + std::to_string(id) + ": 4.2 mm", Role::measurement,
                       Anchor::bottom_left, id});
      lines.push_back(drawn);
    }
    const auto placed = laid_out(texts, {400.0, 300.0}, lines);
    expect_apart(placed, {400.0, 300.0});
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const PlacedText& label = placed[i + 2];
      ASSERT_TRUE(label.shown);
      ++labels;
      for (std::size_t k = 1; k < lines[i].px.size(); ++k)
        EXPECT_FALSE((LabelLine{lines[i].px[k - 1], lines[i].px[k]}.crosses(label.rect))) << run;
    }
  }
  EXPECT_EQ(labels, 800);
}

TEST(TextLayout, OutsideIsToldFromWithoutRoom) {
  OverlayText label = text_at({-5.0, 20.0}, "Note 1", Anchor::left);
  label.label_of = 1;
  const auto outside = laid_out({label});
  EXPECT_TRUE(!outside[0].shown && outside[0].outside);
  label.px = Vec2(5.0, 5.0);
  const auto narrow = laid_out({label}, {60.0, 9.0});
  EXPECT_TRUE(!narrow[0].shown && !narrow[0].outside);
}

TEST(LabelLine, CrossesWhatItRunsThrough) {
  const LabelRect box{{10.0, 10.0}, {20.0, 10.0}};
  EXPECT_TRUE((LabelLine{{0.0, 15.0}, {50.0, 15.0}}.crosses(box)));
  EXPECT_TRUE((LabelLine{{15.0, 12.0}, {18.0, 13.0}}.crosses(box))) << "within";
  EXPECT_TRUE((LabelLine{{0.0, 0.0}, {40.0, 32.0}}.crosses(box)));
  EXPECT_FALSE((LabelLine{{0.0, 15.0}, {9.0, 15.0}}.crosses(box))) << "ends before";
  EXPECT_TRUE((LabelLine{{0.0, 15.0}, {9.0, 15.0}}.crosses(box, 2.0)));
  EXPECT_FALSE((LabelLine{{0.0, 22.0}, {50.0, 22.0}}.crosses(box)));
  EXPECT_TRUE((LabelLine{{0.0, 21.0}, {50.0, 21.0}}.crosses(box, 2.0)));
  EXPECT_FALSE((LabelLine{{0.0, 20.0}, {20.0, 45.0}}.crosses(box))) << "past a corner";
  EXPECT_TRUE((LabelLine{{15.0, 15.0}, {15.0, 15.0}}.crosses(box))) << "a point";
}

}  // namespace
}  // namespace ostia::view
