#include "ostia/experiments/editing_report.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/session/case_file.h"
#include "ostia/session/edit_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_text;
using geometry::Health;
using Json = nlohmann::ordered_json;
using SectionStep = SectionRun::Step;

const char* name_of(Health health) {
  return health == Health::diseased ? "diseased" : "healthy";
}

Json json_of(const Distances& d) {
  return {{"msd_mm", d.msd_mm}, {"max_sd_mm", d.max_sd_mm}, {"dice", d.dice}};
}

Json parameters_of(const EditingOptions& options) {
  const ReaderOptions& r = options.reader;
  return {{"observer", options.observer},
          {"start_excess_mm", options.start_excess_mm},
          {"margin_mm", options.margin_mm},
          {"start_spacing_mm", options.start_spacing_mm},
          {"picture_px", r.picture_px},
          {"pointing_sigma_mm", r.pointing_sigma_mm},
          {"points", r.points},
          {"lines_deg", r.lines_deg},
          {"row_mm", r.row_mm},
          {"section_step_mm", r.section_step_mm},
          {"visible_px", r.visible_px},
          {"section_share", r.section_share},
          {"beta_deg", r.beta_deg},
          {"eps_mm", r.eps_mm},
          {"most_strokes", r.most_strokes},
          {"seconds_a_stroke", r.seconds_a_stroke},
          {"seconds_a_point", r.seconds_a_point},
          {"seconds_a_view", r.seconds_a_view},
          {"seed", r.seed}};
}

Json summary_json(const std::vector<SectionRun>& runs, Health health) {
  const EditingSummary s = summarize(runs, health);
  return {{"health", name_of(health)},
          {"sections", s.sections},
          {"length_mm", s.length_mm},
          {"start", json_of(s.start)},
          {"final", json_of(s.final)},
          {"start_to_truth", json_of(s.start_to_truth)},
          {"final_to_truth", json_of(s.final_to_truth)},
          {"observer_to_truth", json_of(s.observer_against_truth)},
          {"floor_msd_mm", s.floor_msd_mm},
          {"median_strokes", s.median_strokes},
          {"section_share", s.section_share},
          {"mean_seconds", s.mean_seconds}};
}

std::string section_rows(const std::vector<SectionRun>& runs) {
  std::string text =
      "case,section,vessel,health,length_mm,start_radius_mm,start_msd_mm,start_max_sd_mm,final_msd_mm,final_"
      "max_sd_mm,"
      "final_to_truth_msd_mm,final_to_truth_max_sd_mm,observer_to_truth_msd_mm,observer_to_truth_max_sd_mm,"
      "floor_msd_mm,"
      "strokes,section_strokes,refused,seconds,stopped\n";
  for (const SectionRun& r : runs) {
    text += r.case_name + "," + r.section + "," + r.vessel + "," + name_of(r.health);
    for (const double v :
         {r.length_mm, r.start_radius_mm, r.first().to_observer.msd_mm, r.first().to_observer.max_sd_mm,
          r.last().to_observer.msd_mm, r.last().to_observer.max_sd_mm, r.last().to_truth.msd_mm,
          r.last().to_truth.max_sd_mm, r.observer_against_truth.msd_mm, r.observer_against_truth.max_sd_mm,
          r.floor_mm})
      text += "," + fixed_text(v, 4);
    text += "," + std::to_string(r.edits.size()) + "," + std::to_string(r.section_strokes) + "," +
            std::to_string(r.refusals.size()) + "," + fixed_text(r.last().seconds, 1) + ",\"" + r.stopped +
            "\"\n";
  }
  return text;
}

std::string step_rows(const std::vector<SectionRun>& runs) {
  std::string text =
      "case,section,health,strokes,seconds,msd_mm,max_sd_mm,to_truth_msd_mm,to_truth_max_sd_mm\n";
  for (const SectionRun& r : runs) {
    for (const SectionStep& s : r.steps) {
      text += r.case_name + "," + r.section + "," + name_of(r.health) + "," + std::to_string(s.strokes) +
              "," + fixed_text(s.seconds, 1) + "," + fixed_text(s.to_observer.msd_mm, 4) + "," +
              fixed_text(s.to_observer.max_sd_mm, 4) + "," + fixed_text(s.to_truth.msd_mm, 4) + "," +
              fixed_text(s.to_truth.max_sd_mm, 4) + "\n";
    }
  }
  return text;
}

