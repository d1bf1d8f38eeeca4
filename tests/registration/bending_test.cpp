#include "bending.h"

#include "spline_levels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::registration {
namespace {

std::vector<double> shifts_on(const imaging::Geometry& nodes, double (*value)(const Vec3&, int)) {
  std::vector<double> shifts(3 * nodes.voxels());
  for (std::int64_t k = 0; k < nodes.size[2]; ++k)
    for (std::int64_t j = 0; j < nodes.size[1]; ++j)
      for (std::int64_t i = 0; i < nodes.size[0]; ++i)
        for (int c = 0; c < 3; ++c)
          shifts[c * nodes.voxels() + nodes.offset(i, j, k)] = value(nodes.world(Vec3(i, j, k)), c);
  return shifts;
}

TEST(Bending, LinearShiftsCostNothing) {
  const imaging::Geometry nodes = resting_spline({Vec3::Zero(), Vec3(40, 50, 60)}, 10.0).nodes;
  const std::vector<double> shifts =
      shifts_on(nodes, [](const Vec3& x, int c) { return 0.1 * x[c] - 0.2 * x[(c + 1) % 3] + 3.0; });
  std::vector<double> gradient(shifts.size(), 0.0);
  EXPECT_LT(bending_cost(nodes, 1.0, shifts.data(), gradient.data()), 1e-20);
}

TEST(Bending, AParabolaCostsTheSquareOfItsCurvature) {
  const imaging::Geometry nodes = resting_spline({Vec3::Zero(), Vec3(400, 400, 400)}, 20.0).nodes;
  const std::vector<double> shifts =
      shifts_on(nodes, [](const Vec3& x, int c) { return c == 0 ? 0.5 * 0.01 * x.y() * x.y() : 0.0; });
  std::vector<double> gradient(shifts.size(), 0.0);
  // (0.01 / mm)^2 (20 mm)^2 at all nodes but those on two faces.
  const double inner = static_cast<double>(nodes.size[1] - 2) / static_cast<double>(nodes.size[1]);
  EXPECT_NEAR(bending_cost(nodes, 3.0, shifts.data(), gradient.data()), 3.0 * 0.04 * inner, 1e-12);
}

TEST(Bending, TheGradientIsTheDifferenceQuotient) {
  const imaging::Geometry nodes = resting_spline({Vec3::Zero(), Vec3(40, 30, 30)}, 10.0).nodes;
  std::vector<double> shifts =
      shifts_on(nodes, [](const Vec3& x, int c) { return std::sin(0.1 * x[c] + 0.2 * x[(c + 1) % 3]); });
  std::vector<double> gradient(shifts.size(), 0.0), unused(shifts.size(), 0.0);
  bending_cost(nodes, 2.0, shifts.data(), gradient.data());
  for (const std::size_t n : {std::size_t{0}, std::size_t{60}, shifts.size() / 2 + 7, shifts.size() - 1}) {
    const double kept = shifts[n];
    shifts[n] = kept + 1e-5;
    const double above = bending_cost(nodes, 2.0, shifts.data(), unused.data());
    shifts[n] = kept - 1e-5;
    const double below = bending_cost(nodes, 2.0, shifts.data(), unused.data());
    shifts[n] = kept;
    EXPECT_NEAR(gradient[n], (above - below) / 2e-5, 1e-8);
  }
}

}  // namespace
}  // namespace ostia::registration
