#include "review_list.h"

#include "page_files.h"

#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>

namespace ostia::cohort {

std::string review_list(const OpenCohort& cohort) {
  using nlohmann::json;
  json rows = json::array();
  json readers = json::array();
  std::map<std::string, std::size_t> numbers;
  if (cohort.has_later_tables()) {
    Query reviews(
        cohort.store(),
        "SELECT r.scan, r.verdict, r.reader, r.time FROM review r JOIN stage s ON s.scan = r.scan AND "
        "s.stage = ? AND s.result = r.made WHERE r.number = (SELECT max(number) FROM review WHERE "
        "scan = r.scan) ORDER BY r.scan");
    reviews.with(reviewed_stage);
    while (reviews.step()) {
      if (reviews.text(1) == name_of(Verdict::none)) continue;
      const auto [reader, is_new] = numbers.try_emplace(reviews.text(2), numbers.size());
      if (is_new) readers.push_back(reader->first);
      rows.push_back({reviews.integer(0) - 1, reviews.text(1), reader->second, reviews.text(3)});
    }
  }
  return page_data("reviews", json{{"readers", readers}, {"rows", rows}}.dump());
}

void rewrite_review_list(const OpenCohort& cohort) {
  const std::filesystem::path file = cohort.folder() / page_folder / "data/reviews.js";
  if (std::filesystem::is_regular_file(file)) core::write_file(file, review_list(cohort));
}

}  // namespace ostia::cohort