/// A section's MSD at a modelled time: that of the last stroke done by then.
double msd_at(const SectionRun& run, double seconds) {
  double msd = run.first().to_observer.msd_mm;
  for (const SectionStep& step : run.steps)
    if (step.seconds <= seconds) msd = step.to_observer.msd_mm;
  return msd;
}

figure::Series over_time(const std::vector<SectionRun>& runs, Health health) {
  figure::Series series;
  series.name = name_of(health);
  double longest = 0.0, length = 0.0;
  for (const SectionRun& run : runs) {
    if (run.health != health) continue;
    longest = std::max(longest, run.last().seconds);
    length += run.length_mm;
  }
  for (double t = 0.0; t <= longest + 2.0 && length > 0.0; t += 2.0) {
    double sum = 0.0;
    for (const SectionRun& run : runs)
      if (run.health == health) sum += run.length_mm / length * msd_at(run, t);
    series.x.push_back(t);
    series.y.push_back(sum);
  }
  return series;
}

figure::Picture accuracy_plot(const std::vector<SectionRun>& runs) {
  std::vector<figure::Series> strokes, time;
  for (const Health health : {Health::healthy, Health::diseased}) {
    figure::Series series;
    series.name = name_of(health);
    series.y = accuracy_over_strokes(runs, health);
    for (std::size_t i = 0; i < series.y.size(); ++i) series.x.push_back(static_cast<double>(i));
    if (series.y.empty()) continue;
    strokes.push_back(std::move(series));
    time.push_back(over_time(runs, health));
  }
  figure::PlotOptions how;
  how.y_label = "mean surface distance to the observer (mm)";
  how.y_from_zero = true;
  how.title = "Accuracy over strokes, all sections";
  how.x_label = "strokes";
  const figure::Picture left = figure::line_plot(strokes, how);
  how.title = "Accuracy over modelled time";
  how.x_label = "seconds";
  return figure::grid({left, figure::line_plot(time, how)}, {.columns = 2, .look = figure::Look::light});
}

/// The diseased section that needed most strokes of those near the median length.
const SectionRun* example(const std::vector<SectionRun>& runs) {
  const SectionRun* best = nullptr;
  for (const SectionRun& run : runs) {
    if (run.health != Health::diseased) continue;
    if (!best || run.first().to_observer.msd_mm > best->first().to_observer.msd_mm) best = &run;
  }
  return best ? best : (runs.empty() ? nullptr : &runs.front());
}

figure::Picture section_plot(const SectionRun& run) {
  figure::Series mean{"mean surface distance"}, most{"maximum surface distance"};
  for (const SectionStep& step : run.steps) {
    mean.x.push_back(step.seconds);
    mean.y.push_back(step.to_observer.msd_mm);
    most.x.push_back(step.seconds);
    most.y.push_back(step.to_observer.max_sd_mm);
  }
  figure::PlotOptions how;
  how.title = run.case_name + " " + run.section + ", " + run.vessel + ", " + name_of(run.health) + ", " +
              fixed_text(run.length_mm, 1) + " mm";
  how.x_label = "modelled time (s)";
  how.y_label = "distance to the observer (mm)";
  how.y_from_zero = true;
  return figure::line_plot({mean, most}, how);
}

