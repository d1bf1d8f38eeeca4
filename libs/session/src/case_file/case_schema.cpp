#include "case_file/case_schema.h"

#include "case_file/annotation_rows.h"

#include "ostia/core/error.h"
#include "ostia/core/version.h"

#include <array>
#include <string>

namespace ostia::session {
namespace {

// Numbers that must keep every bit stand in columns without a type: a REAL column would store -0.0 as 0.
constexpr const char* tables = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE setting(key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL, checksum INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE image(id INTEGER PRIMARY KEY CHECK(id = 1), sha256 TEXT NOT NULL, pseudonym TEXT NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE content(sha256 TEXT PRIMARY KEY NOT NULL, size INTEGER NOT NULL, zlib BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE model(id INTEGER PRIMARY KEY CHECK(id = 1), next_sample_id INTEGER NOT NULL,
  next_tree_id INTEGER NOT NULL, blend_width_mm NOT NULL, joints TEXT NOT NULL, checksum INTEGER NOT NULL);
CREATE TABLE node(id INTEGER PRIMARY KEY, place INTEGER NOT NULL, position BLOB NOT NULL);
CREATE TABLE segment(id INTEGER PRIMARY KEY, place INTEGER NOT NULL, from_node INTEGER NOT NULL,
  to_node INTEGER NOT NULL, points BLOB NOT NULL, radius BLOB NOT NULL, abscissa BLOB NOT NULL,
  frames BLOB NOT NULL);
CREATE TABLE vessel(id INTEGER PRIMARY KEY, place INTEGER NOT NULL, name TEXT NOT NULL, segments BLOB NOT NULL,
  own_from_mm NOT NULL, kernel TEXT NOT NULL, support_radius_mm NOT NULL, offset_mm NOT NULL,
  far_field TEXT NOT NULL);
CREATE TABLE sample(vessel INTEGER NOT NULL, id INTEGER NOT NULL, s_mm NOT NULL, position BLOB NOT NULL,
  normal BLOB NOT NULL, origin INTEGER NOT NULL, PRIMARY KEY(vessel, id)) WITHOUT ROWID;
CREATE TABLE journal(number INTEGER PRIMARY KEY, op TEXT NOT NULL, parameters TEXT NOT NULL,
  state INTEGER NOT NULL, notes TEXT NOT NULL, changeset BLOB NOT NULL, checksum INTEGER NOT NULL);
)";

// Since version 2.
constexpr const char* annotation_tables = R"(
CREATE TABLE annotation(id INTEGER PRIMARY KEY CHECK(id = 1), next_measurement_id INTEGER NOT NULL,
  checksum INTEGER NOT NULL);
CREATE TABLE measurement(id INTEGER PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, points BLOB NOT NULL,
  vessel INTEGER NOT NULL, from_mm NOT NULL, to_mm NOT NULL, inner_mm NOT NULL, outer_mm NOT NULL);
CREATE TABLE mark(vessel INTEGER PRIMARY KEY, visible INTEGER NOT NULL, checked INTEGER NOT NULL,
  color BLOB NOT NULL, note TEXT NOT NULL);
)";

// Since version 3: the reader's word on stretches, three numbers each: from, to, grade.
constexpr const char* evaluability_table =
    "CREATE TABLE evaluability(vessel INTEGER PRIMARY KEY, stretches BLOB NOT NULL);";

// Since version 4: the reader's word on lesions.
constexpr const char* lesion_table =
    "CREATE TABLE lesion(vessel INTEGER NOT NULL, from_mm NOT NULL, to_mm NOT NULL, state TEXT NOT NULL, "
    "comment TEXT NOT NULL, PRIMARY KEY(vessel, from_mm, to_mm)) WITHOUT ROWID;";

constexpr const char* oldest_reader = "0.2.0";  // the oldest program that reads this version

// Since version 5: when a step was done, and by whom, where that was said. Beside the journal, whose rows are
// the same for the same steps.
constexpr const char* stamp_table =
    "CREATE TABLE step_stamp(number INTEGER PRIMARY KEY, time_s INTEGER NOT NULL, author TEXT NOT NULL, "
    "checksum INTEGER NOT NULL);";

// Since version 6: how the image's axes run, where a person has said so in place of its file.
constexpr const char* axes_table =
    "CREATE TABLE image_axes(id INTEGER PRIMARY KEY CHECK(id = 1), axes TEXT NOT NULL, "
    "checksum INTEGER NOT NULL);";

// Since version 7: what the computed pressures are told.
constexpr const char* pressure_tables = R"(
CREATE TABLE pressure_input(key TEXT PRIMARY KEY NOT NULL, value NOT NULL) WITHOUT ROWID;
CREATE TABLE what_if(place INTEGER PRIMARY KEY, vessel INTEGER NOT NULL, from_mm NOT NULL, to_mm NOT NULL,
  kind TEXT NOT NULL, percent NOT NULL);
)";

// Since version 8: what the report says by a person, each note as the command that makes it; who signed it.
constexpr const char* report_tables = R"(
CREATE TABLE report_note(op TEXT PRIMARY KEY NOT NULL, line TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE report_version(number INTEGER PRIMARY KEY, date TEXT NOT NULL, signer TEXT NOT NULL,
  changes TEXT NOT NULL, digest TEXT NOT NULL);
)";

void create_report(Database& database) {
  database.execute(report_tables);
}

void create_pressure(Database& database) {
  database.execute(pressure_tables);
}

void create_axes(Database& database) {
  database.execute(axes_table);
}

void create_stamps(Database& database) {
  database.execute(stamp_table);
}

void create_lesions(Database& database) {
  database.execute(lesion_table);
}

void create_evaluability(Database& database) {
  database.execute(evaluability_table);
}

void create_annotations(Database& database) {
  database.execute(annotation_tables);
  AnnotationRows::write_new(database);
}

/// Step k makes version k + 2 of version k + 1.
using Step = void (*)(Database&);
constexpr std::array<Step, schema_version - 1> steps{create_annotations, create_evaluability, create_lesions,
                                                     create_stamps,      create_axes,         create_pressure,
                                                     create_report};

void set_version(Database& database, std::int32_t version) {
  database.execute("PRAGMA user_version = " + std::to_string(version));
}

}  // namespace

void create_schema(Database& database) {
  database.execute("PRAGMA application_id = " + std::to_string(application_id));
  database.execute(tables);
  for (const Step step : steps) step(database);
  // Read by programs that are too old for the file: they can name the version that is needed.
  database.execute("INSERT INTO meta VALUES('made_with', '" + core::version() + "'), ('needs', '" +
                   oldest_reader + "')");
  set_version(database, schema_version);
}

void migrate(Database& database, std::int32_t from, const std::function<void()>& check) {
  if (from == schema_version) return;
  if (from < 1) throw InvalidInput("the case " + database.shown() + " has no version; the file is damaged");
  Transaction transaction(database);
  for (auto version = static_cast<std::size_t>(from); version < schema_version; ++version)
    steps.at(version - 1)(database);
  set_version(database, schema_version);
  check();
  database.execute(std::string("UPDATE meta SET value = '") + oldest_reader + "' WHERE key = 'needs'");
  transaction.commit();
}

}  // namespace ostia::session
