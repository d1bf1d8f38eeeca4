#include "ostia/pipeline/motion_report.h"

#include "motion/motion_report_text.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ostia::pipeline {
namespace fs = std::filesystem;
using analysis::LocalMeasure;
using analysis::MotionMeasure;
using analysis::TimeCurve;
using analysis::TreeMotion;
using core::fixed_or_dash;

namespace motion_text {

std::string pair_name(const TreeMotion& motion, const analysis::BranchDistance& pair) {
  return motion.branches[pair.first].name + " | " + motion.branches[pair.second].name;
}

std::string rests_text(const std::vector<analysis::RestPeriod>& rests, double rr_s) {
  std::string text;
  for (const analysis::RestPeriod& one : rests)
    text += (text.empty() ? "" : ", ") + fixed_or_dash(100.0 * one.from, 0) + "-" +
            fixed_or_dash(100.0 * one.to, 0) + " % (" +
            fixed_or_dash(1000.0 * rr_s * (one.to - one.from), 0) + " ms)";
  return text.empty() ? "-" : text;
}

}  // namespace motion_text

namespace {

using nlohmann::json;
using namespace motion_text;

/// Of a table: empty where there is none.
std::string motion_cell(double value) {
  return std::isfinite(value) ? core::significant_text(value, 7) : std::string();
}

json value_json(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json curve_json(const TimeCurve& curve, const std::string& unit) {
  json values = json::array();
  for (const double value : curve.values) values.push_back(value_json(value));
  return {{"unit", unit}, {"at_template", value_json(curve.at_template)}, {"values", values}};
}

json rests_json(const std::vector<analysis::RestPeriod>& rests, double rr_s) {
  json list = json::array();
  for (const analysis::RestPeriod& one : rests)
    list.push_back({{"from_percent", 100.0 * one.from},
                    {"to_percent", 100.0 * one.to},
                    {"duration_ms", 1000.0 * rr_s * (one.to - one.from)},
                    {"motion_mm", one.motion_mm}});
  return list;
}

json branch_json(const analysis::BranchMotion& branch, double rr_s) {
  json measures = json::object();
  for (std::size_t m = 0; m < analysis::branch_measure_count; ++m) {
    const analysis::MeasureName& name = analysis::name_of(static_cast<MotionMeasure>(m));
    measures[name.name] = curve_json(branch.over_time[m], name.unit);
  }
  return {{"name", branch.name},
          {"vessel", branch.vessel},
          {"length_mm", branch.length_mm},
          {"measures", measures},
          {"rests", rests_json(branch.rests, rr_s)}};
}

json options_json(const analysis::MotionMeasureOptions& o) {
  return {{"reach_mm", o.reach_mm},
          {"least_curvature_per_mm", o.least_curvature_per_mm},
          {"arm_mm", o.arm_mm},
          {"least_way_mm", o.least_way_mm},
          {"rest_mm", o.rest_mm}};
}

void add_rows(const std::string& of, const std::string& measure, const std::string& unit,
              const TimeCurve& curve, const TreeMotion& motion, std::string& csv) {
  for (std::size_t k = 0; k < curve.values.size(); ++k)
    csv += core::csv_line({of, motion_cell(100.0 * motion.phases[k]),
                           motion_cell(motion.options.rr_s * motion.phases[k]), measure,
                           motion_cell(curve.values[k]), unit, motion_cell(curve.at_template)});
}

void add_along(const analysis::BranchMotion& branch, const std::string& percent,
               const std::vector<const std::vector<double>*>& columns, std::string& csv) {
  for (std::size_t i = 0; i < branch.s_mm.size(); ++i) {
    std::vector<std::string> row{branch.name, percent, motion_cell(branch.s_mm[i])};
    for (const std::vector<double>* column : columns)
      row.push_back(column == nullptr || column->empty() ? "" : motion_cell((*column)[i]));
    csv += core::csv_line(row);
  }
}

std::pair<double, double> range(const std::vector<double>& values) {
  std::pair<double, double> found{analysis::not_measured, analysis::not_measured};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (!(value >= found.first)) found.first = value;
    if (!(value <= found.second)) found.second = value;
  }
  return found;
}

std::string range_text(const TimeCurve& curve, int decimals) {
  const auto [least, largest] = range(curve.values);
  if (!std::isfinite(least)) return "-";
  return fixed_or_dash(least, decimals) + " to " + fixed_or_dash(largest, decimals);
}

void add_table(figure::HtmlReport& html, const TreeMotion& motion) {
  std::vector<std::vector<std::string>> rows;
  for (const analysis::BranchMotion& b : motion.branches)
    rows.push_back({b.name, fixed_or_dash(b.length_mm, 1),
                    fixed_or_dash(range(b[MotionMeasure::displacement_max].values).second, 1),
                    fixed_or_dash(range(b[MotionMeasure::speed_mean].values).second, 0),
                    range_text(b[MotionMeasure::stretch], 3), range_text(b[MotionMeasure::curvature_mean], 3),
                    range_text(b[MotionMeasure::torsion_mean], 3), range_text(b[MotionMeasure::twist], 1),
                    rests_text(b.rests, motion.options.rr_s)});
  html.section("Branches over the cycle");
  html.table({"branch", "length (mm)", "largest displacement (mm)", "peak of the mean speed (mm/s)",
              "stretch", "mean curvature (1/mm)", "mean torsion (1/mm)", "twist (deg)", "at rest"},
             rows);
  html.key_values({{"The whole tree is at rest", rests_text(motion.rests, motion.options.rr_s)}});
}

void write_html(const fs::path& path, const TreeMotion& motion, const std::vector<ReportPicture>& pictures) {
  figure::HtmlReport html("Motion over the beat", std::to_string(motion.branches.size()) + " branches, " +
                                                      std::to_string(motion.phases.size()) +
                                                      " times, Ostia " + core::version());
  for (const std::string& warning : motion.warnings) html.notice(figure::Notice::warning, warning);
  add_table(html, motion);
  for (const ReportPicture& one : pictures) {
    html.section(one.heading);
    html.picture(one.picture, one.caption);
  }
  html.write(path);
}

}  // namespace