void write_html(const fs::path& path, const std::vector<SectionRun>& runs, const EditingOptions& options) {
  figure::HtmlReport page("Editing a lumen until it agrees with an observer",
                          std::to_string(runs.size()) + " sections");
  page.paragraph(
      "A simulated reader starts from a tube of regular diameter on the given axis, sees the contours of " +
      options.observer +
      " as an overlay on reformations and cross-sections, and edits where they disagree most until nothing "
      "is visibly off.");
  page.section("Result");
  std::vector<std::vector<std::string>> rows;
  for (const Health health : {Health::healthy, Health::diseased}) {
    const EditingSummary s = summarize(runs, health);
    rows.push_back({name_of(health), std::to_string(s.sections), fixed_text(s.length_mm, 0),
                    fixed_text(s.start.msd_mm, 3), fixed_text(s.final.msd_mm, 3),
                    fixed_text(s.start.max_sd_mm, 2), fixed_text(s.final.max_sd_mm, 2),
                    fixed_text(s.floor_msd_mm, 3), fixed_text(s.final_to_truth.msd_mm, 3),
                    fixed_text(s.observer_against_truth.msd_mm, 3), fixed_text(s.median_strokes, 1),
                    fixed_text(100.0 * s.section_share, 0), fixed_text(s.mean_seconds, 0)});
  }
  page.table(
      {"lumen", "sections", "mm", "MSD start", "MSD edited", "max SD start", "max SD edited", "MSD floor",
       "MSD edited, truth", "MSD observer, truth", "strokes (median)", "% on sections", "modelled s"},
      rows, "Against the observer's ruled surface unless \"truth\" is said; distances in mm.");
  page.picture(accuracy_plot(runs), "Means weighted by length; a finished section keeps its last value.");
  if (const SectionRun* one = example(runs)) page.picture(section_plot(*one), "One diseased section.");
  page.section("Section by section");
  std::vector<std::vector<std::string>> cells;
  for (const SectionRun& r : runs)
    cells.push_back({r.case_name, r.section, r.vessel, name_of(r.health), fixed_text(r.length_mm, 1),
                     fixed_text(r.first().to_observer.msd_mm, 3), fixed_text(r.last().to_observer.msd_mm, 3),
                     fixed_text(r.last().to_observer.max_sd_mm, 2), fixed_text(r.last().to_truth.msd_mm, 3),
                     std::to_string(r.edits.size()), std::to_string(r.section_strokes), r.stopped});
  page.table({"case", "section", "vessel", "lumen", "mm", "MSD start", "MSD edited", "max SD edited",
              "MSD edited, truth", "strokes", "on sections", "stopped"},
             cells);
  page.write(path);
}

void write_journal(const fs::path& folder, const SectionRun& run) {
  const std::string name = (run.case_name.empty() ? "" : run.case_name + "_") + run.section;
  session::write_edits(folder / (name + ".jsonl"), run.edits);
  session::CaseFile file = session::CaseFile::create(folder / (name + ".ostia"), run.start);
  for (const lumen::Edit& edit : run.edits) file.apply(edit);
}

}  // namespace

std::vector<double> accuracy_over_strokes(const std::vector<SectionRun>& runs, Health health) {
  std::size_t most = 0;
  double length = 0.0;
  for (const SectionRun& run : runs) {
    if (run.health != health) continue;
    most = std::max(most, run.steps.size());
    length += run.length_mm;
  }
  std::vector<double> mean(most, 0.0);
  for (const SectionRun& run : runs) {
    if (run.health != health) continue;
    for (std::size_t i = 0; i < most; ++i)
      mean[i] += run.length_mm / length * run.steps[std::min(i, run.steps.size() - 1)].to_observer.msd_mm;
  }
  return mean;
}

std::string parameters_json(const EditingOptions& options) {
  return parameters_of(options).dump();
}

std::string editing_json(const std::vector<SectionRun>& runs, const EditingOptions& options) {
  Json out{{"v", 1}, {"kind", "editing"}};
  out["parameters"] = parameters_of(options);
  out["summary"] = {summary_json(runs, Health::healthy), summary_json(runs, Health::diseased)};
  out["sections"] = Json::array();
  for (const SectionRun& run : runs) {
    Json row{{"case", run.case_name},
             {"section", run.section},
             {"vessel", run.vessel},
             {"health", name_of(run.health)},
             {"length_mm", run.length_mm},
             {"start", json_of(run.first().to_observer)},
             {"final", json_of(run.last().to_observer)},
             {"final_to_truth", json_of(run.last().to_truth)},
             {"observer_to_truth", json_of(run.observer_against_truth)},
             {"floor_msd_mm", run.floor_mm},
             {"strokes", run.edits.size()},
             {"section_strokes", run.section_strokes},
             {"refused", run.refusals.size()},
             {"seconds", run.last().seconds},
             {"stopped", run.stopped},
             {"digest", run.digest}};
    out["sections"].push_back(row);
  }
  return out.dump(1) + "\n";
}

void write_editing_report(const fs::path& folder, const std::vector<SectionRun>& runs,
                          const EditingOptions& options) {
  core::write_file(folder / "sections.csv", section_rows(runs));
  core::write_file(folder / "steps.csv", step_rows(runs));
  accuracy_plot(runs).write_png(folder / "accuracy.png", 2.0);
  if (const SectionRun* one = example(runs)) section_plot(*one).write_png(folder / "one-section.png", 2.0);
  write_html(folder / "report.html", runs, options);
  fs::create_directory(folder / "edits");
  for (const SectionRun& run : runs) write_journal(folder / "edits", run);
}

}  // namespace ostia::experiments
