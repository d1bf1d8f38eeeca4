#include "motion/motion_keep.h"
#include "motion/motion_plots.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/motion.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace ostia::experiments {
namespace {

using core::fixed_text;
using Json = nlohmann::ordered_json;

std::string name_of(const MotionRow& row) {
  return name_of(row.method, row.depth, row.sampling);
}

const std::vector<std::string> header{"method",       "runs",           "seconds",      "processor, s",
                                      "distance, mm", "Dice",           "least Dice",   "points, mm",
                                      "worst, mm",    "inverted cells", "intersections"};
std::vector<std::string> cells(const MotionRow& row) {
  return {name_of(row),
          std::to_string(row.runs),
          row.seconds > 0.0 ? fixed_text(row.seconds, 2) : "-",
          row.seconds > 0.0 ? fixed_text(row.processor_seconds, 2) : "-",
          fixed_text(row.distance_mm, 3) + " ± " + fixed_text(row.distance_sd_mm, 3),
          fixed_text(row.dice, 3) + " ± " + fixed_text(row.dice_sd, 3),
          fixed_text(row.least_dice, 3),
          fixed_text(row.vertex_mm, 3),
          fixed_text(row.worst_vertex_mm, 3),
          std::to_string(row.inverted_cells),
          std::to_string(row.new_intersections)};
}

Json row_json(const MotionRow& r) {
  return {{"method", word(r.method)},
          {"depth", r.depth},
          {"sampling", r.sampling},
          {"runs", r.runs},
          {"seconds", r.seconds},
          {"processor_seconds", r.processor_seconds},
          {"distance_mm", r.distance_mm},
          {"distance_sd_mm", r.distance_sd_mm},
          {"dice", r.dice},
          {"dice_sd", r.dice_sd},
          {"least_dice", r.least_dice},
          {"vertex_mm", r.vertex_mm},
          {"worst_vertex_mm", r.worst_vertex_mm},
          {"inverted_cells", r.inverted_cells},
          {"new_intersections", r.new_intersections}};
}

bool by_method(const MotionRun& run, int depth) {
  return run.sampling == "all" && (run.method == MotionMethod::none || run.depth == depth);
}
bool by_depth(const MotionRun& run) {
  return run.sampling == "all" && run.method <= MotionMethod::cage;
}
bool by_sampling(const MotionRun& run, int depth) {
  return run.method == MotionMethod::none || (run.method == MotionMethod::cage && run.depth == depth);
}

std::vector<std::string> hearts_of(const std::vector<MotionRun>& runs) {
  std::vector<std::string> hearts;
  for (const MotionRun& run : runs)
    if (std::find(hearts.begin(), hearts.end(), run.heart) == hearts.end()) hearts.push_back(run.heart);
  return hearts;
}

void add_table(figure::HtmlReport& page, const std::string& title, const std::vector<MotionRow>& rows,
               const std::string& note) {
  std::vector<std::vector<std::string>> lines;
  for (const MotionRow& row : rows) lines.push_back(cells(row));
  page.section(title);
  page.table(header, lines, note);
}

void save(figure::HtmlReport& page, const std::filesystem::path& folder, const std::string& file,
          const figure::Picture& picture, const std::string& caption) {
  picture.write_png(folder / file, 2.0);
  page.picture(picture, caption);
}

using NamedAgreements = std::array<std::pair<const char*, BranchAgreement>, 4>;
NamedAgreements named(const BranchAgreements& near) {
  return {{{"stretch", near.stretch},
           {"torsion", near.torsion},
           {"torsion size", near.torsion_size},
           {"curvature", near.curvature}}};
}

Json agreement_json(const BranchAgreement& a) {
  return {{"count", a.count}, {"median", a.median},       {"p95", a.p95},
          {"worst", a.worst}, {"of_change", a.of_change}, {"within_5_percent", a.within_5_percent}};
}

void add_branches(figure::HtmlReport& page, const std::vector<BranchRun>& branches) {
  if (branches.empty()) return;
  std::vector<std::vector<std::string>> lines;
  for (const auto& [name, one] : named(agreement(branches)))
    lines.push_back({name, std::to_string(one.count), fixed_text(100.0 * one.median, 2),
                     fixed_text(100.0 * one.p95, 2), fixed_text(100.0 * one.worst, 1),
                     fixed_text(100.0 * one.within_5_percent, 1), fixed_text(100.0 * one.of_change, 1)});
  page.section("Stretch and torsion of the branches");
  page.table(
      {"measure", "values", "median, %", "95 %, %", "worst, %", "within 5 %, %", "of the change, %"}, lines,
      "Fitted against known, branch by branch and phase by phase; torsion where it is 0.005/mm or more; "
      "torsion: the mean with its sign; its size: of the motion that all branches have in common; "
      "of the change: mean error over the branch's largest change from the template.");
}

}  // namespace

std::string parameters_json(const MotionOptions& o) {
  Json methods = Json::array();
  for (const MotionMethod method : o.methods) methods.push_back(word(method));
  return Json{{"hearts", o.hearts},
              {"seed", o.heart.seed},
              {"phases", o.heart.phases},
              {"template_points", o.heart.template_points},
              {"target_points", o.heart.target_points},
              {"noise_mm", o.heart.noise_mm},
              {"noise_length_mm", o.heart.noise_length_mm},
              {"phases_with_loss", o.heart.phases_with_loss},
              {"depths", o.depths},
              {"depth", o.depth},
              {"methods", methods},
              {"compared_phases", o.compared_phases},
              {"compared_hearts", o.compared_hearts},
              {"dice_resolution_mm", o.dice_resolution_mm}}
      .dump();
}