std::string motion_measures_json(const TreeMotion& motion) {
  const double rr_s = motion.options.rr_s;
  json percents = json::array(), branches = json::array(), distances = json::array(), angles = json::array();
  for (const double phase : motion.phases) percents.push_back(100.0 * phase);
  for (const analysis::BranchMotion& branch : motion.branches) branches.push_back(branch_json(branch, rr_s));
  for (const analysis::BranchDistance& pair : motion.distances)
    distances.push_back({{"first", motion.branches[pair.first].name},
                         {"second", motion.branches[pair.second].name},
                         {"distance", curve_json(pair.distance, "mm")},
                         {"at_first", curve_json(pair.s_first, "mm")},
                         {"at_second", curve_json(pair.s_second, "mm")}});
  for (const analysis::JointAngle& one : motion.angles)
    angles.push_back({{"node", one.node}, {"name", one.name}, {"angle", curve_json(one.angle, "deg")}});
  const json all{{"v", 1},
                 {"kind", "motion-measures"},
                 {"rr_s", rr_s},
                 {"template_percent", 100.0 * motion.template_phase},
                 {"percents", percents},
                 {"options", options_json(motion.options)},
                 {"branches", branches},
                 {"distances", distances},
                 {"angles", angles},
                 {"rests", rests_json(motion.rests, rr_s)},
                 {"warnings", motion.warnings}};
  return all.dump(1) + "\n";
}

std::string motion_measures_csv(const TreeMotion& motion) {
  std::string csv =
      core::csv_line({"branch", "percent", "time_s", "measure", "value", "unit", "at_template"});
  for (const analysis::BranchMotion& branch : motion.branches)
    for (std::size_t m = 0; m < analysis::branch_measure_count; ++m) {
      const analysis::MeasureName& name = analysis::name_of(static_cast<MotionMeasure>(m));
      add_rows(branch.name, name.name, name.unit, branch.over_time[m], motion, csv);
    }
  for (const analysis::BranchDistance& pair : motion.distances) {
    const std::string name = pair_name(motion, pair);
    add_rows(name, "distance", "mm", pair.distance, motion, csv);
    add_rows(name, "distance_at_first", "mm", pair.s_first, motion, csv);
    add_rows(name, "distance_at_second", "mm", pair.s_second, motion, csv);
  }
  for (const analysis::JointAngle& one : motion.angles)
    add_rows(one.name, "angle", "deg", one.angle, motion, csv);
  return csv;
}

std::string motion_along_csv(const TreeMotion& motion) {
  std::vector<std::string> header{"branch", "percent", "s_mm"};
  for (std::size_t m = 0; m < analysis::local_measure_count; ++m) {
    const analysis::MeasureName& name = analysis::name_of(static_cast<LocalMeasure>(m));
    header.push_back(name.unit.empty() ? name.name : name.name + " (" + name.unit + ")");
  }
  std::string csv = core::csv_line(header);
  for (const analysis::BranchMotion& branch : motion.branches) {
    std::vector<const std::vector<double>*> columns;
    for (const analysis::AlongCurve& curve : branch.along) columns.push_back(&curve.at_template);
    add_along(branch, "template", columns, csv);
    for (std::size_t k = 0; k < motion.phases.size(); ++k) {
      for (std::size_t m = 0; m < columns.size(); ++m)
        columns[m] = branch.along[m].values.empty() ? nullptr : &branch.along[m].values[k];
      add_along(branch, motion_cell(100.0 * motion.phases[k]), columns, csv);
    }
  }
  return csv;
}

void write_motion_report(const fs::path& folder, const TreeMotion& motion, const JobKey& key,
                         double seconds_before, const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  task.set_stage("report");
  core::StagedFolder staged(folder);
  core::write_file(staged.temporary() / "measures.json", motion_measures_json(motion));
  core::write_file(staged.temporary() / "measures.csv", motion_measures_csv(motion));
  core::write_file(staged.temporary() / "along.csv", motion_along_csv(motion));
  task.throw_if_cancelled();
  const std::vector<ReportPicture> pictures = motion_pictures(motion);
  write_pictures(staged.temporary(), pictures, task);
  write_html(staged.temporary() / "report.html", motion, pictures);
  const double seconds =
      seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_manifest(staged.temporary(), {key, ExitCode::ok, seconds, motion.warnings, "{}"});
  task.throw_if_cancelled();
  staged.commit();
  task.set_progress(1.0);
}

}  // namespace ostia::pipeline
