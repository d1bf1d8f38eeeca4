// A smooth normal number along a tree: its variance and correlation, its forks.

#include "wall_field.h"

#include "flow_networks.h"

#include "ostia/core/quasi_random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace ostia::hemodynamics {
namespace {

using testing::tube_of;

Network forked() {
  Network network;
  network.branches = {tube_of(20.0, 2.0), tube_of(15.0, 1.5, 0), tube_of(12.0, 1.2, 0)};
  for (Station& station : network.branches[2].stations)
    station.s_mm += 22.0;  // from outside its parent's lumen
  return network;
}

/// Of independent numbers of variance 1 the covariance is that of the map's rows.
TEST(WallField, HasTheVarianceAndCorrelationThatItSays) {
  constexpr double length = 4.0;
  const Network network = forked();
  const WallField field(network, length);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < field.stations(); ++i) {
    std::vector<double> one(field.stations(), 0.0);
    one[i] = 1.0;
    rows.push_back(field.influence(one));
  }
  const auto covariance = [&](std::size_t i, std::size_t k) {
    return std::inner_product(rows[i].begin(), rows[i].end(), rows[k].begin(), 0.0);
  };
  const auto expected = [&](double mm) {
    const double a = std::sqrt(3.0) * mm / length;
    return (1.0 + a) * std::exp(-a);
  };
  for (std::size_t i = 0; i < field.stations(); ++i) EXPECT_NEAR(covariance(i, i), 1.0, 1e-9) << i;
  for (const std::size_t k : {1u, 5u, 12u, 40u}) EXPECT_NEAR(covariance(0, k), expected(0.5 * k), 1e-9) << k;
  // From the trunk through the fork: as far as the way is.
  const std::size_t child = network.branches[0].stations.size() + network.branches[1].stations.size();
  EXPECT_NEAR(covariance(36, child + 4), expected(2.0 + 2.0), 1e-9);
}

TEST(WallField, IsTheSameOnAllSidesOfAForkAndSmooth) {
  const Network network = forked();
  const WallField field(network, 4.0);
  std::vector<double> independent(field.innovations()), z(field.stations());
  core::fill_normal_numbers(3, independent);
  field.values(independent, z);
  const std::size_t first = network.branches[0].stations.size(),
                    second = first + network.branches[1].stations.size();
  EXPECT_NEAR(z[first], z[first - 1], 1e-7);
  EXPECT_NEAR(z[second], z[first - 1], 1e-7);
  EXPECT_NE(z[second + 10], z[first + 10]);
  for (std::size_t i = 1; i < first; ++i) EXPECT_LT(std::abs(z[i] - z[i - 1]), 1.2) << i;
}

TEST(WallField, InfluenceIsTheTransposedMap) {
  const WallField field(forked(), 4.0);
  std::vector<double> independent(field.innovations()), weights(field.stations()), z(field.stations());
  core::fill_normal_numbers(3, independent);
  core::fill_normal_numbers(4, weights);
  field.values(independent, z);
  const std::vector<double> influence = field.influence(weights);
  EXPECT_NEAR(std::inner_product(z.begin(), z.end(), weights.begin(), 0.0),
              std::inner_product(influence.begin(), influence.end(), independent.begin(), 0.0), 1e-9);
}

TEST(EvenDirections, PutWhatIsDrawnEvenlyWhereItHasTheMostSay) {
  const std::vector<double> a = {1.0, 2.0, 0.0, -1.0}, b = {2.0, 4.0, 0.0, -2.0}, c = {0.0, 1.0, 1.0, 1.0};
  const EvenDirections directions({a, b, c});
  EXPECT_EQ(directions.count(), 2u);  // b says what a says
  std::vector<double> independent = {0.3, -1.2, 0.8, 0.1};
  directions.put(std::vector<double>{0.7, -0.4}, independent);
  const double along = std::inner_product(a.begin(), a.end(), independent.begin(), 0.0) / std::sqrt(6.0);
  EXPECT_NEAR(along, 0.7, 1e-12);
}

}  // namespace
}  // namespace ostia::hemodynamics
