#include "evaluate/evaluate.h"
#include "output/outputs.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/agreement.h"
#include "ostia/evaluation/agreement_plot.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/evaluation/frame_hint.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/io/contour_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using evaluation::SectionScore;
using geometry::ContourSection;
using geometry::ContourSet;

/// A score with who was compared with whom.
struct Compared {
  std::string case_name, who;  ///< who: "result - truth", "observer1 - observer2"
  bool of_result = false;
  SectionScore score;
};

/// The result of a case: a surface for all sections, or contours of its own.
struct Result {
  std::unique_ptr<evaluation::LumenResult> surface;
  ContourSet contours;
};

Result result_from(const fs::path& path, const EvaluateCommand& command, const ContourSet& reference) {
  Result out;
  const std::vector<fs::path> parts =
      files_in(path, {"lumen.vtp", "lumen.stl", "lumen.ply", "contours.json"}, "surface or contours");
  if (parts.front().extension() == ".json") {
    out.contours = io::read_contours(parts.front());
    return out;
  }
  geometry::TriMesh mesh = surface_of_parts(parts, command.units);
  std::vector<geometry::Vec3> points;
  for (const ContourSection& section : reference.sections)
    for (const geometry::Contour& c : section.contours)
      points.insert(points.end(), c.points.begin(), c.points.end());
  const std::string hint = evaluation::hint_of_other_frame(points, mesh.points);
  if (!hint.empty()) core::log_warning(hint);
  out.surface = std::make_unique<evaluation::LumenResult>(std::move(mesh));
  return out;
}

const ContourSection* section_like(const ContourSet& set, const ContourSection& like) {
  for (const ContourSection& s : set.sections)
    if (s.section == like.section && s.boundary == like.boundary) return &s;
  return nullptr;
}

void score_result(const std::string& case_name, const ContourSet& reference, const Result* result,
                  std::vector<Compared>& all, const core::TaskContext& task) {
  for (const ContourSection& section : reference.sections) {
    if (section.boundary != "lumen") continue;
    task.throw_if_cancelled();
    Compared one{case_name, "result - " + section.observer, true, {}};
    const ContourSection* own = result ? section_like(result->contours, section) : nullptr;
    if (result && result->surface) {
      one.score = result->surface->score(section, {}, task);
    } else if (own) {
      one.score = evaluation::result_of(*own).score(section, {}, task);
    } else {
      one.score = evaluation::score_of_nothing(section);
    }
    if (!one.score.found)
      core::log_warning(section.section + " (" + section.vessel + "): the result has nothing there");
    all.push_back(std::move(one));
  }
}

/// Observers against each other and against the truth.
void score_observers(const std::string& case_name, const ContourSet& reference, std::vector<Compared>& all,
                     const core::TaskContext& task) {
  for (const ContourSection& a : reference.sections) {
    for (const ContourSection& b : reference.sections) {
      if (a.boundary != "lumen" || b.boundary != "lumen" || a.section != b.section) continue;
      const bool ordered = a.observer != "truth" && (b.observer == "truth" || a.observer > b.observer);
      if (!ordered) continue;
      task.throw_if_cancelled();
      const std::string who = b.observer == "truth" ? "observer - truth" : "observer - observer";
      all.push_back({case_name, who, false,
                     evaluation::result_of(a).score(b, {.sample_mm = 0.2, .line_mm = 0.08}, task)});
    }
  }
}

Json lumen_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const char* name_of(geometry::Health health) {
  return health == geometry::Health::diseased ? "diseased" : "healthy";
}

Json section_row(const Compared& c) {
  const SectionScore& s = c.score;
  Json row;
  if (!c.case_name.empty()) row["case"] = c.case_name;
  row["section"] = s.section;
  row["vessel"] = s.vessel;
  row["health"] = name_of(s.health);
  row["observer"] = s.observer;
  row["length_mm"] = s.length_mm;
  row["dice"] = s.dice;
  row["msd_mm"] = lumen_number(s.msd_mm);
  row["rms_sd_mm"] = lumen_number(s.rms_sd_mm);
  row["max_sd_mm"] = lumen_number(s.max_sd_mm);
  row["signed_mean_mm"] = lumen_number(s.signed_mean_mm);
  row["floor_mm"] = s.floor_mm;
  return row;
}

