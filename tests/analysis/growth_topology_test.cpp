#include "growth/growth_topology.h"

#include "growth/growth_random.h"

#include "ostia/analysis/coronary_morphometry.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace {

using namespace ostia;
using namespace ostia::analysis;

TEST(CoronaryMorphometry, ItsTablesAgreeWithEachOther) {
  // An element with k daughters has k - 1 segments: two part its end. Tables 6-8 against table 5.
  for (const CoronaryArtery artery :
       {CoronaryArtery::right, CoronaryArtery::left_anterior, CoronaryArtery::circumflex}) {
    const Morphometry& table = coronary_morphometry(artery);
    ASSERT_EQ(table.connectivity.size(), table.orders.size());
    for (std::int32_t n = 1; n <= table.highest(); ++n) {
      double daughters = 0.0;
      // Table 8 repeats the left anterior artery's order 4, table 5 does not.
      const double within = artery == CoronaryArtery::circumflex && n == 4 ? 0.4 : 0.27;
      ASSERT_EQ(table.connectivity[static_cast<std::size_t>(n - 1)].size(), static_cast<std::size_t>(n + 1));
      for (std::int32_t m = 0; m <= n; ++m) daughters += table.springs(m, n);
      EXPECT_NEAR(daughters - 1.0, table.order(n).segments_per_element,
                  within * table.order(n).segments_per_element)
          << table.name << ", order " << n;
      if (n > 1) {
        EXPECT_GT(table.upper_mm(n), table.upper_mm(n - 1)) << table.name << n;
      }
      EXPECT_EQ(table.order_of(table.order(n).diameter_mm), n);
    }
  }
}

TEST(CoronaryMorphometry, OfTheRightArteryGivesItsNumbers) {
  // Table 9 from table 6: numbers of elements of a whole tree, from the one of order 11.
  const Morphometry& table = coronary_morphometry(CoronaryArtery::right);
  const GrowthTopology tree = grow_topology(table, {{11, 3.218}}, 1, 10'000'000);
  std::vector<double> number(12, 0.0);
  for (const GrowthElement& element : tree.elements) number[static_cast<std::size_t>(element.order)] += 1.0;
  for (std::int32_t n = 1; n <= 11; ++n)
    EXPECT_NEAR(number[static_cast<std::size_t>(n)] / table.order(n).elements, 1.0, 0.25) << n;
  EXPECT_NEAR(static_cast<double>(tree.segments), 1.18e6, 0.2e6);
}

TEST(GrowthTopology, HasTheTablesMeansAndConnectivity) {
  const Morphometry& table = coronary_morphometry(CoronaryArtery::left_anterior);
  const std::vector<GrowthRoot> roots(20, {8, 0.462});
  const GrowthTopology tree = grow_topology(table, roots, 5, 10'000'000);
  std::vector<double> number(9), length(9), diameter(9);
  std::vector<std::vector<double>> springs(9, std::vector<double>(9));
  for (const GrowthElement& e : tree.elements) {
    const auto n = static_cast<std::size_t>(e.order);
    number[n] += 1.0;
    length[n] += e.length_mm;
    diameter[n] += e.diameter_mm;
    if (e.parent < 0) continue;
    const GrowthElement& parent = tree.elements[static_cast<std::size_t>(e.parent)];
    springs[static_cast<std::size_t>(parent.order)][n] += 1.0;
    EXPECT_GE(parent.diameter_mm, e.diameter_mm);
    EXPECT_LT(e.fork, parent.segments);
  }
  for (std::int32_t n = 1; n <= 8; ++n) {
    const auto i = static_cast<std::size_t>(n);
    EXPECT_NEAR(length[i] / number[i], table.order(n).length_mm, 0.001 * table.order(n).length_mm) << n;
    EXPECT_NEAR(diameter[i] / number[i], table.order(n).diameter_mm, 0.01 * table.order(n).diameter_mm) << n;
    for (std::int32_t m = 1; m <= n; ++m)
      EXPECT_NEAR(springs[i][static_cast<std::size_t>(m)], table.springs(m, n) * number[i], 1.0) << m << n;
  }
}

TEST(GrowthTopology, IsThatOfItsSeed) {
  const Morphometry& table = coronary_morphometry(CoronaryArtery::circumflex);
  const GrowthTopology a = grow_topology(table, {{6, 0.14}}, 1, 100'000);
  const GrowthTopology b = grow_topology(table, {{6, 0.14}}, 1, 100'000);
  const GrowthTopology c = grow_topology(table, {{6, 0.14}}, 2, 100'000);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  bool differs = a.elements.size() != c.elements.size();
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    EXPECT_EQ(a.elements[i].length_mm, b.elements[i].length_mm);
    differs = differs || a.elements[i].length_mm != c.elements[i].length_mm;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(a.elements[0].diameter_mm, 0.14);
}

TEST(GrowthTopology, RefusesOrdersThatAreNotThereAndTooMuch) {
  const Morphometry& table = coronary_morphometry(CoronaryArtery::circumflex);
  EXPECT_THROW(grow_topology(table, {{11, 3.0}}, 1, 1000), InvalidInput);
  EXPECT_THROW(grow_topology(table, {{0, 3.0}}, 1, 1000), InvalidInput);
  EXPECT_THROW(grow_topology(table, {{9, 1.0}}, 1, 1000), ResourceError);
}

TEST(GrowthRandom, HasTheMomentsAsked) {
  GrowthRandom random(3, 4);
  double sum = 0.0, squares = 0.0;
  const int count = 200'000;
  for (int i = 0; i < count; ++i) {
    const double x = random.gamma(0.7);
    EXPECT_GT(x, 0.0);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / count, 1.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / count - 1.0), 0.7, 0.01);
}

}  // namespace
