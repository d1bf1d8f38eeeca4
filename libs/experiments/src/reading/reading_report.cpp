#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/experiments/reading.h"
#include "ostia/figure/html_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace ostia::experiments {
namespace {

using core::fixed_or_dash;
using ReadingJson = nlohmann::ordered_json;

const char* start_word(bool automatic) {
  return automatic ? "automatic" : "manual";
}

std::size_t tree_actions(const ReadingRun& run) {
  return run.actions.size() - run.count(ReadingAct::stroke);
}

ReadingJson state_json(const ReadingState& state) {
  return {{"length_mm", state.length_mm},         {"missing_mm", state.missing_mm},
          {"wall_off_mm", state.wall_off_mm},     {"axis_off_mm", state.axis_off_mm},
          {"beyond_mm", state.beyond_mm},         {"worst_wall_mm", state.worst_wall_mm},
          {"worst_axis_mm", state.worst_axis_mm}, {"astray_mm", state.astray_mm},
          {"wrong_names", state.wrong_names}};
}

ReadingJson acts_json(const ReadingRun& run) {
  ReadingJson acts;
  for (const ReadingAct act : reading_acts) acts[word(act)] = run.count(act);
  return acts;
}

ReadingJson reading_run_json(const ReadingRun& run) {
  return {{"patient", run.patient},
          {"start", start_word(run.automatic)},
          {"search_refusal", run.search_refusal},
          {"vessels", run.vessels},
          {"actions", run.actions.size()},
          {"by_act", acts_json(run)},
          {"refused", run.refused()},
          {"clicks", run.clicks()},
          {"seconds", run.seconds()},
          {"gave_up", run.gave_up},
          {"before", state_json(run.before)},
          {"after", state_json(run.after)},
          {"left", run.left},
          {"digest", run.digest}};
}

ReadingJson quartiles_json(const ReadingQuartiles& of) {
  const auto value = [](double v) { return std::isnan(v) ? ReadingJson() : ReadingJson(v); };
  return {{"low", value(of.low)}, {"median", value(of.median)}, {"high", value(of.high)}};
}

ReadingJson reading_summary_json(const ReadingSummary& summary) {
  ReadingJson acts;
  for (std::size_t i = 0; i < std::size(reading_acts); ++i)
    acts[word(reading_acts[i])] = quartiles_json(summary.by_act[i]);
  return {{"patients", summary.patients},
          {"gave_up", summary.gave_up},
          {"refused_searches", summary.refused_searches},
          {"actions", quartiles_json(summary.actions)},
          {"tree_actions", quartiles_json(summary.tree_actions)},
          {"by_act", acts},
          {"clicks", quartiles_json(summary.clicks)},
          {"minutes", quartiles_json(summary.minutes)},
          {"share_beyond_before", quartiles_json(summary.share_before)},
          {"share_beyond", quartiles_json(summary.share_beyond)},
          {"worst_wall_mm", quartiles_json(summary.worst_wall_mm)},
          {"worst_axis_mm", quartiles_json(summary.worst_axis_mm)},
          {"missing_mm", quartiles_json(summary.missing_mm)}};
}

ReadingJson reader_json(const ReadingOptions& o) {
  const ReaderOptions& s = o.strokes;
  const HandTimes& t = o.times;
  return {{"tolerance_mm", o.tolerance_mm},
          {"least_diameter_mm", o.least_diameter_mm},
          {"astray_mm", o.astray_mm},
          {"click_sigma_mm", o.click_sigma_mm},
          {"view_mm", o.view_mm},
          {"most_actions", o.most_actions},
          {"times_s",
           {{"think", t.think_s},
            {"home", t.home_s},
            {"key", t.key_s},
            {"point", t.point_s},
            {"press", t.press_s},
            {"stroke", s.seconds_a_stroke},
            {"point_of_stroke", s.seconds_a_point},
            {"view", s.seconds_a_view}}},
          {"strokes",
           {{"picture_px", s.picture_px},
            {"pointing_sigma_mm", s.pointing_sigma_mm},
            {"points", s.points},
            {"lines_deg", s.lines_deg},
            {"row_mm", s.row_mm},
            {"section_step_mm", s.section_step_mm},
            {"section_share", s.section_share},
            {"beta_deg", s.beta_deg},
            {"eps_mm", s.eps_mm},
            {"most_a_view", s.most_strokes}}}};
}

ReadingJson reading_parameters(const ReadingPatients& options) {
  ReadingJson out{{"first_seed", options.first_seed},
                  {"patients", options.patients},
                  {"voxel_mm", options.voxel_mm},
                  {"suite", options.hard ? "hard" : "full"}};
  if (!options.hard) {
    out["noise_hu"] = options.noise_hu;
    out["motion_mm"] = options.motion_mm;
  }
  out["reader"] = reader_json(options.reader);
  return out;
}

std::string quartiles_text(const ReadingQuartiles& of, int decimals, double factor = 1.0) {
  return fixed_or_dash(factor * of.median, decimals) + " (" + fixed_or_dash(factor * of.low, decimals) +
         " to " + fixed_or_dash(factor * of.high, decimals) + ")";
}

std::vector<std::vector<std::string>> summary_rows(const std::vector<ReadingRun>& runs) {
  const ReadingSummary automatic = summarize(runs, true), manual = summarize(runs, false);
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](const std::string& what, const auto& text) {
    rows.push_back({what, text(automatic), text(manual)});
  };
  row("patients", [](const ReadingSummary& s) { return std::to_string(s.patients); });
  row("actions", [](const ReadingSummary& s) { return quartiles_text(s.actions, 1); });
  row("of these all but strokes", [](const ReadingSummary& s) { return quartiles_text(s.tree_actions, 1); });
  for (std::size_t i = 0; i < std::size(reading_acts); ++i)
    row(std::string("  ") + word(reading_acts[i]),
        [i](const ReadingSummary& s) { return quartiles_text(s.by_act[i], 1); });
  row("clicks", [](const ReadingSummary& s) { return quartiles_text(s.clicks, 1); });
  row("modelled time, min", [](const ReadingSummary& s) { return quartiles_text(s.minutes, 1); });
  row("beyond the tolerance before, % of the length",
      [](const ReadingSummary& s) { return quartiles_text(s.share_before, 1, 100.0); });
  row("beyond the tolerance after, % of the length",
      [](const ReadingSummary& s) { return quartiles_text(s.share_beyond, 1, 100.0); });
  row("worst wall after, mm", [](const ReadingSummary& s) { return quartiles_text(s.worst_wall_mm, 2); });
  row("worst axis after, mm", [](const ReadingSummary& s) { return quartiles_text(s.worst_axis_mm, 2); });
  row("missing after, mm", [](const ReadingSummary& s) { return quartiles_text(s.missing_mm, 1); });
  row("given up", [](const ReadingSummary& s) { return std::to_string(s.gave_up); });
  row("searches refused", [](const ReadingSummary& s) { return std::to_string(s.refused_searches); });
  return rows;
}

