#include "degrees.h"

#include "ostia/analysis/graph_report.h"
#include "ostia/core/csv.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <ostream>
#include <utility>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::VesselGraph;
using Column = GraphTable::Column;

GraphTable segment_table(const VesselGraph& graph, const TreeReport& report) {
  GraphTable table{"segments", graph.edges.size(), {}};
  const auto real = [&table](std::string name, std::function<double(std::size_t)> value) {
    table.columns.push_back({std::move(name), std::move(value), false});
  };
  const auto whole = [&table](std::string name, std::function<double(std::size_t)> value) {
    table.columns.push_back({std::move(name), std::move(value), true});
  };
  const auto cone = [&graph](std::size_t row) {
    return measure_segment(graph, static_cast<std::int32_t>(row));
  };
  const auto branch = [&report](std::size_t row) {
    return static_cast<std::size_t>(report.links.branch_of[row]);
  };
  whole("segment", [](std::size_t row) { return static_cast<double>(row); });
  whole("reference", [&graph](std::size_t row) {
    return static_cast<double>(graph.references.empty() ? static_cast<std::int64_t>(row)
                                                        : graph.references[row]);
  });
  whole("parent", [&report](std::size_t row) { return report.links.parent[row]; });
  whole("branch", [&report](std::size_t row) { return report.links.branch_of[row]; });
  whole("strahler_order", [&report, branch](std::size_t row) { return report.strahler[branch(row)]; });
  whole("diameter_order",
        [&report, branch](std::size_t row) { return report.diameter_orders.of_branch[branch(row)]; });
  real("length_mm", [cone](std::size_t row) { return cone(row).length_mm; });
  real("radius_from_mm", [&graph](std::size_t row) { return graph.edges[row].radius_from; });
  real("radius_to_mm", [&graph](std::size_t row) { return graph.edges[row].radius_to; });
  real("area_mm2", [cone](std::size_t row) { return cone(row).area_mm2; });
  real("volume_mm3", [cone](std::size_t row) { return cone(row).volume_mm3; });
  real("subtree_length_mm", [&report](std::size_t row) { return report.subtrees[row].length_mm; });
  real("subtree_area_mm2", [&report](std::size_t row) { return report.subtrees[row].area_mm2; });
  real("subtree_volume_mm3", [&report](std::size_t row) { return report.subtrees[row].volume_mm3; });
  whole("subtree_segments", [&report](std::size_t row) { return report.subtrees[row].segments; });
  whole("subtree_ends", [&report](std::size_t row) { return report.subtrees[row].ends; });
  return table;
}

GraphTable branch_table(const TreeReport& report) {
  const TreeReport* r = &report;
  const auto value = [r](double BranchMeasure::*member) {
    return [r, member](std::size_t row) { return r->branches[row].*member; };
  };
  return {"branches",
          report.branches.size(),
          {{"branch", [](std::size_t row) { return static_cast<double>(row); }, true},
           {"parent", [r](std::size_t row) { return r->links.branch_parent[row]; }, true},
           {"first_segment", [r](std::size_t row) { return r->links.branches[row].edges.front(); }, true},
           {"segments",
            [r](std::size_t row) { return static_cast<double>(r->links.branches[row].edges.size()); }, true},
           {"strahler_order", [r](std::size_t row) { return r->strahler[row]; }, true},
           {"diameter_order", [r](std::size_t row) { return r->diameter_orders.of_branch[row]; }, true},
           {"element", [r](std::size_t row) { return r->elements.of_branch[row]; }, true},
           {"length_mm", [r](std::size_t row) { return r->branches[row].sum.length_mm; }},
           {"chord_mm", value(&BranchMeasure::chord_mm)},
           {"diameter_mm", value(&BranchMeasure::diameter_mm)},
           {"radius_from_mm", value(&BranchMeasure::radius_from_mm)},
           {"radius_to_mm", value(&BranchMeasure::radius_to_mm)},
           {"area_mm2", [r](std::size_t row) { return r->branches[row].sum.area_mm2; }},
           {"volume_mm3", [r](std::size_t row) { return r->branches[row].sum.volume_mm3; }}}};
}

