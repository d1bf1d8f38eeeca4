#include "ostia/pipeline/tree_report.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::GraphTable;
using analysis::OrderMeasure;
using core::significant_text;
using nlohmann::json;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::size_t listed_overlaps = 20;

json mean_json(const analysis::RunningMean& of) {
  return {{"count", of.count}, {"mean", of.mean}, {"sd", of.sd()}};
}

json fit_json(const analysis::LogFit& fit) {
  return {
      {"a", fit.a}, {"b", fit.b}, {"ratio", fit.ratio}, {"r_squared", fit.r_squared}, {"points", fit.points}};
}

json orders_json(const MeasuredTree& tree) {
  json all = json::array();
  for (std::size_t i = 0; i < tree.report.orders.size(); ++i) {
    const OrderMeasure& one = tree.report.orders[i];
    const double upper = tree.report.diameter_orders.upper_mm[i];
    const double murray = tree.report.murray_by_order[i];
    all.push_back({{"order", one.order},
                   {"largest_diameter_mm", std::isfinite(upper) ? json(upper) : json(nullptr)},
                   {"element_diameter_mm", mean_json(one.element_diameter_mm)},
                   {"element_length_mm", mean_json(one.element_length_mm)},
                   {"branch_diameter_mm", mean_json(one.branch_diameter_mm)},
                   {"branch_length_mm", mean_json(one.branch_length_mm)},
                   {"branches_per_element", one.branches_per_element.mean},
                   {"length_mm", one.length_mm},
                   {"area_mm2", one.area_mm2},
                   {"volume_mm3", one.volume_mm3},
                   {"murray_exponent", std::isfinite(murray) ? json(murray) : json(nullptr)}});
  }
  return all;
}

json connectivity_json(const analysis::ConnectivityMatrix& matrix) {
  json rows = json::array();
  for (std::int32_t m = 1; m <= matrix.orders; ++m) {
    json row = json::array();
    for (std::int32_t n = 1; n <= matrix.orders; ++n) row.push_back(matrix.at(m, n));
    rows.push_back(row);
  }
  return rows;
}

std::int64_t reference(const MeasuredTree& tree, std::int32_t edge) {
  const auto& names = tree.graph.references;
  return names.empty() ? edge : names[static_cast<std::size_t>(edge)];
}

json overlaps_json(const MeasuredTree& tree) {
  json first = json::array();
  for (std::size_t i = 0; i < std::min(listed_overlaps, tree.overlaps.size()); ++i) {
    const analysis::GraphOverlap& one = tree.overlaps[i];
    first.push_back({{"segments", {one.first, one.second}},
                     {"references", {reference(tree, one.first), reference(tree, one.second)}},
                     {"depth_mm", one.depth_mm},
                     {"place_mm", {one.place.x(), one.place.y(), one.place.z()}}});
  }
  return {{"count", tree.overlaps.size()}, {"first", first}};
}

/// 0 without any.
double median_angle(const analysis::TreeReport& report, double analysis::ForkAngles::*member) {
  std::vector<double> values;
  for (const analysis::ForkAngles& one : report.angles) values.push_back(degrees * one.*member);
  return analysis::median(std::move(values));
}

GraphTable overlap_table(const MeasuredTree& tree) {
  const MeasuredTree* t = &tree;
  const auto place = [t](Eigen::Index axis) {
    return [t, axis](std::size_t row) { return t->overlaps[row].place[axis]; };
  };
  return {
      "overlaps",
      tree.overlaps.size(),
      {{"first_segment", [t](std::size_t row) { return t->overlaps[row].first; }, true},
       {"second_segment", [t](std::size_t row) { return t->overlaps[row].second; }, true},
       {"first_reference",
        [t](std::size_t row) { return static_cast<double>(reference(*t, t->overlaps[row].first)); }, true},
       {"second_reference",
        [t](std::size_t row) { return static_cast<double>(reference(*t, t->overlaps[row].second)); }, true},
       {"depth_mm", [t](std::size_t row) { return t->overlaps[row].depth_mm; }},
       {"x_mm", place(0)},
       {"y_mm", place(1)},
       {"z_mm", place(2)}}};
}

void write_table(const fs::path& folder, const GraphTable& table, const core::TaskContext& task) {
  const fs::path path = folder / (table.name + ".csv");
  std::ofstream out(path, std::ios::binary);
  analysis::write_csv(table, out, task);
  out.flush();
  if (!out) throw IoError("cannot write " + path.string() + ": is the disk full?");
}

void add_orders(const MeasuredTree& tree, figure::HtmlReport& html) {
  std::vector<std::vector<std::string>> rows;
  const auto spread = [](const analysis::RunningMean& of) {
    return significant_text(of.mean, 4) + " ± " + significant_text(of.sd(), 3);
  };
  for (const OrderMeasure& one : tree.report.orders)
    rows.push_back({std::to_string(one.order), std::to_string(one.element_diameter_mm.count),
                    spread(one.element_diameter_mm), spread(one.element_length_mm),
                    core::fixed_text(one.branches_per_element.mean, 2), significant_text(one.volume_mm3, 4)});
  html.section("Orders");
  html.table({"order", "elements", "diameter (mm)", "length (mm)", "branches per element", "volume (mm3)"},
             rows, "Diameter-defined Strahler orders; elements are branches of one order in series.");
}

