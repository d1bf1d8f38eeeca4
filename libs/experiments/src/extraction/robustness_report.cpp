#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/robustness.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace ostia::experiments {
namespace {

using core::fixed_or_dash;
using Json = nlohmann::ordered_json;

constexpr double holds_ov = 0.9, holds_astray_mm = 5.0;

/// A warning without its numbers and without the vessel it is about: its kind.
std::string kind_of(const std::string& warning) {
  std::string kind;
  const std::size_t colon = warning.find(": ");
  for (const char c : colon < 6 ? warning.substr(colon + 2) : warning)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.') kind += c;
  return kind;
}

bool is_main(const std::string& name) {
  return name == "LAD" || name == "LCX" || name == "RCA";
}

/// Sums; `finish` makes means of them.
struct Sums {
  double ov = 0.0, ai = 0.0, main = 0.0, astray = 0.0;
  std::size_t vessels = 0, found = 0, mains = 0;
};

void add(const RobustnessRun& run, const std::set<std::string>& usual, Sums& sums, RobustnessRow& row) {
  ++row.patients;
  for (const VesselRun& vessel : run.score.vessels) {
    sums.ov += vessel.scores.ov;
    ++sums.vessels;
    if (!std::isnan(vessel.scores.ai_mm)) {
      sums.ai += vessel.scores.ai_mm;
      ++sums.found;
    }
    if (is_main(vessel.name)) {
      sums.main += vessel.scores.ov;
      ++sums.mains;
    }
    row.right += vessel.verdict == NameVerdict::right ? 1 : 0;
    row.wrong += vessel.verdict == NameVerdict::wrong ? 1 : 0;
    row.unnamed += vessel.verdict == NameVerdict::unnamed ? 1 : 0;
    row.missing += vessel.verdict == NameVerdict::missing ? 1 : 0;
  }
  sums.astray += run.score.astray_mm;
  std::vector<std::string> said = run.warnings;
  if (!run.score.failure.empty()) {
    ++row.refused;
    said.push_back(run.score.failure);
  }
  std::set<std::string> known = usual;
  for (const std::string& told : row.told) known.insert(kind_of(told));
  for (const std::string& warning : said)
    if (known.insert(kind_of(warning)).second) row.told.push_back(warning);
}

/// Nothing where no row is a step of something that gets worse.
std::optional<figure::Picture> overlap_plot(const std::vector<RobustnessRow>& rows) {
  std::vector<figure::Series> series;
  for (const RobustnessRow& row : rows) {
    if (row.what == "as drawn" || row.what == "anatomy" || row.what == "stent") continue;
    if (series.empty() || series.back().name != row.what) series.push_back({row.what});
    series.back().x.push_back(static_cast<double>(series.back().x.size() + 1));
    series.back().y.push_back(row.ov);
  }
  if (series.empty()) return std::nullopt;
  figure::PlotOptions how;
  how.title = "Overlap as one thing gets worse";
  how.x_label = "step, in the table's order";
  how.y_label = "OV, mean over all vessels";
  how.y_from_zero = true;
  return figure::line_plot(series, how);
}

std::vector<std::string> cells_of(const RobustnessRow& row) {
  std::string told;
  for (const std::string& one : row.told) told += (told.empty() ? "" : "; ") + one;
  return {row.what,
          row.step,
          std::to_string(row.refused) + " of " + std::to_string(row.patients),
          fixed_or_dash(row.ov, 3),
          fixed_or_dash(row.main_ov, 3),
          fixed_or_dash(row.ai_mm, 3),
          std::to_string(row.right) + " / " + std::to_string(row.wrong) + " / " +
              std::to_string(row.unnamed) + " / " + std::to_string(row.missing),
          fixed_or_dash(row.astray_mm, 1),
          row.holds() ? "holds" : "breaks",
          told};
}

std::string csv_of(const std::vector<RobustnessRun>& runs) {
  std::string text = "what,step,seed,vessel,ov,of,ai_mm,verdict,found_as\n";
  for (const RobustnessRun& run : runs)
    for (const VesselRun& vessel : run.score.vessels)
      text += run.variation.what + ",\"" + run.variation.step + "\"," + std::to_string(run.seed) + "," +
              vessel.name + "," + fixed_or_dash(vessel.scores.ov, 4) + "," +
              fixed_or_dash(vessel.scores.of, 4) + "," + fixed_or_dash(vessel.scores.ai_mm, 4) + "," +
              name_of(vessel.verdict) + "," + vessel.found_name + "\n";
  return text;
}

}  // namespace

bool RobustnessRow::holds() const {
  return refused == 0 && ov >= holds_ov && wrong == 0 && astray_mm <= holds_astray_mm;
}

