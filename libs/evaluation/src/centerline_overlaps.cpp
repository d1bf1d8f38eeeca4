#include "centerline_overlaps.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <limits>

namespace ostia::evaluation {
namespace {

/// The paper's: up to the first point of the reference none of whose pairs counts.
double until_first_missed_point(const std::vector<ReferencePointScore>& points, double free_start_mm) {
  std::size_t matched = 0;
  for (const ReferencePointScore& p : points) {
    if (!p.matched && p.s_mm >= free_start_mm) break;
    matched += p.matched;
  }
  return static_cast<double>(matched) / static_cast<double>(points.size());
}

/// The challenge's program's: what lies before the point of the reference at which a pair fails first.
double until_first_failing_pair(const std::vector<ReferencePointScore>& points,
                                const std::vector<PointPair>& pairs, double free_start_mm) {
  const auto failing = std::find_if(pairs.begin(), pairs.end(), [&](const PointPair& p) {
    return !p.counts && points[p.reference].s_mm >= free_start_mm;
  });
  const std::size_t end = failing == pairs.end() ? points.size() : failing->reference;
  const auto matched = std::count_if(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(end),
                                     [](const ReferencePointScore& p) { return p.matched; });
  return static_cast<double>(matched) / static_cast<double>(points.size());
}

}  // namespace

double OverlapCounts::overlap() const {
  const double all = static_cast<double>(tpr + fn + tpm + fp);
  return all > 0.0 ? static_cast<double>(tpr + tpm) / all : 0.0;
}

OverlapCounts overlap_counts(const std::vector<PointPair>& pairs, std::size_t count) {
  std::vector<signed char> reference, candidate;
  const auto mark = [](std::vector<signed char>& list, std::size_t at, bool counts) {
    if (list.size() <= at) list.resize(at + 1, -1);
    list[at] = std::max<signed char>(list[at], counts ? 1 : 0);
  };
  for (std::size_t k = 0; k < count; ++k) {
    mark(reference, pairs[k].reference, pairs[k].counts);
    mark(candidate, pairs[k].candidate, pairs[k].counts);
  }
  OverlapCounts counts;
  for (const signed char c : reference) ++(c == 1 ? counts.tpr : counts.fn);
  for (const signed char c : candidate) ++(c == 1 ? counts.tpm : counts.fp);
  return counts;
}

double overlap_until_first_failure(const io::RotterdamReference& reference, const CenterlineScores& scores,
                                   const CenterlineScoreOptions& options) {
  const std::vector<ReferencePointScore> points = along_reference(reference, scores);
  return options.rules == OverlapRules::paper
             ? until_first_missed_point(points, options.free_start_mm)
             : until_first_failing_pair(points, scores.pairs, options.free_start_mm);
}

double overlap_where_wide(const io::RotterdamReference& reference, const std::vector<PointPair>& pairs,
                          const CenterlineScoreOptions& options) {
  const auto wide = std::find_if(reference.radius.rbegin(), reference.radius.rend(),
                                 [&](double r) { return r >= options.least_radius_mm; });
  if (wide == reference.radius.rend()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<std::size_t>(reference.radius.rend() - wide) - 1;
  // Pairs come in the reference's order, and each of its points has one at least.
  auto end =
      std::find_if(pairs.begin(), pairs.end(), [&](const PointPair& p) { return p.reference == last; });
  if (options.rules == OverlapRules::paper) {
    while (end != pairs.end() && end->reference == last) ++end;
  } else if (end != pairs.end()) {
    ++end;
  }
  return overlap_counts(pairs, static_cast<std::size_t>(end - pairs.begin())).overlap();
}

}  // namespace ostia::evaluation
