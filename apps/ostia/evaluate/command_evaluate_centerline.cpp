#include "evaluate/evaluate.h"
#include "options/model_options.h"
#include "output/outputs.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/centerline_scores.h"
#include "ostia/evaluation/frame_hint.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/scene.h"
#include "ostia/geometry/polyline.h"
#include "ostia/io/rotterdam_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using geometry::Vec3;

struct VesselScore {
  std::string case_name, vessel;
  fs::path folder;
  io::RotterdamReference reference;
  std::size_t result_repeated = 0;  ///< points of the result's line that repeat the one before
  std::string candidate;            ///< empty: no line overlaps
  std::vector<Vec3> line;
  evaluation::CenterlineScores scores;
  double observer_ov = NAN;  ///< mean overlap of the observers' own lines, where they are there
};

/// The vessels' folders of a data set, or a single reference file.
std::vector<std::pair<std::string, fs::path>> references_of(const fs::path& path) {
  std::vector<std::pair<std::string, fs::path>> out;
  if (!fs::is_directory(path)) return {{path.parent_path().filename().string(), path}};
  if (fs::exists(path / "reference.txt")) return {{path.filename().string(), path / "reference.txt"}};
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.is_directory() && fs::exists(entry.path() / "reference.txt"))
      out.emplace_back(entry.path().filename().string(), entry.path() / "reference.txt");
  std::sort(out.begin(), out.end());
  if (out.empty())
    throw InvalidInput("no reference in the folder " + path.string() +
                       ": neither reference.txt nor vesselM/reference.txt is there");
  return out;
}

/// Lines that may stand for a vessel.
struct Candidates {
  std::vector<evaluation::NamedLine> lines;
  std::size_t repeated = 0;
};

/// A line of the challenge is scored as it stands in its file, points that repeat the one before included.
Candidates challenge_line(const fs::path& path, const std::string& units) {
  InputOptions input;
  input.units = units;
  const double unit_mm = source_options(input).unit_mm.value_or(1.0);
  std::vector<Vec3> points = io::read_rotterdam_line(path);
  for (Vec3& p : points) p *= unit_mm;
  const std::size_t repeated = io::count_repeated(points);
  return {{{path.stem().string(), std::move(points)}}, repeated};
}

/// Lines for one vessel: its own result.txt where a folder has one, else all lines of the result.
Candidates candidates_for(const fs::path& result, const std::string& vessel, const std::string& units) {
  if (fs::is_directory(result)) {
    for (const fs::path& own : {result / vessel / "result.txt", result / "result.txt"})
      if (fs::exists(own)) return challenge_line(own, units);
  }
  const std::vector<fs::path> parts = files_in(result, {"centerlines.vtp", "centerlines.csv"}, "centerlines");
  if (parts.size() == 1 && parts.front().extension() == ".txt") return challenge_line(parts.front(), units);
  return {evaluation::lines_of(lines_of_parts(parts, units))};
}

void tell_repeated(const std::string& vessel, const std::string& which, std::size_t count) {
  if (count > 0)
    core::log_warning((vessel.empty() ? "" : vessel + ": ") + "the " + which + " has " +
                      std::to_string(count) + (count == 1 ? " point that repeats" : " points that repeat") +
                      " the one before; taken as they are");
}

double observers_overlap(const fs::path& folder, const io::RotterdamReference& reference) {
  double sum = 0.0;
  int count = 0;
  for (int i = 1; i <= 9; ++i) {
    const fs::path path = folder / ("observer" + std::to_string(i) + ".txt");
    if (!fs::exists(path)) continue;
    sum += evaluation::score_centerline(reference, io::read_rotterdam_line(path)).ov;
    ++count;
  }
  return count > 0 ? sum / count : NAN;
}

