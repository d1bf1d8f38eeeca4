#pragma once
/// \file A grown tree held against the tables that it was grown by.

#include "ostia/analysis/coronary_morphometry.h"
#include "ostia/analysis/graph_report.h"
#include "ostia/analysis/tree_growth.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace ostia::analysis::testing {

/// Of a tree from scanned vessels of order 8: measured anew from places and radii alone, with the table's
/// bounds between the orders. `told`: a row of a Markdown table for each order on standard output.
inline void expect_published_sizes(const GrownTree& tree, bool told = false) {
  const Morphometry& table = coronary_morphometry(CoronaryArtery::left_anterior);
  const TreeLinks links = link_tree(tree.graph, geometry::GraphIncidence(tree.graph));
  const std::vector<BranchMeasure> branches = measure_branches(tree.graph, links);
  std::vector<double> upper;
  for (std::int32_t n = 1; n <= table.highest(); ++n) upper.push_back(table.upper_mm(n));
  const TreeElements elements = tree_elements(links, branches, orders_by_bounds(links, branches, upper));
  const std::vector<OrderMeasure> rows = measure_orders(elements, branches);
  const ConnectivityMatrix matrix = connectivity_matrix(elements);
  ASSERT_EQ(rows.size(), 8U);
  for (const OrderMeasure& row : rows) {
    const Morphometry::Order& known = table.order(row.order);
    const auto parents = matrix.elements[static_cast<std::size_t>(row.order - 1)];
    if (told)
      std::printf("| %d | %lld | %.4g (%.4g) | %.3f (%.3f) | %.2f (%.2f) |\n", static_cast<int>(row.order),
                  static_cast<long long>(parents), 1e3 * row.element_diameter_mm.mean,
                  1e3 * known.diameter_mm, row.element_length_mm.mean, known.length_mm,
                  matrix.at(std::max(1, row.order - 1), row.order),
                  table.springs(std::max(1, row.order - 1), row.order));
    if (row.order == 8) continue;  // those that continue scanned vessels, whose length theirs is, too
    EXPECT_NEAR(row.element_diameter_mm.mean, known.diameter_mm, 0.05 * known.diameter_mm) << row.order;
    EXPECT_NEAR(row.element_length_mm.mean, known.length_mm, 0.05 * known.length_mm) << row.order;
    for (std::int32_t m = 1; m <= row.order; ++m) {
      const double known_ratio = table.springs(m, row.order);
      // No closer than whole daughters allow.
      EXPECT_NEAR(matrix.at(m, row.order), known_ratio,
                  std::max(0.05 * known_ratio, 1.5 / static_cast<double>(parents)))
          << m << " from " << row.order;
    }
  }
}

}  // namespace ostia::analysis::testing