std::string motion_json(const MotionResults& results, const MotionOptions& options) {
  Json out{{"v", 1}, {"kind", "motion"}};
  out["parameters"] = Json::parse(parameters_json(options));
  out["rows"] = Json::array();
  for (const MotionRow& row : rows_of(results.runs, false)) out["rows"].push_back(row_json(row));
  out["compared"] = Json::array();
  for (const MotionRow& row : rows_of(results.runs, true)) out["compared"].push_back(row_json(row));
  const BranchAgreements near = agreement(results.branches);
  out["branches"] = Json{{"stretch", agreement_json(near.stretch)},
                         {"torsion", agreement_json(near.torsion)},
                         {"torsion_size", agreement_json(near.torsion_size)},
                         {"curvature", agreement_json(near.curvature)}};
  return out.dump(1) + "\n";
}

std::string motion_text(const MotionResults& results) {
  std::string text;
  char line[256];
  std::snprintf(line, sizeof line, "%-28s %5s %8s %8s %16s %14s %8s %8s %5s %5s\n", "method", "runs",
                "seconds", "proc. s", "distance, mm", "Dice", "least", "points", "inv.", "sect.");
  const std::string head = line;
  for (const bool compared : {false, true}) {
    const std::vector<MotionRow> rows = rows_of(results.runs, compared);
    if (rows.empty()) continue;
    text += (compared ? "Where all methods were run:\n" : "") + head;
    for (const MotionRow& row : rows) {
      std::snprintf(line, sizeof line,
                    "%-28s %5zu %8.2f %8.2f %7.3f +- %5.3f %5.3f +- %5.3f %8.3f %8.3f %5zu %5zu\n",
                    name_of(row).c_str(), row.runs, row.seconds, row.processor_seconds, row.distance_mm,
                    row.distance_sd_mm, row.dice, row.dice_sd, row.least_dice, row.vertex_mm,
                    row.inverted_cells, row.new_intersections);
      text += line;
    }
  }
  if (results.branches.empty()) return text;
  const BranchAgreements near = agreement(results.branches);
  text += "Branches of the fitted motion against the known one:\n";
  for (const auto& [name, one] : named(near)) {
    std::snprintf(
        line, sizeof line,
        "%-12s %5zu values, error: median %.2f %%, 95 %% below %.2f %%, worst %.1f %%; within 5 %%: "
        "%.1f %%; of the change: %.1f %%\n",
        name, one.count, 100.0 * one.median, 100.0 * one.p95, 100.0 * one.worst, 100.0 * one.within_5_percent,
        100.0 * one.of_change);
    text += line;
  }
  return text;
}

void write_motion_report(const std::filesystem::path& folder, const MotionResults& results,
                         const MotionOptions& options) {
  const std::vector<MotionRun>& runs = results.runs;
  core::write_file(folder / "runs.csv", runs_csv(runs));
  core::write_file(folder / "branches.csv", branches_csv(results.branches));
  figure::HtmlReport page("Motion of coronary trees");
  add_table(page, "All phases of all hearts", rows_of(runs, false),
            "Means and standard deviations over phases and hearts; points: to where the known motion carries "
            "them; worst: the run with the largest mean.");
  const std::vector<MotionRow> compared = rows_of(runs, true);
  if (!compared.empty())
    add_table(page, "Methods compared", compared, "Phases and hearts at which all methods were run.");
  std::vector<MotionRun> lossy;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(lossy),
               [](const MotionRun& run) { return !run.lost.empty(); });
  if (!lossy.empty())
    add_table(page, "Phases that lack a branch", rows_of(lossy, false),
              "The same, where the target is without one of its side branches: what the energy is for.");
  add_branches(page, results.branches);
  save(page, folder, "depths.png", pair_of_plots(runs, "Depth of the cage", by_depth),
       "Mean over the hearts, by the depth of the cage.");
  save(page, folder, "samplings.png",
       pair_of_plots(runs, "Phases known", [&](const MotionRun& r) { return by_sampling(r, options.depth); }),
       "All phases from splines through some of them.");
  if (!compared.empty())
    save(page, folder, "methods.png",
         pair_of_plots(runs, "Methods", [&](const MotionRun& r) { return by_method(r, options.depth); }),
         "Mean over the hearts, by method, at the phases at which each was run.");
  if (!results.branches.empty())
    save(page, folder, "branches.png", branch_plots(results.branches),
         "Stretch and size of the torsion of the longest branches: known (solid) and fitted (dashed).");
  page.section("Heart by heart");
  for (const std::string& heart : hearts_of(runs)) {
    std::string file = heart + ".png";
    std::replace(file.begin(), file.end(), ' ', '-');
    const auto mine = [&](const MotionRun& r) { return r.heart == heart; };
    std::vector<figure::Picture> panels;
    panels.push_back(pair_of_plots(runs, heart, [&](const MotionRun& r) { return mine(r) && by_depth(r); }));
    panels.push_back(pair_of_plots(runs, heart + ", phases known", [&](const MotionRun& r) {
      return mine(r) && by_sampling(r, options.depth);
    }));
    if (std::any_of(runs.begin(), runs.end(),
                    [&](const MotionRun& r) { return mine(r) && r.method > MotionMethod::cage; }))
      panels.push_back(pair_of_plots(runs, heart + ", methods", [&](const MotionRun& r) {
        return mine(r) && by_method(r, options.depth);
      }));
    save(page, folder, file, figure::grid(panels, {.columns = 1, .look = figure::Look::light}), heart);
  }
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