VesselScore scored(const std::string& case_name, const std::string& vessel, const fs::path& reference,
                   const fs::path& result, const EvaluateCommand& command, const core::TaskContext& task) {
  VesselScore out;
  out.case_name = case_name;
  out.vessel = vessel;
  out.folder = reference.parent_path();
  out.reference = io::read_rotterdam_reference(reference);
  tell_repeated(vessel, "reference", io::count_repeated(out.reference.points));
  out.scores.ai_mm = out.scores.ai_score = NAN;
  out.scores.fn = out.reference.points.size();
  if (result.empty()) return out;
  const auto [candidates, repeated] = candidates_for(result, vessel, command.units);
  out.result_repeated = repeated;
  tell_repeated(vessel, "result", repeated);
  evaluation::CenterlineScoreOptions how;
  if (command.rules == "paper") how.rules = evaluation::OverlapRules::paper;
  evaluation::BestLine best = evaluation::score_best_line(out.reference, candidates, how, task);
  if (best.scores.ov > 0.0) {
    out.candidate = candidates[best.index].name;
    out.line = candidates[best.index].points;
    out.scores = std::move(best.scores);
    if (out.scores.turned)
      core::log_warning(vessel + ": " + out.candidate + " runs from its distal end; it was turned round");
  }
  std::vector<Vec3> all;
  for (const evaluation::NamedLine& line : candidates)
    all.insert(all.end(), line.points.begin(), line.points.end());
  if (out.candidate.empty()) {
    const std::string hint = evaluation::hint_of_other_frame(out.reference.points, all);
    core::log_warning(vessel + ": no line of the result overlaps with the reference" +
                      (hint.empty() ? "" : "; " + hint));
  }
  out.observer_ov = observers_overlap(out.folder, out.reference);
  return out;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json row_of(const VesselScore& v) {
  const evaluation::CenterlineScores& s = v.scores;
  Json row;
  if (!v.case_name.empty()) row["case"] = v.case_name;
  row["vessel"] = v.vessel;
  row["result"] = v.candidate.empty() ? Json(nullptr) : Json(v.candidate);
  row["length_mm"] = geometry::length(v.reference.points);
  row["ov"] = s.ov;
  row["of"] = s.of;
  row["ot"] = number(s.ot);
  row["ai_mm"] = number(s.ai_mm);
  row["ai_score"] = number(s.ai_score);
  row["observer_ov"] = number(v.observer_ov);
  row["ov_score"] =
      std::isnan(v.observer_ov) ? Json(nullptr) : Json(evaluation::overlap_score(s.ov, v.observer_ov));
  row["tpr"] = s.tpr;
  row["fn"] = s.fn;
  row["tpm"] = s.tpm;
  row["fp"] = s.fp;
  row["reference_repeated"] = io::count_repeated(v.reference.points);
  row["result_repeated"] = v.result_repeated;
  return row;
}

Json mean_of(const std::vector<VesselScore>& all) {
  std::vector<evaluation::CenterlineScores> scores;
  for (const VesselScore& v : all) scores.push_back(v.scores);
  const evaluation::MeanCenterlineScores mean = evaluation::mean_scores(scores);
  return {{"vessels", mean.vessels}, {"missing", mean.missed}, {"ov", mean.ov},
          {"of", mean.of},           {"ot", number(mean.ot)},  {"ai_mm", number(mean.ai_mm)}};
}

void write_page(const fs::path& path, const Json& result, const std::vector<VesselScore>& all,
                const core::TaskContext& task) {
  figure::HtmlReport page("Centerlines against their references", "Scores of the Rotterdam challenge");
  page.section("Scores");
  std::vector<std::vector<std::string>> rows;
  for (const Json& row : result["vessels"]) {
    std::vector<std::string> cells{row.value("case", ""), row["vessel"]};
    for (const char* key : {"length_mm", "ov", "of", "ot", "ai_mm", "observer_ov", "ov_score", "ai_score"}) {
      cells.push_back(row[key].is_number() ? core::fixed_text(row[key].get<double>(), 3) : "-");
    }
    rows.push_back(cells);
  }
  page.table(
      {"case", "vessel", "length (mm)", "OV", "OF", "OT", "AI (mm)", "observers' OV", "OV score", "AI score"},
      rows,
      "OV, OF, OT: overlap, until the first error, of the part 1.5 mm wide and more. AI: mean "
      "distance where the line counts as right.");
  page.section("Lines");
  for (const VesselScore& v : all) {
    task.throw_if_cancelled();
    if (v.line.empty()) {
      page.notice(figure::Notice::bad,
                  v.case_name + " " + v.vessel + ": no line overlaps with the reference.");
      continue;
    }
    figure::Scene scene;
    figure::TubeActor reference{v.reference.points, {0.25}, figure::palette(0), "reference"};
    scene.tubes.push_back(std::move(reference));
    scene.tubes.push_back({v.line, {0.35}, figure::palette(1), "result"});
    for (const auto& pair : v.scores.pairs) {  // where the reference is missed
      if (pair.counts || pair.reference % 20 != 0) continue;
      scene.tubes.push_back({{v.reference.points[pair.reference]}, {0.6}, figure::palette(3), ""});
    }
    page.picture(figure::scene_figure(scene, figure::cameras::broadside(v.reference.points),
                                      {.width_px = 640, .height_px = 420}, task),
                 v.case_name + " " + v.vessel +
                     ": reference and result; dots where the two are farther apart than the radius.");
  }
  page.write(path);
}

}  // namespace

ExitCode run_evaluate_centerline(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  require_output(command.report, {".html", ".htm"});
  std::vector<VesselScore> all;
  const std::vector<CasePair> pairs = case_pairs(command.reference, command.result);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const core::TaskContext part =
        task.sub(0.9 * static_cast<double>(k) / static_cast<double>(pairs.size()),
                 0.9 * static_cast<double>(k + 1) / static_cast<double>(pairs.size()));
    if (pairs[k].missing) core::log_warning(pairs[k].name + " has no result: its vessels count as missed");
    for (const auto& [vessel, path] : references_of(pairs[k].reference))
      all.push_back(scored(pairs[k].name, vessel, path, pairs[k].missing ? fs::path() : pairs[k].result,
                           command, part));
  }
  Json out{{"v", 1}, {"kind", "centerline"}, {"rules", command.rules}};
  out["mean"] = mean_of(all);
  out["vessels"] = Json::array();
  for (const VesselScore& v : all) out["vessels"].push_back(row_of(v));
  if (!command.report.empty()) write_page(command.report, out, all, task.sub(0.9, 1.0));
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
