#include "ostia/analysis/graph_orders.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::analysis {
namespace {

using Orders = std::vector<std::int32_t>;

std::int32_t& at(Orders& orders, std::int32_t branch) {
  return orders[static_cast<std::size_t>(branch)];
}
std::int32_t at(const Orders& orders, std::int32_t branch) {
  return orders[static_cast<std::size_t>(branch)];
}

/// Orders without branches vanish: 1, 3, 4 become 1, 2, 3. Returns the highest.
std::int32_t close_gaps(Orders& orders) {
  Orders renamed(static_cast<std::size_t>(*std::max_element(orders.begin(), orders.end())) + 1, 0);
  for (const std::int32_t order : orders) at(renamed, order) = 1;
  std::int32_t highest = 0;
  for (std::int32_t& name : renamed)
    if (name != 0) name = ++highest;
  for (std::int32_t& order : orders) order = at(renamed, order);
  return highest;
}

std::vector<double> upper_bounds(const Orders& orders, std::int32_t highest,
                                 const std::vector<BranchMeasure>& measures) {
  std::vector<RunningMean> diameters(static_cast<std::size_t>(highest));
  for (std::size_t b = 0; b < orders.size(); ++b)
    diameters[static_cast<std::size_t>(orders[b] - 1)].add(measures[b].diameter_mm);
  std::vector<double> upper(diameters.size(), std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n + 1 < diameters.size(); ++n) {
    const RunningMean &low = diameters[n], &high = diameters[n + 1];
    // Where an order is spread so widely that half way lies beyond one of the means, the bound stays between.
    const double half_way = 0.5 * (low.mean + low.sd() + high.mean - high.sd());
    upper[n] = std::max(low.mean, std::min(half_way, high.mean));
    if (n > 0) upper[n] = std::max(upper[n], upper[n - 1]);
  }
  return upper;
}

Orders by_diameter(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                   const std::vector<double>& upper) {
  Orders orders(measures.size(), 1);
  for (std::size_t k = links.branches_outward.size(); k-- > 0;) {
    const std::int32_t b = links.branches_outward[k];
    const double diameter = measures[static_cast<std::size_t>(b)].diameter_mm;
    const auto bound = std::lower_bound(upper.begin(), upper.end(), diameter);
    at(orders, b) = std::max(at(orders, b), static_cast<std::int32_t>(bound - upper.begin()) + 1);
    const std::int32_t parent = at(links.branch_parent, b);
    if (parent >= 0) at(orders, parent) = std::max(at(orders, parent), at(orders, b));
  }
  return orders;
}

/// Of each branch the one behind it that continues its element; -1: none.
Orders continuations(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                     const Orders& orders) {
  Orders next(orders.size(), -1);
  for (const std::int32_t b : links.branches_outward) {
    const std::int32_t parent = at(links.branch_parent, b);
    if (parent < 0 || at(orders, parent) != at(orders, b)) continue;
    std::int32_t& chosen = at(next, parent);
    if (chosen < 0 || measures[static_cast<std::size_t>(b)].diameter_mm >
                          measures[static_cast<std::size_t>(chosen)].diameter_mm)
      chosen = b;
  }
  return next;
}

}  // namespace

Orders strahler_orders(const TreeLinks& links) {
  Orders orders(links.branches.size(), 1);
  std::vector<bool> twice(links.branches.size(), false);  // two branches of the highest order so far
  Orders highest(links.branches.size(), 0);
  for (std::size_t k = links.branches_outward.size(); k-- > 0;) {
    const std::int32_t b = links.branches_outward[k];
    if (at(highest, b) > 0) at(orders, b) = at(highest, b) + (twice[static_cast<std::size_t>(b)] ? 1 : 0);
    const std::int32_t parent = at(links.branch_parent, b);
    if (parent < 0) continue;
    if (at(orders, b) == at(highest, parent)) twice[static_cast<std::size_t>(parent)] = true;
    if (at(orders, b) <= at(highest, parent)) continue;
    at(highest, parent) = at(orders, b);
    twice[static_cast<std::size_t>(parent)] = false;
  }
  return orders;
}

DiameterOrders diameter_orders(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                               int most_rounds) {
  if (most_rounds < 1)
    throw InvalidInput("diameter-defined orders: " + std::to_string(most_rounds) +
                       " rounds; give at least 1");
  DiameterOrders result;
  result.of_branch = strahler_orders(links);
  std::int32_t highest = close_gaps(result.of_branch);
  for (result.rounds = 0; result.rounds < most_rounds && !result.converged; ++result.rounds) {
    Orders next = by_diameter(links, measures, upper_bounds(result.of_branch, highest, measures));
    highest = close_gaps(next);
    result.converged = next == result.of_branch;
    result.of_branch = std::move(next);
  }
  result.upper_mm = upper_bounds(result.of_branch, highest, measures);
  return result;
}

