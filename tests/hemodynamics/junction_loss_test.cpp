// Forks: against the authors' own formula, written out once more as they publish it.

#include "ostia/hemodynamics/junction_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::hemodynamics {
namespace {

/// C of a branch where one vessel supplies two: Mynard and Valen-Sendstad 2015 for this case, angles about
/// the fork.
double published(double supplier_flow, double supplier_area, double flow, double area, double angle,
                 double other_angle) {
  const double mean = 0.5 * (angle + other_angle);
  double theta = std::remainder(angle - mean, 2.0 * std::numbers::pi),
         from = std::remainder(std::numbers::pi - mean, 2.0 * std::numbers::pi);
  if (from < 0.0) theta = -theta, from = -from;
  const double share = flow / supplier_flow;
  const double sign = theta > 0.0 ? 1.0 : theta < 0.0 ? -1.0 : 0.0;
  const double exchange = (0.8 * (std::numbers::pi - from) * sign - 0.2) * (1.0 - share);
  const double speed = supplier_flow / supplier_area;
  const double ratio = supplier_flow / ((1.0 - exchange) * speed) / area;
  double phi = std::fmod(from - theta + 4.0 * std::numbers::pi, 2.0 * std::numbers::pi);
  return (1.0 - std::exp(-share / 0.02)) *
         (1.0 - 1.0 / (ratio * share) * std::cos(0.75 * (std::numbers::pi - phi)));
}

TEST(JunctionLoss, IsTheAuthorsFormula) {
  const double density = 1060.0;
  for (const double share : {0.2, 0.5, 0.8})
    for (const auto& [a, b] :
         {std::pair{0.0, std::numbers::pi / 2}, std::pair{0.4, -0.6}, std::pair{-0.3, 1.2}}) {
      const double Q = 2.0, A = 9.0, areas[2] = {7.0, 4.0}, flows[2] = {share * Q, (1.0 - share) * Q};
      const double angles[2] = {a, b};
      const std::vector<ForkBranch> fork = {{flows[0], areas[0], a}, {flows[1], areas[1], b}};
      const auto drops = fork_drops(density, Q, A, fork);
      for (std::size_t i = 0; i < 2; ++i) {
        const double speed = flows[i] / areas[i];
        const double expected =
            published(Q, A, flows[i], areas[i], angles[i], angles[1 - i]) * density * speed * speed;
        EXPECT_NEAR(drops[i].pa, expected, 1e-9 * std::max(1.0, std::abs(expected)))
            << share << " " << a << " " << b;
      }
    }
}

TEST(JunctionLoss, IsNoneWhereAVesselGoesStraightOn) {
  const std::vector<ForkBranch> on = {{1.5, 6.0, 0.0}};
  EXPECT_NEAR(fork_drops(1060.0, 1.5, 6.0, on)[0].pa, 0.0, 1e-9);
}

TEST(JunctionLoss, HasTheExactDerivatives) {
  const double Q = 2.0, A = 9.0;
  const auto at = [&](double q, double whole) {
    const std::vector<ForkBranch> fork = {{q, 5.0, 0.7}, {0.6, 4.0, -0.3}};
    return fork_drops(1060.0, whole, A, fork)[0];
  };
  for (const double q : {0.01, 0.05, 0.5, 1.4}) {
    const double h = 1e-6;
    EXPECT_NEAR(at(q, Q).by_own_pa_s_ml, (at(q + h, Q).pa - at(q - h, Q).pa) / (2.0 * h), 1e-4);
    EXPECT_NEAR(at(q, Q).by_parent_pa_s_ml, (at(q, Q + h).pa - at(q, Q - h).pa) / (2.0 * h), 1e-4);
  }
}

TEST(JunctionLoss, IsNoneAgainstTheFlow) {
  const std::vector<ForkBranch> fork = {{-0.5, 5.0, 0.7}, {2.5, 4.0, -0.3}};
  EXPECT_EQ(fork_drops(1060.0, 2.0, 9.0, fork)[0].pa, 0.0);
  EXPECT_EQ(fork_drops(1060.0, -2.0, 9.0, fork)[1].pa, 0.0);
}

}  // namespace
}  // namespace ostia::hemodynamics
