// Labels at hundreds of random places: none over another, none outside, each as near as can be, and the same
// again.

#include "ostia/view/label_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ostia::view {
namespace {

constexpr double made_width = 800.0, made_height = 600.0;

std::vector<LabelWish> random_wishes(unsigned seed, int count, double spread = 1.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.5 - 0.5 * spread, 0.5 + 0.5 * spread), wide(40.0, 130.0);
  std::vector<LabelWish> wishes;
  for (int i = 0; i < count; ++i)
    wishes.push_back({{made_width * share(random), made_height * share(random)}, {wide(random), 16.0}, {}});
  return wishes;
}

LabelRoom room_of(std::vector<LabelRect> taken = {}) {
  return {{made_width, made_height}, 6.0, std::move(taken)};
}

void expect_sound(const std::vector<PlacedLabel>& placed, const LabelRoom& room) {
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (!placed[i].shown) continue;
    const LabelRect& rect = placed[i].rect;
    EXPECT_TRUE((rect.low.array() >= 0.0).all() &&
                ((rect.low + rect.size).array() <= room.size.array()).all())
        << i << " is outside";
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(placed[j].shown && rect.meets(placed[j].rect)) << i << " is over " << j;
    for (const LabelRect& one : room.taken) EXPECT_FALSE(rect.meets(one)) << i;
  }
}

bool same_places(const std::vector<PlacedLabel>& a, const std::vector<PlacedLabel>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const PlacedLabel& p, const PlacedLabel& q) {
    return p.shown == q.shown && p.rect.low == q.rect.low && p.leader_to == q.leader_to;
  });
}

TEST(LabelLayout, OneStandsRightAboveItsAnchorAndInsideNearTheRim) {
  const auto one = place_labels({{{100.0, 100.0}, {50.0, 16.0}, {}}}, room_of());
  ASSERT_TRUE(one[0].shown);
  EXPECT_EQ(one[0].rect.low, Vec2(106.0, 78.0));
  EXPECT_FALSE(one[0].leader_to);
  for (const Vec2& corner : {Vec2(0.0, 0.0), Vec2(800.0, 0.0), Vec2(0.0, 600.0), Vec2(800.0, 600.0)}) {
    const auto placed = place_labels({{corner, {50.0, 16.0}, {}}}, room_of());
    ASSERT_TRUE(placed[0].shown);
    expect_sound(placed, room_of());
    EXPECT_LT((placed[0].rect.low + 0.5 * placed[0].rect.size - corner).norm(), 45.0);
  }
}

TEST(LabelLayout, HundredsNeverOverlap) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto wishes = random_wishes(seed, 120);
    const auto placed = place_labels(wishes, room_of());
    expect_sound(placed, room_of());
    EXPECT_TRUE(std::all_of(placed.begin(), placed.end(), [](const PlacedLabel& one) { return one.shown; }))
        << "there is room for all, seed " << seed;
    EXPECT_TRUE(same_places(placed, place_labels(wishes, room_of()))) << seed;
  }
}

TEST(LabelLayout, ManyAtOnePlaceSpreadWithLeaders) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto wishes = random_wishes(seed, 100, 0.02);
    const auto placed = place_labels(wishes, room_of());
    expect_sound(placed, room_of());
    for (std::size_t i = 0; i < placed.size(); ++i) {
      ASSERT_TRUE(placed[i].shown);
      const LabelRect& rect = placed[i].rect;
      const Vec2 nearest = wishes[i].anchor.cwiseMax(rect.low).cwiseMin(rect.low + rect.size);
      if ((nearest - wishes[i].anchor).norm() <= 15.0) continue;
      ASSERT_TRUE(placed[i].leader_to) << i;
      EXPECT_EQ(*placed[i].leader_to, nearest);
    }
  }
}

TEST(LabelLayout, KeepsOffTextsThatStay) {
  const std::vector<LabelRect> corners{{{0.0, 0.0}, {200.0, 40.0}}, {{600.0, 560.0}, {200.0, 40.0}}};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto placed = place_labels(random_wishes(seed, 120), room_of(corners));
    expect_sound(placed, room_of(corners));
  }
}

TEST(LabelLayout, StaysWhereItWasWhileAnchorsMoveALittle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> little(-1.0, 1.0);
  auto wishes = random_wishes(7, 80);
  auto before = place_labels(wishes, room_of());
  int moved = 0, steps = 0;
  for (int step = 0; step < 50; ++step) {
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      wishes[i].before = before[i].rect.low - wishes[i].anchor;
      wishes[i].anchor += Vec2(little(random), little(random));
    }
    const auto now = place_labels(wishes, room_of());
    expect_sound(now, room_of());
    for (std::size_t i = 0; i < now.size(); ++i) {
      const bool inside = (wishes[i].anchor.array() >= 0.0).all() && wishes[i].anchor.x() <= made_width &&
                          wishes[i].anchor.y() <= made_height;
      EXPECT_EQ(now[i].shown, inside);
      if (!now[i].shown || !before[i].shown) continue;
      ++steps;
      if ((now[i].rect.low - before[i].rect.low).norm() > 3.0) ++moved;
    }
    before = now;
  }
  EXPECT_LT(moved, steps / 25) << moved << " of " << steps << " labels jumped";
}

TEST(LabelLayout, LeavesOutWhatHasNoRoomOrLiesOutside) {
  const auto outside =
      place_labels({{{-5.0, 20.0}, {50.0, 16.0}, {}}, {{NAN, 20.0}, {50.0, 16.0}, {}}}, room_of());
  EXPECT_FALSE(outside[0].shown || outside[1].shown);
  const auto large = place_labels({{{20.0, 20.0}, {900.0, 16.0}, {}}}, room_of());
  EXPECT_FALSE(large[0].shown);
  const auto full = place_labels(random_wishes(3, 300), room_of());
  expect_sound(full, room_of());
  EXPECT_GT(std::count_if(full.begin(), full.end(), [](const PlacedLabel& one) { return one.shown; }), 150);
  EXPECT_TRUE(place_labels({}, room_of()).empty());
}

}  // namespace
}  // namespace ostia::view
