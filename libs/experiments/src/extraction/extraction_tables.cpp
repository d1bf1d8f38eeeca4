#include "extraction/extraction_tables.h"

#include "ostia/core/text.h"

#include <algorithm>

namespace ostia::experiments {
namespace {

using core::fixed_or_dash;
using evaluation::Lesion;

const char* word(geometry::Health health) {
  return health == geometry::Health::diseased ? "diseased" : "healthy";
}

std::string stretches(const std::vector<std::pair<double, double>>& pieces) {
  std::string text;
  for (const auto& [from, to] : pieces)
    text += (text.empty() ? "" : "; ") + fixed_or_dash(from, 1) + " to " + fixed_or_dash(to, 1);
  return text;
}

std::vector<std::string> case_row(const std::string& name, const std::vector<ExtractionRun>& runs,
                                  const ExtractionScoreOptions& options) {
  const ExtractionSummary s = summarize(runs, options);
  const evaluation::LesionCounts& lesions = s.stenoses.all;
  return {
      name,
      fixed_or_dash(s.annotated.ov, 3),
      fixed_or_dash(s.annotated.of, 3),
      fixed_or_dash(s.annotated.ot, 3),
      fixed_or_dash(s.annotated.ai_mm, 3),
      fixed_or_dash(s.all.ov, 3),
      fixed_or_dash(s.astray_mm, 1),
      std::to_string(s.right) + "/" + std::to_string(s.wrong) + "/" + std::to_string(s.unnamed + s.missing),
      fixed_or_dash(s.healthy.dice, 3),
      fixed_or_dash(s.healthy.msd_mm, 3),
      fixed_or_dash(s.healthy.max_sd_mm, 2),
      fixed_or_dash(s.diseased.dice, 3),
      fixed_or_dash(s.diseased.msd_mm, 3),
      fixed_or_dash(s.diseased.max_sd_mm, 2),
      std::to_string(lesions.true_positive) + "/" + std::to_string(lesions.false_negative) + "/" +
          std::to_string(lesions.false_positive),
      fixed_or_dash(s.most_seconds, 1),
      fixed_or_dash(s.most_mb / 1024.0, 2)};
}

std::string place(const Lesion& lesion) {
  return fixed_or_dash(lesion.s_throat_mm, 1) + " (" + fixed_or_dash(lesion.s_from_mm, 1) + " to " +
         fixed_or_dash(lesion.s_to_mm, 1) + ")";
}

}  // namespace

Table case_table(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options) {
  Table table;
  table.header = {"case",
                  "OV",
                  "OF",
                  "OT",
                  "AI, mm",
                  "OV, all",
                  "astray, mm",
                  "names right/wrong/none",
                  "healthy Dice",
                  "MSD, mm",
                  "max, mm",
                  "diseased Dice",
                  "MSD, mm",
                  "max, mm",
                  "stenoses found/missed/false",
                  "s",
                  "GB"};
  for (const ExtractionRun& run : runs) table.rows.push_back(case_row(run.case_name, {run}, options));
  if (runs.size() > 1) table.rows.push_back(case_row("all", runs, options));
  return table;
}

Table vessel_table(const std::vector<ExtractionRun>& runs) {
  Table table;
  table.header = {"case", "vessel", "annotated", "length_mm", "ov",      "of",
                  "ot",   "ai_mm",  "missed_mm", "named",     "found_as"};
  for (const ExtractionRun& run : runs)
    for (const VesselRun& v : run.vessels)
      table.rows.push_back({run.case_name, v.name, v.annotated ? "yes" : "no", fixed_or_dash(v.length_mm, 1),
                            fixed_or_dash(v.scores.ov, 4), fixed_or_dash(v.scores.of, 4),
                            fixed_or_dash(v.scores.ot, 4), fixed_or_dash(v.scores.ai_mm, 4),
                            stretches(v.missed_mm), name_of(v.verdict), v.found_name});
  return table;
}

Table section_table(const std::vector<ExtractionRun>& runs) {
  Table table;
  table.header = {"case", "section", "vessel",    "health",        "length_mm",
                  "dice", "msd_mm",  "max_sd_mm", "signed_mean_mm"};
  for (const ExtractionRun& run : runs)
    for (const evaluation::SectionScore& s : run.sections)
      table.rows.push_back({run.case_name, s.section, s.vessel, word(s.health), fixed_or_dash(s.length_mm, 1),
                            fixed_or_dash(s.dice, 4), fixed_or_dash(s.msd_mm, 4),
                            fixed_or_dash(s.max_sd_mm, 3), fixed_or_dash(s.signed_mean_mm, 4)});
  return table;
}

Table stenosis_table(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options) {
  Table table;
  table.header = {"case",           "vessel",        "true_place_mm", "true_percent",
                  "found_place_mm", "found_percent", "verdict"};
  for (const ExtractionRun& run : runs) {
    const evaluation::LesionDetection d =
        evaluation::detect_lesions(run.lesions, run.found_lesions, options.threshold);
    const auto add = [&](const Lesion* truth, const Lesion* found) {
      const bool is = truth && truth->grade >= options.threshold;
      const bool seen = found && found->grade >= options.threshold;
      if (!is && !seen) return;
      table.rows.push_back({run.case_name, (truth ? truth : found)->vessel, truth ? place(*truth) : "-",
                            truth ? fixed_or_dash(100.0 * truth->grade, 1) : "-", found ? place(*found) : "-",
                            found ? fixed_or_dash(100.0 * found->grade, 1) : "-",
                            is && seen ? "found" : (is ? "missed" : "false")});
    };
    for (const evaluation::LesionPair& pair : d.pairs)
      add(&run.lesions[pair.reference], &run.found_lesions[pair.found]);
    for (const std::size_t i : d.missed) add(&run.lesions[i], nullptr);
    for (const std::size_t i : d.unexplained) add(nullptr, &run.found_lesions[i]);
  }
  return table;
}

std::vector<std::string> worst_of(const std::vector<ExtractionRun>& runs,
                                  const ExtractionScoreOptions& options) {
  std::vector<std::string> said;
  for (const ExtractionRun& run : runs)
    if (!run.failure.empty()) said.push_back(run.case_name + ": nothing was found: " + run.failure);
  const VesselRun* vessel = nullptr;
  const evaluation::SectionScore* sections[2] = {nullptr, nullptr};
  std::string of_vessel, of_section[2];
  for (const ExtractionRun& run : runs) {
    for (const VesselRun& one : run.vessels)
      if (one.annotated && (!vessel || one.scores.ov < vessel->scores.ov))
        vessel = &one, of_vessel = run.case_name;
    for (const evaluation::SectionScore& one : run.sections) {
      const std::size_t kind = one.health == geometry::Health::diseased ? 1 : 0;
      if (!sections[kind] || one.dice < sections[kind]->dice)
        sections[kind] = &one, of_section[kind] = run.case_name;
    }
  }
  if (vessel)
    said.push_back("annotated vessel of the least overlap: " + vessel->name + " of " + of_vessel + ", OV " +
                   fixed_or_dash(vessel->scores.ov, 3) +
                   (vessel->missed_mm.empty() ? "" : ", missed: " + stretches(vessel->missed_mm) + " mm"));
  for (std::size_t kind = 0; kind < 2; ++kind)
    if (sections[kind])
      said.push_back(std::string(word(sections[kind]->health)) + " section of the least Dice: " +
                     sections[kind]->section + " (" + sections[kind]->vessel + ") of " + of_section[kind] +
                     ", Dice " + fixed_or_dash(sections[kind]->dice, 3) + ", MSD " +
                     fixed_or_dash(sections[kind]->msd_mm, 3) + " mm");
  const Table stenoses = stenosis_table(runs, options);
  for (const std::vector<std::string>& row : stenoses.rows)
    if (row.back() != "found")
      said.push_back(row[0] + " " + row[1] + ": stenosis of " + row[3] + " % at " + row[2] + " mm, found " +
                     row[5] + " % at " + row[4] + " mm");
  return said;
}

}  // namespace ostia::experiments