std::string patients_csv(const std::vector<ReadingRun>& runs) {
  std::vector<std::string> header{"patient", "start", "vessels", "actions"};
  for (const ReadingAct act : reading_acts) header.emplace_back(word(act));
  for (const char* name :
       {"refused", "clicks", "seconds", "gave_up", "length_mm", "beyond_before_mm", "beyond_mm", "missing_mm",
        "wall_off_mm", "axis_off_mm", "worst_wall_mm", "worst_axis_mm", "astray_mm", "wrong_names"})
    header.emplace_back(name);
  std::string text = core::csv_line(header);
  for (const ReadingRun& run : runs) {
    std::vector<std::string> cells{run.patient, start_word(run.automatic), std::to_string(run.vessels),
                                   std::to_string(run.actions.size())};
    for (const ReadingAct act : reading_acts) cells.push_back(std::to_string(run.count(act)));
    cells.push_back(std::to_string(run.refused()));
    cells.push_back(std::to_string(run.clicks()));
    cells.push_back(fixed_or_dash(run.seconds(), 1));
    cells.emplace_back(run.gave_up ? "1" : "0");
    const ReadingState& s = run.after;
    for (const double value : {s.length_mm, run.before.beyond_mm, s.beyond_mm, s.missing_mm, s.wall_off_mm,
                               s.axis_off_mm, s.worst_wall_mm, s.worst_axis_mm, s.astray_mm})
      cells.push_back(fixed_or_dash(value, 3));
    cells.push_back(std::to_string(s.wrong_names));
    text += core::csv_line(cells);
  }
  return text;
}

std::string actions_csv(const std::vector<ReadingRun>& runs) {
  std::string text = core::csv_line({"patient", "start", "number", "action", "vessel", "clicks", "seconds",
                                     "on_section", "s_mm", "worst_mm", "refusal"});
  for (const ReadingRun& run : runs)
    for (std::size_t i = 0; i < run.actions.size(); ++i) {
      const ReadingAction& one = run.actions[i];
      text += core::csv_line({run.patient, start_word(run.automatic), std::to_string(i + 1), word(one.act),
                              one.vessel, std::to_string(one.clicks), fixed_or_dash(one.seconds, 2),
                              one.on_section ? "1" : "0", fixed_or_dash(one.s_mm, 1),
                              fixed_or_dash(one.worst_mm, 3), one.refusal});
    }
  return text;
}

