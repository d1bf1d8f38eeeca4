#include "stage_results.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::int64_t block = 4096;  // scans that are in memory at once
constexpr std::uint64_t most_record_bytes = 1 << 20;

/// A file that is written anew has another one, even where the clock went back. Empty: no file.
std::string stamp_of(const fs::path& file) {
  struct stat known {};
  if (::stat(file.c_str(), &known) != 0 || !S_ISREG(known.st_mode)) return "";
  return std::to_string(known.st_ino) + ":" + std::to_string(known.st_size) + ":" +
         std::to_string(known.st_mtim.tv_sec) + "." + std::to_string(known.st_mtim.tv_nsec);
}

fs::path checked(const fs::path& folder) {
  if (!fs::is_regular_file(folder / database_name))
    throw InvalidInput("cannot use " + folder.string() +
                       ": it is no cohort; `ostia cohort init` makes one, with a " + database_name);
  return folder;
}

bool as_recorded(const fs::path& file, const std::string& digest, bool verify) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  return !verify || core::sha256_file(file) == digest;
}

/// What `ostia run` left: its manifest is written last.
/// `accepted`: a digest of the stage's result that a person has answered for.
StageResult result_of_manifest(const fs::path& folder, const Stage& stage, bool verify,
                               const std::string& accepted) {
  StageResult out;
  out.state = StageState::damaged;
  try {
    const json manifest = json::parse(pipeline::manifest_of(folder));
    if (manifest.at("v") != 1 || manifest.at("command") != "run") return out;
    out.exit_code = manifest.at("exit_code").get<int>();
    out.seconds = manifest.at("seconds").get<double>();
    out.peak_mb = manifest.at("peak_mb").get<double>();
    for (const json& digest : manifest.at("inputs")) out.inputs += digest.get<std::string>() + " ";
    const json& outputs = manifest.at("outputs");
    out.result = outputs.at(stage.result).get<std::string>();
    for (const auto& [name, digest] : outputs.items())
      if (!as_recorded(folder / name, digest.get<std::string>(), verify) &&
          (name != stage.result || accepted.empty() || !as_recorded(folder / name, accepted, verify)))
        return out;
    out.state = out.exit_code == static_cast<int>(ExitCode::ok) ? StageState::ok : StageState::quality;
  } catch (const json::exception&) {
    // No manifest of ours: what lies there is not to be trusted.
  }
  return out;
}

/// What the workflow wrote of a step that ended without a result.
StageResult result_of_record(const fs::path& file) {
  StageResult out;
  try {
    const json record = json::parse(core::read_file(file, most_record_bytes));
    out.reason = record.value("message", "");
    const json code = record.at("exit_code"), signal = record.at("signal");
    if (signal.is_number())
      out.exit_code = 128 + signal.get<int>();
    else if (code.is_number())
      out.exit_code = code.get<int>();
    else
      return out;  // it was not begun
    // Done, and then taken away: there is nothing to be trusted, and it is to be done again.
    if (out.exit_code == static_cast<int>(ExitCode::ok) ||
        out.exit_code == static_cast<int>(ExitCode::quality_failed))
      return {};
    out.state = StageState::failed;
    out.seconds = record.value("seconds", 0.0);
  } catch (const json::exception&) {
    out = {};
    out.state = StageState::failed;
    out.exit_code = static_cast<int>(ExitCode::internal);
    out.reason = "its record in logs/ cannot be read";
  }
  return out;
}

/// What a folder holds, by name. Asking the system for a million names that are not there, one by one, takes
/// minutes; to list those that are takes a moment.
class ListedFolder {
 public:
  explicit ListedFolder(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      names_.push_back(hash_of(entry->path().filename().native()));
    std::ranges::sort(names_);
  }
  /// False: it is not there. True: it is worth a look.
  bool may_have(const std::string& name) const { return std::ranges::binary_search(names_, hash_of(name)); }