void add_overlaps(const MeasuredTree& tree, figure::HtmlReport& html) {
  html.section("Overlaps");
  if (tree.overlaps.empty()) return html.paragraph("No two vessels run into each other.");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(listed_overlaps, tree.overlaps.size()); ++i) {
    const analysis::GraphOverlap& one = tree.overlaps[i];
    rows.push_back({std::to_string(reference(tree, one.first)), std::to_string(reference(tree, one.second)),
                    significant_text(one.depth_mm, 4), significant_text(one.place.x(), 4),
                    significant_text(one.place.y(), 4), significant_text(one.place.z(), 4)});
  }
  html.table({tree.reference_name, "and", "depth (mm)", "x (mm)", "y (mm)", "z (mm)"}, rows,
             std::to_string(tree.overlaps.size()) + " pairs of segments in all; the rest in overlaps.csv.");
}

void add_bifurcations(const BranchReport& branches, figure::HtmlReport& html) {
  if (branches.bifurcations->systems.empty()) return;
  std::vector<std::vector<std::string>> rows;
  for (const analysis::BifurcationVector& one : branches.bifurcations->vectors)
    rows.push_back({std::to_string(one.bifurcation), std::to_string(one.group),
                    one.downstream ? "leaves it" : "comes to it",
                    core::fixed_text(degrees * one.in_plane_rad, 1),
                    core::fixed_text(degrees * one.out_of_plane_rad, 1)});
  html.section("Bifurcations");
  html.table(
      {"bifurcation", "branch", "", "in its plane (deg)", "out of it (deg)"}, rows,
      "Directions of branches against the bifurcation's own system; groups as in centerlines' GroupIds.");
}

void write_html(const fs::path& path, const MeasuredTree& tree, const std::vector<ReportPicture>& pictures) {
  const analysis::TreeReport& r = tree.report;
  figure::HtmlReport html("Measures of a tree",
                          std::to_string(tree.graph.edges.size()) + " segments, Ostia " + core::version());
  html.section("The whole tree");
  html.key_values(
      {{"Branches", std::to_string(r.branches.size())},
       {"Ends", std::to_string(r.total.ends)},
       {"Length", significant_text(r.total.length_mm, 4) + " mm"},
       {"Area of the wall", significant_text(r.total.area_mm2, 4) + " mm2"},
       {"Volume", significant_text(r.total.volume_mm3, 4) + " mm3"},
       {"Murray's exponent, median", core::fixed_text(r.murray_median, 2)},
       {"Diameter from one order to the next", core::fixed_text(r.diameter_fit.ratio, 3) + " times"},
       {"Length from one order to the next", core::fixed_text(r.length_fit.ratio, 3) + " times"},
       {"Overlaps", std::to_string(tree.overlaps.size())}});
  add_orders(tree, html);
  add_overlaps(tree, html);
  if (tree.branches) add_bifurcations(*tree.branches, html);
  for (const ReportPicture& one : pictures) {
    html.section(one.heading);
    html.picture(one.picture, one.caption);
  }
  html.write(path);
}

}  // namespace

MeasuredTree measured(geometry::VesselGraph graph, const core::TaskContext& task) {
  MeasuredTree out;
  out.graph = std::move(graph);
  task.set_stage("measuring");
  out.report = analysis::measure_tree(out.graph, task.sub(0.0, 0.6));
  task.set_stage("overlaps");
  out.overlaps =
      analysis::find_overlaps(out.graph, geometry::GraphIncidence(out.graph), {}, task.sub(0.6, 1.0));
  return out;
}

std::string tree_measures_json(const MeasuredTree& tree) {
  const analysis::TreeReport& r = tree.report;
  const json all{{"v", 1},
                 {"kind", "tree-measures"},
                 {"segments", tree.graph.edges.size()},
                 {"branches", r.branches.size()},
                 {"ends", r.total.ends},
                 {"forks", r.exponents.size()},
                 {"length_mm", r.total.length_mm},
                 {"area_mm2", r.total.area_mm2},
                 {"volume_mm3", r.total.volume_mm3},
                 {"highest_strahler_order",
                  r.strahler.empty() ? 0 : *std::max_element(r.strahler.begin(), r.strahler.end())},
                 {"orders_converged", r.diameter_orders.converged},
                 {"orders", orders_json(tree)},
                 {"connectivity", connectivity_json(r.connectivity)},
                 {"murray_exponent", r.murray_median},
                 {"fits",
                  {{"diameter", fit_json(r.diameter_fit)},
                   {"length", fit_json(r.length_fit)},
                   {"number", fit_json(r.number_fit)}}},
                 {"median_angles_deg",
                  {{"between", median_angle(r, &analysis::ForkAngles::between_rad)},
                   {"wide", median_angle(r, &analysis::ForkAngles::wide_rad)},
                   {"narrow", median_angle(r, &analysis::ForkAngles::narrow_rad)},
                   {"tilt", median_angle(r, &analysis::ForkAngles::tilt_rad)}}},
                 {"overlaps", overlaps_json(tree)}};
  return all.dump(1) + "\n";
}

void write_tree_report(const fs::path& folder, const MeasuredTree& tree, const JobKey& key,
                       double seconds_before, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("report");
  core::StagedFolder staged(folder);
  core::write_file(staged.temporary() / "measures.json", tree_measures_json(tree));
  std::vector<GraphTable> tables = analysis::tree_tables(tree.graph, tree.report);
  tables.push_back(overlap_table(tree));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    task.set_progress(0.8 * static_cast<double>(i) / static_cast<double>(tables.size()));
    write_table(staged.temporary(), tables[i], task);
  }
  if (tree.branches) write_branch_report(staged.temporary(), *tree.branches);
  const std::vector<ReportPicture> pictures = tree_pictures(tree);
  write_pictures(staged.temporary(), pictures, task);
  write_html(staged.temporary() / "report.html", tree, pictures);
  const double seconds =
      seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_manifest(staged.temporary(), {key, ExitCode::ok, seconds, {}, "{}"});
  task.throw_if_cancelled();
  staged.commit();
  task.set_progress(1.0);
}

}  // namespace ostia::pipeline
