#include "ostia/cohort/reproduction.h"

#include "crate_reader.h"
#include "same_content.h"
#include "store.h"

#include "ostia/cohort/crate.h"
#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;
using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t first_stage = stage_of("import"), case_stage = stage_of("extract");

/// Where a scan came from.
struct Origin {
  std::string scan, series;
};

class Sources {
 public:
  explicit Sources(const fs::path& folder) : store_(folder / "sources.sqlite", Store::Mode::read) {}
  Origin of(const std::string& pseudonym) const {
    Query row(store_, "SELECT scan, series FROM source WHERE pseudonym = ?");
    if (!row.with(pseudonym).step())
      throw InvalidInput("cannot reproduce " + pseudonym + ": the private folder does not know it");
    return {row.text(0), row.text(1)};
  }

 private:
  const Store store_;
};

fs::path place_of(std::size_t stage, const std::string& scan) {
  return fs::path(stages[stage].folder) / scan;
}

bool is_result(int exit_code) {
  return exit_code == static_cast<int>(ExitCode::ok) ||
         exit_code == static_cast<int>(ExitCode::quality_failed);
}

class Reproducing {
 public:
  Reproducing(const fs::path& crate, const RecordedCrate& recorded, const Sources* sources, fs::path made,
              const ChainRun& run)
      : crate_(crate), recorded_(recorded), sources_(sources), made_(std::move(made)), run_(run) {}
  void take(const RecordedScan& scan, const core::TaskContext& task);
  Reproduction result() { return std::move(out_); }

 private:
  void check_chain(const std::string& chain) const;
  std::optional<fs::path> read_by(const RecordedScan& scan, std::size_t stage) const;
  Values values_of(const RecordedScan& scan, std::size_t stage, const fs::path& read) const;
  void do_step(const RecordedScan& scan, std::size_t stage);
  void compare(const RecordedScan& scan, std::size_t stage, const std::optional<json>& manifest);
  void add(const RecordedScan& scan, std::size_t stage, const std::string& file, const std::string& recorded,
           const std::string& found, FileVerdict verdict) {
    out_.files.push_back({scan.pseudonym, stages[stage].name, file, recorded, found, verdict});
  }

  const fs::path crate_;
  const RecordedCrate& recorded_;
  const Sources* sources_;
  const fs::path made_;
  const ChainRun& run_;
  Reproduction out_;
};

void Reproducing::check_chain(const std::string& chain) const {
  const auto known = recorded_.digests.find(chain);
  std::error_code error;
  if (known == recorded_.digests.end() || chain.find("..") != chain.npos ||
      !fs::is_regular_file(crate_ / chain, error) || core::sha256_file(crate_ / chain) != known->second)
    throw InvalidInput("cannot reproduce " + crate_.string() + ": " + chain +
                       " is not the one that is recorded; take it from where the crate was made");
}

/// Nothing: what the step has read is not at hand.
std::optional<fs::path> Reproducing::read_by(const RecordedScan& scan, std::size_t stage) const {
  if (stage == first_stage) return fs::path(sources_->of(scan.pseudonym).scan);
  const auto before = static_cast<std::size_t>(stages[stage].after);
  const fs::path file = place_of(before, scan.pseudonym) / stages[before].result;
  const RecordedStep& step = *scan.steps[stage];
  const auto result_before = [&] {
    const auto known = scan.steps[before]->files.find(stages[before].result);
    return known == scan.steps[before]->files.end() ? "" : known->second;
  };
  const bool is_as_made = scan.steps[before] && step.read.contains(result_before());
  std::error_code error;
  if (is_as_made && fs::is_regular_file(made_ / file, error)) return made_ / file;
  // What a person has corrected, or what was imported where the scan itself is not at hand.
  const bool is_from_crate = !is_as_made || (before == first_stage && !sources_);
  if (is_from_crate && fs::is_regular_file(crate_ / file, error) &&
      step.read.contains(core::sha256_file(crate_ / file)))
    return crate_ / file;
  if (before == first_stage && !sources_)
    throw InvalidInput("cannot reproduce " + scan.pseudonym + ": neither " + file.string() +
                       " as it is recorded nor a private folder, which says where the scan is, is at hand; "
                       "name it by --private");
  return {};
}

Values Reproducing::values_of(const RecordedScan& scan, std::size_t stage, const fs::path& read) const {
  const std::string chain = core::read_file(crate_ / scan.steps[stage]->chain);
  Values out;
  const auto add_where_used = [&](const char* name, const std::string& value) {
    if (chain.find("{" + std::string(name) + "}") != std::string::npos) out.emplace_back(name, value);
  };
  const fs::path image = place_of(first_stage, scan.pseudonym) / stages[first_stage].result;
  const bool is_of_case = stages[stage].after == static_cast<int>(case_stage);
  if (is_of_case) add_where_used("case", read.string());
  add_where_used("scan", !is_of_case                 ? read.string()
                         : fs::exists(made_ / image) ? (made_ / image).string()
                                                     : (crate_ / image).string());
  if (stage == first_stage) add_where_used("series", sources_->of(scan.pseudonym).series);
  return out;
}

