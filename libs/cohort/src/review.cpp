#include "ostia/cohort/review.h"

#include "review_list.h"
#include "stage_results.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/utf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::size_t longest_reader_name = 100;
constexpr std::size_t fewest_digest_digits = 16, most_digest_digits = 64;

bool is_plain_name(const std::string& text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
  return !text.empty() && text.size() <= longest_reader_name && core::is_utf8(text) &&
         std::ranges::none_of(text, is_control);
}

/// "2026-03-01T12:00:00Z": its form alone, since clocks may be wrong.
bool is_time(const std::string& text) {
  constexpr std::string_view form = "0000-00-00T00:00:00Z";
  return text.size() == form.size() && std::ranges::equal(text, form, [](char c, char like) {
           return like == '0' ? c >= '0' && c <= '9' : c == like;
         });
}

bool is_digest(const std::string& text) {
  return text.size() >= fewest_digest_digits && text.size() <= most_digest_digits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Review review_of(const json& entry) {
  Review out;
  const auto refuse = [](const char* member, const char* should) {
    throw InvalidInput(std::string("its \"") + member + "\" should be " + should);
  };
  const auto text = [&](const char* member) {
    if (!entry.is_object() || !entry.contains(member) || !entry.at(member).is_string())
      refuse(member, "a text");
    return entry.at(member).get<std::string>();
  };
  out.scan = text("scan");
  const auto verdict = verdict_named(text("verdict"));
  if (!verdict) refuse("verdict", "\"ok\", \"again\" or \"none\"");
  out.verdict = *verdict;
  if (out.reader = text("reader"); !is_plain_name(out.reader))
    refuse("reader", "a name of 100 bytes at the most, in UTF-8 without control characters");
  if (out.time = text("time"); !is_time(out.time)) refuse("time", "of the form 2026-03-01T12:00:00Z");
  if (out.made = text("made"); !is_digest(out.made)) refuse("made", "16 to 64 hexadecimal digits");
  return out;
}

struct Numbered {
  const Review* review;
  std::int64_t scan;
};

std::vector<Numbered> with_numbers(const OpenCohort& cohort, const std::vector<Review>& reviews) {
  std::vector<Numbered> out;
  for (const Review& one : reviews) {
    const std::int64_t number = cohort.number_of(one.scan);
    if (number == 0)
      throw InvalidInput("cannot take the reviews: " + one.scan +
                         " is no scan of this cohort; they were exported from the page of another one");
    out.push_back({&one, number});
  }
  return out;
}

}  // namespace

std::string name_of(Verdict verdict) {
  return verdict == Verdict::ok ? "ok" : verdict == Verdict::again ? "again" : "none";
}

std::optional<Verdict> verdict_named(std::string_view name) {
  for (const Verdict one : {Verdict::none, Verdict::ok, Verdict::again})
    if (name == name_of(one)) return one;
  return std::nullopt;
}

std::vector<Review> parse_reviews(std::string_view text, const std::string& shown) {
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput("cannot use " + shown + ": " + why + "; the page of a cohort exports such a file");
  };
  const json all = json::parse(text, nullptr, false);
  if (!all.is_object() || all.value("kind", json()) != "cohort reviews" || !all.contains("reviews") ||
      !all.at("reviews").is_array())
    refuse("it holds no reviews of a cohort");
  if (all.value("v", json()) != 1) refuse("it is of another version than 1");
  std::vector<Review> out;
  for (const json& entry : all.at("reviews")) {
    try {
      out.push_back(review_of(entry));
    } catch (const InvalidInput& error) {
      refuse("review " + std::to_string(out.size() + 1) + ": " + error.what());
    }
  }
  return out;
}

TakenReviews take_reviews(const fs::path& folder, const std::vector<Review>& reviews,
                          const core::TaskContext& task) {
  const OpenCohort cohort(folder);
  if (!cohort.has_later_tables())
    throw IoError("cannot write reviews into " + folder.string() + ": nobody may write its " + database_name);
  const std::vector<Numbered> numbered = with_numbers(cohort, reviews);
  const Stage& stage = stages[reviewed_stage];
  TakenReviews out;
  std::map<std::string, std::pair<StageResult, std::string>> looked_at;  // a scan's case, and its digest now
  cohort.store().execute("BEGIN IMMEDIATE");
  Query put(cohort.store(),
            "INSERT INTO review(scan, verdict, reader, time, made, result) VALUES(?, ?, ?, ?, ?, ?)");
  for (const auto& [review, number] : numbered) {
    task.throw_if_cancelled();
    const auto [at, is_new] = looked_at.try_emplace(review->scan);
    auto& [made, now] = at->second;
    if (is_new) {
      made = cohort.result_of(review->scan, reviewed_stage);
      if (is_done(made.state)) now = core::sha256_file(folder / stage.folder / review->scan / stage.result);
    }
    if (!is_done(made.state) || !made.result.starts_with(review->made)) {
      out.left_out.push_back(review->scan);
      continue;
    }
    put.with(number, name_of(review->verdict), review->reader, review->time, made.result, now).step();
    ++(review->verdict == Verdict::ok      ? out.ok
       : review->verdict == Verdict::again ? out.again
                                           : out.taken_back);
  }
  cohort.store().execute("COMMIT");
  rewrite_review_list(cohort);
  return out;
}

}  // namespace ostia::cohort
