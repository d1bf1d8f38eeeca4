#pragma once
/// \file What a person says of a scan's case: it may be used, or must be looked at again.

#include "ostia/cohort/cohort.h"
#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::cohort {

/// The stage whose result is reviewed.
inline constexpr std::size_t reviewed_stage = stage_of("extract");

enum class Verdict {
  none,  ///< what was said before is taken back
  ok,
  again,
};
std::string name_of(Verdict verdict);
std::optional<Verdict> verdict_named(std::string_view name);

struct Review {
  std::string scan;  ///< pseudonym
  Verdict verdict = Verdict::none;
  std::string reader;  ///< who says so
  std::string time;    ///< 2026-03-01T12:00:00Z, by that person's clock
  std::string made;    ///< the first digits, 16 or more, of the digest that the case had when it was made
};

/// Reads the JSON that the cohort's page exports (schema docs/schemas/cohort-reviews.schema.json). Throws
/// InvalidInput that names `shown` and the entry.
std::vector<Review> parse_reviews(std::string_view text, const std::string& shown);

struct TakenReviews {
  std::size_t ok = 0, again = 0, taken_back = 0;
  std::vector<std::string> left_out;  ///< scans whose case is not there, or was made anew since
};

/// Adds them to the cohort, in their order; the last of a scan is the one that holds. What was said is kept
/// with the digest of the case as it lies there now, which a person may have corrected. Throws InvalidInput
/// where one names a scan that the cohort does not have (nothing is taken then), ResourceError where another
/// program is at work in it, IoError, Cancelled.
TakenReviews take_reviews(const std::filesystem::path& cohort, const std::vector<Review>& reviews,
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