 private:
  static std::size_t hash_of(std::string_view name) { return std::hash<std::string_view>()(name); }
  std::vector<std::size_t> names_;
};

/// Where there may be something.
struct Places {
  bool result = true, record = true;
};

StageResult result_now(const fs::path& cohort, const Stage& stage, const std::string& pseudonym,
                       const StageResult& known, bool verify, const std::string& accepted,
                       const Places& places = {}) {
  StageResult out;
  if (!places.result && !places.record) return out;
  const fs::path folder = cohort / stage.folder / pseudonym;
  const fs::path record = cohort / "logs" / pseudonym / (std::string(stage.name) + ".json");
  if (const std::string made = stamp_of(folder / "manifest.json"); !made.empty()) {
    const bool same = known.stamp == made && is_done(known.state) && !verify;
    out = same ? known : result_of_manifest(folder, stage, verify, accepted);
    out.stamp = made;
    if (same && stamp_of(folder / stage.result).empty()) out.state = StageState::damaged;
  } else if (const std::string written = stamp_of(record); !written.empty()) {
    out = known.stamp == written ? known : result_of_record(record);
    out.stamp = written;
  }
  return out;
}

/// As the stages before it leave it.
StageState state_after(const StageResult& one, const StageResult& before) {
  if (!is_done(before.state)) return StageState::waiting;
  const bool made_of_it = one.inputs.find(before.result + " ") != std::string::npos;
  return is_done(one.state) && !made_of_it ? StageState::stale : one.state;
}

bool same_result(const StageResult& a, const StageResult& b) {
  return a.state == b.state && a.stamp == b.stamp;
}

}  // namespace

OpenCohort::OpenCohort(const fs::path& folder)
    : folder_(checked(folder)), store_(folder / database_name, Store::Mode::write) {
  Query meta(store_, "SELECT value FROM meta WHERE key = ?");
  if (!meta.with("format").step() || meta.text(0) != "ostia cohort")
    throw InvalidInput("cannot use " + folder.string() + ": its " + database_name + " is no cohort's");
  if (!meta.with("v").step() || meta.text(0) != "1")
    throw InvalidInput("cannot use " + folder.string() +
                       ": a newer version of Ostia made this cohort (format " + meta.text(0) +
                       ", this one knows 1)");
  has_later_tables_ = store_.try_execute(later_tables);
}

std::size_t OpenCohort::count(const char* table) const {
  Query rows(store_, (std::string("SELECT count(*) FROM ") + table).c_str());
  return rows.step() ? static_cast<std::size_t>(rows.integer(0)) : 0;
}

std::int64_t OpenCohort::number_of(const std::string& pseudonym) const {
  Query row(store_, "SELECT number FROM scan WHERE pseudonym = ?");
  return row.with(pseudonym).step() ? row.integer(0) : 0;
}

StageResult OpenCohort::result_of(const std::string& pseudonym, std::size_t stage) const {
  return result_now(folder_, stages[stage], pseudonym, {}, false, "");
}

std::string OpenCohort::table_digest() const {
  Query meta(store_, "SELECT value FROM meta WHERE key = 'table_sha256'");
  return meta.step() ? meta.text(0) : "";
}

void OpenCohort::add_reviews(std::vector<CohortScan>& scans) const {
  if (!has_later_tables_ || scans.empty()) return;
  Query rows(store_,
             "SELECT scan, verdict, reader, time, made, result FROM review WHERE scan BETWEEN ? AND ? "
             "ORDER BY scan, number");
  rows.with(scans.front().number, scans.back().number);
  auto at = scans.begin();
  while (rows.step()) {
    while (at != scans.end() && at->number < rows.integer(0)) ++at;
    if (at == scans.end() || at->number != rows.integer(0)) continue;
    const auto verdict = verdict_named(rows.text(1));
    if (!verdict || *verdict == Verdict::none)
      at->review.reset();
    else
      at->review = KnownReview{*verdict, rows.text(2), rows.text(3), rows.text(4), rows.text(5)};
  }
}