std::vector<std::string> patient_row(const ReadingRun& run) {
  std::string kinds;
  for (const ReadingAct act : reading_acts)
    if (const std::size_t count = run.count(act))
      kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + word(act);
  std::string left = run.search_refusal.empty() ? "" : "the search refused: " + run.search_refusal;
  for (const std::string& one : run.left) left += (left.empty() ? "" : "; ") + one;
  if (run.gave_up) left += left.empty() ? "given up" : "; given up";
  return {run.patient,
          start_word(run.automatic),
          std::to_string(run.actions.size()),
          kinds,
          fixed_or_dash(run.seconds() / 60.0, 1),
          fixed_or_dash(100.0 * run.before.share_beyond(), 1),
          fixed_or_dash(100.0 * run.after.share_beyond(), 1),
          fixed_or_dash(run.after.worst_wall_mm, 2),
          fixed_or_dash(run.after.worst_axis_mm, 2),
          left};
}

}  // namespace

ReadingQuartiles quartiles_of(std::vector<double> values) {
  if (values.empty()) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {at(0.25), at(0.5), at(0.75)};
}

ReadingSummary summarize(const std::vector<ReadingRun>& runs, bool automatic) {
  ReadingSummary out;
  std::vector<const ReadingRun*> chosen;
  for (const ReadingRun& run : runs)
    if (run.automatic == automatic) chosen.push_back(&run);
  const auto of = [&](const auto& value) {
    std::vector<double> values;
    for (const ReadingRun* run : chosen) values.push_back(static_cast<double>(value(*run)));
    return quartiles_of(std::move(values));
  };
  out.patients = chosen.size();
  for (const ReadingRun* run : chosen) {
    out.gave_up += run->gave_up ? 1 : 0;
    out.refused_searches += run->search_refusal.empty() ? 0 : 1;
  }
  out.actions = of([](const ReadingRun& run) { return run.actions.size(); });
  out.tree_actions = of([](const ReadingRun& run) { return tree_actions(run); });
  for (const ReadingAct act : reading_acts)
    out.by_act.push_back(of([act](const ReadingRun& run) { return run.count(act); }));
  out.clicks = of([](const ReadingRun& run) { return run.clicks(); });
  out.minutes = of([](const ReadingRun& run) { return run.seconds() / 60.0; });
  out.share_before = of([](const ReadingRun& run) { return run.before.share_beyond(); });
  out.share_beyond = of([](const ReadingRun& run) { return run.after.share_beyond(); });
  out.worst_wall_mm = of([](const ReadingRun& run) { return run.after.worst_wall_mm; });
  out.worst_axis_mm = of([](const ReadingRun& run) { return run.after.worst_axis_mm; });
  out.missing_mm = of([](const ReadingRun& run) { return run.after.missing_mm; });
  return out;
}

std::string parameters_json(const ReadingPatients& options) {
  return reading_parameters(options).dump();
}

std::string reading_json(const std::vector<ReadingRun>& runs, const ReadingPatients& options) {
  ReadingJson out{{"v", 1}, {"kind", "reading"}, {"parameters", reading_parameters(options)}};
  out["automatic"] = reading_summary_json(summarize(runs, true));
  out["manual"] = reading_summary_json(summarize(runs, false));
  out["runs"] = ReadingJson::array();
  for (const ReadingRun& run : runs) out["runs"].push_back(reading_run_json(run));
  return out.dump(1) + "\n";
}

std::string reading_text(const std::vector<ReadingRun>& runs) {
  std::string text = "median (quartiles) a patient | automatic start | manual start\n";
  for (const std::vector<std::string>& row : summary_rows(runs))
    text += row[0] + " | " + row[1] + " | " + row[2] + "\n";
  return text;
}

void write_reading_report(const std::filesystem::path& folder, const std::vector<ReadingRun>& runs,
                          const ReadingPatients& options) {
  core::write_file(folder / "patients.csv", patients_csv(runs));
  core::write_file(folder / "actions.csv", actions_csv(runs));
  figure::HtmlReport page("Reading a coronary tree", std::to_string(options.patients) +
                                                         " synthetic patients, each from the tree that the "
                                                         "search finds and from nothing but the image");
  page.paragraph("A simulated reader sees the truth as an overlay and acts until nothing beyond " +
                 core::mm_text(options.reader.tolerance_mm, 2) + " is seen. Vessels count that are " +
                 core::mm_text(options.reader.least_diameter_mm, 1) +
                 " wide where they begin, as far as they stay so wide without lesions. What the program "
                 "refused counts. Times are modelled.");
  page.section("All patients");
  page.table({"median (quartiles) a patient", "automatic start", "manual start"}, summary_rows(runs));
  page.section("Each patient");
  std::vector<std::vector<std::string>> rows;
  for (const ReadingRun& run : runs) rows.push_back(patient_row(run));
  page.table({"patient", "start", "actions", "of these", "min", "beyond before, %", "beyond after, %",
              "worst wall, mm", "worst axis, mm", "left"},
             rows);
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
