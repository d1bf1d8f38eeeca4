#pragma once
/// \file All measures of a tree at once, its scaling laws, and tables of them. See
/// docs/methods/tree-measures.md.

#include "ostia/analysis/graph_angles.h"
#include "ostia/analysis/graph_orders.h"

#include <functional>
#include <iosfwd>
#include <string>

namespace ostia::analysis {

/// log10(y) = a + b x, by least squares, as Kassab et al. 1993 fit diameters, lengths and numbers by order.
struct LogFit {
  double a = 0.0, b = 0.0;
  double ratio = 1.0;      ///< 10^b: from one order to the next
  double r_squared = 0.0;  ///< 1 where all points are on the line
  int points = 0;          ///< that are positive; fewer than two give no fit: ratio 1
};
LogFit fit_log(const std::vector<double>& x, const std::vector<double>& y);

struct Histogram {
  std::vector<double> bounds;  ///< one more than there are bins
  std::vector<std::int64_t> counts;
  bool logarithmic = false;
};
/// From the least to the greatest of the finite values (of the positive ones where logarithmic). All of one
/// value: one bin. None: no bins. `bins` >= 1, else InvalidInput.
Histogram histogram(const std::vector<double>& values, int bins, bool logarithmic);

double median(std::vector<double> values);  ///< 0 without any

struct TreeReport {
  TreeLinks links;
  std::vector<SubtreeTotals> subtrees;  ///< of each edge
  std::vector<BranchMeasure> branches;
  std::vector<std::int32_t> strahler;  ///< of each branch
  DiameterOrders diameter_orders;
  TreeElements elements;  ///< by the diameter-defined orders
  std::vector<OrderMeasure> orders;
  ConnectivityMatrix connectivity;
  std::vector<ForkAngles> angles;
  std::vector<ForkExponent> exponents;
  double murray_median = 0.0;                   ///< of the forks that have an exponent; 0 without any
  std::vector<double> murray_by_order;          ///< the same by the parent's order, from 1; NaN without any
  LogFit diameter_fit, length_fit, number_fit;  ///< of elements, by order; mm
  SubtreeTotals total;
};
/// Throws what link_tree throws.
TreeReport measure_tree(const geometry::VesselGraph& graph, const core::TaskContext& task = core::no_task());

/// Numbers in named columns, asked for row by row: a table of a million rows takes no memory.
struct GraphTable {
  struct Column {
    std::string name;  ///< with its unit: `length_mm`
    std::function<double(std::size_t row)> value;
    bool whole = false;  ///< written without decimals
  };
  std::string name;
  std::size_t rows = 0;
  std::vector<Column> columns;
};
/// Of segments, branches, orders, the connectivity matrix and forks. The tables ask the graph and the report
/// whenever they are written: both must stay.
std::vector<GraphTable> tree_tables(const geometry::VesselGraph& graph, const TreeReport& report);
/// Lines of RFC 4180 with a header; what is not a finite number is left empty.
void write_csv(const GraphTable& table, std::ostream& out, const core::TaskContext& task = core::no_task());
/// {"v":1,"name":..,"columns":[..],"rows":[[..]]}, null for what is not a finite number.
void write_json(const GraphTable& table, std::ostream& out, const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
