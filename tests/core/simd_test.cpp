#include "ostia/core/simd.h"

#include "ostia/core/processor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

namespace ostia::core::simd {
namespace {

constexpr std::array<double, 8> some_doubles{1.0, -2.0, 3.5, 0.0, 2.0, 1e-3, -7.0, 4.0};
constexpr std::array<double, 8> other_doubles{1.5, -3.0, 3.5, -1.0, 2.5, 1e-4, 7.0, 4.0};
constexpr std::array<float, 16> some_floats{1.0F, -2.0F, 3.5F, 0.0F, 2.0F, 1e-3F, -7.0F, 4.0F,
                                            5.0F, -6.0F, 0.5F, 9.0F, 2.5F, 1e-5F, -8.0F, 3.0F};
constexpr std::array<float, 16> other_floats{1.5F, -3.0F, 3.5F, -1.0F, 2.5F, 1e-4F, 7.0F, 4.0F,
                                             4.5F, -5.0F, 0.5F, 8.0F,  3.5F, 1e-6F, 8.0F, 2.0F};

TEST(Simd, DoublesAreThoseOfOneAtATime) {
  for (std::size_t i = 0; i < some_doubles.size(); i += double_pack_size) {
    const DoublePack a = load(some_doubles.data() + i), b = load(other_doubles.data() + i);
    std::array<double, 8> most{}, roots{}, made{};
    store(most.data(), larger(a, b));
    store(roots.data(), root(a * a + all(0.3)));
    store(made.data(), (a - b) * b / all(3.0));
    const int mask = not_above(a, b);
    for (std::size_t k = 0; k < double_pack_size; ++k) {
      const double x = some_doubles[i + k], y = other_doubles[i + k];
      EXPECT_EQ(most[k], x > y ? x : y);
      EXPECT_EQ(roots[k], std::sqrt(x * x + 0.3));
      EXPECT_EQ(made[k], (x - y) * y / 3.0);
      EXPECT_EQ((mask >> k) & 1, x <= y ? 1 : 0);
    }
  }
}

TEST(Simd, FloatsAreThoseOfOneAtATime) {
  for (std::size_t i = 0; i < some_floats.size(); i += float_pack_size) {
    const FloatPack a = load(some_floats.data() + i), b = load(other_floats.data() + i);
    std::array<float, 16> most{}, least{}, roots{}, chosen{};
    store(most.data(), larger(a, b));
    store(least.data(), smaller(a, b));
    store(roots.data(), root(a * a + all(0.3F)));
    store(chosen.data(), choose(above(a, b), a - b, b));
    for (std::size_t k = 0; k < float_pack_size; ++k) {
      const float x = some_floats[i + k], y = other_floats[i + k];
      EXPECT_EQ(most[k], x > y ? x : y);
      EXPECT_EQ(least[k], x < y ? x : y);
      EXPECT_EQ(roots[k], std::sqrt(x * x + 0.3F));
      EXPECT_EQ(chosen[k], x > y ? x - y : y);
    }
  }
}

TEST(Processor, HasAvx2WhereTheSystemSaysSoAndIsGivenItsFunction) {
  std::ifstream said("/proc/cpuinfo");
  const std::string all{std::istreambuf_iterator<char>(said), {}};
  if (!all.empty()) {
    EXPECT_EQ(has_avx2(), all.find(" avx2 ") != std::string::npos);
  }
  const auto new_one = [] { return 2; };
  const auto old_one = [] { return 1; };
  EXPECT_EQ(best_for_processor<int()>(new_one, old_one), has_avx2() ? 2 : 1);
}

}  // namespace
}  // namespace ostia::core::simd