Orders orders_by_bounds(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                        const std::vector<double>& upper_mm) {
  if (upper_mm.empty() || !std::is_sorted(upper_mm.begin(), upper_mm.end()) ||
      upper_mm.back() != std::numeric_limits<double>::infinity())
    throw InvalidInput("orders by diameter: bounds must rise, and the last one be infinite");
  return by_diameter(links, measures, upper_mm);
}

TreeElements tree_elements(const TreeLinks& links, const std::vector<BranchMeasure>& measures,
                           const Orders& order_of_branch) {
  TreeElements result;
  result.of_branch.assign(order_of_branch.size(), -1);
  const Orders next = continuations(links, measures, order_of_branch);
  for (const std::int32_t b : links.branches_outward) {
    const std::int32_t parent = at(links.branch_parent, b);
    const std::int32_t before = parent < 0 ? -1 : at(result.of_branch, parent);
    std::int32_t own = before;
    if (parent < 0 || at(next, parent) != b) {
      own = static_cast<std::int32_t>(result.elements.size());
      result.elements.push_back({at(order_of_branch, b), before, 0, 0.0, 0.0});
    }
    at(result.of_branch, b) = own;
    TreeElement& element = result.elements[static_cast<std::size_t>(own)];
    ++element.branches;
    element.length_mm += measures[static_cast<std::size_t>(b)].sum.length_mm;
    element.diameter_mm += measures[static_cast<std::size_t>(b)].diameter_mm;
  }
  for (TreeElement& element : result.elements) element.diameter_mm /= element.branches;
  return result;
}

ConnectivityMatrix connectivity_matrix(const TreeElements& elements) {
  ConnectivityMatrix result;
  for (const TreeElement& element : elements.elements) result.orders = std::max(result.orders, element.order);
  const auto orders = static_cast<std::size_t>(result.orders);
  result.mean.assign(orders * orders, 0.0);
  result.elements.assign(orders, 0);
  for (const TreeElement& element : elements.elements) {
    const auto m = static_cast<std::size_t>(element.order - 1);
    ++result.elements[m];
    if (element.parent < 0) continue;
    const TreeElement& parent = elements.elements[static_cast<std::size_t>(element.parent)];
    result.mean[m * orders + static_cast<std::size_t>(parent.order - 1)] += 1.0;
  }
  for (std::size_t n = 0; n < orders; ++n)
    for (std::size_t m = 0; m < orders && result.elements[n] > 0; ++m)
      result.mean[m * orders + n] /= static_cast<double>(result.elements[n]);
  return result;
}

void RunningMean::add(double value) {
  ++count;
  const double off = value - mean;
  mean += off / static_cast<double>(count);
  squares += off * (value - mean);
}

double RunningMean::sd() const {
  return count > 1 ? std::sqrt(std::max(0.0, squares) / static_cast<double>(count - 1)) : 0.0;
}

std::vector<OrderMeasure> measure_orders(const TreeElements& elements,
                                         const std::vector<BranchMeasure>& measures) {
  std::vector<OrderMeasure> result;
  const auto row = [&result](std::int32_t order) -> OrderMeasure& {
    while (static_cast<std::int32_t>(result.size()) < order) {
      result.emplace_back();
      result.back().order = static_cast<std::int32_t>(result.size());
    }
    return result[static_cast<std::size_t>(order - 1)];
  };
  for (const TreeElement& element : elements.elements) {
    OrderMeasure& own = row(element.order);
    own.element_diameter_mm.add(element.diameter_mm);
    own.element_length_mm.add(element.length_mm);
    own.branches_per_element.add(element.branches);
  }
  for (std::size_t b = 0; b < measures.size(); ++b) {
    OrderMeasure& own = row(elements.elements[static_cast<std::size_t>(elements.of_branch[b])].order);
    own.branch_diameter_mm.add(measures[b].diameter_mm);
    own.branch_length_mm.add(measures[b].sum.length_mm);
    own.length_mm += measures[b].sum.length_mm;
    own.area_mm2 += measures[b].sum.area_mm2;
    own.volume_mm3 += measures[b].sum.volume_mm3;
  }
  return result;
}

}  // namespace ostia::analysis