std::vector<CohortScan> OpenCohort::scans_from(std::int64_t number) const {
  std::vector<CohortScan> scans;
  Query rows(store_,
             "SELECT number, pseudonym, patient, kind FROM scan WHERE number >= ? ORDER BY number LIMIT ?");
  rows.with(number, block);
  while (rows.step()) scans.push_back({rows.integer(0), rows.text(1), rows.text(2), rows.text(3)});
  if (scans.empty()) return scans;
  add_reviews(scans);
  Query known(
      store_,
      "SELECT scan, stage, state, exit_code, seconds, peak_mb, reason, inputs, result, stamp FROM stage "
      "WHERE scan BETWEEN ? AND ? ORDER BY scan, stage");
  known.with(scans.front().number, scans.back().number);
  auto at = scans.begin();
  while (known.step()) {
    while (at != scans.end() && at->number < known.integer(0)) ++at;
    const auto stage = static_cast<std::size_t>(known.integer(1)),
               state = static_cast<std::size_t>(known.integer(2));
    if (at == scans.end() || at->number != known.integer(0) || stage >= stages.size() ||
        state >= stage_state_count)
      continue;
    at->results[stage] = {static_cast<StageState>(state),
                          static_cast<int>(known.integer(3)),
                          known.real(4),
                          known.real(5),
                          known.text(6),
                          known.text(7),
                          known.text(8),
                          known.text(9)};
  }
  return scans;
}

namespace {

void keep_changes(Query& put, const CohortScan& before, const CohortScan& now) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageResult& one = now.results[i];
    if (same_result(before.results[i], one)) continue;
    put.with(now.number, i, static_cast<int>(one.state), one.exit_code, one.seconds, one.peak_mb, one.reason,
             one.inputs, one.result, one.stamp)
        .step();
  }
}

}  // namespace

void OpenCohort::for_each(const StatusOptions& options, const core::TaskContext& task,
                          const std::function<void(const CohortScan&)>& take) const {
  const double all = std::max(1.0, static_cast<double>(count("scan")));
  double done = 0.0;
  std::vector<ListedFolder> made;
  for (const Stage& stage : stages) made.emplace_back(folder_ / stage.folder);
  const ListedFolder logs(folder_ / "logs");
  const bool may_write = ::access(folder_.c_str(), W_OK) == 0;
  Query put(store_, "INSERT OR REPLACE INTO stage VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (std::vector<CohortScan> known = scans_from(0); !known.empty();
       known = scans_from(known.back().number + 1)) {
    const bool keeping = may_write && store_.try_execute("BEGIN IMMEDIATE");
    keeps_ = keeping;
    for (const CohortScan& before : known) {
      task.throw_if_cancelled();
      CohortScan now = before;
      const bool has_logs = logs.may_have(now.pseudonym);
      for (std::size_t i = 0; i < stages.size(); ++i)
        now.results[i] = result_now(folder_, stages[i], now.pseudonym, before.results[i], options.verify,
                                    now.review && i == reviewed_stage ? now.review->result : "",
                                    {made[i].may_have(now.pseudonym), has_logs});
      if (keeping) keep_changes(put, before, now);
      // What follows from others is not kept: they may change without it.
      StageResult& reviewed = now.results[reviewed_stage];
      if (now.review && (!is_done(reviewed.state) || now.review->made != reviewed.result)) now.review.reset();
      if (now.review) reviewed.result = now.review->result;
      for (std::size_t i = 0; i < stages.size(); ++i)
        if (stages[i].after >= 0)
          now.results[i].state =
              state_after(now.results[i], now.results[static_cast<std::size_t>(stages[i].after)]);
      take(now);
    }
    keeps_ = false;
    if (keeping) store_.execute("COMMIT");
    done += static_cast<double>(known.size());
    task.set_progress(done / all);
  }
}

}  // namespace ostia::cohort
