#include "ostia/cohort/cohort.h"

#include "stage_results.h"
#include "store.h"

#include "ostia/cohort/pseudonym.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/version.h"

#include <system_error>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

constexpr auto owner_only = fs::perms::owner_read | fs::perms::owner_write;

constexpr const char* cohort_schema = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE scan(number INTEGER PRIMARY KEY, pseudonym TEXT NOT NULL, patient TEXT NOT NULL, kind TEXT NOT NULL);
CREATE TABLE refused(line INTEGER PRIMARY KEY, reason TEXT NOT NULL);
CREATE TABLE stage(scan INTEGER NOT NULL, stage INTEGER NOT NULL, state INTEGER NOT NULL, exit_code INTEGER NOT NULL,
  seconds REAL NOT NULL, peak_mb REAL NOT NULL, reason TEXT NOT NULL, inputs TEXT NOT NULL, result TEXT NOT NULL,
  stamp TEXT NOT NULL, PRIMARY KEY(scan, stage)) WITHOUT ROWID;
)";
constexpr const char* private_schema = R"(
CREATE TABLE source(number INTEGER PRIMARY KEY, pseudonym TEXT NOT NULL, id TEXT NOT NULL, patient TEXT NOT NULL,
  patient_id TEXT NOT NULL, kind TEXT NOT NULL, scan TEXT NOT NULL, series TEXT NOT NULL);
)";

void require_new(const fs::path& folder, const char* way_out) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (fs::is_directory(folder) && fs::is_empty(folder)) return;
  throw InvalidInput(
      "cannot begin a cohort in " + folder.string() + ": " +
      (fs::exists(folder / database_name) ? "it holds a cohort already" : "it is there already") + way_out);
}

class Writer {
 public:
  Writer(const fs::path& shared, const fs::path& hidden, const std::string& key)
      : pseudonyms_(key),
        cohort_(shared / database_name, Store::Mode::create),
        sources_(hidden / "sources.sqlite", Store::Mode::create) {
    for (const Store* one : {&cohort_, &sources_}) one->execute("BEGIN");
    cohort_.execute(cohort_schema);
    cohort_.execute(later_tables);
    sources_.execute(private_schema);
  }
  std::size_t write(const ScanTable& table, const TableCheck& check, const core::TaskContext& task);

 private:
  const Pseudonyms pseudonyms_;
  const Store cohort_, sources_;
};

std::size_t Writer::write(const ScanTable& table, const TableCheck& check, const core::TaskContext& task) {
  Query meta(cohort_, "INSERT INTO meta VALUES(?, ?)");
  meta.with("format", "ostia cohort").step();
  meta.with("v", "1").step();
  meta.with("program", "ostia " + core::version()).step();
  meta.with("table_sha256", table.digest()).step();
  Query refused(cohort_, "INSERT INTO refused VALUES(?, ?)");
  for (const RefusedRow& row : check.refused) refused.with(row.line, row.reason).step();
  Query scan(cohort_, "INSERT INTO scan VALUES(?, ?, ?, ?)");
  Query source(sources_, "INSERT INTO source VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  std::size_t count = 0;
  table.for_each(check, [&](const ScanRow& row) {
    if (++count % 1024 == 0) {
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(count) / static_cast<double>(check.rows));
    }
    const std::string pseudonym = pseudonyms_.of("scan " + row.id), kind = name_of(row.kind);
    const std::string patient = pseudonyms_.of("patient " + row.patient);
    scan.with(count, pseudonym, patient, kind).step();
    source.with(count, pseudonym, row.id, patient, row.patient, kind, row.scan.string(), row.series).step();
  });
  cohort_.execute("CREATE UNIQUE INDEX scan_pseudonym ON scan(pseudonym)");
  sources_.execute("CREATE UNIQUE INDEX source_pseudonym ON source(pseudonym)");
  for (const Store* one : {&cohort_, &sources_}) one->execute("COMMIT");
  return count;
}

/// Nothing in it for others, not even while it is made.
void write_key(const fs::path& folder, const std::string& key) {
  fs::permissions(folder, fs::perms::owner_all, fs::perm_options::replace);
  core::write_file(folder / "key", key + "\n");
  fs::permissions(folder / "key", owner_only, fs::perm_options::replace);
}

fs::path without_slash(const fs::path& folder) {
  const fs::path normal = fs::absolute(folder).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

fs::path private_folder_of(const fs::path& cohort) {
  fs::path folder = without_slash(cohort);
  folder += ".private";
  return folder;
}

InitResult init_cohort(const InitOptions& options, const core::TaskContext& task) {
  InitResult out;
  out.private_folder = private_folder_of(options.output);
  const fs::path target = without_slash(options.output);
  require_new(target, "; name another folder");
  require_new(out.private_folder,
              "; it may be the only key to an older cohort: move it, or name another folder");
  task.set_stage("checking");
  const ScanTable table = ScanTable::read(options.table);
  out.check = table.check(task.sub(0.0, 0.5));
  if (!out.check.refused.empty() && !options.skip_bad) return out;
  if (out.check.refused.size() == out.check.rows)
    throw InvalidInput("cannot use " + options.table.string() + ": none of its rows can be used");

  task.set_stage("writing");
  core::StagedFolder hidden(out.private_folder), shared(target);
  const std::string key = new_key();
  write_key(hidden.temporary(), key);
  for (const char* folder : {"inputs", "cases", "lumens", "meshes", "flow", "measures", "logs", "pictures"})
    fs::create_directory(shared.temporary() / folder);
  out.scans = Writer(shared.temporary(), hidden.temporary(), key).write(table, out.check, task.sub(0.5, 1.0));
  fs::permissions(hidden.temporary() / "sources.sqlite", owner_only, fs::perm_options::replace);
  hidden.commit();
  try {
    shared.commit();
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(out.private_folder, ignored);  // made a moment ago; a key without a cohort
    throw;
  }
  out.made = true;
  return out;
}

}  // namespace ostia::cohort
