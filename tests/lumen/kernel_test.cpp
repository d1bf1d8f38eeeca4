#include "ostia/lumen/kernel.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::lumen {
namespace {

class EveryKernel : public ::testing::TestWithParam<Kernel> {};

TEST_P(EveryKernel, IsOneAtItsCentreAndZeroBeyondItsSupport) {
  EXPECT_EQ(phi(GetParam(), 0.0), 1.0);
  EXPECT_EQ(phi(GetParam(), 1.0), 0.0);
  EXPECT_EQ(phi(GetParam(), 1.7), 0.0);
  EXPECT_EQ(phi_slope(GetParam(), 1.0), 0.0);
}

TEST_P(EveryKernel, HasTheSlopeOfItsDifferences) {
  constexpr double h = 1e-6;
  for (double x = 0.05; x < 0.999; x += 0.05) {
    const double difference = (phi(GetParam(), x + h) - phi(GetParam(), x - h)) / (2.0 * h);
    EXPECT_NEAR(phi_slope(GetParam(), x), difference, 1e-8) << x;
    EXPECT_NEAR(phi_slope_over_x(GetParam(), x) * x, difference, 1e-8) << x;
  }
}

TEST_P(EveryKernel, IsFoundByItsName) {
  EXPECT_EQ(kernel_named(name(GetParam())), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel,
                         ::testing::Values(Kernel::morse_c0, Kernel::wendland_c2, Kernel::wendland_c4));

TEST(Kernel, SmoothOnesAreFlatAtTheirCentre) {
  EXPECT_EQ(phi_slope(Kernel::wendland_c2, 0.0), 0.0);
  EXPECT_EQ(phi_slope(Kernel::wendland_c4, 0.0), 0.0);
  EXPECT_EQ(phi_slope(Kernel::morse_c0, 0.0), -2.0);
}

TEST(Kernel, NamesTheChoicesWhenAskedForAnUnknownOne) {
  try {
    kernel_named("gaussian");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("wendland-c2"), std::string::npos);
  }
}

}  // namespace
}  // namespace ostia::lumen
