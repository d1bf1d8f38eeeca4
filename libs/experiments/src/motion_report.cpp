#include "ostia/core/files.h"
#include "ostia/experiments/motion.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>

namespace ostia::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// How a row is called in tables and legends.
std::string name_of(MotionMethod method, int depth, const std::string& sampling) {
  if (method == MotionMethod::none) return "before registration";
  std::string name = std::string(word(method)) + ", depth " + std::to_string(depth);
  if (sampling != "all") name += ", " + sampling;
  return name;
}
std::string name_of(const MotionRun& run) {
  return name_of(run.method, run.depth, run.sampling);
}
std::string name_of(const MotionRow& row) {
  return name_of(row.method, row.depth, row.sampling);
}

const std::vector<std::string> header{"method",         "runs",         "seconds",    "distance, mm",
                                      "Dice",           "least Dice",   "points, mm", "worst, mm",
                                      "inverted cells", "intersections"};
std::vector<std::string> cells(const MotionRow& row) {
  return {name_of(row),
          std::to_string(row.runs),
          row.seconds > 0.0 ? fixed(row.seconds, 2) : "-",
          fixed(row.distance_mm, 3) + " ± " + fixed(row.distance_sd_mm, 3),
          fixed(row.dice, 3) + " ± " + fixed(row.dice_sd, 3),
          fixed(row.least_dice, 3),
          fixed(row.vertex_mm, 3),
          fixed(row.worst_vertex_mm, 3),
          std::to_string(row.inverted_cells),
          std::to_string(row.new_intersections)};
}

Json row_json(const MotionRow& r) {
  return {{"method", word(r.method)},
          {"depth", r.depth},
          {"sampling", r.sampling},
          {"runs", r.runs},
          {"seconds", r.seconds},
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

using Chosen = std::function<bool(const MotionRun&)>;
using Value = std::function<double(const MotionRun&)>;

/// A curve over the phase for each kind of run among those chosen, mean over hearts.
std::vector<figure::Series> curves(const std::vector<MotionRun>& runs, const Chosen& chosen,
                                   const Value& value) {
  struct Sum {
    double phase, sum;
    int count;
  };
  std::vector<std::pair<std::string, std::vector<Sum>>> found;
  for (const MotionRun& run : runs) {
    if (!chosen(run)) continue;
    const std::string name = name_of(run);
    auto curve = std::find_if(found.begin(), found.end(), [&](const auto& c) { return c.first == name; });
    if (curve == found.end()) curve = found.insert(found.end(), {name, {}});
    auto at = std::find_if(curve->second.begin(), curve->second.end(),
                           [&](const Sum& s) { return s.phase == run.phase; });
    if (at == curve->second.end()) at = curve->second.insert(curve->second.end(), {run.phase, 0.0, 0});
    at->sum += value(run);
    ++at->count;
  }
  std::vector<figure::Series> series;
  for (auto& [name, sums] : found) {
    std::sort(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.phase < b.phase; });
    figure::Series one;
    one.name = name;
    if (name == "before registration") one.style = figure::LineStyle::dashed;
    for (const Sum& s : sums) {
      one.x.push_back(100.0 * s.phase);
      one.y.push_back(s.sum / s.count);
    }
    series.push_back(std::move(one));
  }
  return series;
}

figure::Picture pair_of_plots(const std::vector<MotionRun>& runs, const std::string& title,
                              const Chosen& chosen) {
  figure::PlotOptions how;
  how.title = title + ": Dice";
  how.x_label = "phase, % of RR";
  how.y_range = {{0.0, 1.0}};
  std::vector<figure::Picture> panels;
  panels.push_back(figure::line_plot(curves(runs, chosen, [](const MotionRun& r) { return r.dice; }), how));
  how.title = title + ": distance, target to result";
  how.y_label = "mm";
  how.y_range.reset();
  how.y_from_zero = true;
  panels.push_back(
      figure::line_plot(curves(runs, chosen, [](const MotionRun& r) { return r.distance_mm; }), how));
  return figure::grid(panels, {.columns = 2, .look = figure::Look::light});
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

std::string csv(const std::vector<MotionRun>& runs) {
  std::string text =
      "heart,phase_percent,method,depth,sampling,lost,seconds,distance_mm,dice,vertex_mm,vertex_worst_mm,"
      "inverted_cells,new_intersections\n";
  for (const MotionRun& r : runs)
    text += r.heart + "," + fixed(100.0 * r.phase, 1) + "," + word(r.method) + "," + std::to_string(r.depth) +
            "," + r.sampling + "," + r.lost + "," + fixed(r.seconds, 3) + "," + fixed(r.distance_mm, 4) +
            "," + fixed(r.dice, 4) + "," + fixed(r.vertex_mm, 4) + "," + fixed(r.vertex_worst_mm, 4) + "," +
            std::to_string(r.inverted_cells) + "," + std::to_string(r.new_intersections) + "\n";
  return text;
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

std::string motion_json(const std::vector<MotionRun>& runs, const MotionOptions& options) {
  Json out{{"v", 1}, {"kind", "motion"}};
  out["parameters"] = Json::parse(parameters_json(options));
  out["rows"] = Json::array();
  for (const MotionRow& row : rows_of(runs, false)) out["rows"].push_back(row_json(row));
  out["compared"] = Json::array();
  for (const MotionRow& row : rows_of(runs, true)) out["compared"].push_back(row_json(row));
  return out.dump(1) + "\n";
}

std::string motion_text(const std::vector<MotionRun>& runs) {
  std::string text;
  char line[256];
  std::snprintf(line, sizeof line, "%-28s %5s %8s %16s %14s %8s %8s %5s %5s\n", "method", "runs", "seconds",
                "distance, mm", "Dice", "least", "points", "inv.", "sect.");
  for (const bool compared : {false, true}) {
    const std::vector<MotionRow> rows = rows_of(runs, compared);
    if (rows.empty()) continue;
    text += compared ? "Where all methods were run:\n" : "";
    text += line;
    for (const MotionRow& row : rows) {
      char cells_line[256];
      std::snprintf(cells_line, sizeof cells_line,
                    "%-28s %5zu %8.2f %7.3f +- %5.3f %5.3f +- %5.3f %8.3f %8.3f %5zu %5zu\n",
                    name_of(row).c_str(), row.runs, row.seconds, row.distance_mm, row.distance_sd_mm,
                    row.dice, row.dice_sd, row.least_dice, row.vertex_mm, row.inverted_cells,
                    row.new_intersections);
      text += cells_line;
    }
  }
  return text;
}

void write_motion_report(const std::filesystem::path& folder, const std::vector<MotionRun>& runs,
                         const MotionOptions& options) {
  core::write_file(folder / "runs.csv", csv(runs));
  figure::HtmlReport page("Motion of coronary trees");
  add_table(page, "All phases of all hearts", rows_of(runs, false),
            "Means and standard deviations over phases and hearts; points: to where the known motion carries "
            "them; worst: the run with the largest mean.");
  const std::vector<MotionRow> compared = rows_of(runs, true);
  if (!compared.empty())
    add_table(page, "Methods compared", compared, "Phases and hearts at which all methods were run.");
  save(page, folder, "depths.png", pair_of_plots(runs, "Depth of the cage", by_depth),
       "Mean over the hearts, by the depth of the cage.");
  save(page, folder, "samplings.png",
       pair_of_plots(runs, "Phases known", [&](const MotionRun& r) { return by_sampling(r, options.depth); }),
       "All phases from splines through some of them.");
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
    save(page, folder, file, figure::grid(panels, {.columns = 1, .look = figure::Look::light}), heart);
  }
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
