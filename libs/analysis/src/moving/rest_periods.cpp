#include "moving/motion_parts.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr std::size_t most_periods = 4;

/// From a phase on, as far as distances allow.
RestPeriod period_from(const PhaseDistances& distances, const std::vector<double>& phases, std::size_t start,
                       double bound_mm) {
  const std::size_t count = phases.size();
  const auto at = [&](std::size_t k) { return phases[k % count] + (k >= count ? 1.0 : 0.0); };
  RestPeriod period{phases[start], phases[start], 0.0};
  for (std::size_t k = start + 1; k <= start + count; ++k) {
    double farthest = period.motion_mm;
    for (std::size_t before = start; before < k; ++before)
      farthest = std::max(farthest, distances[before % count][k % count]);
    if (farthest > bound_mm) {
      const double share = (bound_mm - period.motion_mm) / (farthest - period.motion_mm);
      period.to += share * (at(k) - period.to);
      period.motion_mm = bound_mm;
      return period;
    }
    period.to = at(k);
    period.motion_mm = farthest;
  }
  return period;
}

bool overlap(const RestPeriod& a, const RestPeriod& b) {
  for (const double turn : {-1.0, 0.0, 1.0})
    if (a.from < b.to + turn && b.from + turn < a.to) return true;
  return false;
}

}  // namespace

PhaseDistances phase_distances(const MovingBranch& branch) {
  const std::size_t count = branch.places.size();
  const std::vector<double> shares = length_shares(branch.s_mm);
  PhaseDistances distances(count, std::vector<double>(count, 0.0));
  core::parallel_for(count, 4, [&](std::size_t i) {
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t p = 0; p < shares.size() && j != i; ++p)
        distances[i][j] += shares[p] * (branch.places[i][p] - branch.places[j][p]).norm();
  });
  return distances;
}

std::vector<RestPeriod> rest_periods(const PhaseDistances& distances, const std::vector<double>& phases,
                                     double bound_mm) {
  const std::size_t count = phases.size();
  std::vector<RestPeriod> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(period_from(distances, phases, k, bound_mm));
  const auto span = [](const RestPeriod& p) { return p.to - p.from; };
  if (span(all.front()) >= 1.0 - 1e-12) return {all.front()};  // it never leaves
  std::vector<RestPeriod> candidates;
  for (std::size_t k = 0; k < count; ++k) {
    const double before = span(all[(k + count - 1) % count]), after = span(all[(k + 1) % count]);
    if (span(all[k]) >= before && span(all[k]) >= after) candidates.push_back(all[k]);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const RestPeriod& a, const RestPeriod& b) { return span(a) > span(b); });
  std::vector<RestPeriod> chosen;
  for (const RestPeriod& one : candidates)
    if (chosen.size() < most_periods &&
        std::none_of(chosen.begin(), chosen.end(),
                     [&](const RestPeriod& other) { return overlap(one, other); }))
      chosen.push_back(one);
  return chosen;
}

}  // namespace ostia::analysis
