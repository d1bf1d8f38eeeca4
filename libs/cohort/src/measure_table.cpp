#include "ostia/cohort/measure_table.h"

#include "measure_fields.h"
#include "stage_results.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <optional>
#include <string_view>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::size_t measures_stage = stage_of("measures"), pressure_stage = stage_of("pressure");

constexpr const char* tables_schema = R"(
CREATE TABLE scans(scan TEXT PRIMARY KEY, patient TEXT NOT NULL, kind TEXT NOT NULL, import TEXT NOT NULL,
  extract TEXT NOT NULL, lumen TEXT NOT NULL, mesh TEXT NOT NULL, measures TEXT NOT NULL, pressure TEXT NOT NULL);
CREATE TABLE measures(scan TEXT NOT NULL, patient TEXT NOT NULL, level TEXT NOT NULL, entry INTEGER NOT NULL,
  item TEXT NOT NULL, measure TEXT NOT NULL, value, unit TEXT NOT NULL);
CREATE TABLE dictionary("table" TEXT NOT NULL, "column" TEXT NOT NULL, level TEXT NOT NULL, measure TEXT NOT NULL,
  unit TEXT NOT NULL, meaning TEXT NOT NULL);
)";

/// A CSV file that grows line by line.
class CsvFile {
 public:
  CsvFile(const fs::path& file, const std::vector<std::string>& columns) : stream_(file, std::ios::binary) {
    add(columns);
  }
  void add(const std::vector<std::string>& cells) { stream_ << core::csv_line(cells); }
  void close() {
    stream_.close();
    if (!stream_) throw ResourceError("cannot write the cohort's tables: the disk is full, or out of order");
  }

 private:
  std::ofstream stream_;
};

class Tables {
 public:
  explicit Tables(const fs::path& folder)
      : scans_(folder / "scans.csv",
               {"scan", "patient", "kind", "import", "extract", "lumen", "mesh", "measures", "pressure"}),
        measures_(folder / "measures.csv",
                  {"scan", "patient", "level", "entry", "item", "measure", "value", "unit"}),
        dictionary_(folder / "dictionary.csv", {"table", "column", "level", "measure", "unit", "meaning"}),
        store_(folder / "measures.sqlite", Store::Mode::create) {
    store_.execute("BEGIN");
    store_.execute(tables_schema);
    put_scan_.emplace(store_, "INSERT INTO scans VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
    put_measure_.emplace(store_, "INSERT INTO measures VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
    write_dictionary();
  }
  void take_scan(const CohortScan& scan);
  void take_result(const CohortScan& scan, const char* stage, const json& result);
  std::size_t close();

 private:
  void write_dictionary();
  void take_entry(const CohortScan& scan, const MeasureLevel& level, std::size_t number, const json& entry);

  CsvFile scans_, measures_, dictionary_;
  Store store_;
  std::optional<Query> put_scan_, put_measure_;
  std::size_t values_ = 0;
};

void Tables::write_dictionary() {
  Query put(store_, "INSERT INTO dictionary VALUES(?, ?, ?, ?, ?, ?)");
  const auto add = [&](const char* table, const char* column, const char* level, const char* measure,
                       const char* unit, const char* meaning) {
    dictionary_.add({table, column, level, measure, unit, meaning});
    put.with(table, column, level, measure, unit, meaning).step();
  };
  for (const ColumnWords& one : column_words()) add(one.table, one.column, "", "", "", one.meaning);
  for (const MeasureField& one : measure_fields())
    add("measures", "value", one.level, one.measure, one.unit, one.meaning);
}

void Tables::take_scan(const CohortScan& scan) {
  const auto state = [&](std::size_t stage) { return name_of(scan.results[stage].state); };
  scans_.add(
      {scan.pseudonym, scan.patient, scan.kind, state(0), state(1), state(2), state(3), state(4), state(5)});
  put_scan_
      ->with(scan.pseudonym, scan.patient, scan.kind, state(0), state(1), state(2), state(3), state(4),
             state(5))
      .step();
}

std::string text_of_value(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? core::shortest_text(value.get<double>()) : value.dump();
}

void Tables::take_entry(const CohortScan& scan, const MeasureLevel& level, std::size_t number,
                        const json& entry) {
  const std::string_view pointer = level.item;
  const std::string item =
      pointer.empty() ? ""
                      : level.prefix + text_of_value(entry.value(json::json_pointer(level.item), json("")));
  for (const MeasureField& field : measure_fields()) {
    if (std::string_view(field.level) != level.level) continue;
    const json::json_pointer at(field.pointer);
    if (!entry.contains(at) || !entry.at(at).is_primitive() || entry.at(at).is_null()) continue;
    const json& value = entry.at(at);
    measures_.add({scan.pseudonym, scan.patient, level.level, std::to_string(number), item, field.measure,
                   text_of_value(value), field.unit});
    if (value.is_number())
      put_measure_
          ->with(scan.pseudonym, scan.patient, level.level, number, item, field.measure, value.get<double>(),
                 field.unit)
          .step();
    else
      put_measure_
          ->with(scan.pseudonym, scan.patient, level.level, number, item, field.measure, text_of_value(value),
                 field.unit)
          .step();
    ++values_;
  }
}

void Tables::take_result(const CohortScan& scan, const char* stage, const json& report) {
  for (const MeasureLevel& level : measure_levels()) {
    if (std::string_view(level.stage) != stage) continue;
    if (std::string_view(level.list).empty()) {
      take_entry(scan, level, 1, report);
      continue;
    }
    std::size_t number = 0;
    for (const json& entry : report.value(level.list, json::array()))
      take_entry(scan, level, ++number, entry);
  }
}

std::size_t Tables::close() {
  put_scan_.reset();
  put_measure_.reset();
  store_.execute("CREATE INDEX measures_scan ON measures(scan); COMMIT");
  for (CsvFile* one : {&scans_, &measures_, &dictionary_}) one->close();
  return values_;
}

json result_of(const fs::path& file, const char* kind) {
  try {
    json result = json::parse(core::read_file(file));
    if (result.value("v", 0) == 1 && result.value("kind", "") == kind) return result;
  } catch (const json::exception&) {
    // Below.
  }
  throw InvalidInput("cannot use " + file.string() + ": it is no " + kind + ", though its manifest names it");
}

}  // namespace

MeasureTableResult write_measure_table(const fs::path& folder, const fs::path& output,
                                       const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  const OpenCohort cohort(folder);
  pipeline::require_free_folder(output);
  core::StagedFolder staged(output);
  MeasureTableResult out;
  std::string made_of;
  {
    Tables tables(staged.temporary());
    cohort.for_each({}, task, [&](const CohortScan& scan) {
      ++out.scans;
      tables.take_scan(scan);
      for (const auto& [number, kind] :
           {std::pair{measures_stage, "case report"}, std::pair{pressure_stage, "ffr"}}) {
        const StageResult& result = scan.results[number];
        if (!is_done(result.state)) continue;
        out.measured += number == measures_stage;
        made_of = core::sha256(made_of + scan.pseudonym + result.result);
        const Stage& stage = stages[number];
        tables.take_result(scan, stage.name,
                           result_of(folder / stage.folder / scan.pseudonym / stage.result, kind));
      }
    });
    out.values = tables.close();
  }
  pipeline::ManifestRecord record;
  record.key = {"cohort table", {{"measures", core::sha256(made_of)}}, "{}"};
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
  return out;
}

}  // namespace ostia::cohort
