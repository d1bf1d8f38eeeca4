#include "ostia/analysis/scct_segments.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>

namespace ostia::analysis {
namespace {

constexpr std::array dominances{Dominance::unknown, Dominance::right, Dominance::left, Dominance::codominant};
constexpr int right_pda = 4, left_pda = 15, left_plb = 18;

}  // namespace

std::string to_string(Dominance dominance) {
  switch (dominance) {
    case Dominance::unknown:
      return "unknown";
    case Dominance::right:
      return "right";
    case Dominance::left:
      return "left";
    case Dominance::codominant:
      break;
  }
  return "co-dominant";
}

Dominance dominance(const std::string& text) {
  for (const Dominance one : dominances)
    if (to_string(one) == text) return one;
  throw InvalidInput("the dominance is \"" + text + "\"; it can be unknown, right, left or co-dominant");
}

Dominance dominance_of(const std::vector<VesselSegment>& segments) {
  const auto has = [&](int number) {
    return std::any_of(segments.begin(), segments.end(),
                       [=](const VesselSegment& one) { return one.aha && one.aha->number == number; });
  };
  if (has(right_pda)) return has(left_pda) || has(left_plb) ? Dominance::codominant : Dominance::right;
  return has(left_pda) ? Dominance::left : Dominance::unknown;
}

}  // namespace ostia::analysis