Json summary_of(const std::vector<Compared>& all) {
  std::map<std::pair<std::string, int>, std::vector<SectionScore>> groups;
  for (const Compared& c : all) groups[{c.who, static_cast<int>(c.score.health)}].push_back(c.score);
  Json rows = Json::array();
  for (const auto& [key, scores] : groups) {
    const evaluation::LumenSummary s = evaluation::summarize(scores);
    rows.push_back({{"name", key.first + ", " + name_of(static_cast<geometry::Health>(key.second))},
                    {"compared", key.first},
                    {"health", name_of(static_cast<geometry::Health>(key.second))},
                    {"sections", s.sections},
                    {"missing", s.missing},
                    {"length_mm", s.length_mm},
                    {"dice", s.dice},
                    {"msd_mm", lumen_number(s.msd_mm)},
                    {"rms_sd_mm", lumen_number(s.rms_sd_mm)},
                    {"max_sd_mm", lumen_number(s.max_sd_mm)}});
  }
  return rows;
}

/// The observer whose contours stand for the truth: "truth" where it is there, else the first.
std::string main_observer(const std::vector<Compared>& all) {
  std::set<std::string> names;
  for (const Compared& c : all)
    if (c.of_result) names.insert(c.score.observer);
  if (names.empty()) return {};
  return names.contains("truth") ? "truth" : *names.begin();
}

struct RadiusPairs {
  std::vector<double> reference, result;
};

RadiusPairs radii_of(const std::vector<Compared>& all, const std::string& observer) {
  RadiusPairs out;
  for (const Compared& c : all) {
    if (!c.of_result || !c.score.found || c.score.observer != observer) continue;
    out.reference.insert(out.reference.end(), c.score.reference_radius_mm.begin(),
                         c.score.reference_radius_mm.end());
    out.result.insert(out.result.end(), c.score.result_radius_mm.begin(), c.score.result_radius_mm.end());
  }
  return out;
}

Json agreement_of(const RadiusPairs& pairs) {
  if (pairs.reference.size() < 2) return nullptr;
  const evaluation::BlandAltman a = evaluation::bland_altman(pairs.reference, pairs.result);
  return {{"contours", a.count},
          {"bias_mm", a.bias},
          {"sd_mm", a.sd},
          {"lower_limit_mm", a.lower_limit},
          {"upper_limit_mm", a.upper_limit},
          {"correlation", lumen_number(a.correlation)}};
}

Json stenoses_of(const std::vector<Compared>& all, const std::string& observer, double threshold) {
  std::vector<evaluation::GradedPlace> places;
  Json rows = Json::array();
  for (const Compared& c : all) {
    if (!c.of_result || c.score.observer != observer || c.score.s_mm.size() < 3) continue;
    const SectionScore& s = c.score;
    const evaluation::GradedPlace place{
        evaluation::diameter_stenosis(s.s_mm, s.reference_radius_mm),
        s.found ? evaluation::diameter_stenosis(s.s_mm, s.result_radius_mm) : 0.0};
    places.push_back(place);
    Json row;
    if (!c.case_name.empty()) row["case"] = c.case_name;
    row.update(Json{{"section", s.section},
                    {"vessel", s.vessel},
                    {"reference", place.reference},
                    {"result", place.result}});
    rows.push_back(row);
  }
  if (places.empty()) return nullptr;
  const evaluation::StenosisDetection d = evaluation::detect_stenoses(places, threshold);
  return {{"threshold", threshold},
          {"true_positive", d.true_positive},
          {"false_positive", d.false_positive},
          {"false_negative", d.false_negative},
          {"true_negative", d.true_negative},
          {"sensitivity", lumen_number(d.sensitivity)},
          {"ppv", lumen_number(d.ppv)},
          {"mean_grade_difference", d.mean_grade_difference},
          {"weighted_kappa", lumen_number(d.weighted_kappa)},
          {"sections", rows}};
}

figure::Picture agreement_plot(const RadiusPairs& pairs) {
  RadiusPairs diameters = pairs;
  for (std::vector<double>* values : {&diameters.reference, &diameters.result})
    for (double& v : *values) v *= 2.0;
  return evaluation::agreement_plot(diameters.reference, diameters.result,
                                    {.title = "Diameters: result against reference"});
}

figure::Picture radius_plot(const Compared& c) {
  const SectionScore& s = c.score;
  figure::Series reference{"reference", s.s_mm, s.reference_radius_mm},
      result{"result", s.s_mm, s.result_radius_mm};
  figure::PlotOptions how;
  how.title =
      (c.case_name.empty() ? "" : c.case_name + " ") + s.section + ", " + s.vessel + ", " + name_of(s.health);
  how.x_label = "along the vessel (mm)";
  how.y_label = "radius of equal area (mm)";
  how.y_from_zero = true;
  how.width_px = 460;
  how.height_px = 260;
  return figure::line_plot({reference, result}, how);
}