void Reproducing::compare(const RecordedScan& scan, std::size_t stage, const std::optional<json>& manifest) {
  const fs::path place = place_of(stage, scan.pseudonym);
  const json outputs = manifest ? manifest->value("outputs", json::object()) : json::object();
  for (const auto& [file, digest] : scan.steps[stage]->files) {
    const std::string found = outputs.contains(file) ? outputs.at(file).get<std::string>() : "";
    if (found.empty() || found == digest) {
      add(scan, stage, file, digest, found, found.empty() ? FileVerdict::missing : FileVerdict::same);
      continue;
    }
    FileVerdict verdict = FileVerdict::differs;
    std::error_code error;
    if (holds_times(file) && !fs::is_regular_file(crate_ / place / file, error))
      verdict = FileVerdict::not_compared;
    else if (holds_times(file) && same_but_for_times(crate_ / place / file, made_ / place / file))
      verdict = FileVerdict::but_for_times;
    add(scan, stage, file, digest, found, verdict);
  }
}

void Reproducing::do_step(const RecordedScan& scan, std::size_t stage) {
  const RecordedStep& step = *scan.steps[stage];
  check_chain(step.chain);
  const std::optional<fs::path> read = read_by(scan, stage);
  const fs::path folder = made_ / place_of(stage, scan.pseudonym);
  std::optional<json> manifest;
  if (read && is_result(run_(crate_ / step.chain, folder, values_of(scan, stage, *read))))
    manifest = json::parse(pipeline::manifest_of(folder), nullptr, false);
  if (manifest && !manifest->is_object()) manifest.reset();
  if (manifest && stage == first_stage)
    for (const json& digest : manifest->at("inputs"))
      if (!step.read.contains(digest.get<std::string>()))
        add(scan, stage, "the scan itself", *step.read.begin(), digest, FileVerdict::differs);
  compare(scan, stage, manifest);
  ++out_.steps;
}

void Reproducing::take(const RecordedScan& scan, const core::TaskContext& task) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    task.throw_if_cancelled();
    if (!scan.steps[i]) continue;
    if (i == first_stage && !sources_)
      for (const auto& [file, digest] : scan.steps[i]->files)
        add(scan, i, file, digest, "", FileVerdict::not_compared);
    else
      do_step(scan, i);
  }
  ++out_.scans;
}

void write_verdicts(const fs::path& file, const std::vector<ReproducedFile>& files) {
  std::string text = core::csv_line({"scan", "stage", "file", "recorded", "found", "verdict"});
  for (const ReproducedFile& one : files)
    text += core::csv_line({one.scan, one.stage, one.file, one.recorded, one.found, name_of(one.verdict)});
  core::write_file(file, text);
}

}  // namespace

std::string name_of(FileVerdict verdict) {
  constexpr std::array names{"same", "same but for times", "differs", "missing", "not compared"};
  static_assert(names.size() == file_verdict_count);
  return names[static_cast<std::size_t>(verdict)];
}

std::size_t Reproduction::count(FileVerdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(files, verdict, &ReproducedFile::verdict));
}

bool Reproduction::is_same() const {
  return count(FileVerdict::differs) == 0 && count(FileVerdict::missing) == 0;
}

Reproduction reproduce(const ReproductionOptions& options, const ChainRun& run,
                       const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  const RecordedCrate recorded = read_crate(options.crate, options.only);
  pipeline::require_free_folder(options.output);
  const bool is_told = !options.private_folder.empty();
  const fs::path hidden = is_told ? options.private_folder : private_folder_of(options.crate);
  std::optional<Sources> sources;
  if (is_told || fs::exists(hidden / "sources.sqlite")) sources.emplace(hidden);
  core::StagedFolder staged(options.output);
  Reproducing work(fs::absolute(options.crate), recorded, sources ? &*sources : nullptr,
                   fs::absolute(staged.temporary()), run);
  double done = 0.0;
  for (const RecordedScan& scan : recorded.scans) {
    work.take(scan, task);
    task.set_progress(++done / static_cast<double>(recorded.scans.size()));
  }
  Reproduction out = work.result();
  out.programs.assign(recorded.programs.begin(), recorded.programs.end());
  write_verdicts(staged.temporary() / "files.csv", out.files);
  pipeline::ManifestRecord record;
  record.key = {"cohort reproduce", {{"crate", core::sha256_file(options.crate / crate_name)}}, "{}"};
  record.exit_code = out.is_same() ? ExitCode::ok : ExitCode::quality_failed;
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
  return out;
}

}  // namespace ostia::cohort