GraphTable order_table(const TreeReport& report) {
  const TreeReport* r = &report;
  GraphTable table{"orders", report.orders.size(), {}};
  table.columns.push_back({"order", [r](std::size_t row) { return r->orders[row].order; }, true});
  const auto mean = [&](const std::string& name, const std::string& unit, RunningMean OrderMeasure::*member) {
    table.columns.push_back(
        {name + unit, [r, member](std::size_t row) { return (r->orders[row].*member).mean; }});
    table.columns.push_back(
        {name + "_sd" + unit, [r, member](std::size_t row) { return (r->orders[row].*member).sd(); }});
  };
  const auto count = [&](const std::string& name, RunningMean OrderMeasure::*member) {
    table.columns.push_back(
        {name, [r, member](std::size_t row) { return static_cast<double>((r->orders[row].*member).count); },
         true});
  };
  count("elements", &OrderMeasure::element_diameter_mm);
  count("branches", &OrderMeasure::branch_diameter_mm);
  mean("element_diameter", "_mm", &OrderMeasure::element_diameter_mm);
  mean("element_length", "_mm", &OrderMeasure::element_length_mm);
  mean("branch_diameter", "_mm", &OrderMeasure::branch_diameter_mm);
  mean("branch_length", "_mm", &OrderMeasure::branch_length_mm);
  mean("branches_per_element", "", &OrderMeasure::branches_per_element);
  table.columns.push_back({"length_mm", [r](std::size_t row) { return r->orders[row].length_mm; }});
  table.columns.push_back({"area_mm2", [r](std::size_t row) { return r->orders[row].area_mm2; }});
  table.columns.push_back({"volume_mm3", [r](std::size_t row) { return r->orders[row].volume_mm3; }});
  table.columns.push_back({"murray_exponent", [r](std::size_t row) { return r->murray_by_order[row]; }});
  return table;
}

GraphTable connectivity_table(const TreeReport& report) {
  const TreeReport* r = &report;
  GraphTable table{"connectivity", static_cast<std::size_t>(report.connectivity.orders), {}};
  table.columns.push_back({"order", [](std::size_t row) { return static_cast<double>(row + 1); }, true});
  for (std::int32_t n = 1; n <= report.connectivity.orders; ++n)
    table.columns.push_back({"from_order_" + std::to_string(n), [r, n](std::size_t row) {
                               return r->connectivity.at(static_cast<std::int32_t>(row) + 1, n);
                             }});
  return table;
}

GraphTable fork_table(const TreeReport& report) {
  const TreeReport* r = &report;
  const auto index = [r](std::int32_t ForkAngles::*member) {
    return [r, member](std::size_t row) { return r->angles[row].*member; };
  };
  const auto turn = [r](double ForkAngles::*member) {
    return [r, member](std::size_t row) { return degrees * r->angles[row].*member; };
  };
  return {"forks",
          report.angles.size(),
          {{"point", index(&ForkAngles::point), true},
           {"parent_segment", index(&ForkAngles::parent), true},
           {"wide_segment", index(&ForkAngles::wide), true},
           {"narrow_segment", index(&ForkAngles::narrow), true},
           {"between_deg", turn(&ForkAngles::between_rad)},
           {"wide_deg", turn(&ForkAngles::wide_rad)},
           {"narrow_deg", turn(&ForkAngles::narrow_rad)},
           {"tilt_deg", turn(&ForkAngles::tilt_rad)}}};
}

/// The shortest text that reads back as the same number; false for what is not finite.
bool append(std::string& line, double value, bool whole) {
  if (!std::isfinite(value)) return false;
  char text[32];
  const auto end = whole ? std::to_chars(text, text + sizeof text, static_cast<long long>(value)).ptr
                         : std::to_chars(text, text + sizeof text, value).ptr;
  line.append(text, end);
  return true;
}

void write_rows(const GraphTable& table, std::ostream& out, const core::TaskContext& task,
                const std::function<void(std::size_t, std::string&)>& write) {
  std::string text;
  for (std::size_t row = 0; row < table.rows; ++row) {
    write(row, text);
    if (text.size() < 65536 && row + 1 < table.rows) continue;
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(row + 1) / static_cast<double>(table.rows));
    out << text;
    text.clear();
  }
}

}  // namespace

std::vector<GraphTable> tree_tables(const VesselGraph& graph, const TreeReport& report) {
  return {segment_table(graph, report), branch_table(report), order_table(report), connectivity_table(report),
          fork_table(report)};
}

void write_csv(const GraphTable& table, std::ostream& out, const core::TaskContext& task) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  out << core::csv_line(names);
  write_rows(table, out, task, [&](std::size_t row, std::string& text) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) text += ',';
      append(text, table.columns[c].value(row), table.columns[c].whole);
    }
    text += '\n';
  });
}

void write_json(const GraphTable& table, std::ostream& out, const core::TaskContext& task) {
  out << "{\"v\":1,\"name\":\"" << table.name << "\",\"columns\":[";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out << (c > 0 ? ",\"" : "\"") << table.columns[c].name << '"';
  out << "],\"rows\":[";
  write_rows(table, out, task, [&](std::size_t row, std::string& text) {
    text += row > 0 ? ",\n[" : "\n[";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) text += ',';
      if (!append(text, table.columns[c].value(row), table.columns[c].whole)) text += "null";
    }
    text += ']';
  });
  out << "\n]}\n";
}

}  // namespace ostia::analysis