void add_table(figure::HtmlReport& page, const Json& rows, const std::vector<std::string>& keys) {
  std::vector<std::vector<std::string>> cells;
  for (const Json& row : rows) {
    std::vector<std::string> line;
    for (const std::string& key : keys) {
      const Json value = row.contains(key) ? row[key] : Json("");
      line.push_back(value.is_string()   ? value.get<std::string>()
                     : value.is_number() ? core::significant_text(value.get<double>(), 4)
                                         : "-");
    }
    cells.push_back(line);
  }
  if (!cells.empty()) page.table(keys, cells);
}

void write_page(const fs::path& path, const Json& out, const std::vector<Compared>& all,
                const std::string& observer) {
  figure::HtmlReport page("Lumen sections against their references");
  page.section("Pooled");
  page.paragraph(
      "Means weighted by length; the maximum is the largest of all. Observers against each other show "
      "what can be asked for.");
  add_table(
      page, out["summary"],
      {"compared", "health", "sections", "missing", "length_mm", "dice", "msd_mm", "rms_sd_mm", "max_sd_mm"});
  page.section("Section by section");
  add_table(page, out["sections"],
            {"case", "section", "vessel", "health", "observer", "length_mm", "dice", "msd_mm", "rms_sd_mm",
             "max_sd_mm", "signed_mean_mm", "floor_mm"});
  const RadiusPairs pairs = radii_of(all, observer);
  if (pairs.reference.size() >= 2) {
    page.section("Agreement of diameters");
    page.picture(
        agreement_plot(pairs),
        "Bland-Altman plot of the diameters of equal area, contour by contour, against " + observer + ".");
  }
  std::vector<figure::Picture> panels;
  for (const Compared& c : all)
    if (c.of_result && c.score.found && c.score.observer == observer && panels.size() < 12)
      panels.push_back(radius_plot(c));
  if (!panels.empty()) {
    page.section("Along the sections");
    page.picture(figure::grid(panels, {.columns = 2, .look = figure::Look::light}),
                 "Radius of equal area of reference and result.");
  }
  page.write(path);
}

ExitCode print_floor(const EvaluateCommand& command, const core::TaskContext& task) {
  task.set_stage("floor");
  Json out{{"v", 1},
           {"kind", "floor"},
           {"shape", "tube on a circle of radius 20 mm, 1.75 to 1.25 mm, stenosis of 50 %, not round"}};
  out["rows"] = Json::array();
  for (const evaluation::FloorRow& row : evaluation::floor_table())
    out["rows"].push_back({{"spacing_mm", row.spacing_mm},
                           {"points", row.points},
                           {"mean_mm", row.mean_mm},
                           {"max_mm", row.max_mm},
                           {"estimate_mm", row.estimate_mm}});
  return finish(command, out);
}

}  // namespace

ExitCode run_evaluate_lumen(const EvaluateCommand& command, const core::TaskContext& task) {
  if (command.floor) return print_floor(command, task);
  require_pair(command);
  require_output(command.report, {".html", ".htm"});
  std::vector<Compared> all;
  const std::vector<CasePair> pairs = case_pairs(command.reference, command.result);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const CasePair& pair = pairs[k];
    task.set_stage(pair.name.empty() ? "sections" : pair.name);
    task.set_progress(0.9 * static_cast<double>(k) / static_cast<double>(pairs.size()));
    const ContourSet reference = io::read_contours(file_in(pair.reference, {"contours.json"}, "contours"));
    if (pair.missing) core::log_warning(pair.name + " has no result: its sections count as missed");
    std::optional<Result> result;
    if (!pair.missing) result = result_from(pair.result, command, reference);
    score_result(pair.name, reference, result ? &*result : nullptr, all, task);
    score_observers(pair.name, reference, all, task);
  }
  if (all.empty()) throw InvalidInput(command.reference.string() + " holds no section of a lumen");
  const std::string observer = main_observer(all);
  Json out{{"v", 1}, {"kind", "lumen"}};
  out["summary"] = summary_of(all);
  out["agreement"] = agreement_of(radii_of(all, observer));
  if (command.find_stenoses) out["stenoses"] = stenoses_of(all, observer, command.stenosis_threshold);
  out["sections"] = Json::array();
  for (const Compared& c : all)
    if (c.of_result) out["sections"].push_back(section_row(c));
  if (!command.report.empty()) write_page(command.report, out, all, observer);
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