std::vector<RobustnessRow> rows_of(const std::vector<RobustnessRun>& runs) {
  std::vector<RobustnessRow> rows;
  std::vector<Sums> sums;
  std::map<std::uint64_t, std::set<std::string>> usual;  // kinds of warnings that a patient as drawn has
  for (const RobustnessRun& run : runs)
    if (run.variation.what == "as drawn")
      for (const std::string& warning : run.warnings) usual[run.seed].insert(kind_of(warning));
  for (const RobustnessRun& run : runs) {
    const auto known = std::find_if(rows.begin(), rows.end(), [&](const RobustnessRow& row) {
      return row.what == run.variation.what && row.step == run.variation.step;
    });
    const auto at = static_cast<std::size_t>(known - rows.begin());
    if (known == rows.end()) {
      rows.emplace_back();
      rows.back().what = run.variation.what;
      rows.back().step = run.variation.step;
      sums.emplace_back();
    }
    const bool drawn = run.variation.what == "as drawn";
    add(run, drawn ? std::set<std::string>{} : usual[run.seed], sums[at], rows[at]);
  }
  const auto mean = [](double sum, std::size_t count) {
    return count > 0 ? sum / static_cast<double>(count) : std::nan("");
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].ov = mean(sums[i].ov, sums[i].vessels);
    rows[i].main_ov = mean(sums[i].main, sums[i].mains);
    rows[i].ai_mm = mean(sums[i].ai, sums[i].found);
    rows[i].astray_mm = mean(sums[i].astray, rows[i].patients);
  }
  return rows;
}

std::string parameters_json(const std::vector<Variation>& variations, const RobustnessOptions& options) {
  Json steps = Json::array();
  for (const Variation& one : variations) steps.push_back(one.what + ": " + one.step);
  return Json{{"first_seed", options.first_seed},
              {"seeds", options.seeds},
              {"voxel_mm", options.voxel_mm},
              {"astray_mm", options.scores.astray_mm},
              {"variations", steps}}
      .dump();
}

std::string robustness_json(const std::vector<RobustnessRun>& runs, const RobustnessOptions& options) {
  Json out{{"v", 1}, {"kind", "robustness"}};
  out["parameters"] = {
      {"first_seed", options.first_seed}, {"seeds", options.seeds}, {"voxel_mm", options.voxel_mm}};
  out["rows"] = Json::array();
  for (const RobustnessRow& row : rows_of(runs))
    out["rows"].push_back({{"what", row.what},
                           {"step", row.step},
                           {"patients", row.patients},
                           {"refused", row.refused},
                           {"ov", row.ov},
                           {"main_ov", row.main_ov},
                           {"ai_mm", std::isnan(row.ai_mm) ? Json() : Json(row.ai_mm)},
                           {"names_right", row.right},
                           {"names_wrong", row.wrong},
                           {"unnamed", row.unnamed},
                           {"missing", row.missing},
                           {"astray_mm", row.astray_mm},
                           {"holds", row.holds()},
                           {"told", row.told}});
  return out.dump(1) + "\n";
}

std::string robustness_text(const std::vector<RobustnessRun>& runs) {
  std::string text =
      "what | step | refused | OV | OV of LAD, LCX, RCA | AI mm | names right / wrong / none / missing | "
      "astray mm | verdict | told\n";
  for (const RobustnessRow& row : rows_of(runs)) {
    const std::vector<std::string> cells = cells_of(row);
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : " | ") + cells[i];
    text += "\n";
  }
  return text;
}

void write_robustness_report(const std::filesystem::path& folder, const std::vector<RobustnessRun>& runs) {
  const std::vector<RobustnessRow> rows = rows_of(runs);
  core::write_file(folder / "runs.csv", csv_of(runs));
  const std::optional<figure::Picture> plot = overlap_plot(rows);
  if (plot) plot->write_png(folder / "overlap.png", 2.0);
  figure::HtmlReport page("Where the search for coronary arteries breaks",
                          std::to_string(rows.empty() ? 0 : rows.front().patients) + " synthetic patients");
  page.paragraph(
      "One thing at a time is made worse. A step holds where nothing is refused, the mean overlap is at "
      "least " +
      fixed_or_dash(holds_ov, 2) + ", no vessel bears another's name and at most " +
      fixed_or_dash(holds_astray_mm, 0) + " mm of what was found in a patient follow no artery.");
  std::vector<std::vector<std::string>> cells;
  for (const RobustnessRow& row : rows) cells.push_back(cells_of(row));
  page.table({"what", "step", "refused", "OV", "OV of LAD, LCX, RCA", "AI, mm",
              "names right / wrong / none / missing", "astray, mm", "verdict", "told besides"},
             cells);
  if (plot) page.picture(*plot, "Each line is one variation; its steps are those of the table.");
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
