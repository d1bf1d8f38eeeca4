#include "report/report_rows.h"

#include "case_file/case_damage.h"
#include "case_file/model_blob.h"

#include "ostia/core/error.h"
#include "ostia/session/annotation_json.h"

#include <map>
#include <utility>

namespace ostia::session {
namespace {

/// What is not as in a new case, by command: each is kept as the command that makes it.
std::map<std::string, std::string> note_lines(const ReportNotes& notes) {
  std::map<std::string, std::string> lines;
  const auto add = [&](const AnnotationCommand& command) { lines[op_name(command)] = to_json(command); };
  if (!notes.impression.empty()) add(SetReportImpression{notes.impression});
  if (!(notes.modifiers == ReportModifiers{})) add(SetReportModifiers{notes.modifiers});
  if (!notes.features.empty()) add(SetPlaqueFeatures{notes.features});
  if (!notes.calcium.empty()) add(SetCalciumPlaces{notes.calcium});
  return lines;
}

std::uint64_t sum_of_note(const std::string& op, const std::string& line) {
  return Checksum().add("report_note").add(op).add(line).value();
}

std::uint64_t sum_of_version(std::size_t number, const ReportVersion& one) {
  Checksum sum;
  sum.add("report_version").add(static_cast<std::int64_t>(number)).add(one.date).add(one.signer);
  return sum.add(one.changes).add(one.digest).value();
}

void take_note(ReportNotes& notes, const std::string& op, const std::string& line) {
  try {
    AnnotationCommand command = annotation_of_json(line);
    if (op_name(command) != op) damaged("a note of its report is another one");
    if (auto* impression = std::get_if<SetReportImpression>(&command)) {
      validate_impression(impression->text);
      notes.impression = std::move(impression->text);
    } else if (auto* modifiers = std::get_if<SetReportModifiers>(&command)) {
      validate(modifiers->modifiers);
      notes.modifiers = std::move(modifiers->modifiers);
    } else if (auto* features = std::get_if<SetPlaqueFeatures>(&command)) {
      validate(features->features);
      notes.features = std::move(features->features);
    } else if (auto* calcium = std::get_if<SetCalciumPlaces>(&command)) {
      validate(calcium->words);
      notes.calcium = std::move(calcium->words);
    } else {
      damaged("its report has a note that is none");
    }
  } catch (const InvalidInput&) {
    damaged("a note of its report is none");
  }
}

}  // namespace

std::uint64_t sum_of(const ReportNotes& notes) {
  std::uint64_t sum = 0;
  for (const auto& [op, line] : note_lines(notes)) sum += sum_of_note(op, line);
  for (std::size_t i = 0; i < notes.versions.size(); ++i) sum += sum_of_version(i + 1, notes.versions[i]);
  return sum;
}

ReportRows::ReportRows(const Database& db)
    : put_note_(db,
                "INSERT INTO report_note VALUES(?1, ?2) ON CONFLICT(op) DO UPDATE SET line = excluded.line"),
      erase_note_(db, "DELETE FROM report_note WHERE op = ?1"),
      read_notes_(db, "SELECT op, line FROM report_note ORDER BY op"),
      put_version_(db,
                   "INSERT INTO report_version VALUES(?1, ?2, ?3, ?4, ?5) ON CONFLICT(number) DO UPDATE SET "
                   "date = excluded.date, signer = excluded.signer, changes = excluded.changes, "
                   "digest = excluded.digest"),
      erase_versions_(db, "DELETE FROM report_version WHERE number > ?1"),
      read_versions_(db, "SELECT number, date, signer, changes, digest FROM report_version ORDER BY number") {
}

void ReportRows::write(const ReportNotes& before, const ReportNotes& after) {
  const auto lines = note_lines(after);
  for (const auto& [op, line] : note_lines(before))
    if (!lines.contains(op)) erase_note_.with(op).run();
  for (const auto& [op, line] : lines) put_note_.with(op, line).run();
  erase_versions_.with(static_cast<std::int64_t>(after.versions.size())).run();
  for (std::size_t i = 0; i < after.versions.size(); ++i) {
    const ReportVersion& one = after.versions[i];
    put_version_.with(static_cast<std::int64_t>(i + 1), one.date, one.signer, one.changes, one.digest).run();
  }
}

ReportNotes ReportRows::read() {
  ReportNotes notes;
  for (Statement& row = read_notes_.with(); row.step();) take_note(notes, row.text(0), row.text(1));
  for (Statement& row = read_versions_.with(); row.step();) {
    if (row.integer(0) != static_cast<std::int64_t>(notes.versions.size() + 1))
      damaged("a version of its report is missing");
    ReportVersion one{row.text(1), row.text(2), row.text(3), row.text(4)};
    try {
      validate(one);
    } catch (const InvalidInput&) {
      damaged("a version of its report is none");
    }
    notes.versions.push_back(std::move(one));
  }
  return notes;
}

}  // namespace ostia::session
