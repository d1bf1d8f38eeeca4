#include "ostia/cohort/page.h"

#include "page_files.h"
#include "page_text.h"
#include "review_list.h"
#include "shown_measures.h"
#include "status_counter.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::size_t rows_of_a_block = 2000, scans_of_an_index = 65536;

/// 0: not known; else the bin from 1 on.
int bin_of(const ShownMeasure& measure, double value) {
  if (!std::isfinite(value)) return 0;
  const double at = std::floor((value - measure.from) / measure.step);
  return 1 + static_cast<int>(std::clamp(at, 0.0, measure.bins - 1.0));
}

/// One printable character, none of which needs an escape within a JavaScript text.
char digit_of(std::size_t value) {
  constexpr std::string_view digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
  return digits[value];
}

std::string number_or_null(double value) {
  return std::isfinite(value) ? core::significant_text(value, 4) : "null";
}

void write_block(const fs::path& folder, const std::string& name, const std::string& text) {
  std::ofstream stream(folder / (name + ".js"), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw ResourceError("cannot write the cohort's page: the disk is full, or out of order");
}

class PageData {
 public:
  PageData(const fs::path& folder, std::size_t refused) : folder_(folder), counter_(refused) {
    for (std::size_t i = 0; i < bins_.size(); ++i)
      bins_[i].resize(static_cast<std::size_t>(shown_measures[i].bins));
  }
  void take(const CohortScan& scan, const Outcome& outcome);
  /// What stands above all scans; call it last.
  void close(const OpenCohort& cohort);
  std::size_t scans() const { return scans_; }
  std::size_t files() const { return blocks_ + indices_ + 2; }

 private:
  std::size_t set_of(const std::vector<std::size_t>& failures);
  void add_to_index(const CohortScan& scan, std::size_t set, const Outcome& outcome);
  void add_row(const CohortScan& scan, const Outcome& outcome);
  void write_rows();
  void write_index();
  json summary(const OpenCohort& cohort) const;

  fs::path folder_;
  StatusCounter counter_;
  std::map<std::vector<std::size_t>, std::size_t> sets_{{{}, 0}};  ///< of failures that one scan has
  std::array<std::vector<std::size_t>, shown_measures.size()> bins_;
  std::map<std::string, std::size_t> rows_of_examples_;
  std::string rows_, index_;
  std::size_t scans_ = 0, blocks_ = 0, indices_ = 0;
};

std::size_t PageData::set_of(const std::vector<std::size_t>& failures) {
  constexpr std::size_t most_sets = 64 * 64 - 1;  // two characters; the last one is for all others
  const auto known = sets_.find(failures);
  if (known != sets_.end()) return known->second;
  if (sets_.size() >= most_sets) return most_sets;
  return sets_.emplace(failures, sets_.size()).first->second;
}

void PageData::take(const CohortScan& scan, const Outcome& outcome) {
  const std::size_t before = counter_.reasons().size();
  const std::vector<std::size_t> failures = counter_.take(scan);
  if (counter_.reasons().size() > before) rows_of_examples_.emplace(scan.pseudonym, scans_);
  add_to_index(scan, set_of(failures), outcome);
  add_row(scan, outcome);
  ++scans_;
  if (scans_ % rows_of_a_block == 0) write_rows();
  if (scans_ % scans_of_an_index == 0) write_index();
}

void PageData::add_to_index(const CohortScan& scan, std::size_t set, const Outcome& outcome) {
  for (const StageResult& one : scan.results) index_ += digit_of(static_cast<std::size_t>(one.state));
  index_ += digit_of(set / 64);
  index_ += digit_of(set % 64);
  for (std::size_t i = 0; i < shown_measures.size(); ++i) {
    const int bin = bin_of(shown_measures[i], outcome.*shown_measures[i].value);
    index_ += digit_of(static_cast<std::size_t>(bin));
    if (bin > 0) ++bins_[i][static_cast<std::size_t>(bin - 1)];
  }
  index_ += scan.pseudonym.substr(2, 4);
}

void PageData::add_row(const CohortScan& scan, const Outcome& outcome) {
  const StageResult& reviewed = scan.results[reviewed_stage];
  const std::string made = is_done(reviewed.state) ? (scan.review ? scan.review->made : reviewed.result) : "";
  rows_ += rows_.empty() ? "[" : ",\n[";
  for (const std::string* text : {&scan.pseudonym, &scan.patient, &scan.kind}) rows_ += '"' + *text + "\",";
  rows_ += '"' + made.substr(0, shown_digest_digits) + "\"," + json(outcome.cad_rads).dump();
  for (const ShownMeasure& measure : shown_measures) rows_ += "," + number_or_null(outcome.*measure.value);
  rows_ += "]";
}

void PageData::write_rows() {
  if (rows_.empty()) return;
  write_block(folder_, "rows-" + std::to_string(blocks_),
              page_data("rows", std::to_string(blocks_) + ",[" + rows_ + "]"));
  rows_.clear();
  ++blocks_;
}

void PageData::write_index() {
  if (index_.empty()) return;
  write_block(folder_, "index-" + std::to_string(indices_),
              page_data("index", std::to_string(indices_) + ",\"" + index_ + "\""));
  index_.clear();
  ++indices_;
}

json PageData::summary(const OpenCohort& cohort) const {
  const CohortStatus status = counter_.result();
  json all{{"v", 1},
           {"program", "ostia " + core::version()},
           {"cohort", cohort.table_digest().substr(0, shown_digest_digits)},
           {"scans", status.scans},
           {"refused", status.refused},
           {"whole", status.whole},
           {"rows_of_a_block", rows_of_a_block},
           {"scans_of_an_index", scans_of_an_index}};
  all["states"] = json::array();
  for (std::size_t s = 0; s < stage_state_count; ++s)
    all["states"].push_back(name_of(static_cast<StageState>(s)));
  for (std::size_t i = 0; i < stages.size(); ++i)
    all["stages"].push_back({{"name", stages[i].name},
                             {"counts", status.stages[i].scans},
                             {"seconds", status.stages[i].seconds},
                             {"peak_mb", status.stages[i].peak_mb}});
  all["reasons"] = json::array();
  for (const FailureReason& one : counter_.reasons())
    all["reasons"].push_back({{"stage", one.stage},
                              {"exit_code", one.exit_code},
                              {"reason", one.reason},
                              {"scans", one.scans},
                              {"example", one.example},
                              {"row", rows_of_examples_.at(one.example)}});
  all["sets"] = json::array();
  for (const auto& [failures, number] : sets_) all["sets"].push_back({number, failures});
  for (std::size_t i = 0; i < shown_measures.size(); ++i) {
    const ShownMeasure& one = shown_measures[i];
    all["measures"].push_back({{"name", one.name},
                               {"title", one.title},
                               {"unit", one.unit},
                               {"from", one.from},
                               {"step", one.step},
                               {"bins", bins_[i]}});
  }
  return all;
}

void PageData::close(const OpenCohort& cohort) {
  write_rows();
  write_index();
  // A message may have bytes that are no UTF-8.
  const std::string text = summary(cohort).dump(-1, ' ', false, json::error_handler_t::replace);
  write_block(folder_, "summary", page_data("summary", text));
  write_block(folder_, "reviews", review_list(cohort));
}

}  // namespace

PageResult write_page(const fs::path& folder, const core::TaskContext& task) {
  const OpenCohort cohort(folder);
  core::StagedFolder staged(folder / page_folder);
  fs::create_directory(staged.temporary() / "data");
  PageData data(staged.temporary() / "data", cohort.count("refused"));
  Outcomes outcomes(cohort);
  cohort.for_each({}, task, [&](const CohortScan& scan) { data.take(scan, outcomes.of(scan)); });
  data.close(cohort);
  core::write_file(staged.temporary() / "index.html", page_text);
  staged.commit();
  return {data.scans(), data.files() + 1, folder / page_folder / "index.html"};
}

}  // namespace ostia::cohort
