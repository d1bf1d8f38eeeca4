#pragma once
/// \file Orders of a tree's branches, its elements, and which springs from which. See
/// docs/methods/tree-measures.md. Branches, from fork to fork, are what Kassab et al. 1993 (Am J Physiol
/// 265:H350) call segments; branches of one order in series are an element.

#include "ostia/analysis/graph_measures.h"

namespace ostia::analysis {

/// Strahler's: 1 for a branch with nothing behind it; where two or more of the highest order meet, one more.
std::vector<std::int32_t> strahler_orders(const TreeLinks& links);

struct DiameterOrders {
  std::vector<std::int32_t> of_branch;  ///< from 1
  std::vector<double> upper_mm;         ///< of each order: the largest diameter; infinity for the highest
  int rounds = 0;
  bool converged = false;
};
/// Kassab's diameter-defined Strahler orders: from Strahler's, the bound between two orders is half way from
/// mean + SD of the diameters of the lower one to mean - SD of the higher one; each branch has the order of
/// its diameter, yet none below that of a branch behind it; again until no order changes. Orders that lose
/// all their branches vanish. `most_rounds` >= 1, else InvalidInput.
DiameterOrders diameter_orders(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                               int most_rounds = 100);

/// The orders that given bounds make, such as published ones: upper_mm rises, one for each order, the last
/// infinite. Here too none is below that of a branch behind it. Throws InvalidInput for bounds that fall.
std::vector<std::int32_t> orders_by_bounds(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                                           const std::vector<double>& upper_mm);

struct TreeElement {
  std::int32_t order = 1;
  std::int32_t parent = -1;  ///< the element it springs from
  std::int32_t branches = 0;
  double length_mm = 0.0;
  double diameter_mm = 0.0;  ///< mean of its branches
};
struct TreeElements {
  std::vector<TreeElement> elements;    ///< each behind its parent
  std::vector<std::int32_t> of_branch;  ///< the element of each branch
};
/// Where several branches of the order of the one before them go on, the widest continues its element and
/// the others begin elements of their own.
TreeElements tree_elements(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                           const std::vector<std::int32_t>& order_of_branch);

/// How many elements of order m spring from an element of order n, on average.
struct ConnectivityMatrix {
  std::int32_t orders = 0;
  std::vector<double> mean;            ///< (m - 1) * orders + (n - 1)
  std::vector<std::int64_t> elements;  ///< of each order
  double at(std::int32_t m, std::int32_t n) const {
    return mean[static_cast<std::size_t>(m - 1) * static_cast<std::size_t>(orders) +
                static_cast<std::size_t>(n - 1)];
  }
};
ConnectivityMatrix connectivity_matrix(const TreeElements& elements);

/// Mean and standard deviation (n - 1; 0 for one value) of what was added.
struct RunningMean {
  std::int64_t count = 0;
  double mean = 0.0, squares = 0.0;
  void add(double value);
  double sd() const;
};

struct OrderMeasure {
  std::int32_t order = 1;
  RunningMean element_diameter_mm, element_length_mm, branch_diameter_mm, branch_length_mm;
  RunningMean branches_per_element;
  double length_mm = 0.0, area_mm2 = 0.0, volume_mm3 = 0.0;  ///< all of the order
};
/// One for each order, from 1.
std::vector<OrderMeasure> measure_orders(const TreeElements& elements,
                                         const std::vector<BranchMeasure>& measures);

}  // namespace ostia::analysis
