#include "../../libs/phantom/src/body/organ.h"

#include "ostia/phantom/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ostia::phantom {
namespace {

Vec3 random_place(std::uint64_t index, double half_mm) {
  return half_mm * Vec3(2.0 * uniform(3, 3 * index) - 1.0, 2.0 * uniform(3, 3 * index + 1) - 1.0,
                        2.0 * uniform(3, 3 * index + 2) - 1.0);
}

std::vector<std::pair<std::string, Distance>> shapes() {
  const auto noise = std::make_shared<const NoiseField>(7);
  const Distance egg = ellipsoid({1, 2, 3}, Vec3(10, 20, 30));
  const Distance pillar = column(4, -3, 12, 5);
  const Distance below = half_space({0, 0, 5}, Vec3(0, 1, 2));
  return {{"ellipsoid", egg},
          {"column", pillar},
          {"half space", below},
          {"both", both(egg, below)},
          {"either", either({egg, pillar})},
          {"without", without(egg, pillar)},
          {"grown", grown(egg, 2.0)},
          {"uneven", uneven(egg, 1.0, 8.0, noise)},
          {"uneven union", either({uneven(egg, 0.6, 12.0, noise), pillar})}};
}

TEST(Organ, EllipsoidIsZeroOnItsSurface) {
  const Distance egg = ellipsoid({1, 2, 3}, Vec3(10, 20, 30));
  EXPECT_NEAR(egg({11, 2, 3}), 0.0, 1e-12);
  EXPECT_NEAR(egg({1, -18, 3}), 0.0, 1e-12);
  EXPECT_NEAR(egg({1, 2, 33}), 0.0, 1e-12);
  EXPECT_NEAR(egg({1, 2, 3}), -10.0, 1e-12);
}

TEST(Organ, NoShapeEndsNearerThanItsFunctionSays) {
  for (const auto& [name, shape] : shapes()) {
    int tested = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Vec3 p = random_place(i, 40.0);
      const double reach = std::abs(shape(p));
      if (reach < 0.05) continue;
      const Vec3 direction = random_place(i + 90000, 1.0).normalized();
      for (const double share : {0.3, 0.7, 0.99}) {
        EXPECT_EQ(shape(p) < 0.0, shape(p + share * reach * direction) < 0.0) << name;
        ++tested;
      }
    }
    EXPECT_GT(tested, 1000);
  }
}

TEST(Organ, ACapsuleHoldsWhatIsNearerThanItsRadius) {
  const Capsule c{{0, 0, 0}, {10, 0, 0}, 2.0, 4.0};
  EXPECT_TRUE(c.holds({5, 2.99, 0}));
  EXPECT_FALSE(c.holds({5, 3.01, 0}));
  EXPECT_TRUE(c.holds({-1.99, 0, 0}));
  EXPECT_FALSE(c.holds({-2.01, 0, 0}));
  EXPECT_TRUE(c.holds({13.9, 0, 0}));
  const Capsule point{{1, 1, 1}, {1, 1, 1}, 1.0, 1.0};
  EXPECT_TRUE(point.holds({1, 1, 1.9}));
}

TEST(Organ, ACapsuleLiesInItsBox) {
  const Capsule c{{0, 3, -2}, {10, -4, 6}, 2.0, 4.0};
  int inside = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Vec3 p = random_place(i, 16.0);
    if (!c.holds(p)) continue;
    ++inside;
    EXPECT_TRUE(c.box().contains(p));
  }
  EXPECT_GT(inside, 20);
}

TEST(Organ, ATubeFollowsItsControls) {
  const Capsules t = tube({{0, 0, 0}, {20, 5, 0}, {40, 0, 3}}, {2.0, 3.0, 1.0});
  const auto holds = [&](const Vec3& p) {
    return std::any_of(t.begin(), t.end(), [&](const Capsule& c) { return c.holds(p); });
  };
  EXPECT_TRUE(holds({0.5, 0, 0}));
  EXPECT_TRUE(holds({20, 5, 0}));
  EXPECT_TRUE(holds({20, 5, 2.7}));
  EXPECT_FALSE(holds({20, 5, 3.3}));
  EXPECT_FALSE(holds({20, -5, 0}));
}

TEST(Organ, NoiseHasDeviationOneAndIsContinuous) {
  const NoiseField noise(11);
  double sum = 0.0, squares = 0.0;
  const int count = 40000;
  for (int i = 0; i < count; ++i) {
    const double v = noise.at(random_place(static_cast<std::uint64_t>(i), 30.0));
    sum += v;
    squares += v * v;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 1.0, 0.1);
  for (const double x : {-3.0, 0.0, 5.0, 63.0, 64.0})
    EXPECT_NEAR(noise.at({x - 1e-9, 0.4, 0.7}), noise.at({x + 1e-9, 0.4, 0.7}), 1e-6);
}

}  // namespace
}  // namespace ostia::phantom
