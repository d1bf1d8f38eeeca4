#include "ostia/view/profile_view.h"

#include "bench_case.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::view {
namespace {

using testing::TubeCase;

const OverlayLine* line_of(const Overlay& overlay, Role role) {
  const auto found = std::find_if(overlay.lines.begin(), overlay.lines.end(),
                                  [&](const OverlayLine& line) { return line.role == role; });
  return found == overlay.lines.end() ? nullptr : &*found;
}

TEST(ProfileView, AbscissasGoThereAndBack) {
  TubeCase tube;
  ProfileView profile(tube.bench);
  profile.set_size(600, 160, 1.0);
  for (const double s : {0.0, 7.3, 30.0}) EXPECT_NEAR(*profile.abscissa_at(profile.x_of(s)), s, 1e-9);
  EXPECT_DOUBLE_EQ(*profile.abscissa_at(-50.0), 0.0);
  EXPECT_NEAR(*profile.abscissa_at(5000.0), 30.0, 1e-9);
}

TEST(ProfileView, ATubeIsALevelLine) {
  TubeCase tube;
  ProfileView profile(tube.bench);
  profile.set_size(600, 160, 1.0);
  const OverlayLine* diameter = line_of(profile.overlay(), Role::diameter);
  ASSERT_TRUE(diameter);
  const double level = diameter->px[diameter->px.size() / 2].y();
  for (const Vec2& p : diameter->px) {
    if (p.x() < profile.x_of(3.0) || p.x() > profile.x_of(27.0)) continue;
    EXPECT_NEAR(p.y(), level, 1.5);
  }
}

TEST(ProfileView, FollowsAnEdit) {
  TubeCase tube;
  ProfileView profile(tube.bench);
  profile.set_size(600, 160, 1.0);
  const auto at_fifteen = [&] {
    const OverlayLine* diameter = line_of(profile.overlay(), Role::diameter);
    const double x = profile.x_of(15.0);
    return std::min_element(
               diameter->px.begin(), diameter->px.end(),
               [&](const Vec2& a, const Vec2& b) { return std::abs(a.x() - x) < std::abs(b.x() - x); })
        ->y();
  };
  const double before = at_fifteen();
  lumen::SectionContour narrow;
  narrow.vessel = tube.bench.vessel.get();
  narrow.s_mm = 15.0;
  for (int i = 0; i < 16; ++i)
    narrow.points.push_back(tube.bench.axis()->place(15.0, 2.0 * M_PI * i / 16.0, 0.7));
  tube.bench.edit(narrow);
  EXPECT_GT(at_fifteen(), before + 20.0);         // lower on the picture
  EXPECT_FALSE(profile.overlay().bands.empty());  // and marked as a narrowing
}

TEST(ProfileView, ShowsNothingWithoutACase) {
  TubeCase tube;
  ProfileView profile(tube.bench);
  profile.set_size(600, 160, 1.0);
  tube.bench.close_case();
  EXPECT_FALSE(profile.ready());
  EXPECT_TRUE(profile.overlay().lines.empty());
  EXPECT_FALSE(profile.abscissa_at(100.0));
}

}  // namespace
}  // namespace ostia::view
